//! The equations, taken through a tree of any shape, with constants of each link: a
//! strip is all links of one height.

#![allow(unsafe_code)]

use super::passes::{Passes, add};
use super::strip::VectorPlaces;
use super::view::LinkCells;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::Cells;
use crate::tree::equations::{LinkEquations, Row};
use crate::tree::output::Output;
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
        // SAFETY: places of strips and attachments are there, as the view has seen.
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

    /// Goes back down as `one_by_one_up` went up.
    #[inline(always)]
    fn one_by_one_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        // SAFETY: places of strips and attachments are there, as the view has seen.
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

    /// The responses of the links of a strip from the place `at` on.
    ///
    /// # Safety
    /// A place of the strip.
    #[inline(always)]
    unsafe fn response(&self, cells: &OwnCells<N, T>, strip: &Strip, at: usize) -> E::Response<V> {
        // SAFETY: the caller's. All that a link has stands there, as the view has seen.
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

    /// Writes the accelerations of the links of a strip from the place `at` on, and
    /// what they hand to their children.
    ///
    /// # Safety
    /// A place of the strip.
    #[inline(always)]
    unsafe fn accelerate(
        &self,
        cells: &OwnCells<N, T>,
        strip: &Strip,
        at: usize,
        pivot: [V; 2],
        out: &mut impl Output<T>,
    ) {
        // SAFETY: the caller's. All that a link has stands there, as the view has seen.
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

    /// A strip of links with constants of their own, up.
    #[inline(always)]
    fn links_up(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let mut places = VectorPlaces::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: places of strips are there, as the view has seen.
            unsafe {
                let response = self.response(cells, strip, at);
                cells.links.responses.write(at, &response);
            }
        }
    }

    /// Goes back down as `links_up` went up; the accelerations of pivots are in memory.
    #[inline(always)]
    fn links_down(&self, cells: &OwnCells<N, T>, strip: &Strip, out: &mut impl Output<T>) {
        let mut places = VectorPlaces::of::<T, V>(strip.length);
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: places of strips are there, as the view has seen.
            unsafe {
                let pivot = cells.links.responses.read(at);
                self.accelerate(cells, strip, at, pivot, out);
            }
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
            // SAFETY: places of attachments are there, as the view has seen. Lanes beyond the
            // parents are written as they were.
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

    /// Adds to the first `count` lanes of sums, or puts there what would be added to nothing.
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

    /// Adds the response of the child number `at` of an attachment.
    ///
    /// # Safety
    /// The attachment has so many children.
    #[inline(always)]
    unsafe fn attach_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
        response: E::Response<V>,
    ) {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: the caller's. All that both links have stands there, as the view has seen.
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

    /// Writes the accelerations of the pivots of a strip.
    #[inline(always)]
    fn hand_down(&self, cells: &OwnCells<N, T>, strip: &Strip) {
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // Lanes beyond are those of children behind, which come later.
                // SAFETY: places of attachments are there, as the view has seen.
                unsafe {
                    let pivot = self.pivot_at(cells, attachment, at);
                    cells.links.responses.write(attachment.child + at, &pivot);
                }
                at += V::LANES;
            }
        }
    }

    /// The accelerations of the pivots of children.
    ///
    /// # Safety
    /// The attachment has more than `at` children.
    #[inline(always)]
    unsafe fn pivot_at(
        &self,
        cells: &OwnCells<N, T>,
        attachment: &Attachment,
        at: usize,
    ) -> [V; 2] {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: the caller's. All that both links have stands there, as the view has seen.
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

    /// The constants of the links from `at` on, each its own.
    ///
    /// # Safety
    /// Links of the tree.
    #[inline(always)]
    unsafe fn constants(&self, cells: &OwnCells<N, T>, at: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let mut column = 0;
        while column < <E::Constants<V> as Row<V>>::LENGTH {
            // SAFETY: the caller's. There is a column for each constant, as the view has seen.
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
/// The numbers may be read there.
#[inline(always)]
unsafe fn constant<N: Scalar, T: Scalar + Simd<N>, V: Simd<T>>(
    constants: Cells<N>,
    column: usize,
    at: usize,
) -> V {
    let start = constants.place(at, column);
    // One lane in an array may be aligned so that it takes more memory than its number.
    let is_number = const { <T as Simd<N>>::LANES == 1 && size_of::<T>() == size_of::<N>() };
    // SAFETY: the caller's. A `T` of one lane and of this size is the `N` that it holds.
    unsafe {
        match is_number {
            true => V::read(start.cast()),
            false => V::splat(T::splat(start.read())),
        }
    }
}
