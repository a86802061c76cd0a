//! Equations of motion with derivatives in reverse mode.
//!
//! The method is that of trees in loops ([`VirtualPower`]).

mod constants;

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::system::{
    AbsoluteAngles, Model, Ode, PullbackOde, PullbackWorkspace, Workspace,
};
use branched_pendulum::tree::{VirtualMotion, VirtualPower};

use crate::drive::Courses;
use crate::forms::{Acting, Equations};
use crate::tree::PendulumTree;

/// Equations of motion of a tree in the links' angles, with derivatives in reverse mode by the
/// state and by all parameters of the description.
///
/// The state is the angles (rad), followed by the angular velocities (rad/s). The order of the
/// parameters is that of [`TreeDescription::parameters`](crate::TreeDescription::parameters); they
/// are in SI units. One pullback takes O(links) time, and time for each constant that depends on a
/// parameter.
///
/// # Examples
///
/// The derivative of an angle after two seconds by the length:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::TreeDescription;
///
/// let rod = TreeDescription::parse("gravity = 9.81, rod: rod(mass = 0.2, length = l)")?;
/// let motion = rod.tree(&[("l", 0.5)])?.pullback();
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let start = State::at_rest(0.0, &[0.1]);
/// let angle = |_: usize, state: &[f64], slopes: &mut [f64]| {
///     slopes[0] = 1.0;
///     state[0]
/// };
/// let gradient = method.gradient(&motion, motion.parameters(), &start, &[2.0], angle)?;
///
/// let after = |length: f64| -> Result<f64, Box<dyn std::error::Error>> {
///     let tree = rod.tree(&[("l", length)])?;
///     Ok(method.run(&AbsoluteAngles(&tree), &start, 2.0)?.state.values[0])
/// };
/// let difference = (after(0.5 + 1e-5)? - after(0.5 - 1e-5)?) / 2e-5;
/// assert!((gradient.parameters[0] - difference).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreePullback<T = f64> {
    tree: PendulumTree<T>,
    /// Equations of the same links without gravity, springs and friction.
    inertia: Equations<T>,
    power: VirtualPower<T>,
    /// The drive, with its derivative by each parameter on which it depends.
    drives: Vec<(usize, Courses<Dual<T, 1>>)>,
}

/// Derivatives of a weighted sum of accelerations, as [`TreePullback::accelerations_pullback`] returns
/// them.
#[derive(Clone, Debug, PartialEq)]
pub struct AccelerationSlopes<T> {
    /// By the angles.
    pub theta: Vec<T>,
    /// By the angular velocities.
    pub omega: Vec<T>,
    /// By torques on the links.
    pub torques: Vec<T>,
    /// By the parameters of the description.
    pub parameters: Vec<T>,
}

impl<T: Scalar> PendulumTree<T> {
    /// Returns the equations of motion with derivatives in reverse mode. Creating them takes
    /// O(parameters · links).
    #[must_use]
    pub fn pullback(&self) -> TreePullback<T> {
        let (scene, values) = (&*self.description().scene, self.described.values());
        TreePullback {
            tree: self.clone(),
            inertia: self.inertia_alone(),
            power: constants::virtual_power(scene, values),
            drives: constants::drives(scene, values),
        }
    }
}

impl<T: Scalar> TreePullback<T> {
    /// Numbers of memory that one link takes.
    const NUMBERS: usize = 2 + VirtualPower::<T>::NUMBERS;

    /// Returns the number of parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.tree.described.values().len()
    }

    /// Returns the derivatives of Σ w_i α_i, a sum of the accelerations with `weights` w, at angles
    /// `theta` (rad) and angular velocities `omega` (rad/s), under `torques` (N m) on the links if
    /// they are given. `time` (s) only matters if the tree has a drive. NaN if a slice does not have
    /// one value per link.
    #[must_use]
    pub fn accelerations_pullback(
        &self,
        time: T,
        [theta, omega]: [&[T]; 2],
        torques: Option<&[T]>,
        weights: &[T],
    ) -> AccelerationSlopes<T> {
        let n = self.tree.links();
        let [zero, nan] = [0.0, f64::NAN].map(T::from_f64);
        let torques_fit = torques.is_none_or(|torques| torques.len() == n);
        let fit = torques_fit && [theta, omega, weights].iter().all(|own| own.len() == n);
        let start = if fit { zero } else { nan };
        let mut slopes = AccelerationSlopes {
            theta: vec![start; n],
            omega: vec![start; n],
            torques: vec![start; n],
            parameters: vec![start; self.parameters()],
        };
        if fit {
            let mut numbers = vec![zero; Self::NUMBERS * n];
            let acting = self.tree.acting(time, torques);
            self.add(
                (&mut Workspace::new(), &mut numbers),
                (time, acting),
                [theta, omega, weights],
                &mut slopes.torques,
                [&mut slopes.theta, &mut slopes.omega, &mut slopes.parameters],
            );
        }
        slopes
    }

    /// Writes the derivatives by torques on the links to `lambda` and adds those by angles,
    /// angular velocities and parameters to `by`. All slices have the right length; `numbers` has
    /// [`NUMBERS`](Self::NUMBERS) for each link.
    fn add(
        &self,
        (workspace, numbers): (&mut Workspace<T>, &mut [T]),
        (time, acting): (T, Acting<'_, T>),
        [theta, omega, weights]: [&[T]; 3],
        lambda: &mut [T],
        by: [&mut [T]; 3],
    ) {
        let (alpha, numbers) = numbers.split_at_mut(theta.len());
        let (still, vectors) = numbers.split_at_mut(theta.len());
        still.fill(T::from_f64(0.0));
        // M λ = w.
        let pushed = Acting {
            drive: None,
            torques: Some(weights),
        };
        self.inertia
            .accelerate(workspace, pushed, [theta, still], lambda);
        self.tree
            .accelerate(workspace, acting, [theta, omega], alpha);
        // `RootDrive` has the opposite of the pivot's acceleration.
        let pivot = acting
            .drive
            .map_or([T::from_f64(0.0); 2], |own| own.pivot.map(|own| -own));
        let motion = VirtualMotion {
            theta,
            omega,
            alpha,
            lambda,
            pivot,
        };
        let [by_theta, by_omega, parameters] = by;
        let slopes = [by_theta, by_omega, &mut *parameters];
        let pivot = self.power.add_derivatives(motion, vectors, slopes);
        for (parameter, drive) in &self.drives {
            let [x, y, torque] = drive.inner(Dual::constant(time)).map(|own| own.tangents[0]);
            if let (Some(sum), Some(&root)) = (parameters.get_mut(*parameter), lambda.first()) {
                *sum = *sum + pivot[0] * x + pivot[1] * y + root * torque;
            }
        }
    }
}

impl<T: Scalar> Ode<T> for TreePullback<T> {
    fn dimension(&self) -> usize {
        2 * self.tree.links()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        AbsoluteAngles(&self.tree).rates_with(workspace, time, state, rates);
    }
}

impl<T: Scalar> PullbackOde<T> for TreePullback<T> {
    fn add_pullback(
        &self,
        workspace: &mut PullbackWorkspace<T>,
        time: T,
        state: &[T],
        weights: &[T],
        state_adjoint: &mut [T],
        parameters_adjoint: &mut [T],
    ) {
        let n = self.tree.links();
        let fit = [state.len(), weights.len(), state_adjoint.len()] == [2 * n; 3];
        if !fit || parameters_adjoint.len() != self.parameters() {
            let nan = T::from_f64(f64::NAN);
            state_adjoint.fill(nan);
            return parameters_adjoint.fill(nan);
        }
        let (theta, omega) = state.split_at(n);
        let (of_angles, of_velocities) = weights.split_at(n);
        let (by_theta, by_omega) = state_adjoint.split_at_mut(n);
        // The rates of the angles are the velocities.
        for (sum, weight) in by_omega.iter_mut().zip(of_angles) {
            *sum = *sum + *weight;
        }
        let (workspace, numbers) = workspace.parts((Self::NUMBERS + 1) * n);
        let (lambda, numbers) = numbers.split_at_mut(n);
        self.add(
            (workspace, numbers),
            (time, self.tree.acting(time, None)),
            [theta, omega, of_velocities],
            lambda,
            [by_theta, by_omega, parameters_adjoint],
        );
    }
}
