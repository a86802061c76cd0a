//! Links whose motion is given from outside.

use std::sync::Arc;

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{Prescribed, PrescribedMotion, Workspace};
use branched_pendulum::tree::Tree;
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

    fn accelerations_prescribed_into(
        &self,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        alpha: &mut [T],
        reactions: &mut [T],
    ) {
        let workspace = &mut Workspace::new();
        self.accelerations_prescribed_with(workspace, set, time, motion, alpha, reactions);
    }

    fn accelerations_prescribed_with(
        &self,
        workspace: &mut Workspace<T>,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        alpha: &mut [T],
        reactions: &mut [T],
    ) {
        let acting = self.acting(time, Some(motion.torques));
        let (drive, mut sum) = (acting.drive, [T::from_f64(0.0)]);
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        match &self.held {
            Some(HeldLinks { tree, sets }) => {
                let links = sets.get(set).map(Vec::as_slice);
                let results = [alpha, reactions];
                tree.accelerations_prescribed_with(workspace, drive, links, motion, results);
            }
            None => {
                alpha.fill(T::from_f64(f64::NAN));
                reactions.fill(T::from_f64(f64::NAN));
            }
        }
    }

    #[inline(always)]
    fn accelerations_prescribed_of<S: Scalar>(
        tree: &PendulumTree<S>,
        set: usize,
        time: S,
        motion: PrescribedMotion<'_, S>,
        alpha: &mut [S],
        reactions: &mut [S],
    ) {
        let acting = tree.acting(time, Some(motion.torques));
        let (drive, mut sum) = (acting.drive, [S::from_f64(0.0)]);
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        match &tree.held {
            Some(HeldLinks { tree, sets }) => {
                let links = sets.get(set).map(Vec::as_slice);
                tree.evaluate_prescribed(drive, links, motion, [alpha, reactions]);
            }
            None => {
                alpha.fill(S::from_f64(f64::NAN));
                reactions.fill(S::from_f64(f64::NAN));
            }
        }
    }
}
