//! The equations, taken through a block: compiled with every model.

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

/// Which way the equations are taken through a block.
#[derive(Clone, Copy, Debug)]
pub(in crate::tree) struct Way<'a, T> {
    /// From the leaves to the first generation, at first.
    pub(in crate::tree) up: bool,
    /// From the first generation, the accelerations of whose pivots are the root's or
    /// in memory, to the leaves. The accelerations start with the block's first link,
    /// and are as many as its strips reach.
    pub(in crate::tree) down: Option<Shared<'a, T>>,
}

/// Takes the equations through a block, in the widest registers of the machine.
pub(in crate::tree) fn sweep<E: LinkEquations, T: Scalar>(view: &View<'_, T, T>, way: Way<'_, T>) {
    in_widest(SweepKernel::<E, T>(view, way, PhantomData));
}

/// [`sweep`] in one kind of registers.
pub(in crate::tree) struct SweepKernel<'a, E, T>(
    pub(in crate::tree) &'a View<'a, T, T>,
    pub(in crate::tree) Way<'a, T>,
    pub(in crate::tree) PhantomData<E>,
);

impl<E: LinkEquations, T: Scalar> Kernel<T> for SweepKernel<'_, E, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let (passes, Way { up, down }) = (Passes::<E, T, T, V>::of(self.0), self.1);
        if up {
            passes.up();
        }
        if let Some(mut alpha) = down {
            passes.down(&mut alpha);
        }
    }
}

/// The passes through a block, in vectors `V` of numbers `T`, for one set of equations.
pub(in crate::tree) struct Passes<'a, E, N, T, V> {
    pub(super) view: &'a View<'a, N, T>,
    /// None if the block is not one of these equations.
    pub(super) strips: &'a [Strip],
    pub(super) attachments: &'a [Attachment],
    types: PhantomData<(E, V)>,
}

// Of all this: there are strips only if the view has the columns of these
// equations; all places come from `StripView::places`, copies are counted up to
// `StripView::copies`, and attachments are those of the strips. Behind the last place there is
// room for the widest register; states in lanes, `T`, are a `V` each.
impl<'a, E, N, T, V> Passes<'a, E, N, T, V>
where
    E: LinkEquations,
    N: Scalar,
    T: Scalar + Simd<N>,
    V: Simd<T>,
{
    /// How many copies of children there are everywhere, otherwise 0: what is known
    /// when the equations are compiled takes no loop.
    const BRANCHING: usize = branching(E::COPIES);

    /// Numbers `T` are several states: the numbers of a link stand side by side then.
    const IN_ROWS: bool = <T as Simd<N>>::LANES > 1;

    const SIZES: Sizes = Sizes::of::<E, V>();

    /// Values that the equations read of a link's own motion.
    pub(super) const READ: Read = Read {
        joints: E::JOINTS,
        torques: E::FORCED,
        held: E::HELD,
    };

    /// Values that they read of the motion of a parent.
    pub(super) const DIRECTION: Read = Read {
        joints: false,
        torques: false,
        held: false,
    };

    /// Constants are a row a link.
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

    /// Returns the passes through these strips alone.
    #[inline(always)]
    pub(in crate::tree) fn within(self, strips: Range<usize>) -> Self {
        let strips = self.strips.get(strips).unwrap_or_default();
        Self { strips, ..self }
    }

    /// Where the numbers of links stand: asked for where a loop begins, since compilers
    /// read what is behind a reference again after everything that is written.
    #[inline(always)]
    pub(super) fn links(&self) -> LinkCells<T> {
        match Self::IN_ROWS {
            true => self.view.rows(Self::SIZES),
            false => self.view.columns(),
        }
    }

    /// The constants of a generation; zeros if it has none.
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

    /// The constants of leaves: the last row.
    #[inline(always)]
    fn leaf(&self) -> E::Constants<V> {
        let rows = self.view.constants.len() / <E::Constants<V> as Row<V>>::LENGTH.max(1);
        self.row(rows.saturating_sub(1))
    }

    /// From the leaves to the first strip.
    #[inline(always)]
    pub(in crate::tree) fn up(&self) {
        match Self::BY_LINK {
            true => self.heights_up(),
            false => self.generations_up(),
        }
    }

    /// From the first strip, the acceleration of whose pivots is the root's or in
    /// memory, to the leaves.
    #[inline(always)]
    pub(in crate::tree) fn down(&self, out: &mut impl Output<T>) {
        match Self::BY_LINK {
            true => self.heights_down(out),
            false => self.generations_down(out),
        }
    }

    /// From the last generation to the first. The equations stand here once, for links
    /// above leaves, in the uppermost generations and between: every copy of them is
    /// compiled with each model, three times.
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
                // SAFETY: places of a strip and its copies are there, as the view has seen.
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

    /// The sum of the responses of children that are leaves.
    ///
    /// # Safety
    /// A place of the strip.
    #[inline(always)]
    unsafe fn leaves(
        near: &StripView<T>,
        at: usize,
        constants: &E::Constants<V>,
        link: LinkMotion<V>,
    ) -> E::Sums<V> {
        // SAFETY: the caller's; its copies are there, as the view has seen.
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

    /// The sum of the responses of children that are no leaves.
    ///
    /// # Safety
    /// A place of the strip.
    #[inline(always)]
    unsafe fn sum(
        near: &StripView<T>,
        at: usize,
        constants: &E::Constants<V>,
        link: LinkMotion<V>,
    ) -> E::Sums<V> {
        // SAFETY: the caller's; its copies are there, as the view has seen.
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

    /// Adds them up where they are in registers, one child behind the other.
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

    /// From the first generation to the last.
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
                // SAFETY: places of a strip and its copies are there, as the view has seen.
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

    /// The accelerations of children that are leaves, whose pivot has one.
    ///
    /// # Safety
    /// A place of the strip.
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
            // SAFETY: the caller's; its copies are there, as the view has seen.
            unsafe {
                let link = near.children.motion(at + copy * near.apart, Self::READ);
                let acceleration = E::accelerate_leaf(constants, link, pivot);
                near.accelerate_leaf(out, at, copy, acceleration);
            }
            copy += 1;
        }
    }
}

/// As many copies are written one after the other, where all generations have them.
const UNROLLED: usize = 4;

/// Copies of every generation but the root's, 0 if these are not as many everywhere,
/// or too many.
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

// `map`, `from_fn` and iterators are not always inlined, must be, and are many lines
// to compile.
#[inline(always)]
pub(in crate::tree) fn add<V: Scalar, A: Row<V>>(sums: &mut A, terms: &A) {
    let mut i = 0;
    while i < A::LENGTH {
        sums.as_mut()[i] = sums.as_ref()[i] + terms.as_ref()[i];
        i += 1;
    }
}
