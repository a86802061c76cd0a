//! Energies, powers, momenta and linear modes.

use branched_pendulum::analysis::{EquilibriumError, Modes, ModesError, equilibrium_of_torques};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::spring_dampers::SpringDampers;
use branched_pendulum::system::{Model, Slopes, Workspace, gradient};
use branched_pendulum::translational::TranslationalSpringDampers;

use crate::between::Between;
use crate::carried::LinkBodies;
use crate::tree::PendulumTree;

impl<T: Scalar> PendulumTree<T> {
    /// Returns the torsion springs and the friction between links that are not parent and child.
    pub fn spring_dampers(&self) -> &SpringDampers<T> {
        &self.between().torsional
    }

    /// Returns the straight springs and dampers between points of links, and those to the ground.
    pub fn translational_spring_dampers(&self) -> &TranslationalSpringDampers<T> {
        &self.between().translational
    }

    pub(crate) fn between(&self) -> &Between<T> {
        self.equations.between()
    }

    /// Returns the power (W) of friction and drag, which is never positive. It depends on the
    /// angles only if there are straight dampers; NaN if the end points of such a damper meet.
    #[must_use]
    pub fn friction_power(&self, theta: &[T], omega: &[T]) -> T {
        match self.between().is_empty() {
            true => self.bodies.friction_power(omega),
            false => self.bodies.friction_power(omega) + self.between().power(theta, omega),
        }
    }

    /// Returns the power (W) of the external torques (N m).
    #[must_use]
    pub fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
        self.bodies.outside_power(omega, torques)
    }

    /// Returns the power (W) of the drive, zero without one. The rate dE/dt of the energy is the
    /// sum of the powers of drive, friction and external torques.
    #[must_use]
    pub fn drive_power(&self, time: T, theta: &[T], omega: &[T]) -> T {
        let zero = T::from_f64(0.0);
        let drive = match &self.drive {
            Some(drive) => drive.inner(time),
            None => [zero; 3],
        };
        let workspace = &mut Workspace::new();
        self.bodies.drive_power(workspace, drive, theta, omega)
    }

    /// Returns the acceleration x, y (m/s²) of the root's pivot and the torque (N m) on the
    /// root at a time (s) of the drive, if there is one.
    #[must_use]
    pub fn drive(&self, time: T) -> Option<[T; 3]> {
        self.drive.as_ref().map(|drive| drive.at(time))
    }

    /// Returns the generalized momenta ∂K/∂ω (kg m²/s) of the links. O(links²).
    #[must_use]
    pub fn momenta(&self, theta: &[T], omega: &[T]) -> Vec<T> {
        let bodies = self.bodies.cast(Slopes::<T>::constant);
        self.momenta_of(&bodies, theta, omega)
    }

    fn momenta_of(&self, bodies: &LinkBodies<Slopes<T>>, theta: &[T], omega: &[T]) -> Vec<T> {
        // A value that is not a number has derivatives of zero.
        if theta.len() != self.links() {
            return vec![T::from_f64(f64::NAN); self.links()];
        }
        let theta: Vec<Slopes<T>> = theta.iter().copied().map(Dual::constant).collect();
        gradient_of(self.links(), omega, |omega, workspace| {
            bodies.kinetic_energy(workspace, &theta, omega)
        })
    }

    /// Returns the mass matrix (kg m²) at angles `theta` (rad), one row per link: row i contains
    /// the momenta at unit velocity of link i. O(links³).
    #[must_use]
    pub fn mass_matrix(&self, theta: &[T]) -> Vec<Vec<T>> {
        let bodies = self.bodies.cast(Slopes::<T>::constant);
        let row = |link: usize| {
            let mut omega = vec![T::from_f64(0.0); self.links()];
            if let Some(own) = omega.get_mut(link) {
                *own = T::from_f64(1.0);
            }
            self.momenta_of(&bodies, theta, &omega)
        };
        (0..self.links()).map(row).collect()
    }
}

impl PendulumTree<f64> {
    /// Returns the linear modes about equilibrium angles `theta` (rad). They are zeros, unless
    /// springs or lateral offsets cause another equilibrium, which
    /// [`equilibrium`](Self::equilibrium) finds. Friction and drive are neglected.
    ///
    /// # Errors
    /// [`ModesError`] if there is not one angle per link, if the angles are not an equilibrium
    /// (with the torques there), or if it is unstable.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let rod = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 2, length = 0.5)")?;
    /// let modes = rod.modes(&[0.0])?;
    /// let expected = (1.5 * 9.81 / 0.5_f64).sqrt() / std::f64::consts::TAU;
    /// assert!((modes.frequencies_hz[0] - expected).abs() < 1e-14);
    /// assert!(rod.modes(&[0.1]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn modes(&self, theta: &[f64]) -> Result<Modes, ModesError> {
        Modes::at_rest(
            &self.mass_matrix(theta),
            &self.stiffness_matrix(theta),
            &self.torques_at_rest(theta),
        )
    }

    /// Returns equilibrium angles (rad) near `theta`, stable or not, found by Newton's method;
    /// [`stable_equilibrium`](Self::stable_equilibrium) descends to a stable equilibrium. The drive
    /// is neglected.
    ///
    /// # Errors
    /// [`EquilibriumError`] if there is not one angle per link, or if no equilibrium is found.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let reed = PendulumTree::parse(
    ///     "gravity = 9.81, reed: rod(mass = 0.1, length = 0.3, spring = 0.2, rest = 1)",
    /// )?;
    /// let theta = reed.equilibrium(&[0.0])?;
    /// assert!(reed.accelerations(0.0, &theta, &[0.0])[0].abs() < 1e-12);
    /// assert!(reed.modes(&theta).is_ok());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn equilibrium(&self, theta: &[f64]) -> Result<Vec<f64>, EquilibriumError> {
        // Without torques nothing is solved: a matrix of all links takes memory and time.
        if self
            .torques_at_rest(theta)
            .iter()
            .all(|torque| *torque == 0.0)
        {
            return Ok(theta.to_vec());
        }
        equilibrium_of_torques(theta, |theta| {
            Ok((self.stiffness_matrix(theta), self.torques_at_rest(theta)))
        })
    }
}

/// Returns the potential energy (J) of gravity and of all springs.
pub(crate) fn potential_energy<T: Scalar>(
    bodies: &LinkBodies<T>,
    between: &Between<T>,
    workspace: &mut Workspace<T>,
    theta: &[T],
) -> T {
    let energy = bodies.potential_energy(workspace, theta);
    match between.is_empty() {
        true => energy,
        false => energy + between.energy(theta),
    }
}

/// Returns the derivatives of a function by its variables; NaN if the number of values is not `n`.
fn gradient_of<T: Scalar>(
    n: usize,
    values: &[T],
    function: impl Fn(&[Slopes<T>], &mut Workspace<Slopes<T>>) -> Slopes<T>,
) -> Vec<T> {
    let mut slopes = vec![T::from_f64(f64::NAN); n];
    if values.len() == n {
        let mut workspace = Workspace::new();
        gradient(values, &mut slopes, |point| function(point, &mut workspace));
    }
    slopes
}
