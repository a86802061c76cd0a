//! Where the equations read and write: a vector of neighbours at a time.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::view::View;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::{read, write};
use crate::tree::equations::{LinkMotion, Row};
use crate::tree::strips::Strip;

/// The numbers of neighbours and of their children, from the first one's on. The
/// children are leaves, or their responses are in memory.
///
/// The functions take the place of a vector among the neighbours, a multiple of its
/// lanes or the last place, and the number of a copy of the children. They are sound
/// for equations of the sizes that [`strips`](View::strips) has been asked for.
// A copy of its own: compilers keep it in registers, and read what is behind a
// reference again after everything that is written.
pub(super) struct StripView<'a, T> {
    length: usize,
    sincos: *const T,
    joint_motions: *const T,
    links: usize,
    omega: *const T,
    responses: *mut T,
    eliminations: *mut T,
    slots: usize,
    whole: usize,
    step: usize,
    pub(super) copies: usize,
    apart: usize,
    whole_apart: usize,
    leaf_sincos: *const T,
    leaf_joint_motions: *const T,
    leaf_omega: *const T,
    leaf_whole: usize,
    below: *mut T,
    numbers: PhantomData<&'a mut [T]>,
}

/// Where accelerations go.
pub(in crate::tree) trait Output<T> {
    /// Takes the accelerations of `count` links from the one with number `at` in the
    /// tree on: as many as `V` has lanes, or the first of these.
    ///
    /// # Safety
    /// The links are within reach of the strips of the block that is being computed.
    unsafe fn write<V: Simd<T>>(&mut self, at: usize, alpha: V, count: usize);
}

// SAFETY, for all of these: the numbers are the view's own for as long as it lives,
// and no reference to them is there. By `view` there are as many as the strips reach,
// with those of a vector of any width from the last place on, in as many columns as
// the sizes say.
impl<'a, T: Scalar> StripView<'a, T> {
    /// Of a strip that has come from [`strips`](View::strips), for the same
    /// `branching`.
    #[inline(always)]
    pub(super) fn of<N>(view: &'a View<'_, N, T>, strip: &Strip, branching: usize) -> Self {
        let Strip {
            first,
            child,
            length,
            apart,
            whole_apart,
            ..
        } = *strip;
        StripView {
            length,
            sincos: view.sincos.wrapping_add(first.own),
            joint_motions: view.joint_motions.wrapping_add(first.own),
            links: view.links,
            omega: view.omega.wrapping_add(first.own),
            responses: view.responses.wrapping_add(first.slot),
            eliminations: view.eliminations.wrapping_add(first.slot),
            slots: view.slots,
            whole: first.whole,
            step: strip.step,
            copies: match branching {
                0 => strip.copies,
                branching => branching,
            },
            apart,
            whole_apart,
            leaf_sincos: view.sincos.wrapping_add(child.own),
            leaf_joint_motions: view.joint_motions.wrapping_add(child.own),
            leaf_omega: view.omega.wrapping_add(child.own),
            leaf_whole: child.whole,
            below: view.responses.wrapping_add(child.slot),
            numbers: PhantomData,
        }
    }

    /// The places of vectors: the last ones overlap those before, where vectors do not
    /// divide the neighbours; fewer than a vector holds are one step, whose other
    /// lanes mean nothing.
    #[inline(always)]
    pub(super) fn places<V: Simd<T>>(&self) -> Places {
        Places::of::<T, V>(self.length)
    }

    #[inline(always)]
    unsafe fn motion_at<V: Simd<T>>(
        &self,
        [sincos, joint_motions, omega]: [*const T; 3],
        joints: bool,
    ) -> LinkMotion<V> {
        // SAFETY: see the top.
        let [sine, cosine]: [V; 2] = unsafe { read(sincos, self.links) };
        // SAFETY: see the top.
        let omega = unsafe { V::read(omega) };
        // Where nothing acts in joints nobody reads them.
        let [joint_angle, joint_rate] = match joints {
            // SAFETY: see the top.
            true => unsafe { read(joint_motions, self.links) },
            false => [omega; 2],
        };
        LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
        }
    }

    #[inline(always)]
    pub(super) unsafe fn motion<V: Simd<T>>(&self, at: usize, joints: bool) -> LinkMotion<V> {
        let places = [
            self.sincos.wrapping_add(at),
            self.joint_motions.wrapping_add(at),
            self.omega.wrapping_add(at),
        ];
        // SAFETY: see the top.
        unsafe { self.motion_at(places, joints) }
    }

    /// Of children that are leaves.
    #[inline(always)]
    pub(super) unsafe fn leaf<V: Simd<T>>(
        &self,
        at: usize,
        copy: usize,
        joints: bool,
    ) -> LinkMotion<V> {
        let at = at + copy * self.apart;
        let places = [
            self.leaf_sincos.wrapping_add(at),
            self.leaf_joint_motions.wrapping_add(at),
            self.leaf_omega.wrapping_add(at),
        ];
        // SAFETY: see the top.
        unsafe { self.motion_at(places, joints) }
    }

    /// The first columns of responses: on the way down, accelerations of pivots.
    #[inline(always)]
    pub(super) unsafe fn responses<V: Simd<T>, A: Row<V>>(&self, at: usize) -> A {
        // SAFETY: see the top.
        unsafe { read(self.responses.add(at), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn respond<V: Simd<T>, A: Row<V>>(&self, at: usize, row: &A) {
        // SAFETY: see the top.
        unsafe { write(row, self.responses.add(at), self.slots) }
    }

    /// The same of children that are no leaves.
    #[inline(always)]
    pub(super) unsafe fn below<V: Simd<T>, A: Row<V>>(&self, at: usize, copy: usize) -> A {
        // SAFETY: see the top.
        unsafe { read(self.below.add(at + copy * self.apart), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn give<V: Simd<T>, A: Row<V>>(&self, at: usize, copy: usize, row: &A) {
        // SAFETY: see the top.
        unsafe { write(row, self.below.add(at + copy * self.apart), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn elimination<V: Simd<T>, A: Row<V>>(&self, at: usize) -> A {
        // SAFETY: see the top.
        unsafe { read(self.eliminations.add(at), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn keep<V: Simd<T>, A: Row<V>>(&self, at: usize, row: &A) {
        // SAFETY: see the top.
        unsafe { write(row, self.eliminations.add(at), self.slots) }
    }

    /// From one link to the next in the tree: neighbours in lanes stand side by side.
    #[inline(always)]
    fn step<V: Simd<T>>(&self) -> usize {
        match V::LANES {
            1 => self.step,
            _ => 1,
        }
    }

    /// Writes their accelerations.
    #[inline(always)]
    pub(super) unsafe fn accelerate<V: Simd<T>>(
        &self,
        out: &mut impl Output<T>,
        at: usize,
        alpha: V,
    ) {
        let count = self.length.min(V::LANES);
        // SAFETY: see the top.
        unsafe { out.write(self.whole + at * self.step::<V>(), alpha, count) }
    }

    /// Those of children that are leaves.
    #[inline(always)]
    pub(super) unsafe fn accelerate_leaf<V: Simd<T>>(
        &self,
        out: &mut impl Output<T>,
        at: usize,
        copy: usize,
        alpha: V,
    ) {
        let count = self.length.min(V::LANES);
        let at = self.leaf_whole + at * self.step::<V>() + copy * self.whole_apart;
        // SAFETY: see the top.
        unsafe { out.write(at, alpha, count) }
    }
}

/// Places of vectors among neighbours.
pub(super) struct Places {
    next: usize,
    step: usize,
    last: usize,
    length: usize,
}

impl Places {
    /// Of so many neighbours.
    #[inline(always)]
    pub(super) fn of<T, V: Simd<T>>(length: usize) -> Self {
        Self {
            next: 0,
            step: V::LANES,
            last: length.saturating_sub(V::LANES),
            length,
        }
    }

    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<usize> {
        if self.next >= self.length {
            return None;
        }
        let place = self.next.min(self.last);
        self.next += self.step;
        Some(place)
    }
}
