//! How the links of a tree hang on each other.

use core::marker::PhantomData;

use super::expand::Connectivity;

/// The links of a tree, parents before children.
pub(super) trait TreeLinks: Copy {
    /// Returns how many there are.
    fn count(&self) -> usize;

    /// Returns the number of a link's parent. The root's does not count.
    fn parent(&self, link: usize) -> usize;

    /// Returns the links that none hangs on, from the last to the first.
    fn leaves(&self) -> &[usize];

    /// Returns the links that others hang on, from the last one to the root.
    fn carriers(&self) -> &[usize];

    /// Returns false if centres of mass and pivots lie on the links' axes.
    fn lateral(&self) -> bool;
}

/// TreeLinks that the compiler knows.
pub(super) struct KnownLinks<C, const N: usize>(PhantomData<C>);

impl<C, const N: usize> KnownLinks<C, N> {
    pub(super) const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<C, const N: usize> Clone for KnownLinks<C, N> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<C, const N: usize> Copy for KnownLinks<C, N> {}

impl<C: Connectivity<N>, const N: usize> TreeLinks for KnownLinks<C, N> {
    #[inline(always)]
    fn count(&self) -> usize {
        N
    }

    #[inline(always)]
    fn parent(&self, link: usize) -> usize {
        C::PARENTS[link]
    }

    #[inline(always)]
    fn leaves(&self) -> &[usize] {
        let (leaves, count) = const { &C::LEAVES };
        &leaves[..*count]
    }

    #[inline(always)]
    fn carriers(&self) -> &[usize] {
        let (carriers, count) = const { &C::CARRIERS };
        &carriers[..*count]
    }

    #[inline(always)]
    fn lateral(&self) -> bool {
        C::LATERAL
    }
}
