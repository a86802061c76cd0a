//! Workspace for the links' numbers during an expansion: on the stack if the number of links is a
//! compile-time constant, so that they become registers; otherwise in memory of the caller.

use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// Array of entries; each entry has `K` numbers of type `P`.
pub(super) trait PackColumn<P, const K: usize> {
    /// Returns the numbers of entry `place`.
    fn at(&self, place: usize) -> [P; K];

    /// Sets the numbers of entry `place`.
    fn put(&mut self, place: usize, numbers: [P; K]);
}

/// One number of each link.
pub(super) trait OfLinks<T> {
    /// Returns the number that belongs to a link.
    fn of(&self, link: usize) -> T;
}

/// One number per link, readable from several places at once.
pub(super) trait SharedNumbers<T>: OfLinks<T> + Copy {
    /// Restricts the numbers to the first `links` links; the compiler knows the length if possible.
    fn first_links(self, links: usize) -> Self;
}

/// Numbers, one per link, that are written for several links at once (a pack, which is a wide
/// number).
pub(super) trait WritableNumbers<T: Scalar>: OfLinks<T> {
    /// Writes the numbers of the links of one pack.
    fn write<P: Simd<T>>(&mut self, pack: usize, numbers: P);
}

/// Allocator of workspace with arbitrary initial contents. A *pack* is a wide number that holds one
/// or four links.
pub(super) trait PackBuffer<T: Scalar> {
    /// Array with `K` numbers for each pack.
    type OfPacks<P: Simd<T>, const K: usize>: PackColumn<P, K>;

    /// Array with `K` numbers for each link.
    type OfLinks<P: Simd<T>, const K: usize>: PackColumn<P, K>;

    /// Array with one number for each link.
    type WritableNumbers: WritableNumbers<T>;

    /// Quads (vectors of four) that together hold one number for each link.
    type Quads: AsMut<[Quad<T>]>;

    /// One quad of each link.
    type LinkQuads: AsMut<[Quad<T>]>;

    /// Room that is free again.
    type Rest<'r>: PackBuffer<T>
    where
        Self: 'r;

    /// Returns the remaining workspace, borrowed as long as the result is in use.
    fn rest(&mut self) -> Self::Rest<'_>;

    /// Returns the number of packs.
    fn packs(&self) -> usize;

    fn of_packs<P: Simd<T>, const K: usize>(&mut self) -> Self::OfPacks<P, K>;

    fn of_links<P: Simd<T>, const K: usize>(&mut self) -> Self::OfLinks<P, K>;

    fn numbers(&mut self) -> Self::WritableNumbers;

    fn quads(&mut self) -> Self::Quads;

    fn link_quads(&mut self) -> Self::LinkQuads;
}

/// Workspace for packs of four links or of one link, depending on the machine.
pub(super) trait Buffers<T: Scalar> {
    type InFours: PackBuffer<T>;
    type OneByOne: PackBuffer<T>;

    fn in_fours(self) -> Self::InFours;

    fn one_by_one(self) -> Self::OneByOne;
}

/// Workspace on the stack for N links in Q quads and M packs; a part of it can be used for fewer
/// links.
pub(super) struct OnStack<C, const N: usize, const Q: usize, const M: usize>(C);

/// Number of packs that are in use. It is a type, so that the compiler knows if all of them are.
pub(super) trait PackCount: Copy {
    fn of(self, most: usize) -> usize;
}

/// All packs.
#[derive(Clone, Copy)]
pub(super) struct All;

impl PackCount for All {
    #[inline(always)]
    fn of(self, most: usize) -> usize {
        most
    }
}

/// So many of them.
#[derive(Clone, Copy)]
pub(super) struct First(usize);

impl PackCount for First {
    #[inline(always)]
    fn of(self, most: usize) -> usize {
        self.0.min(most)
    }
}

impl<P: Copy, const K: usize, const COUNT: usize> PackColumn<P, K> for [[P; K]; COUNT] {
    #[inline(always)]
    fn at(&self, place: usize) -> [P; K] {
        self[place]
    }

    #[inline(always)]
    fn put(&mut self, place: usize, numbers: [P; K]) {
        self[place] = numbers;
    }
}

impl<T: Copy> OfLinks<T> for &[T] {
    #[inline(always)]
    fn of(&self, link: usize) -> T {
        self[link]
    }
}

impl<T: Copy> SharedNumbers<T> for &[T] {
    #[inline(always)]
    fn first_links(self, links: usize) -> Self {
        &self[..links]
    }
}

impl<T: Copy, const Q: usize> OfLinks<T> for [[T; 4]; Q] {
    #[inline(always)]
    fn of(&self, link: usize) -> T {
        self.as_flattened()[link]
    }
}

impl<T: Scalar, const Q: usize> WritableNumbers<T> for [[T; 4]; Q] {
    #[inline(always)]
    fn write<P: Simd<T>>(&mut self, pack: usize, numbers: P) {
        numbers.store(&mut self.as_flattened_mut()[pack * P::LANES..]);
    }
}

impl<T, C, const N: usize, const Q: usize, const M: usize> PackBuffer<T> for OnStack<C, N, Q, M>
where
    T: Scalar,
    C: PackCount,
{
    type OfPacks<P: Simd<T>, const K: usize> = [[P; K]; M];
    type OfLinks<P: Simd<T>, const K: usize> = [[P; K]; N];
    type WritableNumbers = [[T; 4]; Q];
    type Quads = [Quad<T>; Q];
    type LinkQuads = [Quad<T>; N];
    type Rest<'r>
        = Self
    where
        Self: 'r;

    #[inline(always)]
    fn rest(&mut self) -> Self {
        Self(self.0)
    }

    #[inline(always)]
    fn packs(&self) -> usize {
        self.0.of(M)
    }

    #[inline(always)]
    fn of_packs<P: Simd<T>, const K: usize>(&mut self) -> [[P; K]; M] {
        [[P::splat(T::from_f64(0.0)); K]; M]
    }

    #[inline(always)]
    fn of_links<P: Simd<T>, const K: usize>(&mut self) -> [[P; K]; N] {
        [[P::splat(T::from_f64(0.0)); K]; N]
    }

    #[inline(always)]
    fn numbers(&mut self) -> [[T; 4]; Q] {
        [[T::from_f64(0.0); 4]; Q]
    }

    #[inline(always)]
    fn quads(&mut self) -> [Quad<T>; Q] {
        [Quad::splat(T::from_f64(0.0)); Q]
    }

    #[inline(always)]
    fn link_quads(&mut self) -> [Quad<T>; N] {
        [Quad::splat(T::from_f64(0.0)); N]
    }
}

/// Workspace on the stack for exactly N links in Q quads.
pub(super) struct StackBuffers<const N: usize, const Q: usize>;

impl<T: Scalar, const N: usize, const Q: usize> Buffers<T> for StackBuffers<N, Q> {
    type InFours = OnStack<All, N, Q, Q>;
    type OneByOne = OnStack<All, N, Q, N>;

    #[inline(always)]
    fn in_fours(self) -> Self::InFours {
        OnStack(All)
    }

    #[inline(always)]
    fn one_by_one(self) -> Self::OneByOne {
        OnStack(All)
    }
}

/// Workspace on the stack for at most N links in Q quads, of which some are used.
pub(super) struct FewLinkBuffers<const N: usize, const Q: usize> {
    pub(super) links: usize,
}

impl<T: Scalar, const N: usize, const Q: usize> Buffers<T> for FewLinkBuffers<N, Q> {
    type InFours = OnStack<All, N, Q, Q>;
    type OneByOne = OnStack<First, N, Q, N>;

    #[inline(always)]
    fn in_fours(self) -> Self::InFours {
        OnStack(All)
    }

    #[inline(always)]
    fn one_by_one(self) -> Self::OneByOne {
        OnStack(First(self.links))
    }
}

/// Copies one number per link to entry `k` of each pack; `quads` is workspace.
#[inline(always)]
pub(super) fn read<T: Scalar, P: Simd<T>, const K: usize>(
    numbers: impl OfLinks<T>,
    quads: &mut [Quad<T>],
    [packs, links]: [usize; 2],
    k: usize,
    column: &mut impl PackColumn<P, K>,
) {
    spread(numbers, links, quads);
    for m in 0..packs {
        let mut own = column.at(m);
        own[k] = P::load_quad(quads, m);
        column.put(m, own);
    }
}

/// Writes the numbers of all links to quads of four links, padded with zeros.
#[inline(always)]
pub(super) fn spread<T: Scalar>(numbers: impl OfLinks<T>, links: usize, quads: &mut [Quad<T>]) {
    for (q, quad) in quads.iter_mut().enumerate() {
        for (l, number) in quad.0.iter_mut().enumerate() {
            *number = match 4 * q + l < links {
                true => numbers.of(4 * q + l),
                false => T::from_f64(0.0),
            };
        }
    }
}

/// Reads the numbers of all links from quads of four links.
#[inline(always)]
pub(super) fn collect<T: Scalar>(quads: &[Quad<T>], numbers: &mut [T]) {
    let (fours, few) = numbers.as_chunks_mut::<4>();
    let last = quads.get(fours.len());
    for (four, quad) in fours.iter_mut().zip(quads) {
        *four = quad.0;
    }
    if let Some(last) = last {
        for (number, own) in few.iter_mut().zip(last.0) {
            *number = own;
        }
    }
}
