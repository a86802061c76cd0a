//! Trees in thermal equilibrium: random velocities for a temperature, and the mean energies of the
//! scales.
//!
//! At temperature T the momenta for given angles are normally distributed with the covariance kT
//! M(θ), and so are the angular velocities with kT M⁻¹. The kinetic energy of scale s, ½ ωᵀ K_s ω
//! with Σ K_s = M, has the mean ½ kT tr K_s M⁻¹ at these angles (T. Konishi and T. Yanagita,
//! arXiv:0811.4637 and 2111.11677: generalised equipartition). If the copies are not in phase, this
//! is not ½ kT for each degree of freedom of the scale; the sum over all scales is ½ kT N.

use std::sync::Arc;

use branched_pendulum::ScaleBudget;
use branched_pendulum::system::{LinkPoint, Model, Pendulum, Positions, Workspace};
use branched_pendulum_codegen::scene::Quantity;

use crate::description::TreeDescription;
use crate::error::TreeError;
use crate::tree::PendulumTree;

impl PendulumTree<f64> {
    /// Returns the tree without friction, drag and drive. Springs and gravity remain; they conserve
    /// the energy.
    ///
    /// # Errors
    /// Does not occur for an existing tree, since its values have been checked before.
    pub fn conservative(&self) -> Result<Self, TreeError> {
        let mut scene = self.description().scene.as_ref().clone();
        scene.drive = None;
        let links = scene.links.iter_mut().map(|link| &mut link.passive);
        let spring_dampers = scene.spring_dampers.iter_mut().map(|own| &mut own.torques);
        for passive in links.chain(spring_dampers) {
            *passive = passive.frictionless();
        }
        scene
            .spring_dampers
            .retain(|own| !own.torques.spring.is_zero());
        for own in &mut scene.translational {
            own.friction = Quantity::zero();
        }
        scene.translational.retain(|own| !own.potentials.is_empty());
        let scene = Arc::new(scene);
        Self::of(TreeDescription { scene }, self.described.values().to_vec())
    }

    /// Writes random angular velocities (rad/s) for kT = 1 J, with the covariance M⁻¹; multiply
    /// them by √(kT) for another temperature. `normal` contains three independent standard normal
    /// numbers for each link: the momenta that its body would have without joints, which the
    /// function projects onto the motions that the joints allow. Writes NaN if a slice has a wrong
    /// length. O(links).
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// // Of one rod the kinetic energy is half of the square of one normal number.
    /// let rod = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 0.2, length = 0.5)")?;
    /// let mut omega = [0.0];
    /// let inertia = 0.2 * 0.5 * 0.5 / 3.0_f64;
    /// let mut mean = 0.0;
    /// for normal in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
    ///     rod.thermal_velocities(&[0.3], &normal, &mut omega);
    ///     mean += 0.5 * inertia * omega[0] * omega[0];
    /// }
    /// assert!((mean - 0.5).abs() < 1e-12);
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    pub fn thermal_velocities(&self, theta: &[f64], normal: &[f64], omega: &mut [f64]) {
        let links = self.links();
        if [theta.len(), omega.len(), normal.len()] != [links, links, 3 * links] {
            return omega.fill(f64::NAN);
        }
        let (mut forces, mut spins) = (Vec::with_capacity(links), Vec::with_capacity(links));
        for (link, normal) in normal.as_chunks::<3>().0.iter().enumerate() {
            let Some(own) = self.properties_of(link) else {
                return omega.fill(f64::NAN);
            };
            let [x, y, spin] = normal;
            let root = own.mass.sqrt();
            forces.push([root * x, root * y]);
            spins.push(own.inertia.sqrt() * spin);
        }
        let mut momenta = vec![0.0; links];
        self.point_torques_into(LinkPoint::Centre, theta, &forces, &mut momenta);
        for (momentum, spin) in momenta.iter_mut().zip(&spins) {
            *momentum += spin;
        }
        self.solve_mass(&mut Workspace::new(), theta, &momenta, omega);
    }

    /// Writes M⁻¹ p: the angular velocities (rad/s) of momenta p (kg m²/s) at angles `theta`. They
    /// are computed as the accelerations at rest under the torques p, minus those without torques.
    /// NaN for slices of another length than there are links. O(links).
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::system::Workspace;
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let rod = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 0.3, length = 1)")?;
    /// let mut omega = [0.0];
    /// rod.solve_mass(&mut Workspace::new(), &[0.4], &[0.2], &mut omega);
    /// assert!((omega[0] - 2.0).abs() < 1e-14);
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    pub fn solve_mass(
        &self,
        workspace: &mut Workspace<f64>,
        theta: &[f64],
        momenta: &[f64],
        omega: &mut [f64],
    ) {
        let still = vec![0.0; theta.len()];
        let mut without = still.clone();
        self.accelerations_under_with(workspace, 0.0, theta, &still, &still, &mut without);
        self.accelerations_under_with(workspace, 0.0, theta, &still, momenta, omega);
        for (own, without) in omega.iter_mut().zip(&without) {
            *own -= without;
        }
    }

    /// Returns tr K_s M⁻¹ of each scale s at the angles `theta`: twice its mean kinetic energy at
    /// kT = 1 J. The sum over all scales is the number of links. `None` if the tree has no scales
    /// or the number of angles is wrong. O(links²).
    ///
    /// # Examples
    ///
    /// If all copies are in phase, the value of a scale is its number of degrees of freedom;
    /// otherwise it is not.
    ///
    /// ```
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let tree = PendulumTree::parse(
    ///     "gravity = 9.81, a: rod(mass = 0.2, length = 0.5) [b: rod(mass = 0.1, length = 0.3) * 2]",
    /// )?;
    /// let in_phase = tree.kinetic_shares(&[0.3, 0.8, 0.8]).unwrap();
    /// assert!((in_phase[0] - 2.0).abs() < 1e-12 && (in_phase[1] - 1.0).abs() < 1e-12);
    /// let off = tree.kinetic_shares(&[0.3, 0.8, -0.8]).unwrap();
    /// assert!((off[0] + off[1] - 3.0).abs() < 1e-12 && off[1] > 1.02);
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    #[must_use]
    pub fn kinetic_shares(&self, theta: &[f64]) -> Option<Vec<f64>> {
        let links = self.links();
        let scales = self.degrees_of_freedom_by_scale()?.len();
        if theta.len() != links {
            return None;
        }
        let workspace = &mut Workspace::new();
        let mut budget = ScaleBudget::new();
        let mut shares = vec![0.0; scales];
        let mut unit = vec![0.0; links];
        let mut flow = vec![0.0; links];
        // v·K_s·w = (E_s(v + w) − E_s(v − w))/2, where potential energies cancel.
        for link in 0..links {
            unit.fill(0.0);
            if let Some(own) = unit.get_mut(link) {
                *own = 1.0;
            }
            self.solve_mass(workspace, theta, &unit, &mut flow);
            // Scales both to one size, so that neither is lost to rounding.
            let size = flow.iter().fold(0.0, |size: f64, own| size.max(own.abs()));
            for sign in [1.0, -1.0] {
                let omega = unit.iter().zip(&flow);
                let omega: Vec<f64> = omega.map(|(v, w)| v + sign * w / size).collect();
                self.energies_by_scale_into(workspace, theta, &omega, &mut budget);
                for (scale, share) in shares.iter_mut().enumerate() {
                    *share += 0.5 * sign * size * budget.energy(scale);
                }
            }
        }
        Some(shares)
    }
}
