//! The links of a table: their order, and what equations read and write of one.

use alloc::vec::Vec;

use super::recursion::Motion;
use super::vector::{Step, Vector, each};
use crate::scalar::Scalar;

/// Which link hangs from which.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// Parents stand before their children, depth first; the root's own is 0.
    pub(super) parents: &'static [u32],
    /// How many links are above each one.
    pub(super) depths: Vec<u32>,
    /// The links by depth, those of one depth in their order: neighbours do not wait
    /// for each other.
    pub(super) order: Vec<u32>,
}

impl Shape {
    pub(super) fn new(parents: &'static [u32]) -> Self {
        let mut depths: Vec<u32> = Vec::with_capacity(parents.len());
        for &parent in parents {
            // The root comes first, and has none above.
            depths.push(depths.get(parent as usize).map_or(0, |depth| depth + 1));
        }
        let mut order: Vec<u32> = (0..).take(depths.len()).collect();
        order.sort_by_key(|&link| depths.get(link as usize).copied());
        Self {
            parents,
            depths,
            order,
        }
    }

    #[inline(always)]
    pub(super) fn parent(&self, link: usize) -> usize {
        self.parents.get(link).map_or(0, |&parent| parent as usize)
    }

    /// Links stand depth first: a link's first child comes next.
    #[inline(always)]
    pub(super) fn is_leaf(&self, link: usize) -> bool {
        link + 1 >= self.parents.len() || self.parent(link + 1) != link
    }

    /// Of a link, 0 where there is none.
    #[inline(always)]
    pub(super) fn depth(&self, link: usize) -> usize {
        self.depths.get(link).map_or(0, |&depth| depth as usize)
    }

    /// How many depths there are.
    pub(super) fn levels(&self) -> usize {
        self.order
            .last()
            .map_or(0, |&link| self.depth(link as usize) + 1)
    }
}

/// Sines and cosines.
struct Turns<'a, T> {
    theta: &'a [T],
    sines: &'a mut [T],
    cosines: &'a mut [T],
}

impl<T: Scalar, V: Vector<T>> Step<V> for Turns<'_, T> {
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let (sine, cosine) = V::load(self.theta, index).sin_cos();
        sine.store(self.sines, index);
        cosine.store(self.cosines, index);
        Some(())
    }
}

/// What does not change on the way through the links.
pub(super) struct State<'a, T> {
    shape: &'a Shape,
    theta: &'a [T],
    omega: &'a [T],
    sines: &'a [T],
    cosines: &'a [T],
}

impl<'a, T: Scalar> State<'a, T> {
    /// Forms the sines and cosines of all angles, several at a time, in the front of a
    /// buffer that has room for them; with what is left of it.
    #[inline(always)]
    pub(super) fn new<V: Vector<T>>(
        shape: &'a Shape,
        theta: &'a [T],
        omega: &'a [T],
        buffer: &'a mut [T],
    ) -> (Self, &'a mut [T]) {
        let n = shape.parents.len();
        let (sines, buffer) = buffer.split_at_mut(n);
        let (cosines, rest) = buffer.split_at_mut(n);
        let mut turns = Turns {
            theta,
            sines,
            cosines,
        };
        let _ = each::<T, V>(n, &mut turns);
        let Turns { sines, cosines, .. } = turns;
        let state = Self {
            shape,
            theta,
            omega,
            sines,
            cosines,
        };
        (state, rest)
    }

    #[inline(always)]
    pub(super) fn motion<V: Vector<T>>(&self, link: usize, joints: bool) -> Motion<V> {
        let (theta, omega) = (V::load(self.theta, link), V::load(self.omega, link));
        let (mut bend, mut bend_rate) = (theta, omega);
        if joints && link > 0 {
            let parent = self.shape.parent(link);
            bend = bend - V::load(self.theta, parent);
            bend_rate = bend_rate - V::load(self.omega, parent);
        }
        Motion {
            sine: V::load(self.sines, link),
            cosine: V::load(self.cosines, link),
            omega,
            bend,
            bend_rate,
        }
    }
}

/// Loads `N` numbers of a link.
#[inline(always)]
pub(super) fn load<T: Scalar, V: Vector<T>, const N: usize>(all: &[T], link: usize) -> [V; N] {
    let own = all.get(link * N..link * N + N).unwrap_or_default();
    let mut values = [V::from_f64(0.0); N];
    for (i, value) in values.iter_mut().enumerate() {
        *value = V::load(own, i);
    }
    values
}

/// Stores `N` numbers of a link.
#[inline(always)]
pub(super) fn store<T: Scalar, V: Vector<T>, const N: usize>(
    values: [V; N],
    all: &mut [T],
    link: usize,
) {
    let own = all.get_mut(link * N..link * N + N).unwrap_or_default();
    for (i, value) in values.into_iter().enumerate() {
        value.store(own, i);
    }
}
