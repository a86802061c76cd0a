//! Leaves to root, and back: the recursion over a part of the tree.

mod access;
mod equations;
mod near;

use super::memory::Storage;
use super::part::Part;
use super::shared::Shared;
use super::vector::Vector;
use crate::scalar::Scalar;
pub(super) use access::Access;
pub(super) use equations::{down, splat, up};

/// A part with its state.
#[derive(Debug)]
pub(super) struct Sweep<'a, T> {
    pub(super) part: Part<'a>,
    /// Rows of all generations.
    pub(super) constants: &'a [T],
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    pub(super) storage: Storage<'a, T>,
    /// Acceleration of the root's pivot, where the root is in the part.
    pub(super) root: Option<[T; 2]>,
    /// Torque on the root, where the root is in the part.
    pub(super) torque: Option<T>,
    pub(super) alpha: Shared<'a, T>,
}

impl<T: Scalar> Sweep<'_, T> {
    /// Angles and velocities relative to the parents.
    pub(super) fn bend(&mut self) {
        let part = self.part;
        for stage in part.own_stages() {
            let parents = stage.above.map(|start| {
                let count = stage.whole_count / stage.copies.max(1);
                (start, count.max(1))
            });
            for run in 0..stage.runs {
                let place = part.place(stage, run);
                for i in 0..stage.length {
                    let index = place.whole + i;
                    let (mut bend, mut rate) =
                        (T::load(self.theta, index), T::load(self.omega, index));
                    if let Some((start, count)) = parents {
                        let parent = start + (index - stage.whole) % count;
                        bend = bend - T::load(self.theta, parent);
                        rate = rate - T::load(self.omega, parent);
                    }
                    let own = self.storage.lead + place.own + i;
                    let _ = self.storage.bends.store(own, &[bend, rate]);
                }
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests;

#[cfg(test)]
mod driven_tests;
