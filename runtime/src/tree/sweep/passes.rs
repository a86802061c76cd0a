//! Passes of the equations through a block, compiled with every model.

#![allow(unsafe_code)]

use core::marker::PhantomData;
use core::ops::Range;

use super::strip::StripView;
use super::view::{LinkCells, Read, View};
use crate::scalar::Scalar;
use crate::simd::dispatch::in_widest;
use crate::simd::{Kernel, Simd, WIDEST};
use crate::tree::equations::{LinkEquations, LinkMotion, Row};
use crate::tree::memory::Sizes;
use crate::tree::output::Output;
use crate::tree::shared::Shared;
use crate::tree::strips::{Attachment, Strip};

/// Selects the passes that are made through a block: upward, downward, or both.
#[derive(Clone, Copy, Debug)]
pub(in crate::tree) struct PassSelection<'a, T> {
    /// True to make the upward pass, from the leaves to the first generation.
    pub(in crate::tree) up: bool,
    /// Destination of the accelerations if the downward pass is made, from the first generation to
    /// the leaves. The acceleration of the first generation's pivots is that of the root's pivot,
    /// or is in memory. The destination starts with the block's first link and reaches as far as
    /// its strips.
    pub(in crate::tree) down: Option<Shared<'a, T>>,
}

/// Evaluates the equations through a block, in the widest registers of the machine.
pub(in crate::tree) fn sweep<E: LinkEquations, T: Scalar>(
    view: &View<'_, T, T>,
    way: PassSelection<'_, T>,
) {
    in_widest(SweepKernel::<E, T>(view, way, PhantomData));
}

/// Operation that runs [`sweep`] with one kind of registers.
pub(in crate::tree) struct SweepKernel<'a, E, T>(
    pub(in crate::tree) &'a View<'a, T, T>,
    pub(in crate::tree) PassSelection<'a, T>,
    pub(in crate::tree) PhantomData<E>,
);

impl<E: LinkEquations, T: Scalar> Kernel<T> for SweepKernel<'_, E, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let (passes, PassSelection { up, down }) = (Passes::<E, T, T, V>::of(self.0), self.1);
        if up {
            passes.up();
        }
        if let Some(mut alpha) = down {
            passes.down(&mut alpha);
        }
    }
}

/// Passes of one set of equations through a block, in vectors `V` of numbers `T`.
pub(in crate::tree) struct Passes<'a, E, N, T, V> {
    pub(super) view: &'a View<'a, N, T>,
    /// Strips of the block; empty if the block's layout does not match these equations.
    pub(super) strips: &'a [Strip],
    pub(super) attachments: &'a [Attachment],
    types: PhantomData<(E, V)>,
}

// Safety of all functions here: strips exist only if the view has the columns of these equations;
// all indices come from `StripView::places`, copies are counted up to `StripView::copies`, and
// attachments are those of the strips. After the last index a register of the widest kind fits;
// states in lanes, `T`, are one `V` each.
impl<'a, E, N, T, V> Passes<'a, E, N, T, V>
where
    E: LinkEquations,
    N: Scalar,
    T: Scalar + Simd<N>,
    V: Simd<T>,
{
    /// Number of copies under each link if it is the same in all generations, otherwise 0; a
    /// constant number needs no loop.
    const BRANCHING: usize = branching(E::COPIES);

    /// True if a number `T` holds several states; the numbers of a link are then contiguous.
    const IN_ROWS: bool = <T as Simd<N>>::LANES > 1;

    const SIZES: Sizes = Sizes::of::<E, V>();

    /// Selection of those quantities of a link's own motion that the equations use.
    pub(super) const READ: Read = Read {
        joints: E::JOINTS,
        torques: E::FORCED,
        prescribed: E::PRESCRIBED,
    };

    /// Selection of those quantities of the parent's motion that the equations use.
    pub(super) const DIRECTION: Read = Read {
        joints: false,
        torques: false,
        prescribed: false,
    };

    /// True if constants have one row per link.
    const BY_LINK: bool = E::COPIES.is_empty();

    #[inline(always)]
    pub(in crate::tree) fn of(view: &'a View<'_, N, T>) -> Self {
        const { assert!(V::LANES <= WIDEST) };
        let (strips, attachments) = view.strips(Self::SIZES, Self::IN_ROWS, Self::BRANCHING);
        Self {
            view,
            strips,
            attachments,
            types: PhantomData,
        }
    }

    /// Returns passes that are restricted to these strips.
    #[inline(always)]
    pub(in crate::tree) fn within(self, strips: Range<usize>) -> Self {
        let strips = self.strips.get(strips).unwrap_or_default();
        Self { strips, ..self }
    }

    /// Returns the memory layout of the links' numbers. It is called at the start of each loop,
    /// because a compiler reloads values behind a reference after every write.
    #[inline(always)]
    pub(super) fn links(&self) -> LinkCells<T> {
        match Self::IN_ROWS {
            true => self.view.rows(Self::SIZES),
            false => self.view.columns(),
        }
    }

    /// Returns the constants of a generation; zeros if it has none.
    #[inline(always)]
    fn row(&self, generation: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let length = <E::Constants<V> as Row<V>>::LENGTH;
        let start = generation * length;
        if let Some(numbers) = self.view.constants.get(start..start + length) {
            let mut i = 0;
            while i < length {
                row.as_mut()[i] = V::splat(T::splat(numbers[i]));
                i += 1;
            }
        }
        if generation == 0 {
            self.take_torque(&mut row);
        }
        row
    }

    #[inline(always)]
    pub(super) fn take_torque(&self, row: &mut E::Constants<V>) {
        if E::TORQUE
            && let (Some(torque), Some(last)) = (self.view.torque, row.as_mut().last_mut())
        {
            *last = V::splat(torque);
        }
    }

    /// Returns the constants of leaves, which are in the last row.
    #[inline(always)]
    fn leaf(&self) -> E::Constants<V> {
        let rows = self.view.constants.len() / <E::Constants<V> as Row<V>>::LENGTH.max(1);
        self.row(rows.saturating_sub(1))
    }

    /// Makes the upward pass, from the leaves to the first strip.
    #[inline(always)]
    pub(in crate::tree) fn up(&self) {
        match Self::BY_LINK {
            true => self.heights_up(),
            false => self.generations_up(),
        }
    }

    /// Makes the downward pass, from the first strip to the leaves. The acceleration of the first
    /// strip's pivots is that of the root's pivot, or is in memory.
    #[inline(always)]
    pub(in crate::tree) fn down(&self, out: &mut impl Output<T>) {
        match Self::BY_LINK {
            true => self.heights_down(out),
            false => self.generations_down(out),
        }
    }

    /// Makes the upward pass through generations. The same loop body serves links above leaves, the
    /// uppermost generations and those in between, because every copy of the equations is compiled
    /// three times with each model.
    #[inline(always)]
    fn generations_up(&self) {
        let leaf = self.leaf();
        let mut responses = <E::Response<V> as Row<V>>::filled(V::from_f64(0.0));
        let mut strips = self.strips;
        while let Some((strip, before)) = strips.split_last() {
            let row = self.row(strip.generation);
            let below_row = self.row(strip.generation + 1);
            let near = StripView::of(self.links(), strip, Self::BRANCHING);
            let mut places = near.places::<V>();
            while let Some(at) = places.next() {
                // SAFETY: the view has checked the indices of a strip and its copies.
                unsafe {
                    let link = near.links.motion(at, Self::READ);
                    let below = match strip.leaves {
                        true => Self::leaves(&near, at, &leaf, link),
                        false if strip.lanes <= V::LANES => {
                            let (length, copies) = (strip.length, near.copies);
                            Self::neighbours(&responses, length, copies, &below_row, link)
                        }
                        false => Self::sum(&near, at, &below_row, link),
                    };
                    let elimination;
                    (responses, elimination) = E::inner(&row, link, below);
                    near.links.responses.write(at, &responses);
                    near.links.eliminations.write(at, &elimination);
                }
            }
            strips = before;
        }
    }

    /// Computes the responses of those children that are leaves, and returns their sum.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
    #[inline(always)]
    unsafe fn leaves(
        near: &StripView<T>,
        at: usize,
        constants: &E::Constants<V>,
        link: LinkMotion<V>,
    ) -> E::Sums<V> {
        // SAFETY: guaranteed by the caller; the view has checked its copies.
        unsafe {
            let mut sums = E::leaf(constants, near.children.motion(at, Self::READ));
            let mut copy = 1;
            while copy < near.copies {
                let leaf = near.children.motion(at + copy * near.apart, Self::READ);
                add(&mut sums, &E::leaf(constants, leaf));
                copy += 1;
            }
            E::attach(constants, link, sums)
        }
    }

    /// Returns the sum of the stored responses of those children that have children.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
    #[inline(always)]
    unsafe fn sum(
        near: &StripView<T>,
        at: usize,
        constants: &E::Constants<V>,
        link: LinkMotion<V>,
    ) -> E::Sums<V> {
        // SAFETY: guaranteed by the caller; the view has checked its copies.
        unsafe {
            let mut sums: E::Response<V> = near.children.responses.read(at);
            let mut copy = 1;
            while copy < near.copies {
                let place = at + copy * near.apart;
                add(&mut sums, &near.children.responses.read(place));
                copy += 1;
            }
            E::attach(constants, link, sums)
        }
    }

    /// Returns the sum of the children's responses, which are in registers, adding one child after
    /// the other.
    #[inline(always)]
    fn neighbours(
        responses: &E::Response<V>,
        count: usize,
        copies: usize,
        constants: &E::Constants<V>,
        link: LinkMotion<V>,
    ) -> E::Sums<V> {
        let mut sums = *responses;
        let mut copy = 1;
        while copy < copies {
            let mut i = 0;
            while i < <E::Response<V> as Row<V>>::LENGTH {
                let other = responses.as_ref()[i].rotate_lanes(copy * count);
                sums.as_mut()[i] = sums.as_ref()[i] + other;
                i += 1;
            }
            copy += 1;
        }
        E::attach(constants, link, sums)
    }

    /// Makes the downward pass through generations, from the first to the last.
    #[inline(always)]
    fn generations_down(&self, out: &mut impl Output<T>) {
        let leaf = self.leaf();
        let mut known = self.view.root.is_some();
        let mut pivot = match &self.view.root {
            Some([x, y]) => [V::splat(*x), V::splat(*y)],
            None => [V::from_f64(0.0); 2],
        };
        let mut strips = self.strips;
        while let Some((strip, behind)) = strips.split_first() {
            let row = self.row(strip.generation);
            let below_row = self.row(strip.generation + 1);
            let near = StripView::of(self.links(), strip, Self::BRANCHING);
            let in_register = strip.lanes <= V::LANES;
            let mut places = near.places::<V>();
            while let Some(at) = places.next() {
                // SAFETY: the view has checked the indices of a strip and its copies.
                unsafe {
                    if !known {
                        pivot = near.links.responses.read(at);
                    }
                    let link = near.links.motion(at, Self::READ);
                    let elimination = near.links.eliminations.read(at);
                    let (acceleration, carried) = E::accelerate(&row, link, elimination, pivot);
                    near.accelerate(out, at, acceleration);
                    if strip.leaves {
                        let below = E::pivot(&leaf, link, carried);
                        Self::leaves_down(&near, at, &leaf, below, out);
                        continue;
                    }
                    let below = E::pivot(&below_row, link, carried);
                    if in_register {
                        let [x, y] = below;
                        pivot = [x.tile_lanes(strip.length), y.tile_lanes(strip.length)];
                        continue;
                    }
                    let mut copy = 0;
                    while copy < near.copies {
                        let place = at + copy * near.apart;
                        near.children.responses.write(place, &below);
                        copy += 1;
                    }
                }
            }
            known = in_register;
            strips = behind;
        }
    }

    /// Writes the accelerations of those children that are leaves, computed from the acceleration
    /// of their pivot.
    ///
    /// # Safety
    /// `at` must be an index of the strip.
    #[inline(always)]
    unsafe fn leaves_down(
        near: &StripView<T>,
        at: usize,
        constants: &E::Constants<V>,
        pivot: [V; 2],
        out: &mut impl Output<T>,
    ) {
        let mut copy = 0;
        while copy < near.copies {
            // SAFETY: guaranteed by the caller; the view has checked its copies.
            unsafe {
                let link = near.children.motion(at + copy * near.apart, Self::READ);
                let acceleration = E::accelerate_leaf(constants, link, pivot);
                near.accelerate_leaf(out, at, copy, acceleration);
            }
            copy += 1;
        }
    }
}

/// Largest number of copies for which code is written out instead of a loop, if all generations
/// have this number.
const UNROLLED: usize = 4;

/// Returns the number of copies in every generation below the root; 0 if it differs between
/// generations or is too large.
const fn branching(copies: &[usize]) -> usize {
    let mut generation = 2;
    while generation < copies.len() {
        if copies[generation] != copies[1] {
            return 0;
        }
        generation += 1;
    }
    if copies.len() < 2 || copies[1] > UNROLLED {
        return 0;
    }
    copies[1]
}

// A plain loop: `map`, `from_fn` and iterators are not always inlined, which they must be, and take
// long to compile.
#[inline(always)]
pub(in crate::tree) fn add<V: Scalar, A: Row<V>>(sums: &mut A, terms: &A) {
    let mut i = 0;
    while i < A::LENGTH {
        sums.as_mut()[i] = sums.as_ref()[i] + terms.as_ref()[i];
        i += 1;
    }
}
