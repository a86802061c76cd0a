//! Workspace in memory of the caller, for expansions of trees whose number of links is not a
//! compile-time constant.

use core::marker::PhantomData;

use super::buffer::{Buffers, OfLinks, PackBuffer, PackColumn, SharedNumbers, WritableNumbers};
use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// Workspace for any number of links, in memory of the caller.
pub(super) struct CallerBuffers<'a, T> {
    pub(super) free: &'a mut [Quad<T>],
    pub(super) links: usize,
}

/// Returns the number of quads that [`CallerBuffers`] needs for `links` links: the sum of all parts
/// that an expansion takes from [`Lent`] if it refines its start.
pub(super) const fn buffer_quads(links: usize) -> usize {
    36 * links.div_ceil(4) + 8 * links
}

impl<'a, T: Scalar> Buffers<T> for CallerBuffers<'a, T> {
    type InFours = Lent<'a, T>;
    type OneByOne = Lent<'a, T>;

    #[inline(always)]
    fn in_fours(self) -> Lent<'a, T> {
        let Self { free, links } = self;
        Lent {
            free,
            links,
            packs: links.div_ceil(4),
        }
    }

    #[inline(always)]
    fn one_by_one(self) -> Lent<'a, T> {
        let Self { free, links } = self;
        Lent {
            free,
            links,
            packs: links,
        }
    }
}

/// Memory of the caller, from which parts are taken one after the other. A part that does not fit
/// is empty.
pub(super) struct Lent<'a, T> {
    free: &'a mut [Quad<T>],
    links: usize,
    packs: usize,
}

/// Column of entries in memory of the caller.
pub(super) struct LentColumn<'a, T, P> {
    quads: &'a mut [Quad<T>],
    numbers: PhantomData<P>,
}

impl<T: Scalar, P: Simd<T>, const K: usize> PackColumn<P, K> for LentColumn<'_, T, P> {
    #[inline(always)]
    fn at(&self, place: usize) -> [P; K] {
        let mut numbers = [P::splat(T::from_f64(0.0)); K];
        for (k, number) in numbers.iter_mut().enumerate() {
            *number = P::load_quad(self.quads, K * place + k);
        }
        numbers
    }

    #[inline(always)]
    fn put(&mut self, place: usize, numbers: [P; K]) {
        for (k, number) in numbers.into_iter().enumerate() {
            number.store_quad(self.quads, K * place + k);
        }
    }
}

impl<T: Copy> OfLinks<T> for &[Quad<T>] {
    #[inline(always)]
    fn of(&self, link: usize) -> T {
        self[link / 4].0[link % 4]
    }
}

impl<T: Copy> SharedNumbers<T> for &[Quad<T>] {
    #[inline(always)]
    fn first_links(self, _links: usize) -> Self {
        self
    }
}

impl<T: Copy> OfLinks<T> for &mut [Quad<T>] {
    #[inline(always)]
    fn of(&self, link: usize) -> T {
        self[link / 4].0[link % 4]
    }
}

impl<T: Scalar> WritableNumbers<T> for &mut [Quad<T>] {
    #[inline(always)]
    fn write<P: Simd<T>>(&mut self, pack: usize, numbers: P) {
        numbers.store_quad(self, pack);
    }
}

impl<'a, T: Scalar> Lent<'a, T> {
    #[inline(always)]
    fn take(&mut self, quads: usize) -> &'a mut [Quad<T>] {
        let free = core::mem::take(&mut self.free);
        let (taken, free) = free.split_at_mut_checked(quads).unwrap_or_default();
        self.free = free;
        taken
    }

    #[inline(always)]
    fn column<P: Simd<T>>(&mut self, numbers: usize) -> LentColumn<'a, T, P> {
        LentColumn {
            quads: self.take((numbers * P::LANES).div_ceil(4)),
            numbers: PhantomData,
        }
    }
}

impl<'a, T: Scalar> PackBuffer<T> for Lent<'a, T> {
    type OfPacks<P: Simd<T>, const K: usize> = LentColumn<'a, T, P>;
    type OfLinks<P: Simd<T>, const K: usize> = LentColumn<'a, T, P>;
    type WritableNumbers = &'a mut [Quad<T>];
    type Quads = &'a mut [Quad<T>];
    type LinkQuads = &'a mut [Quad<T>];
    type Rest<'r>
        = Lent<'r, T>
    where
        Self: 'r;

    #[inline(always)]
    fn rest(&mut self) -> Lent<'_, T> {
        Lent {
            free: self.free,
            links: self.links,
            packs: self.packs,
        }
    }

    #[inline(always)]
    fn packs(&self) -> usize {
        self.packs
    }

    #[inline(always)]
    fn of_packs<P: Simd<T>, const K: usize>(&mut self) -> LentColumn<'a, T, P> {
        self.column(K * self.packs)
    }

    #[inline(always)]
    fn of_links<P: Simd<T>, const K: usize>(&mut self) -> LentColumn<'a, T, P> {
        self.column(K * self.links)
    }

    #[inline(always)]
    fn numbers(&mut self) -> &'a mut [Quad<T>] {
        self.quads()
    }

    #[inline(always)]
    fn quads(&mut self) -> &'a mut [Quad<T>] {
        self.take(self.links.div_ceil(4))
    }

    #[inline(always)]
    fn link_quads(&mut self) -> &'a mut [Quad<T>] {
        self.take(self.links)
    }
}
