//! How the links of a tree hang on each other.

use core::marker::PhantomData;

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

/// Links that the compiler knows.
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

/// Says which link of a tree hangs on which.
pub trait Connectivity<const N: usize> {
    /// Index of each link's parent, which comes before it. The root's, link 0, does
    /// not count.
    const PARENTS: [usize; N];

    /// False if centres of mass and pivots lie on the links' axes: then all second
    /// components of moments and attachments are zero.
    const LATERAL: bool;

    /// True for links that others hang on.
    #[doc(hidden)]
    const CARRIES: [bool; N] = {
        let mut carries = [false; N];
        let mut link = 1;
        while link < N {
            carries[Self::PARENTS[link]] = true;
            link += 1;
        }
        carries
    };

    /// Links that others hang on, from the last one to the root; and how many they are.
    #[doc(hidden)]
    const CARRIERS: ([usize; N], usize) = listed(&Self::CARRIES, true);

    /// Links that none hangs on, likewise.
    #[doc(hidden)]
    const LEAVES: ([usize; N], usize) = listed(&Self::CARRIES, false);

    /// Fails to compile where a parent comes behind its child.
    #[doc(hidden)]
    const ORDERED: () = {
        let mut link = 1;
        while link < N {
            assert!(Self::PARENTS[link] < link, "parents come before children");
            link += 1;
        }
    };
}

/// Numbers of the links of which this is said, from the last to the first, and how many.
const fn listed<const N: usize>(said: &[bool; N], this: bool) -> ([usize; N], usize) {
    let (mut list, mut count) = ([0; N], 0);
    let mut link = N;
    while link > 0 {
        link -= 1;
        if said[link] == this {
            list[count] = link;
            count += 1;
        }
    }
    (list, count)
}
