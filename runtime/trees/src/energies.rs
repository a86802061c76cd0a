//! Energies, powers, momenta and linear modes.

use branched_pendulum::analysis::{EquilibriumError, Modes, ModesError, equilibrium_of_torques};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::spring_dampers::SpringDampers;
use branched_pendulum::system::{Model, Slopes, Workspace, gradient};
use branched_pendulum::translational::TranslationalSpringDampers;

use crate::between::Between;
use crate::bodies::FormBodies;
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

    /// Returns the power (W) of friction and drag, never positive. The angles matter to straight
    /// dampers alone; NaN where the points of one meet.
    #[must_use]
    pub fn friction_power(&self, theta: &[T], omega: &[T]) -> T {
        match self.between().is_empty() {
            true => self.bodies.friction_power(omega),
            false => self.bodies.friction_power(omega) + self.between().power(theta, omega),
        }
    }

    /// Returns the power (W) of torques from outside.
    #[must_use]
    pub fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
        self.bodies.outside_power(omega, torques)
    }

    /// Returns the power (W) of the drive, zero without one: dE/dt of the energy is this
    /// and the powers of friction and of torques from outside.
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

    /// Returns the generalized momenta ∂K/∂ω (kg m²/s). O(links²).
    #[must_use]
    pub fn momenta(&self, theta: &[T], omega: &[T]) -> Vec<T> {
        let bodies = self.bodies.cast(Slopes::<T>::constant);
        self.momenta_of(&bodies, theta, omega)
    }

    fn momenta_of(&self, bodies: &FormBodies<Slopes<T>>, theta: &[T], omega: &[T]) -> Vec<T> {
        // A value that is no number has derivatives of zero.
        if theta.len() != self.links() {
            return vec![T::from_f64(f64::NAN); self.links()];
        }
        let theta: Vec<Slopes<T>> = theta.iter().copied().map(Dual::constant).collect();
        gradient_of(self.links(), omega, |omega, workspace| {
            bodies.kinetic_energy(workspace, &theta, omega)
        })
    }

    /// Returns the mass matrix (kg m²) at angles `theta`, a row for each link: the momenta
    /// of unit velocities. O(links³).
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

    /// Returns the second derivatives (N m/rad) of the potential energy at angles `theta`, a
    /// row for each link. O(links³).
    #[must_use]
    pub fn stiffness_matrix(&self, theta: &[T]) -> Vec<Vec<T>> {
        type Twice<T> = Slopes<Dual<T, 1>>;
        if theta.len() != self.links() {
            return vec![vec![T::from_f64(f64::NAN); self.links()]; self.links()];
        }
        let lift = |value: T| Twice::<T>::constant(Dual::constant(value));
        let (bodies, between) = (self.bodies.cast(lift), self.between().cast(lift));
        let row = |link: usize| {
            let mut point: Vec<Dual<T, 1>> = theta.iter().copied().map(Dual::constant).collect();
            if let Some(own) = point.get_mut(link) {
                *own = Dual::variable(own.value, 0);
            }
            let slopes = gradient_of(self.links(), &point, |theta, workspace| {
                potential_energy(&bodies, &between, workspace, theta)
            });
            slopes.into_iter().map(|slope| slope.tangents[0]).collect()
        };
        (0..self.links()).map(row).collect()
    }
}

impl PendulumTree<f64> {
    /// Returns the linear modes about angles `theta` (rad) at which the tree stays at rest:
    /// zeros, unless springs or lateral offsets hold it elsewhere, where
    /// [`equilibrium`](Self::equilibrium) finds them. Friction and drive are left out.
    ///
    /// # Errors
    /// [`ModesError`] for angles of another number than there are links, for those that are no
    /// equilibrium (with the torques there), and for an unstable one.
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

    /// Returns the angles (rad) near `theta` at which the tree stays at rest, stable or not.
    /// The drive is left out.
    ///
    /// # Errors
    /// [`EquilibriumError`] for angles of another number than there are links, and where none
    /// is found.
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
        equilibrium_of_torques(theta, |theta| {
            Ok((self.stiffness_matrix(theta), self.torques_at_rest(theta)))
        })
    }

    /// The torques −∂U/∂θ on the links.
    fn torques_at_rest(&self, theta: &[f64]) -> Vec<f64> {
        let bodies = self.bodies.cast(Slopes::<f64>::constant);
        let between = self.between().cast(Slopes::<f64>::constant);
        let slopes = gradient_of(self.links(), theta, |theta, workspace| {
            potential_energy(&bodies, &between, workspace, theta)
        });
        slopes.into_iter().map(|slope| -slope).collect()
    }
}

/// Energy of gravity and of all springs.
pub(crate) fn potential_energy<T: Scalar>(
    bodies: &FormBodies<T>,
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

/// Derivatives of a function by its variables. NaN for another number of values than `n`.
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
