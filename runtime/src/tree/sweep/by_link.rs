//! The equations, taken through a tree of any shape, with constants of each link: a
//! strip is all links of one height.

#![allow(unsafe_code)]

use super::passes::{Passes, add};
use super::strip::{Output, VectorPlaces};
use super::view::LinkCells;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::Cells;
use crate::tree::equations::{LinkEquations, Row};
use crate::tree::strips::{Attachment, Strip};

/// Where the numbers of links and their constants stand. A copy: compilers read what is
/// behind a reference again after everything that is written.
#[derive(Clone, Copy)]
struct OwnCells<N, T> {
    links: LinkCells<T>,
    constants: Cells<N>,
}

// Of all this: as for all passes; the places of links are those of the
// strips and attachments, behind the last of which a register of any width is there.
impl<E, N, T, V> Passes<'_, E, N, T, V>
where
    E: LinkEquations,
    N: Scalar,
    T: Scalar + Simd<N>,
    V: Simd<T>,
{
    /// In single numbers there is nothing but links one by one.
    const SINGLE: bool = V::LANES == 1;

    #[inline(always)]
    fn cells(&self) -> OwnCells<N, T> {
        OwnCells {
            links: self.links(),
            constants: self.view.columns_of_constants(),
        }
    }

    /// From the lowest strip to the root.
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

    /// From the root to the lowest strip.
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
                // Not at once: in registers that start elsewhere than these, what was just
                // written is read late.
                self.hand_down(cells, strip);
                self.links_down(cells, strip, out);
            }
            strips = behind;
        }
    }

    /// A strip of too few links for a register, up, one by one: each link's response goes
    /// to the parent at once, and what is written narrow is read narrow soon.
    #[inline(always)]
    fn one_by_one_up(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        if strip.first.own == 0 {
            // SAFETY: places of strips and attachments are there, as the view has seen.
            let _ = unsafe { self.response(cells, strip, 0) };
        }
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // SAFETY: places of strips and attachments are there, as the view has seen.
                let response = unsafe { self.response(cells, strip, attachment.child + at) };
                // SAFETY: places of strips and attachments are there, as the view has seen.
                unsafe { self.attach_at(cells, attachment, at, response) };
                at += 1;
            }
        }
    }

    /// Goes back down as `one_by_one_up` went up.
    #[inline(always)]
    fn one_by_one_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        if let (0, Some([x, y])) = (strip.first.own, &self.view.root) {
            let pivot = [V::splat(*x), V::splat(*y)];
            // SAFETY: places of strips and attachments are there, as the view has seen.
            unsafe { self.accelerate(cells, strip, 0, pivot, out) };
        }
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // SAFETY: places of strips and attachments are there, as the view has seen.
                let pivot = unsafe { self.pivot_at(cells, attachment, at) };
                // SAFETY: places of strips and attachments are there, as the view has seen.
                unsafe { self.accelerate(cells, strip, attachment.child + at, pivot, out) };
                at += 1;
            }
        }
    }

    /// The responses of the links of a strip from the place `at` on.
    #[inline(always)]
    unsafe fn response(&self, cells: &OwnCells<N, T>, strip: &Strip, at: usize) -> E::Response<V> {
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let (constants, link) = unsafe {
            (
                self.constants(cells, at),
                cells.links.motion(at, Self::READ),
            )
        };
        if strip.copies == 0 {
            return E::leaf(&constants, link);
        }
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let sums = unsafe { cells.links.sums.read(strip.slot(at)) };
        let (response, elimination) = E::inner(&constants, link, sums);
        // SAFETY: places of strips and attachments are there, as the view has seen.
        unsafe { cells.links.eliminations.write(at, &elimination) };
        response
    }

    /// Writes the accelerations of the links of a strip from the place `at` on, and
    /// what they hand to their children.
    #[inline(always)]
    unsafe fn accelerate(
        &self,
        cells: &OwnCells<N, T>,
        strip: &Strip,
        at: usize,
        pivot: [V; 2],
        out: &mut impl Output<T>,
    ) {
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let (constants, link) = unsafe {
            (
                self.constants(cells, at),
                cells.links.motion(at, Self::READ),
            )
        };
        if strip.copies == 0 {
            let acceleration = E::accelerate_leaf(&constants, link, pivot);
            // SAFETY: places of strips and attachments are there, as the view has seen.
            unsafe { out.write(at, acceleration, V::LANES) };
            return;
        }
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let elimination = unsafe { cells.links.eliminations.read(at) };
        let (acceleration, carried) = E::accelerate(&constants, link, elimination, pivot);
        // SAFETY: places of strips and attachments are there, as the view has seen.
        unsafe { out.write(at, acceleration, V::LANES) };
        // SAFETY: places of strips and attachments are there, as the view has seen.
        unsafe { cells.links.sums.write(strip.slot(at), &carried) };
    }

    /// A strip of links with constants of their own, up.
    #[inline(always)]
    fn links_up(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let mut places = VectorPlaces::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: places of strips and attachments are there, as the view has seen.
            let response = unsafe { self.response(cells, strip, at) };
            // SAFETY: places of strips and attachments are there, as the view has seen.
            unsafe { cells.links.responses.write(at, &response) };
        }
    }

    /// Goes back down as `links_up` went up; the accelerations of pivots are in memory.
    #[inline(always)]
    fn links_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        let mut places = VectorPlaces::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: places of strips and attachments are there, as the view has seen.
            let pivot = unsafe { cells.links.responses.read(at) };
            // SAFETY: places of strips and attachments are there, as the view has seen.
            unsafe { self.accelerate(cells, strip, at, pivot, out) };
        }
    }

    /// Adds the responses of a strip to the sums of the parents.
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

    /// Adds the responses of children of the same parents, in registers: what has just
    /// been written in another width, or a little beside, takes long to read.
    #[inline(always)]
    fn attach_siblings(&self, cells: &OwnCells<N, T>, first: &Attachment, siblings: &[Attachment]) {
        let mut at = 0;
        while at < first.length {
            let (mut attachment, mut siblings) = (first, siblings);
            // SAFETY: places of strips and attachments are there, as the view has seen.
            let link = unsafe { cells.links.motion(first.parent + at, Self::DIRECTION) };
            // SAFETY: places of strips and attachments are there, as the view has seen.
            let before: E::Sums<V> = unsafe { cells.links.sums.read(first.slot + at) };
            let mut sums = before;
            let mut fresh = first.first;
            loop {
                let child = attachment.child + at;
                // SAFETY: places of strips and attachments are there, as the view has seen.
                let (constants, response) = unsafe {
                    (
                        self.constants(cells, child),
                        cells.links.responses.read(child),
                    )
                };
                let own = E::attach(&constants, link, response);
                let count = attachment.length - at;
                let mut i = 0;
                while i < <E::Sums<V> as Row<V>>::LENGTH {
                    let (sum, own) = (sums.as_ref()[i], own.as_ref()[i]);
                    let sum = if fresh { own } else { sum + own };
                    sums.as_mut()[i] = sum.in_first_lanes(count, sums.as_ref()[i]);
                    i += 1;
                }
                fresh = false;
                match siblings.split_first() {
                    Some((next, behind)) if at < next.length => {
                        (attachment, siblings) = (next, behind);
                    }
                    _ => break,
                }
            }
            // SAFETY: places of an attachment are there, as the view has seen. Lanes beyond
            // the parents are as they were.
            unsafe { cells.links.sums.write(first.slot + at, &sums) };
            at += V::LANES;
        }
    }

    /// Adds the response of the child number `at` of an attachment.
    #[inline(always)]
    unsafe fn attach_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
        response: E::Response<V>,
    ) {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let (constants, link) = unsafe {
            (
                self.constants(cells, child),
                cells.links.motion(parent, Self::DIRECTION),
            )
        };
        let own = E::attach(&constants, link, response);
        let mut sums = own;
        if !attachment.first {
            // SAFETY: places of strips and attachments are there, as the view has seen.
            sums = unsafe { cells.links.sums.read(attachment.slot + at) };
            add(&mut sums, &own);
        }
        // SAFETY: places of strips and attachments are there, as the view has seen.
        unsafe { cells.links.sums.write(attachment.slot + at, &sums) };
    }

    /// Writes the accelerations of the pivots of a strip.
    #[inline(always)]
    fn hand_down(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // SAFETY: places of strips and attachments are there, as the view has seen.
                let pivot = unsafe { self.pivot_at(cells, attachment, at) };
                // Lanes beyond are those of children behind, which come later.
                // SAFETY: places of strips and attachments are there, as the view has seen.
                unsafe { cells.links.responses.write(attachment.child + at, &pivot) };
                at += V::LANES;
            }
        }
    }

    /// The accelerations of the pivots of children.
    #[inline(always)]
    unsafe fn pivot_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
    ) -> [V; 2] {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let (constants, link) = unsafe {
            (
                self.constants(cells, child),
                cells.links.motion(parent, Self::DIRECTION),
            )
        };
        // SAFETY: places of strips and attachments are there, as the view has seen.
        let carried = unsafe { cells.links.sums.read(attachment.slot + at) };
        E::pivot(&constants, link, carried)
    }

    /// The constants of the links from `at` on, each its own.
    #[inline(always)]
    unsafe fn constants(&self, cells: &OwnCells<N, T>, at: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let mut column = 0;
        while column < <E::Constants<V> as Row<V>>::LENGTH {
            // SAFETY: places of strips and attachments are there, as the view has seen.
            row.as_mut()[column] = unsafe { constant(cells.constants, column, at) };
            column += 1;
        }
        if at == 0 {
            self.take_torque(&mut row);
        }
        row
    }
}

/// The number in a column of constants of the links from `at` on: one for each lane of `V`, or
/// the same for all states of a `T`.
///
/// # Safety
/// They may be read there.
#[inline(always)]
unsafe fn constant<N: Scalar, T: Scalar + Simd<N>, V: Simd<T>>(
    constants: Cells<N>,
    column: usize,
    at: usize,
) -> V {
    let start = constants.place(at, column);
    match <T as Simd<N>>::LANES {
        // SAFETY: the caller's. A `T` of one lane is the `N` that it holds.
        1 => unsafe { V::read(start.cast()) },
        // SAFETY: the caller's.
        _ => V::splat(T::splat(unsafe { start.read() })),
    }
}
