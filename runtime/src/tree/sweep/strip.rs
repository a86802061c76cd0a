//! Where the equations read and write: a vector of neighbours at a time.

#![allow(unsafe_code)]

use super::view::LinkCells;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::output::Output;
use crate::tree::strips::Strip;

/// The numbers of neighbours and of their children, from the first one's on. The
/// children are leaves, or their responses are in memory.
///
/// The functions take the place of a vector among the neighbours, a multiple of its
/// lanes or the last place, and the number of a copy of the children. All are sound
/// for equations of the sizes that [`strips`](super::view::View::strips) has been asked for.
// A copy of its own: compilers keep it in registers, and read what is behind a
// reference again after everything that is written.
pub(super) struct StripView<T> {
    length: usize,
    pub(super) links: LinkCells<T>,
    pub(super) children: LinkCells<T>,
    whole: usize,
    child_whole: usize,
    step: usize,
    pub(super) copies: usize,
    /// From one copy to the next.
    pub(super) apart: usize,
    whole_apart: usize,
}

// Of all these: the numbers are the view's own for as long as it lives,
// and no reference to them is there. By `view` there are as many as the strips reach,
// with those of a vector of any width from the last place on, in as many columns as
// the sizes say.
impl<T: Scalar> StripView<T> {
    /// Of a strip that has come from [`strips`](super::view::View::strips), for the same
    /// `branching`, among these numbers of all links.
    #[inline(always)]
    pub(super) fn of(links: LinkCells<T>, strip: &Strip, branching: usize) -> Self {
        let Strip {
            first,
            child,
            length,
            apart,
            whole_apart,
            step,
            ..
        } = *strip;
        StripView {
            length,
            links: links.from(first.own, first.slot),
            children: links.from(child.own, child.slot),
            whole: first.whole,
            child_whole: child.whole,
            step,
            copies: match branching {
                0 => strip.copies,
                branching => branching,
            },
            apart,
            whole_apart,
        }
    }

    /// The places of vectors: the last ones overlap those before, where vectors do not
    /// divide the neighbours; fewer than a vector holds are one step, whose other
    /// lanes mean nothing.
    #[inline(always)]
    pub(super) fn places<V: Simd<T>>(&self) -> VectorPlaces {
        VectorPlaces::of::<T, V>(self.length)
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
    ///
    /// # Safety
    /// A place of the strip.
    #[inline(always)]
    pub(super) unsafe fn accelerate<V: Simd<T>>(
        &self,
        out: &mut impl Output<T>,
        at: usize,
        alpha: V,
    ) {
        let count = self.length.min(V::LANES);
        // SAFETY: the caller's: it is within reach of the strip.
        unsafe { out.write(self.whole + at * self.step::<V>(), alpha, count) }
    }

    /// Writes the accelerations of children that are leaves.
    ///
    /// # Safety
    /// A place of the strip, and a copy that it has.
    #[inline(always)]
    pub(super) unsafe fn accelerate_leaf<V: Simd<T>>(
        &self,
        out: &mut impl Output<T>,
        at: usize,
        copy: usize,
        alpha: V,
    ) {
        let count = self.length.min(V::LANES);
        let at = self.child_whole + at * self.step::<V>() + copy * self.whole_apart;
        // SAFETY: the caller's: it is within reach of the strip.
        unsafe { out.write(at, alpha, count) }
    }
}

/// Places of vectors among neighbours.
pub(in crate::tree) struct VectorPlaces {
    next: usize,
    step: usize,
    last: usize,
    length: usize,
}

impl VectorPlaces {
    /// Of so many neighbours.
    #[inline(always)]
    pub(in crate::tree) fn of<T, V: Simd<T>>(length: usize) -> Self {
        Self {
            next: 0,
            step: V::LANES,
            last: length.saturating_sub(V::LANES),
            length,
        }
    }

    #[inline(always)]
    pub(in crate::tree) fn next(&mut self) -> Option<usize> {
        if self.next >= self.length {
            return None;
        }
        let place = self.next.min(self.last);
        self.next += self.step;
        Some(place)
    }
}
