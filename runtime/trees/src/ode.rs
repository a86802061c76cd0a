//! Trees as systems of first-order equations, by themselves and under torques.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{CastOde, LaneOde, LaneTorques, Ode, Torques, Workspace};

use crate::tree::PendulumTree;

impl<T: Scalar> Ode<T> for PendulumTree<T> {
    fn dimension(&self) -> usize {
        2 * self.links()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        if let Some(Halves { given, out }) = Halves::of(self.links(), state, rates) {
            let ([theta, omega], [velocities, alpha]) = (given, out);
            velocities.copy_from_slice(omega);
            self.accelerations_with(workspace, time, theta, omega, alpha);
        }
    }
}

impl<T: Scalar, S: Scalar> CastOde<T, S> for PendulumTree<T> {
    type Of = PendulumTree<S>;

    fn cast(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        PendulumTree::cast(self, convert)
    }
}

impl<T: Scalar> LaneOde<T> for PendulumTree<T> {
    type Of<S: Scalar> = PendulumTree<S>;

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        PendulumTree::cast(self, convert)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(tree: &PendulumTree<S>, time: S, state: &[S], rates: &mut [S]) {
        if let Some(Halves { given, out }) = Halves::of(tree.links(), state, rates) {
            let [velocities, alpha] = out;
            velocities.copy_from_slice(given[1]);
            let acting = tree.acting(time, None);
            tree.equations.evaluate(acting, given, alpha);
        }
    }

    fn shape(&self) -> usize {
        self.described.shape
    }
}

/// A tree under torques from outside as a system of first-order equations, as
/// [`UnderTorques`](branched_pendulum::system::UnderTorques) is for compiled models.
///
/// # Examples
///
/// A twig that the wind turns:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::{PendulumTree, TreeUnderTorques};
///
/// let twig = PendulumTree::parse(
///     "gravity = 9.81, twig: rod(mass = 0.1, length = 0.3, friction = 0.01)",
/// )?;
/// let wind = |_: f64, _: &[f64], _: &[f64], torques: &mut [f64]| torques[0] = 0.02;
/// let system = TreeUnderTorques::new(twig, wind);
/// let method = Dop853::new(Options::with_tolerance(1e-9));
/// let start = State::at_rest(0.0, &[0.0]);
/// let end = method.integrate(&system, &start, 20.0, |_| ControlFlow::Continue(()))?.state;
/// assert!((0.1 * 9.81 * 0.15 * end.values[0].sin() - 0.02).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreeUnderTorques<T, F> {
    tree: PendulumTree<T>,
    torques: F,
}

impl<T: Scalar, F: Torques<T>> TreeUnderTorques<T, F> {
    /// The tree under torques: `torques(time, theta, omega, out)` writes them, or a vector
    /// holds those that stay as they are.
    pub fn new(tree: PendulumTree<T>, torques: F) -> Self {
        Self { tree, torques }
    }

    /// Returns the tree.
    pub fn tree(&self) -> &PendulumTree<T> {
        &self.tree
    }

    /// Returns the torques, to change them.
    pub fn torques_mut(&mut self) -> &mut F {
        &mut self.torques
    }
}

impl<T: Scalar, F: Torques<T>> Ode<T> for TreeUnderTorques<T, F> {
    fn dimension(&self) -> usize {
        2 * self.tree.links()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let Self { tree, torques } = self;
        if let Some(Halves { given, out }) = Halves::of(tree.links(), state, rates) {
            let ([theta, omega], [velocities, alpha]) = (given, out);
            // They stand where the velocities will.
            torques.torques_into(time, theta, omega, velocities);
            let given = [theta, omega, &*velocities];
            tree.accelerations_under_with(workspace, time, given, alpha);
            velocities.copy_from_slice(omega);
        }
    }
}

impl<T: Scalar, F: LaneTorques<T>> LaneOde<T> for TreeUnderTorques<T, F> {
    type Of<S: Scalar> = TreeUnderTorques<S, F::Of<S>>;

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        TreeUnderTorques {
            tree: self.tree.cast(&convert),
            torques: self.torques.on_scalar(&convert),
        }
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        let TreeUnderTorques { tree, torques } = system;
        if let Some(Halves { given, out }) = Halves::of(tree.links(), state, rates) {
            let ([theta, omega], [velocities, alpha]) = (given, out);
            torques.torques_into(time, theta, omega, velocities);
            let acting = tree.acting(time, Some(&*velocities));
            tree.equations.evaluate(acting, given, alpha);
            velocities.copy_from_slice(omega);
        }
    }

    fn shape(&self) -> usize {
        self.tree.described.shape
    }
}

/// Angles and angular velocities of a state, and the places of their rates.
struct Halves<'g, 'o, T> {
    given: [&'g [T]; 2],
    out: [&'o mut [T]; 2],
}

impl<'g, 'o, T: Scalar> Halves<'g, 'o, T> {
    /// None for slices of another length than two numbers a link: the rates are NaN then.
    #[inline(always)]
    fn of(links: usize, state: &'g [T], rates: &'o mut [T]) -> Option<Self> {
        if state.len() != 2 * links || rates.len() != 2 * links {
            rates.fill(T::from_f64(f64::NAN));
            return None;
        }
        let (theta, omega) = state.split_at(links);
        let (velocities, alpha) = rates.split_at_mut(links);
        Some(Self {
            given: [theta, omega],
            out: [velocities, alpha],
        })
    }
}
