//! What the equations of a block read and write, as pointers that were checked.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::Sweep;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::memory::Sizes;
use crate::tree::strips::{Attachment, Strip};

/// The numbers of a block, and its strips, none of which goes beyond these numbers.
///
/// Constants are numbers `N`, all others `T`: the same numbers, or several states'.
/// All bounds are checked once, and where this crate is compiled: in the equations,
/// which are compiled with every model, the checks would be more than the mechanics.
#[derive(Debug)]
pub(in crate::tree) struct View<'a, N, T> {
    strips: &'a [Strip],
    attachments: &'a [Attachment],
    branching: usize,
    sizes: Sizes,
    /// Columns of sines and cosines, and of joint angles and rates; from one column
    /// to the next.
    pub(super) sincos: *const T,
    pub(super) joint_motions: *const T,
    pub(super) links: usize,
    /// A column of velocities.
    pub(super) omega: *const T,
    /// Columns of responses, of sums, and of what is kept.
    pub(super) responses: *mut T,
    pub(super) sums: *mut T,
    pub(super) eliminations: *mut T,
    pub(super) slots: usize,
    /// Rows of all generations, or columns of all links.
    pub(super) constants: &'a [N],
    /// The length of these columns.
    column: usize,
    /// Acceleration of the root's pivot, and torque on it.
    pub(super) root: Option<[T; 2]>,
    pub(super) torque: Option<T>,
    /// The block's numbers, which are its alone.
    numbers: PhantomData<&'a mut [T]>,
}

impl<N, T: Scalar> Sweep<'_, N, T> {
    /// None where there are fewer numbers than the strips reach.
    // Moved, it would be read in other widths than it was just written in, and a
    // processor waits for that.
    #[inline(always)]
    pub(in crate::tree) fn view(&mut self) -> Option<View<'_, N, T>> {
        let Self {
            block,
            constants,
            omega,
            storage,
            root,
            torque,
        } = self;
        let reach = block.strips.reach();
        let (sizes, slots) = (storage.sizes, storage.slots);
        let column = constants.len() / sizes.constants.max(1);
        let sincos = storage.sincos.window(storage.lead, reach.own)?;
        let joint_motions = match sizes.joints {
            true => storage.joint_motions.window(storage.lead, reach.own)?,
            false => storage.joint_motions,
        };
        let all = |columns: usize, numbers: &[T]| columns * slots <= numbers.len();
        let there = reach.slot <= slots
            && all(sizes.responses, storage.responses)
            && all(sizes.sums, storage.sums)
            && all(sizes.eliminations, storage.eliminations)
            && (!sizes.by_link || reach.own <= column);
        // A whole tree's links stand in order, as they do where they are given.
        let omega = match storage.velocities {
            Some(column) => column.window(storage.lead, reach.own)?.start().cast_const(),
            None if !block.is_whole() || reach.own > omega.len() => return None,
            None => omega.as_ptr(),
        };
        there.then_some(View {
            strips: block.strips.list(),
            attachments: block.strips.attachments(),
            branching: block.strips.branching(),
            sizes,
            sincos: sincos.start(),
            joint_motions: joint_motions.start(),
            links: sincos.stride(),
            omega,
            responses: storage.responses.as_mut_ptr(),
            sums: storage.sums.as_mut_ptr(),
            eliminations: storage.eliminations.as_mut_ptr(),
            slots,
            constants,
            column,
            root: *root,
            torque: *torque,
            numbers: PhantomData,
        })
    }
}

impl<'a, N, T: Scalar> View<'a, N, T> {
    /// Returns the strips and their attachments, for equations of these sizes and,
    /// where this is not 0, so many copies of children everywhere; none for others.
    #[inline(always)]
    pub(super) fn strips(&self, sizes: Sizes, branching: usize) -> (&'a [Strip], &'a [Attachment]) {
        match self.sizes == sizes && (branching == 0 || branching == self.branching) {
            true => (self.strips, self.attachments),
            false => (&[], &[]),
        }
    }

    /// Returns the constants in column `column` of the links from `at` on, for a tree
    /// with a row a link.
    ///
    /// # Safety
    /// The place and as many behind it as `V` has lanes are within reach of the
    /// strips, the column is one of those that the sizes say.
    #[inline(always)]
    pub(super) unsafe fn constant<V: Simd<T>>(&self, column: usize, at: usize) -> V
    where
        N: Copy,
        T: Simd<N>,
    {
        let start = self
            .constants
            .as_ptr()
            .wrapping_add(column * self.column + at);
        match <T as Simd<N>>::LANES {
            // SAFETY: the caller's. A `T` of one lane is the `N` that it holds.
            1 => unsafe { V::read(start.cast()) },
            // SAFETY: the caller's.
            _ => V::splat(T::splat(unsafe { start.read() })),
        }
    }
}
