//! The links of a table: their order, and what equations read and write of one.

use alloc::vec::Vec;

use super::recursion::Motion;
use super::vector::{Step, Vector, each};
use crate::scalar::Scalar;

/// How many links are above each one.
pub(super) fn depths(parents: &[u32]) -> Vec<u32> {
    let mut depths: Vec<u32> = Vec::with_capacity(parents.len());
    for &parent in parents {
        // The root comes first, and has none above.
        depths.push(depths.get(parent as usize).map_or(0, |depth| depth + 1));
    }
    depths
}

/// The links by their depth, those of one depth in their order.
pub(super) fn by_depth(depths: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..).take(depths.len()).collect();
    order.sort_by_key(|&link| depths.get(link as usize).copied());
    order
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
    parents: &'a [u32],
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
        parents: &'a [u32],
        theta: &'a [T],
        omega: &'a [T],
        buffer: &'a mut [T],
    ) -> (Self, &'a mut [T]) {
        let n = parents.len();
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
            parents,
            theta,
            omega,
            sines,
            cosines,
        };
        (state, rest)
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

    #[inline(always)]
    pub(super) fn motion<V: Vector<T>>(&self, link: usize, joints: bool) -> Motion<V> {
        let (theta, omega) = (V::load(self.theta, link), V::load(self.omega, link));
        let (mut bend, mut bend_rate) = (theta, omega);
        if joints && link > 0 {
            let parent = self.parent(link);
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
