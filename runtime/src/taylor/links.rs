//! Topology of a tree: the parent of each link.

use core::marker::PhantomData;

/// Links of a tree, parents before children.
pub(super) trait TreeLinks: Copy {
    /// Returns the number of links.
    fn count(&self) -> usize;

    /// Returns the index of a link's parent; unused for the root.
    fn parent(&self, link: usize) -> usize;

    /// Returns the links without children, from the last to the first.
    fn leaves(&self) -> &[usize];

    /// Returns the links with children, from the last one to the root.
    fn carriers(&self) -> &[usize];

    /// Returns false if all centres of mass and pivots lie on the links' axes.
    fn lateral(&self) -> bool;
}

/// Topology that is known at compile time.
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

/// Topology of a tree of `N` links as constants.
pub trait Connectivity<const N: usize> {
    /// Index of each link's parent, which must come before the link; the value is ignored for the
    /// root, link 0.
    const PARENTS: [usize; N];

    /// False if all centres of mass and pivots lie on the links' axes. The second components of
    /// moments and attachments are zero then.
    const LATERAL: bool;

    /// True for links with children.
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

    /// Links with children, from the last one to the root, and their number.
    #[doc(hidden)]
    const CARRIERS: ([usize; N], usize) = listed(&Self::CARRIES, true);

    /// Links without children, from the last to the first, and their number.
    #[doc(hidden)]
    const LEAVES: ([usize; N], usize) = listed(&Self::CARRIES, false);

    /// Fails to compile if a parent comes after its child.
    #[doc(hidden)]
    const ORDERED: () = {
        let mut link = 1;
        while link < N {
            assert!(Self::PARENTS[link] < link, "parents come before children");
            link += 1;
        }
    };
}

/// Lists the indices at which `said` equals `this`, from the last to the first, and their number.
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
