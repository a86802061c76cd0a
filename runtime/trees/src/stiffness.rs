//! First and second derivatives of the potential energy: torques at rest, and stiffness.

use branched_pendulum::analysis::{
    Equilibrium, EquilibriumError, PotentialEnergy, Stiffness, equilibria, equilibrium_at,
    stable_equilibrium,
};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::system::{Energy, Model, Slopes, gradient};
use branched_pendulum::translational::{
    LineArm, TranslationalSpringDamper, TranslationalSpringDampers,
};

use crate::tree::PendulumTree;

/// Receives derivatives of the potential energy and adds them up.
trait DerivativeSink<T> {
    /// Adds a derivative by the angle of a link, in N m.
    fn first(&mut self, link: usize, slope: T);
    /// Adds a second derivative by the angles of two links, in N m/rad. A pair of different links
    /// is visited only once.
    fn second(&mut self, links: [usize; 2], stiffness: T);
}

impl<T: Scalar> PendulumTree<T> {
    /// Visits all terms of the derivatives of the potential energy. The cost is proportional to the
    /// number of links, plus the number of pairs with springs, plus the squared number of arms of
    /// each straight spring. Returns false, without a visit, if `theta` does not have one angle per
    /// link.
    fn visit_derivatives(&self, theta: &[T], sink: &mut impl DerivativeSink<T>) -> bool {
        let is_whole = self.bodies.potential_energy_slopes(theta, |own| {
            sink.first(own.link, own.first[0]);
            sink.second([own.link; 2], own.second[0]);
            if let Some(parent) = own.parent {
                sink.first(parent, own.first[1]);
                sink.second([own.link, parent], own.second[1]);
                sink.second([parent; 2], own.second[2]);
            }
        });
        if !is_whole {
            return false;
        }
        let between = self.between();
        if !between.torsional.is_empty() {
            let mut slopes = vec![T::from_f64(0.0); theta.len()];
            between.torsional.add_spring_slopes(theta, &mut slopes);
            for (link, slope) in slopes.into_iter().enumerate() {
                sink.first(link, slope);
            }
            for own in between.torsional.iter() {
                let [one, other] = own.links;
                sink.second([one; 2], own.spring);
                sink.second([other; 2], own.spring);
                sink.second([one, other], -own.spring);
            }
        }
        for line in between.translational.iter() {
            visit_line(&line, theta, sink);
        }
        true
    }

    /// Returns the torques −∂U/∂θ on the links at rest; NaN if `theta` does not have one angle per
    /// link.
    pub(crate) fn torques_at_rest(&self, theta: &[T]) -> Vec<T> {
        struct Torques<T>(Vec<T>);
        impl<T: Scalar> DerivativeSink<T> for Torques<T> {
            fn first(&mut self, link: usize, slope: T) {
                if let Some(own) = self.0.get_mut(link) {
                    *own = *own - slope;
                }
            }
            fn second(&mut self, _: [usize; 2], _: T) {}
        }
        let mut torques = Torques(vec![T::from_f64(0.0); self.links()]);
        match self.visit_derivatives(theta, &mut torques) {
            true => torques.0,
            false => vec![T::from_f64(f64::NAN); self.links()],
        }
    }

    /// Returns the second derivatives (N m/rad) of the potential energy at the angles `theta`, with
    /// one row for each link. O(links²).
    #[must_use]
    pub fn stiffness_matrix(&self, theta: &[T]) -> Vec<Vec<T>> {
        struct Rows<T>(Vec<Vec<T>>);
        impl<T: Scalar> DerivativeSink<T> for Rows<T> {
            fn first(&mut self, _: usize, _: T) {}
            fn second(&mut self, [one, other]: [usize; 2], stiffness: T) {
                let mut add = |row: usize, column: usize| {
                    if let Some(own) = self.0.get_mut(row).and_then(|row| row.get_mut(column)) {
                        *own = *own + stiffness;
                    }
                };
                add(one, other);
                if one != other {
                    add(other, one);
                }
            }
        }
        let n = self.links();
        let mut rows = Rows(vec![vec![T::from_f64(0.0); n]; n]);
        match self.visit_derivatives(theta, &mut rows) {
            true => rows.0,
            false => vec![vec![T::from_f64(f64::NAN); n]; n],
        }
    }
}

/// Visits the derivatives of the energy of one straight spring by the angles on which its length
/// depends.
fn visit_line<T: Scalar>(
    line: &TranslationalSpringDamper<T>,
    theta: &[T],
    sink: &mut impl DerivativeSink<T>,
) {
    let arms = line.arms.iter().enumerate();
    let own = TranslationalSpringDamper {
        arms: arms.map(|(link, arm)| LineArm { link, ..*arm }).collect(),
        ..line.clone()
    };
    let n = own.arms.len();
    let nan = T::from_f64(f64::NAN);
    let angle = |arm: &LineArm<T>| theta.get(arm.link).copied().unwrap_or(nan);
    let angles: Vec<T> = line.arms.iter().map(angle).collect();
    let Some(lines) = TranslationalSpringDampers::new(n, vec![own]) else {
        return;
    };
    let lines = lines.cast(|value| Slopes::constant(Dual::<T, 1>::constant(value)));
    for (column, by) in line.arms.iter().enumerate() {
        let lift = |(place, &angle): (usize, &T)| match place == column {
            true => Dual::<T, 1>::variable(angle, 0),
            false => Dual::constant(angle),
        };
        let point: Vec<Dual<T, 1>> = angles.iter().enumerate().map(lift).collect();
        let mut slopes = vec![Dual::constant(nan); n];
        gradient(&point, &mut slopes, |point| lines.energy(point));
        for (row, (arm, slope)) in line.arms.iter().zip(slopes).enumerate() {
            if row == column {
                sink.first(arm.link, slope.value);
            }
            if row <= column {
                sink.second([arm.link, by.link], slope.tangents[0]);
            }
        }
    }
}

impl PotentialEnergy for PendulumTree<f64> {
    fn angles(&self) -> usize {
        self.links()
    }

    fn energy(&self, theta: &[f64]) -> f64 {
        self.potential_energy_of(theta)
    }

    fn torques_and_stiffness(&self, theta: &[f64]) -> (Vec<f64>, Stiffness) {
        struct Both(Vec<f64>, Stiffness);
        impl DerivativeSink<f64> for Both {
            fn first(&mut self, link: usize, slope: f64) {
                if let Some(own) = self.0.get_mut(link) {
                    *own -= slope;
                }
            }
            fn second(&mut self, links: [usize; 2], stiffness: f64) {
                self.1.add(links, stiffness);
            }
        }
        let n = self.links();
        let mut both = Both(vec![0.0; n], Stiffness::zeros(n));
        if !self.visit_derivatives(theta, &mut both) {
            both.0.fill(f64::NAN);
        }
        (both.0, both.1)
    }
}

impl PendulumTree<f64> {
    /// Returns the equilibrium to which the tree descends from angles `theta` (rad), with its
    /// stability. From a saddle it descends in a direction in which the energy falls. The drive
    /// is left out.
    ///
    /// # Errors
    /// [`EquilibriumError`] if the number of angles is wrong or the descent does not converge.
    ///
    /// # Examples
    ///
    /// A standing rod whose spring is too weak to hold it upright:
    ///
    /// ```
    /// use branched_pendulum::analysis::Stability;
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let rod = PendulumTree::parse(
    ///     "gravity = -9.81, r: rod(mass = 0.4, length = 0.5, spring = 0.9)",
    /// )?;
    /// let rest = rod.stable_equilibrium(&[0.0])?;
    /// assert_eq!(rest.stability, Stability::Stable);
    /// assert!((rest.theta[0].abs() - 0.71286).abs() < 1e-5);
    /// assert!(rod.modes(&rest.theta).is_ok());
    /// // Both sides, and the unstable equilibrium between them.
    /// assert_eq!(rod.equilibria()?.len(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stable_equilibrium(&self, theta: &[f64]) -> Result<Equilibrium, EquilibriumError> {
        match theta.len() == self.links() {
            true => stable_equilibrium(self, theta),
            false => Err(EquilibriumError::NotFinite),
        }
    }

    /// Returns the angles `theta` (rad) as an equilibrium if the tree stays at rest there, that is,
    /// if each torque vanishes after changing the angles by at most `missed` (rad). The drive is
    /// ignored.
    pub fn equilibrium_at(&self, theta: &[f64], missed: f64) -> Option<Equilibrium> {
        equilibrium_at(self, theta, missed)
    }

    /// Returns the equilibria found: first the stable one to which the tree descends from zero
    /// angles, then the other stable ones by ascending energy, and finally the unstable one close
    /// to zero angles, if there is one. Stable ones with small basins may be missed, as
    /// [`equilibria`](branched_pendulum::analysis::equilibria) explains. The drive is ignored.
    ///
    /// # Errors
    /// [`EquilibriumError`] if no descent converges.
    pub fn equilibria(&self) -> Result<Vec<Equilibrium>, EquilibriumError> {
        equilibria(self)
    }
}
