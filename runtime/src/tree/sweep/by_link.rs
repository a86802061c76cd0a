//! Passes of the equations through a tree of any shape, in which each link has its own constants
//! and each strip consists of links of one height.

#![allow(unsafe_code)]

use super::passes::{Passes, add};
use super::strip::VectorIndices;
use super::view::LinkCells;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::Cells;
use crate::tree::equations::{LinkEquations, Row};
use crate::tree::output::Output;
use crate::tree::strips::{Attachment, Strip};

/// Memory layout of the links' numbers and of their constants. It is passed by value, because a
/// compiler reloads values behind a reference after every write.
#[derive(Clone, Copy)]
struct OwnCells<N, T> {
    links: LinkCells<T>,
    constants: Cells<N>,
}

// Safety of all functions here: as for all passes. The positions of links are those of strips and
// attachments, after the last of which a register of any width fits.
impl<E, N, T, V> Passes<'_, E, N, T, V>
where
    E: LinkEquations,
    N: Scalar,
    T: Scalar + Simd<N>,
    V: Simd<T>,
{
    /// True if registers have a single lane, so that all links are computed one by one.
    const SINGLE: bool = V::LANES == 1;

    #[inline(always)]
    fn cells(&self) -> OwnCells<N, T> {
        OwnCells {
            links: self.links(),
            constants: self.view.columns_of_constants(),
        }
    }

    /// Makes the upward pass, from the lowest strip to the root.
    #[inline(always)]
    pub(super) fn heights_up(&self) {
        let cells = &self.cells();
        let narrow = Passes::<E, N, T, V::One>::of(self.view);
        let mut strips = self.strips;
        while let Some((strip, before)) = strips.split_last() {
            if Self::SINGLE {
                self.one_by_one_up(cells, strip);
            } else if strip.length < V::LANES {
                narrow.one_by_one_up(cells, strip);
            } else {
                self.links_up(cells, strip);
                self.attach(cells, strip);
            }
            strips = before;
        }
    }

    /// Makes the downward pass, from the root to the lowest strip.
    #[inline(always)]
    pub(super) fn heights_down(&self, out: &mut impl Output<T>) {
        let cells = &self.cells();
        let narrow = Passes::<E, N, T, V::One>::of(self.view);
        let mut strips = self.strips;
        while let Some((strip, behind)) = strips.split_first() {
            if Self::SINGLE {
                self.one_by_one_down(cells, strip, out);
            } else if strip.length < V::LANES {
                narrow.one_by_one_down(cells, strip, out);
            } else {
                // Not directly after writing: a register that starts at another address than the
                // written one is read slowly.
                self.hand_down(cells, strip);
                self.links_down(cells, strip, out);
            }
            strips = behind;
        }
    }

    /// Makes the upward pass through a strip with too few links for a register, one link after the
    /// other. Each link's response is added to the parent at once, because numbers that were
    /// written one by one are read fastest one by one.
    #[inline(always)]
    fn one_by_one_up(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        // SAFETY: the view has checked the positions of strips and attachments.
        unsafe {
            if strip.first.own == 0 {
                let _ = self.response(cells, strip, 0);
            }
            let (from, to) = strip.attachments;
            for attachment in self.attachments.get(from..to).unwrap_or_default() {
                let mut at = 0;
                while at < attachment.length {
                    let response = self.response(cells, strip, attachment.child + at);
                    self.attach_at(cells, attachment, at, response);
                    at += 1;
                }
            }
        }
    }

    /// Makes the downward pass through a strip link by link; the counterpart of `one_by_one_up`.
    #[inline(always)]
    fn one_by_one_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        // SAFETY: the view has checked the positions of strips and attachments.
        unsafe {
            if let (0, Some([x, y])) = (strip.first.own, &self.view.root) {
                self.accelerate(cells, strip, 0, [V::splat(*x), V::splat(*y)], out);
            }
            let (from, to) = strip.attachments;
            for attachment in self.attachments.get(from..to).unwrap_or_default() {
                let mut at = 0;
                while at < attachment.length {
                    let pivot = self.pivot_at(cells, attachment, at);
                    self.accelerate(cells, strip, attachment.child + at, pivot, out);
                    at += 1;
                }
            }
        }
    }

    /// Computes and returns the responses of the links of a strip from index `at` on.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
    #[inline(always)]
    unsafe fn response(&self, cells: &OwnCells<N, T>, strip: &Strip, at: usize) -> E::Response<V> {
        // SAFETY: guaranteed by the caller; the view has checked all numbers of the links.
        unsafe {
            let constants = self.constants(cells, at);
            let link = cells.links.motion(at, Self::READ);
            if strip.copies == 0 {
                return E::leaf(&constants, link);
            }
            let sums = cells.links.sums.read(strip.slot(at));
            let (response, elimination) = E::inner(&constants, link, sums);
            cells.links.eliminations.write(at, &elimination);
            response
        }
    }

    /// Writes the accelerations of the links of a strip from index `at` on, and the numbers that
    /// they pass to their children.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
    #[inline(always)]
    unsafe fn accelerate(
        &self,
        cells: &OwnCells<N, T>,
        strip: &Strip,
        at: usize,
        pivot: [V; 2],
        out: &mut impl Output<T>,
    ) {
        // SAFETY: guaranteed by the caller; the view has checked all numbers of the links.
        unsafe {
            let constants = self.constants(cells, at);
            let link = cells.links.motion(at, Self::READ);
            if strip.copies == 0 {
                let acceleration = E::accelerate_leaf(&constants, link, pivot);
                out.write(at, acceleration, V::LANES);
                return;
            }
            let elimination = cells.links.eliminations.read(at);
            let (acceleration, carried) = E::accelerate(&constants, link, elimination, pivot);
            out.write(at, acceleration, V::LANES);
            cells.links.sums.write(strip.slot(at), &carried);
        }
    }

    /// Makes the upward pass through a strip whose links have separate constants.
    #[inline(always)]
    fn links_up(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let mut places = VectorIndices::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: the view has checked the positions of strips.
            unsafe {
                let response = self.response(cells, strip, at);
                cells.links.responses.write(at, &response);
            }
        }
    }

    /// Makes the downward pass through a strip; the counterpart of `links_up`. The accelerations of
    /// the pivots are in memory.
    #[inline(always)]
    fn links_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        let mut places = VectorIndices::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: the view has checked the positions of strips.
            unsafe {
                let pivot = cells.links.responses.read(at);
                self.accelerate(cells, strip, at, pivot, out);
            }
        }
    }

    /// Adds the responses of a strip's links to the sums of their parents.
    #[inline(always)]
    fn attach(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let (from, to) = strip.attachments;
        let mut attachments = self.attachments.get(from..to).unwrap_or_default();
        while let Some((first, others)) = attachments.split_first() {
            let mut count = 0;
            while let Some(other) = others.get(count)
                && other.parent == first.parent
                && other.length <= first.length
            {
                count += 1;
            }
            let (siblings, behind) = others.split_at_checked(count).unwrap_or_default();
            self.attach_siblings(cells, first, siblings);
            attachments = behind;
        }
    }

    /// Adds the responses of all children of the same parents while the sums are in registers,
    /// because numbers that were just written with another width or at a shifted address are read
    /// slowly.
    #[inline(always)]
    fn attach_siblings(&self, cells: &OwnCells<N, T>, first: &Attachment, siblings: &[Attachment]) {
        let mut at = 0;
        while at < first.length {
            // SAFETY: the view has checked the positions of attachments. Lanes past the parents are
            // written back unchanged.
            unsafe {
                let link = cells.links.motion(first.parent + at, Self::DIRECTION);
                let mut sums: E::Sums<V> = cells.links.sums.read(first.slot + at);
                let (mut attachment, mut siblings, mut fresh) = (first, siblings, first.first);
                loop {
                    let child = attachment.child + at;
                    let constants = self.constants(cells, child);
                    let own = E::attach(&constants, link, cells.links.responses.read(child));
                    Self::add_first(&mut sums, &own, attachment.length - at, fresh);
                    fresh = false;
                    match siblings.split_first() {
                        Some((next, behind)) if at < next.length => {
                            (attachment, siblings) = (next, behind);
                        }
                        _ => break,
                    }
                }
                cells.links.sums.write(first.slot + at, &sums);
            }
            at += V::LANES;
        }
    }

    /// Adds `terms` to the first `count` lanes of the sums, or sets these lanes if `fresh` is true.
    #[inline(always)]
    fn add_first(sums: &mut E::Sums<V>, terms: &E::Sums<V>, count: usize, fresh: bool) {
        let mut i = 0;
        while i < <E::Sums<V> as Row<V>>::LENGTH {
            let (sum, term) = (sums.as_ref()[i], terms.as_ref()[i]);
            let new = if fresh { term } else { sum + term };
            sums.as_mut()[i] = new.in_first_lanes(count, sum);
            i += 1;
        }
    }

    /// Adds the response of child number `at` of an attachment to the sums of its parent.
    ///
    /// # Safety
    /// The attachment must have this many children.
    #[inline(always)]
    unsafe fn attach_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
        response: E::Response<V>,
    ) {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: guaranteed by the caller; the view has checked all numbers of both links.
        unsafe {
            let constants = self.constants(cells, child);
            let link = cells.links.motion(parent, Self::DIRECTION);
            let own = E::attach(&constants, link, response);
            let mut sums = own;
            if !attachment.first {
                sums = cells.links.sums.read(attachment.slot + at);
                add(&mut sums, &own);
            }
            cells.links.sums.write(attachment.slot + at, &sums);
        }
    }

    /// Writes the accelerations of the pivots of a strip's children.
    #[inline(always)]
    fn hand_down(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // Lanes past the children belong to later children, which are written later.
                // SAFETY: the view has checked the positions of attachments.
                unsafe {
                    let pivot = self.pivot_at(cells, attachment, at);
                    cells.links.responses.write(attachment.child + at, &pivot);
                }
                at += V::LANES;
            }
        }
    }

    /// Returns the accelerations of the pivots of the children from index `at` of an attachment on.
    ///
    /// # Safety
    /// The attachment must have more than `at` children.
    #[inline(always)]
    unsafe fn pivot_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
    ) -> [V; 2] {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: guaranteed by the caller; the view has checked all numbers of both links.
        unsafe {
            let constants = self.constants(cells, child);
            let link = cells.links.motion(parent, Self::DIRECTION);
            E::pivot(
                &constants,
                link,
                cells.links.sums.read(attachment.slot + at),
            )
        }
    }

    /// Returns the constants of the links from index `at` on.
    ///
    /// # Safety
    /// They must be links of the tree.
    #[inline(always)]
    unsafe fn constants(&self, cells: &OwnCells<N, T>, at: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let mut column = 0;
        while column < <E::Constants<V> as Row<V>>::LENGTH {
            // SAFETY: guaranteed by the caller; the view has checked that each constant has a
            // column.
            row.as_mut()[column] = unsafe { constant(cells.constants, column, at) };
            column += 1;
        }
        if at == 0 {
            self.take_torque(&mut row);
        }
        row
    }
}

/// Returns one constant of the links from index `at` on: a separate number for each lane of `V` or,
/// if a `T` holds several states, the same number for all states.
///
/// # Safety
/// The numbers must be valid for reads.
#[inline(always)]
unsafe fn constant<N: Scalar, T: Scalar + Simd<N>, V: Simd<T>>(
    constants: Cells<N>,
    column: usize,
    at: usize,
) -> V {
    let start = constants.place(at, column);
    // A one-lane register may be aligned to more memory than its number.
    let is_number = const { <T as Simd<N>>::LANES == 1 && size_of::<T>() == size_of::<N>() };
    // SAFETY: guaranteed by the caller. A `T` of one lane and of this size is the `N` that it
    // holds.
    unsafe {
        match is_number {
            true => V::read(start.cast()),
            false => V::splat(T::splat(start.read())),
        }
    }
}
