//! Memory that the equations of a block read and write, as pointers whose bounds were checked.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::Sweep;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::Cells;
use crate::tree::equations::LinkMotion;
use crate::tree::memory::Sizes;
use crate::tree::strips::{Attachment, Strip};

/// The numbers of a block, and its strips, all of which lie within these numbers.
///
/// Constants have the type `N`, all other numbers the type `T`, which is the same or holds several
/// states. All bounds are checked once, in code that is compiled with this crate. In the equations,
/// which are compiled with every model, checks would cost more than the mechanics.
#[derive(Debug)]
pub(in crate::tree) struct View<'a, N, T> {
    strips: &'a [Strip],
    attachments: &'a [Attachment],
    branching: usize,
    sizes: Sizes,
    in_rows: bool,
    /// Pointers to the first columns of sines and cosines, velocities, joint angles and rates,
    /// external torques, and flags of prescribed links; with the distances between their columns.
    sincos: *mut T,
    omega: *mut T,
    joint_motions: *mut T,
    torques: *mut T,
    prescribed: *mut T,
    links: usize,
    /// Pointers to the first columns of responses, of their sums, and of the numbers kept for the
    /// downward pass; with the distances between their columns.
    responses: *mut T,
    sums: *mut T,
    eliminations: *mut T,
    slots: usize,
    /// Constants: one row for each generation, or one column per constant for all links.
    pub(super) constants: &'a [N],
    /// The length of these columns.
    column: usize,
    /// Acceleration of the root's pivot, and torque on it.
    pub(super) root: Option<[T; 2]>,
    pub(super) torque: Option<T>,
    /// Marks that the block has exclusive access to its numbers.
    numbers: PhantomData<&'a mut [T]>,
}

/// Flags of the quantities of a link's motion that equations read in addition to sine, cosine and
/// velocity.
#[derive(Clone, Copy)]
pub(super) struct Read {
    /// Joint angle and rate.
    pub(super) joints: bool,
    /// External torque.
    pub(super) torques: bool,
    /// Flag of a prescribed link.
    pub(super) prescribed: bool,
}

/// Memory layout of the numbers of all links.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkCells<T> {
    sincos: Cells<T>,
    omega: Cells<T>,
    joint_motions: Cells<T>,
    torques: Cells<T>,
    prescribed: Cells<T>,
    pub(super) responses: Cells<T>,
    pub(super) sums: Cells<T>,
    pub(super) eliminations: Cells<T>,
}

impl<T: Scalar> LinkCells<T> {
    /// Returns the layout that starts with a given link; `own` is its index among all links, `slot`
    /// its index among links with children.
    #[inline(always)]
    pub(super) fn from(self, own: usize, slot: usize) -> Self {
        Self {
            sincos: self.sincos.from(own),
            omega: self.omega.from(own),
            joint_motions: self.joint_motions.from(own),
            torques: self.torques.from(own),
            prescribed: self.prescribed.from(own),
            responses: self.responses.from(slot),
            sums: self.sums.from(slot),
            eliminations: self.eliminations.from(slot),
        }
    }

    /// Reads the motions of the links from `at` on: sine, cosine and velocity, and the quantities
    /// that `read` selects.
    ///
    /// # Safety
    /// There must be at least as many links from `at` on as `V` has lanes.
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
            let [prescribed] = match read.prescribed {
                true => self.prescribed.read(at),
                false => [omega],
            };
            LinkMotion {
                sine,
                cosine,
                omega,
                joint_angle,
                joint_rate,
                outside_torque,
                prescribed,
            }
        }
    }
}

impl<N, T: Scalar> Sweep<'_, N, T> {
    /// Creates the view; returns `None` if there are fewer numbers than the strips require.
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
            // Identical links share their constants, so that no column is read.
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
        let prescribed = match sizes.prescribed {
            true => storage.prescribed.window(storage.lead, reach.own)?,
            false => storage.prescribed,
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
            prescribed: prescribed.start(),
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
    /// Returns the strips and their attachments for equations of the given sizes, with numbers
    /// stored in rows or in columns, and with `branching` children per link (0: any number). Both
    /// are empty if the block does not match.
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

    /// Returns the memory layout of the links' numbers, if they are stored in columns.
    #[inline(always)]
    pub(super) fn columns(&self) -> LinkCells<T> {
        LinkCells {
            sincos: Cells::columns(self.sincos, self.links),
            omega: Cells::columns(self.omega, self.links),
            joint_motions: Cells::columns(self.joint_motions, self.links),
            torques: Cells::columns(self.torques, self.links),
            prescribed: Cells::columns(self.prescribed, self.links),
            responses: Cells::columns(self.responses, self.slots),
            sums: Cells::columns(self.sums, self.slots),
            eliminations: Cells::columns(self.eliminations, self.slots),
        }
    }

    /// Returns the memory layout of the links' numbers, if they are stored in rows, for equations
    /// of these sizes.
    #[inline(always)]
    pub(super) fn rows(&self, sizes: Sizes) -> LinkCells<T> {
        LinkCells {
            sincos: Cells::rows(self.sincos, sizes.motion()),
            omega: Cells::rows(self.omega, sizes.motion()),
            joint_motions: Cells::rows(self.joint_motions, sizes.motion()),
            torques: Cells::rows(self.torques, sizes.motion()),
            prescribed: Cells::rows(self.prescribed, sizes.motion()),
            responses: Cells::rows(self.responses, sizes.responses),
            sums: Cells::rows(self.sums, sizes.sums),
            eliminations: Cells::rows(self.eliminations, sizes.eliminations),
        }
    }

    /// Returns the memory layout of the links' constants, for a tree with separate constants for
    /// each link.
    #[inline(always)]
    pub(super) fn columns_of_constants(&self) -> Cells<N> {
        // Nobody writes there.
        Cells::columns(self.constants.as_ptr().cast_mut(), self.column)
    }
}
