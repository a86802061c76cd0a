//! Derivatives of the accelerations of a tree in reverse mode, by virtual power.
//!
//! Models in loops contain a [`PullbackTree`]; trees that are built at run time use the same
//! [`VirtualPower`].

mod constants;
mod lines;
mod planar;
mod power;
mod springs;

pub use constants::{ParameterSlopes, PassiveLink};
pub use power::{VirtualMotion, VirtualPower};

use super::small::LinkStates;
use super::{LinkEquations, RootDrive, Tree};
use crate::scalar::Scalar;
use crate::system::Workspace;

/// Part of a model in loops that returns derivatives of its accelerations in reverse mode. Emitted
/// models contain it if these derivatives are requested.
///
/// One pullback takes O(links): two solves of the equations of motion, and one pass from the root to
/// the leaves and back ([`VirtualPower`]).
#[derive(Clone, Debug, PartialEq)]
pub struct PullbackTree<E, T> {
    /// The tree without gravity, springs and friction.
    inertia: Tree<E, T>,
    power: VirtualPower<T>,
}

/// State of a tree, and weights w of a sum Σ w_i α_i of its accelerations.
#[derive(Clone, Copy, Debug)]
pub struct WeightedState<'a, T> {
    /// Angles, in rad.
    pub theta: &'a [T],
    /// Angular velocities, in rad/s.
    pub omega: &'a [T],
    /// Torques on the links, in N m, if they are given.
    pub torques: Option<&'a [T]>,
    /// Weights.
    pub weights: &'a [T],
}

/// Derivatives of a weighted sum of accelerations, which a pullback writes.
#[derive(Debug)]
pub struct StateSlopes<'a, T> {
    /// By the angles.
    pub theta: &'a mut [T],
    /// By the angular velocities.
    pub omega: &'a mut [T],
    /// By torques on the links, if they are wanted.
    pub torques: Option<&'a mut [T]>,
    /// By the parameters, except through the drive.
    pub parameters: &'a mut [T],
}

/// Drive of a tree at one time, in the units of its equations, and the acceleration of the root's
/// pivot (m/s²), with y opposite to a link at angle 0.
#[derive(Clone, Copy, Debug)]
pub struct PivotDrive<T> {
    /// Drive in the units of the equations.
    pub root: RootDrive<T>,
    /// Acceleration of the root's pivot.
    pub pivot: [T; 2],
}

impl<T> StateSlopes<'_, T> {
    fn fill(self, value: T)
    where
        T: Copy,
    {
        let Self {
            theta,
            omega,
            torques,
            parameters,
        } = self;
        let all = [Some(theta), Some(omega), torques, Some(parameters)];
        all.into_iter().flatten().for_each(|own| own.fill(value));
    }
}

impl<E: LinkEquations, T: Scalar> PullbackTree<E, T> {
    /// Numbers of memory that one link takes: its two accelerations, a velocity of zero, and those
    /// of the virtual power.
    const NUMBERS: usize = 3 + VirtualPower::<T>::NUMBERS;

    /// Creates the part for a tree. `torques` are the columns of its constants that hold springs and
    /// friction; `power` has no springs and dampers between links yet, which are those of the tree.
    /// The equations must allow external torques ([`LinkEquations::FORCED`]).
    #[must_use]
    pub fn new(tree: &Tree<E, T>, torques: &[usize], power: VirtualPower<T>) -> Self {
        const { assert!(E::FORCED) };
        let between = (tree.spring_dampers(), tree.translational_spring_dampers());
        Self {
            inertia: tree.inertia_alone(torques),
            power: power.with_forces_between(between.0.clone(), between.1.clone()),
        }
    }

    /// Returns the same part with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PullbackTree<E, S> {
        PullbackTree {
            inertia: self.inertia.cast(&convert),
            power: self.power.cast(convert),
        }
    }

    /// Sets the number of threads that solve the equations of motion, as
    /// [`Tree::set_threads`](super::Tree::set_threads).
    pub fn set_threads(&mut self, threads: core::num::NonZeroUsize) {
        self.inertia.set_threads(threads);
    }

    /// Writes the derivatives of Σ w_i α_i, a sum of the accelerations of `tree` with weights w, and
    /// returns those by the acceleration of the root's pivot, x and y, and by the torque on the root.
    /// All are NaN if a slice has a wrong length.
    pub fn pullback_with(
        &self,
        tree: &Tree<E, T>,
        workspace: &mut Workspace<T>,
        drive: Option<PivotDrive<T>>,
        given: WeightedState<'_, T>,
        slopes: StateSlopes<'_, T>,
    ) -> [T; 3] {
        let (memory, workspace) = workspace.with_inner(Self::NUMBERS * self.power.links());
        self.compute(
            memory,
            drive,
            given,
            slopes,
            |inertia, drive, given, alpha| {
                let own = if inertia { &self.inertia } else { tree };
                own.accelerate(workspace, drive, given, alpha);
            },
        )
    }

    /// Writes the same derivatives, computed in the arithmetic of `T`. Allocates, as
    /// [`Tree::evaluate_under`](super::Tree::evaluate_under) does.
    pub fn evaluate_pullback(
        &self,
        tree: &Tree<E, T>,
        drive: Option<PivotDrive<T>>,
        given: WeightedState<'_, T>,
        slopes: StateSlopes<'_, T>,
    ) -> [T; 3] {
        let links = self.power.links();
        let mut memory = alloc::vec![T::from_f64(0.0); Self::NUMBERS * links];
        let workspace = &mut Workspace::new();
        self.compute(
            &mut memory,
            drive,
            given,
            slopes,
            |inertia, drive, given, alpha| {
                let own = if inertia { &self.inertia } else { tree };
                own.evaluate_apart(workspace, drive, given, alpha);
            },
        )
    }

    /// Writes the derivatives. `solve` writes the accelerations of the tree without gravity, springs
    /// and friction if its first argument is true, and those of the tree if it is false.
    fn compute(
        &self,
        memory: &mut [T],
        drive: Option<PivotDrive<T>>,
        given: WeightedState<'_, T>,
        slopes: StateSlopes<'_, T>,
        mut solve: impl FnMut(bool, Option<RootDrive<T>>, LinkStates<'_, T>, &mut [T]),
    ) -> [T; 3] {
        let links = self.power.links();
        let [zero, nan] = [0.0, f64::NAN].map(T::from_f64);
        let WeightedState {
            theta,
            omega,
            torques,
            weights,
        } = given;
        let fits = |own: Option<usize>| own.is_none_or(|length| length == links);
        let fit = [theta, omega, weights].map(<[T]>::len) == [links; 3]
            && [slopes.theta.len(), slopes.omega.len()] == [links; 2]
            && fits(torques.map(<[T]>::len))
            && fits(slopes.torques.as_ref().map(|own| own.len()))
            && slopes.parameters.len() == self.power.parameters();
        if !fit {
            slopes.fill(nan);
            return [nan; 3];
        }
        let (alpha, memory) = memory.split_at_mut(links);
        let (lambda, memory) = memory.split_at_mut(links);
        let (still, memory) = memory.split_at_mut(links);
        still.fill(zero);
        // M λ = w.
        let pushed = LinkStates {
            theta,
            omega: still,
            torques: Some(weights),
        };
        solve(true, None, pushed, lambda);
        let moved = LinkStates {
            theta,
            omega,
            torques,
        };
        solve(false, drive.map(|drive| drive.root), moved, alpha);
        for own in [&mut *slopes.theta, slopes.omega, slopes.parameters] {
            own.fill(zero);
        }
        let motion = VirtualMotion {
            theta,
            omega,
            alpha,
            lambda,
            pivot: drive.map_or([zero; 2], |drive| drive.pivot),
        };
        let by = [slopes.theta, slopes.omega, slopes.parameters];
        let [x, y] = self.power.add_derivatives(motion, memory, by);
        if let Some(torques) = slopes.torques {
            torques.copy_from_slice(lambda);
        }
        [x, y, lambda.first().copied().unwrap_or(zero)]
    }
}
