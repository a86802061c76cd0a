//! Places that the equations of a block read and write, as pointers that were checked.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::Sweep;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::Cells;
use crate::tree::equations::LinkMotion;
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
    in_rows: bool,
    /// Sines and cosines, velocities, joint angles and rates, torques from outside, and
    /// held links; from one column to the next.
    sincos: *mut T,
    omega: *mut T,
    joint_motions: *mut T,
    torques: *mut T,
    held: *mut T,
    links: usize,
    /// Responses, sums, and what is kept; from one column to the next.
    responses: *mut T,
    sums: *mut T,
    eliminations: *mut T,
    slots: usize,
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

/// Values that equations read of a link's motion beside sine, cosine and velocity.
#[derive(Clone, Copy)]
pub(super) struct Read {
    /// Joint angle and rate.
    pub(super) joints: bool,
    /// The torque from outside.
    pub(super) torques: bool,
    /// Held or not.
    pub(super) held: bool,
}

/// Where the numbers of links stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkCells<T> {
    sincos: Cells<T>,
    omega: Cells<T>,
    joint_motions: Cells<T>,
    torques: Cells<T>,
    held: Cells<T>,
    pub(super) responses: Cells<T>,
    pub(super) sums: Cells<T>,
    pub(super) eliminations: Cells<T>,
}

impl<T: Scalar> LinkCells<T> {
    /// Returns those of the links from one on, that stands there among all links and
    /// among those with children.
    #[inline(always)]
    pub(super) fn from(self, own: usize, slot: usize) -> Self {
        Self {
            sincos: self.sincos.from(own),
            omega: self.omega.from(own),
            joint_motions: self.joint_motions.from(own),
            torques: self.torques.from(own),
            held: self.held.from(own),
            responses: self.responses.from(slot),
            sums: self.sums.from(slot),
            eliminations: self.eliminations.from(slot),
        }
    }

    /// Reads the motions of the links from `at` on, of which the equations read these.
    ///
    /// # Safety
    /// As many links as `V` has lanes are there.
    #[inline(always)]
    pub(super) unsafe fn motion<V: Simd<T>>(&self, at: usize, read: Read) -> LinkMotion<V> {
        // SAFETY: the caller's.
        unsafe {
            let [sine, cosine]: [V; 2] = self.sincos.read(at);
            let [omega]: [V; 1] = self.omega.read(at);
            // What nobody reads may be anything.
            let [joint_angle, joint_rate] = match read.joints {
                true => self.joint_motions.read(at),
                false => [omega; 2],
            };
            let [outside_torque] = match read.torques {
                true => self.torques.read(at),
                false => [omega],
            };
            let [held] = match read.held {
                true => self.held.read(at),
                false => [omega],
            };
            LinkMotion {
                sine,
                cosine,
                omega,
                joint_angle,
                joint_rate,
                outside_torque,
                held,
            }
        }
    }
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
        let column = match sizes.constants {
            // Nothing is read of links that are alike.
            0 => usize::MAX,
            columns => constants.len() / columns,
        };
        let sincos = storage.sincos.window(storage.lead, reach.own)?;
        let joint_motions = match sizes.joints {
            true => storage.joint_motions.window(storage.lead, reach.own)?,
            false => storage.joint_motions,
        };
        let torques = match sizes.forced {
            true => storage.torques.window(storage.lead, reach.own)?,
            false => storage.torques,
        };
        let held = match sizes.held {
            true => storage.held.window(storage.lead, reach.own)?,
            false => storage.held,
        };
        let all = |columns: usize, numbers: &[T]| columns * slots <= numbers.len();
        let there = reach.slot <= slots
            && all(sizes.responses, storage.responses)
            && all(sizes.sums, storage.sums)
            && all(sizes.eliminations, storage.eliminations)
            && (!sizes.by_link || reach.own <= column);
        // A whole tree's links stand in order, as they do where they are given.
        let omega = match storage.velocities {
            Some(column) => column.window(storage.lead, reach.own)?.start(),
            None if !block.is_whole() || reach.own > omega.len() => return None,
            // Nobody writes there.
            None => omega.as_ptr().cast_mut(),
        };
        there.then_some(View {
            strips: block.strips.list(),
            attachments: block.strips.attachments(),
            branching: block.strips.branching(),
            sizes,
            in_rows: storage.in_rows,
            sincos: sincos.start(),
            omega,
            joint_motions: joint_motions.start(),
            torques: torques.start(),
            held: held.start(),
            links: sincos.stride(),
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

impl<'a, N: Scalar, T: Scalar> View<'a, N, T> {
    /// Returns the strips and their attachments, for equations of these sizes, numbers in
    /// rows or columns and, where this is not 0, so many copies of children everywhere;
    /// none for others.
    #[inline(always)]
    pub(super) fn strips(
        &self,
        sizes: Sizes,
        in_rows: bool,
        branching: usize,
    ) -> (&'a [Strip], &'a [Attachment]) {
        let fit = self.sizes == sizes && self.in_rows == in_rows;
        match fit && (branching == 0 || branching == self.branching) {
            true => (self.strips, self.attachments),
            false => (&[], &[]),
        }
    }

    /// Returns where the numbers of links stand, in columns.
    #[inline(always)]
    pub(super) fn columns(&self) -> LinkCells<T> {
        LinkCells {
            sincos: Cells::columns(self.sincos, self.links),
            omega: Cells::columns(self.omega, self.links),
            joint_motions: Cells::columns(self.joint_motions, self.links),
            torques: Cells::columns(self.torques, self.links),
            held: Cells::columns(self.held, self.links),
            responses: Cells::columns(self.responses, self.slots),
            sums: Cells::columns(self.sums, self.slots),
            eliminations: Cells::columns(self.eliminations, self.slots),
        }
    }

    /// Returns where the numbers of links stand, in rows for equations of these sizes.
    #[inline(always)]
    pub(super) fn rows(&self, sizes: Sizes) -> LinkCells<T> {
        LinkCells {
            sincos: Cells::rows(self.sincos, sizes.motion()),
            omega: Cells::rows(self.omega, sizes.motion()),
            joint_motions: Cells::rows(self.joint_motions, sizes.motion()),
            torques: Cells::rows(self.torques, sizes.motion()),
            held: Cells::rows(self.held, sizes.motion()),
            responses: Cells::rows(self.responses, sizes.responses),
            sums: Cells::rows(self.sums, sizes.sums),
            eliminations: Cells::rows(self.eliminations, sizes.eliminations),
        }
    }

    /// Returns where the constants of links stand, for a tree with a row a link.
    #[inline(always)]
    pub(super) fn columns_of_constants(&self) -> Cells<N> {
        // Nobody writes there.
        Cells::columns(self.constants.as_ptr().cast_mut(), self.column)
    }
}
