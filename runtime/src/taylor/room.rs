//! Numbers of all links while an expansion runs: on the stack where the compiler knows how
//! many links there are, so that they become registers; else in memory that the caller lends.

use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// `K` numbers `P` at each of many places.
pub(super) trait PackColumn<P, const K: usize> {
    /// Returns those at a place.
    fn at(&self, place: usize) -> [P; K];

    /// Changes those at a place.
    fn put(&mut self, place: usize, numbers: [P; K]);
}

/// A number of each link.
pub(super) trait OfLinks<T> {
    /// Returns the number of a link.
    fn of(&self, link: usize) -> T;
}

/// A number of each link, that others look at.
pub(super) trait SharedNumbers<T>: OfLinks<T> + Copy {
    /// Returns those of the first links, as many as the compiler may know them to be.
    fn first_links(self, links: usize) -> Self;
}

/// A number of each link, written in packs.
pub(super) trait WritableNumbers<T: Scalar>: OfLinks<T> {
    /// Changes those of a pack.
    fn write<P: Simd<T>>(&mut self, pack: usize, numbers: P);
}

/// Gives out room for numbers, whatever stands there. A *pack* is a wide number of one or
/// four links.
pub(super) trait PackRoom<T: Scalar> {
    /// Numbers of each pack.
    type OfPacks<P: Simd<T>, const K: usize>: PackColumn<P, K>;

    /// Numbers of each link.
    type OfLinks<P: Simd<T>, const K: usize>: PackColumn<P, K>;

    /// A number of each link.
    type WritableNumbers: WritableNumbers<T>;

    /// Quads that together hold a number of each link.
    type Quads: AsMut<[Quad<T>]>;

    /// A quad of each link.
    type LinkQuads: AsMut<[Quad<T>]>;

    /// Room that is free again.
    type Rest<'r>: PackRoom<T>
    where
        Self: 'r;

    /// Returns what is left, for as long as that is needed.
    fn rest(&mut self) -> Self::Rest<'_>;

    /// Returns how many packs there are.
    fn packs(&self) -> usize;

    fn of_packs<P: Simd<T>, const K: usize>(&mut self) -> Self::OfPacks<P, K>;

    fn of_links<P: Simd<T>, const K: usize>(&mut self) -> Self::OfLinks<P, K>;

    fn numbers(&mut self) -> Self::WritableNumbers;

    fn quads(&mut self) -> Self::Quads;

    fn link_quads(&mut self) -> Self::LinkQuads;
}

/// Room for packs of four links or of one, as the machine computes.
pub(super) trait Rooms<T: Scalar> {
    type InFours: PackRoom<T>;
    type OneByOne: PackRoom<T>;

    fn in_fours(self) -> Self::InFours;

    fn one_by_one(self) -> Self::OneByOne;
}

/// Room on the stack for N links in Q quads and M packs, or for the first ones of these.
pub(super) struct OnStack<C, const N: usize, const Q: usize, const M: usize>(C);

/// How many of the packs that there is room for there are: a type, so that the compiler
/// knows where it is all of them.
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

impl<T, C, const N: usize, const Q: usize, const M: usize> PackRoom<T> for OnStack<C, N, Q, M>
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

/// Room on the stack for N links in Q quads.
pub(super) struct StackRooms<const N: usize, const Q: usize>;

impl<T: Scalar, const N: usize, const Q: usize> Rooms<T> for StackRooms<N, Q> {
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

/// Room on the stack for up to N links in Q quads, all of which some of them stand in.
pub(super) struct RoomsOfFew<const N: usize, const Q: usize> {
    pub(super) links: usize,
}

impl<T: Scalar, const N: usize, const Q: usize> Rooms<T> for RoomsOfFew<N, Q> {
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

/// Reads numbers of all links into number `k` of each pack, by way of `quads`.
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

/// Writes numbers of all links as quads, zero where there is no link.
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

/// Writes the numbers of all links that stand in quads.
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
