//! Access to the numbers of a strip of links, one vector of neighbouring links at a time.

#![allow(unsafe_code)]

use super::view::LinkCells;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::output::Output;
use crate::tree::strips::Strip;

/// Access to the numbers of a strip's links and of their children. The children are leaves, or
/// their responses are in memory.
///
/// The functions take the index of a vector of neighbouring links (a multiple of its number of
/// lanes, or the last index), and the index of a copy of the children. They are sound for equations
/// of the sizes for which [`strips`](super::view::View::strips) was called.
// Passed by value: a compiler keeps it in registers, and reloads values behind a reference after
// every write.
pub(super) struct StripView<T> {
    length: usize,
    pub(super) links: LinkCells<T>,
    pub(super) children: LinkCells<T>,
    whole: usize,
    child_whole: usize,
    step: usize,
    pub(super) copies: usize,
    /// Distance between the numbers of two copies of the children.
    pub(super) apart: usize,
    whole_apart: usize,
}

// Safety of all functions here: the numbers belong to the view while it lives, and no reference to
// them exists. `view` guarantees as many as the strips reach, including a vector of any width from
// the last index on, in as many columns as the sizes say.
impl<T: Scalar> StripView<T> {
    /// Creates the view of a strip among the numbers of all links. The strip must come from
    /// [`strips`](super::view::View::strips) with the same `branching`.
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

    /// Iterates over the indices of vectors that cover the links. If the number of links is not a
    /// multiple of the lanes, the last vector overlaps the one before; fewer links than lanes are
    /// one vector, whose other lanes are unused.
    #[inline(always)]
    pub(super) fn places<V: Simd<T>>(&self) -> VectorIndices {
        VectorIndices::of::<T, V>(self.length)
    }

    /// Returns the distance between links in the arrays of the tree: 1 if lanes hold neighbouring
    /// links.
    #[inline(always)]
    fn step<V: Simd<T>>(&self) -> usize {
        match V::LANES {
            1 => self.step,
            _ => 1,
        }
    }

    /// Writes the accelerations of the links from index `at` on.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
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

    /// Writes the accelerations of copy number `copy` of the children, which are leaves.
    ///
    /// # Safety
    /// `at` must be an index of the strip, and `copy` must exist.
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

/// Iterator over the indices of vectors that cover neighbouring links; the last vector may overlap
/// the one before.
pub(in crate::tree) struct VectorIndices {
    next: usize,
    step: usize,
    last: usize,
    length: usize,
}

impl VectorIndices {
    /// Creates the indices for `length` neighbouring links.
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
