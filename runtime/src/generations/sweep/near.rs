//! Where the equations read and write: a vector of neighbours at a time.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::access::Access;
use crate::generations::columns::{read, write};
use crate::generations::recursion::Motion;
use crate::generations::runs::Run;
use crate::generations::vector::Vector;
use crate::scalar::Scalar;

/// The numbers of neighbours and of their children, from the first one's on. The
/// children are leaves, or their answers are in memory.
///
/// The functions take the place of a vector among the neighbours, a multiple of its
/// lanes or the last place, and the number of a copy of the children. They are sound
/// for equations of the sizes that [`runs`](Access::runs) has been asked for.
// A copy of its own: compilers keep it in registers, and read what is behind a
// reference again after everything that is written.
pub(super) struct Near<'a, T> {
    length: usize,
    turns: *const T,
    bends: *const T,
    links: usize,
    omega: *const T,
    answers: *mut T,
    kept: *mut T,
    slots: usize,
    alpha: *mut T,
    pub(super) copies: usize,
    apart: usize,
    whole_apart: usize,
    leaf_turns: *const T,
    leaf_bends: *const T,
    leaf_omega: *const T,
    leaf_alpha: *mut T,
    below: *mut T,
    numbers: PhantomData<&'a mut [T]>,
}

// SAFETY, for all of these: the numbers are the access's own for as long as it lives,
// and no reference to them is there. By `access` there are as many as the runs reach,
// with those of a vector of any width from the last place on, in as many columns as
// the sizes say.
impl<'a, T: Scalar> Near<'a, T> {
    /// Of a run that has come from [`runs`](Access::runs), for the same `branching`.
    #[inline(always)]
    pub(super) fn of(access: &'a Access<'_, T>, run: &Run, branching: usize) -> Self {
        let Run {
            first,
            child,
            length,
            apart,
            whole_apart,
            ..
        } = *run;
        let alpha = access.alpha.start();
        Near {
            length,
            turns: access.turns.wrapping_add(first.own),
            bends: access.bends.wrapping_add(first.own),
            links: access.links,
            omega: access.omega.wrapping_add(first.own),
            answers: access.answers.wrapping_add(first.slot),
            kept: access.kept.wrapping_add(first.slot),
            slots: access.slots,
            alpha: alpha.wrapping_add(first.whole),
            copies: match branching {
                0 => run.copies,
                branching => branching,
            },
            apart,
            whole_apart,
            leaf_turns: access.turns.wrapping_add(child.own),
            leaf_bends: access.bends.wrapping_add(child.own),
            leaf_omega: access.omega.wrapping_add(child.own),
            leaf_alpha: alpha.wrapping_add(child.whole),
            below: access.answers.wrapping_add(child.slot),
            numbers: PhantomData,
        }
    }

    /// The places of vectors: the last ones overlap those before, where vectors do not
    /// divide the neighbours; fewer than a vector holds are one step, whose other
    /// lanes mean nothing.
    #[inline(always)]
    pub(super) fn places<V: Vector<T>>(&self) -> Places {
        Places {
            next: 0,
            step: V::LANES,
            last: self.length.saturating_sub(V::LANES),
            length: self.length,
        }
    }

    #[inline(always)]
    unsafe fn motion_at<V: Vector<T>>(
        &self,
        [turns, bends, omega]: [*const T; 3],
        joints: bool,
    ) -> Motion<V> {
        let [sine, cosine] = unsafe { read(turns, self.links) };
        let omega = unsafe { V::read(omega) };
        // Where nothing acts in joints nobody reads them.
        let [bend, bend_rate] = match joints {
            true => unsafe { read(bends, self.links) },
            false => [omega; 2],
        };
        Motion {
            sine,
            cosine,
            omega,
            bend,
            bend_rate,
        }
    }

    #[inline(always)]
    pub(super) unsafe fn motion<V: Vector<T>>(&self, at: usize, joints: bool) -> Motion<V> {
        let places = [
            self.turns.wrapping_add(at),
            self.bends.wrapping_add(at),
            self.omega.wrapping_add(at),
        ];
        unsafe { self.motion_at(places, joints) }
    }

    /// Of children that are leaves.
    #[inline(always)]
    pub(super) unsafe fn leaf<V: Vector<T>>(
        &self,
        at: usize,
        copy: usize,
        joints: bool,
    ) -> Motion<V> {
        let at = at + copy * self.apart;
        let places = [
            self.leaf_turns.wrapping_add(at),
            self.leaf_bends.wrapping_add(at),
            self.leaf_omega.wrapping_add(at),
        ];
        unsafe { self.motion_at(places, joints) }
    }

    /// The first columns of their answers.
    #[inline(always)]
    pub(super) unsafe fn answers<V: Vector<T>, const M: usize>(&self, at: usize) -> [V; M] {
        unsafe { read(self.answers.add(at), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn answer<V: Vector<T>, const M: usize>(&self, at: usize, vectors: &[V; M]) {
        unsafe { write(vectors, self.answers.add(at), self.slots) }
    }

    /// The same of children that are no leaves.
    #[inline(always)]
    pub(super) unsafe fn below<V: Vector<T>, const M: usize>(
        &self,
        at: usize,
        copy: usize,
    ) -> [V; M] {
        unsafe { read(self.below.add(at + copy * self.apart), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn give<V: Vector<T>, const M: usize>(
        &self,
        at: usize,
        copy: usize,
        vectors: &[V; M],
    ) {
        unsafe { write(vectors, self.below.add(at + copy * self.apart), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn kept<V: Vector<T>, const M: usize>(&self, at: usize) -> [V; M] {
        unsafe { read(self.kept.add(at), self.slots) }
    }

    #[inline(always)]
    pub(super) unsafe fn keep<V: Vector<T>, const M: usize>(&self, at: usize, vectors: &[V; M]) {
        unsafe { write(vectors, self.kept.add(at), self.slots) }
    }

    #[inline(always)]
    unsafe fn accelerate_at<V: Vector<T>>(&self, places: *mut T, alpha: V) {
        match self.length >= V::LANES {
            true => unsafe { alpha.write(places) },
            false => unsafe { alpha.write_some(places, self.length) },
        }
    }

    /// Writes their accelerations.
    #[inline(always)]
    pub(super) unsafe fn accelerate<V: Vector<T>>(&self, at: usize, alpha: V) {
        unsafe { self.accelerate_at(self.alpha.add(at), alpha) }
    }

    /// Those of children that are leaves.
    #[inline(always)]
    pub(super) unsafe fn accelerate_leaf<V: Vector<T>>(&self, at: usize, copy: usize, alpha: V) {
        let at = at + copy * self.whole_apart;
        unsafe { self.accelerate_at(self.leaf_alpha.add(at), alpha) }
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
