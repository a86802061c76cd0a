//! What the equations of a part read and write, as pointers that were checked.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::Sweep;
use crate::generations::memory::Sizes;
use crate::generations::runs::Run;
use crate::generations::shared::Shared;
use crate::scalar::Scalar;

/// The numbers of a part, and its runs, none of which goes beyond these numbers.
///
/// Whether they are there is asked once, and where this crate is compiled: in the
/// equations, which are compiled with every model, the questions would be more than
/// the mechanics.
#[derive(Debug)]
pub(in crate::generations) struct Access<'a, T> {
    runs: &'a [Run],
    branching: usize,
    sizes: Sizes,
    /// Columns of sines and cosines, and of angles and velocities between links; from
    /// one column to the next.
    pub(super) turns: *const T,
    pub(super) bends: *const T,
    pub(super) links: usize,
    /// A column of velocities.
    pub(super) omega: *const T,
    /// Columns of answers and of what is kept.
    pub(super) answers: *mut T,
    pub(super) kept: *mut T,
    pub(super) slots: usize,
    pub(super) alpha: Shared<'a, T>,
    /// Rows of all generations.
    pub(super) constants: &'a [T],
    /// Acceleration of the root's pivot, and torque on it.
    pub(super) root: Option<[T; 2]>,
    pub(super) torque: Option<T>,
    /// The part's numbers, which are its alone.
    numbers: PhantomData<&'a mut [T]>,
}

impl<T: Scalar> Sweep<'_, T> {
    /// None where there are fewer numbers than the runs reach.
    // Moved, it would be read in other widths than it was just written in, and a
    // processor waits for that.
    #[inline(always)]
    pub(in crate::generations) fn access(&mut self) -> Option<Access<'_, T>> {
        let Self {
            part,
            constants,
            omega,
            storage,
            root,
            torque,
            alpha,
            ..
        } = self;
        let reach = part.runs.reach();
        let (sizes, slots) = (storage.sizes, storage.slots);
        let turns = storage.turns.window(storage.lead, reach.own)?;
        let bends = match sizes.joints {
            true => storage.bends.window(storage.lead, reach.own)?,
            false => storage.bends,
        };
        let all = |columns: usize, numbers: &[T]| columns * slots <= numbers.len();
        let there = reach.slot <= slots
            && all(sizes.answers, storage.answers)
            && all(sizes.kept, storage.kept);
        let alpha = alpha.window(part.start, reach.whole)?;
        // A whole tree's links stand in order, as they do where they are given.
        let omega = match storage.velocities {
            Some(column) => column.window(storage.lead, reach.own)?.start().cast_const(),
            None if !part.is_whole() || reach.own > omega.len() => return None,
            None => omega.as_ptr(),
        };
        there.then_some(Access {
            runs: part.runs.list(),
            branching: part.runs.branching(),
            sizes,
            turns: turns.start(),
            bends: bends.start(),
            links: turns.stride(),
            omega,
            answers: storage.answers.as_mut_ptr(),
            kept: storage.kept.as_mut_ptr(),
            slots,
            alpha,
            constants,
            root: *root,
            torque: *torque,
            numbers: PhantomData,
        })
    }
}

impl<'a, T: Scalar> Access<'a, T> {
    /// The runs, for equations of these sizes and, where this is not 0, so many copies
    /// of children everywhere; none if they are others.
    #[inline(always)]
    pub(super) fn runs(&self, sizes: Sizes, branching: usize) -> &'a [Run] {
        let own = &self.sizes;
        let same = own.answers == sizes.answers
            && own.kept == sizes.kept
            && own.joints == sizes.joints
            && (branching == 0 || branching == self.branching);
        if same { self.runs } else { &[] }
    }
}
