//! Links whose motion is given from outside.

use std::sync::Arc;

use branched_pendulum::emitted::no_answer;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::functions::AccelerationsOfHeldLinks;
use branched_pendulum::system::{At, Computes, Prescribed, PrescribedMotion, Workspace};
use branched_pendulum::tree::{RootDrive, Tree};
use branched_pendulum_codegen::scene::Scene;

use crate::equations::HeldEquations;
use crate::tree::PendulumTree;

/// The equations of a tree some of whose links may be held, and which ones.
#[derive(Clone, Debug)]
pub(crate) struct HeldLinks<T> {
    sets: Arc<[Vec<usize>]>,
    tree: Tree<HeldEquations, T>,
}

impl<T: Scalar> HeldLinks<T> {
    /// None without sets of links.
    pub(crate) fn of(
        scene: &Scene,
        parents: &[u32],
        gravity: T,
        rows: impl FnOnce() -> Vec<T>,
    ) -> Option<Self> {
        let sets = scene.prescribed.iter();
        let sets = sets.map(|set| set.links.iter().map(|link| link.0).collect());
        (!scene.prescribed.is_empty()).then(|| Self {
            sets: sets.collect(),
            tree: Tree::with_parents(parents, &rows(), [T::from_f64(0.0), gravity]),
        })
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> HeldLinks<S> {
        HeldLinks {
            sets: Arc::clone(&self.sets),
            tree: self.tree.cast(convert),
        }
    }
}

impl<T: Scalar> Prescribed<T> for PendulumTree<T> {
    fn prescribed_links(&self, set: usize) -> Option<&[usize]> {
        let held = self.held.as_ref()?;
        held.sets.get(set).map(Vec::as_slice)
    }
}

impl<T: Scalar> Computes<AccelerationsOfHeldLinks, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        self.hold(at, given, results, |tree, drive, links, motion, results| {
            tree.evaluate_prescribed(drive, links, motion, results);
        });
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        self.hold(at, given, results, |tree, drive, links, motion, results| {
            tree.accelerations_prescribed_with(workspace, drive, links, motion, results);
        });
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Hands to `compute` what the equations of held links take.
    #[inline(always)]
    fn hold(
        &self,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
        compute: impl FnOnce(
            &Tree<HeldEquations, T>,
            Option<RootDrive<T>>,
            Option<&[usize]>,
            PrescribedMotion<'_, T>,
            [&mut [T]; 2],
        ),
    ) {
        let (Some(held), Some(motion), [alpha, reactions]) =
            (&self.held, PrescribedMotion::of(given), &mut *results)
        else {
            return no_answer(results);
        };
        let outside = self.acting(at.time, Some(motion.torques));
        let (given, mut numbers) = ([motion.theta, motion.omega], Vec::new());
        let acting = self.equations.all_acting(outside, given, &mut numbers);
        let mut sum = [T::from_f64(0.0)];
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        let links = held.sets.get(at.index).map(Vec::as_slice);
        compute(&held.tree, acting.drive, links, motion, [alpha, reactions]);
    }
}
