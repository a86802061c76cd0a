//! What equations read of the angles and velocities, formed before the recursion.

use super::block::Block;
use super::columns::Columns;
use super::prefetch::prefetch;
use super::shared::Shared;
use super::sweep::Sweep;
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// Sines and cosines of a block's angles, and its velocities.
pub(super) struct Motions<'a, 'b, T> {
    pub(super) sweep: &'a mut Sweep<'b, T, T>,
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    /// Where results are written once the block has gone up.
    pub(super) alpha: Option<Shared<'a, T>>,
}

impl<T: Scalar> Kernel<T> for Motions<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let Sweep { block, storage, .. } = self.sweep;
        for (own, whole, length) in block.spans() {
            let (start, rows) = (storage.lead + own, length.max(V::LANES));
            let span = Span {
                theta: self.theta.get(whole..whole + length).unwrap_or_default(),
                omega: self.omega.get(whole..whole + length).unwrap_or_default(),
                sincos: storage.sincos.window(start, rows),
                velocities: storage
                    .velocities
                    .and_then(|column| column.window(start, rows)),
                ahead: block.ahead(),
                alpha: self.alpha.and_then(|alpha| alpha.from(whole)),
            };
            let _ = span.form::<V>();
        }
    }
}

/// Neighbours.
struct Span<'a, T> {
    theta: &'a [T],
    omega: &'a [T],
    sincos: Option<Columns<'a, T, 2>>,
    velocities: Option<Columns<'a, T, 1>>,
    /// How far the links are that come next.
    ahead: Option<usize>,
    /// The results, where they are written next.
    alpha: Option<Shared<'a, T>>,
}

impl<T: Scalar> Span<'_, T> {
    /// Two vectors at a time, for while the result of one operation is awaited the
    /// other keeps the processor busy. The last ones overlap those before.
    #[inline(always)]
    fn form<V: Simd<T>>(self) -> Option<()> {
        let (sincos, count) = (self.sincos?, self.theta.len());
        let last = count.saturating_sub(V::LANES);
        let mut index = 0;
        while index < count {
            let places = [index.min(last), (index + V::LANES).min(last)];
            let angles: [V; 2] = [at(self.theta, places[0]), at(self.theta, places[1])];
            let (sines, cosines) = V::sin_cos_each(&angles);
            for i in 0..2 {
                sincos.store(places[i], &[sines[i], cosines[i]])?;
                if let Some(velocities) = self.velocities {
                    velocities.store::<V, 1>(places[i], &[at(self.omega, places[i])])?;
                }
                if let Some(ahead) = self.ahead {
                    let next = places[i] + ahead;
                    prefetch(self.theta.as_ptr().wrapping_add(next));
                    prefetch(self.omega.as_ptr().wrapping_add(next));
                    if let Some(alpha) = self.alpha {
                        alpha.prefetch(next);
                    }
                }
            }
            index += 2 * V::LANES;
        }
        Some(())
    }
}

#[inline(always)]
fn at<T: Scalar, V: Simd<T>>(numbers: &[T], index: usize) -> V {
    V::load_front(numbers.get(index..).unwrap_or_default())
}

/// Forms joint angles and rates of a block; `parents` has the place of each link's
/// parent in a tree of any shape, and nothing otherwise.
pub(super) fn joint_motions<T: Scalar>(
    sweep: &mut Sweep<'_, T, T>,
    parents: &[u32],
    theta: impl Fn(usize) -> T,
    omega: impl Fn(usize) -> T,
) {
    let (block, storage) = (sweep.block, &sweep.storage);
    each_link(block, parents, |own, link, parent| {
        let (mut angle, mut rate) = (theta(link), omega(link));
        if let Some(parent) = parent {
            angle = angle - theta(parent);
            rate = rate - omega(parent);
        }
        let _ = storage
            .joint_motions
            .store(storage.lead + own, &[angle, rate]);
    });
}

/// Tells of each link of a block: its place there and in the tree, and its parent's
/// place in the tree, but for the root.
#[inline(always)]
pub(super) fn each_link(
    block: Block<'_>,
    parents: &[u32],
    mut tell: impl FnMut(usize, usize, Option<usize>),
) {
    for generation in block.own_generations() {
        let above = generation.above.map(|start| {
            let count = generation.whole_count / generation.copies.max(1);
            (start, count.max(1))
        });
        for span in 0..generation.strips {
            let place = block.place(generation, span);
            for i in 0..generation.length {
                let link = place.whole + i * generation.step;
                let parent = match above {
                    Some((start, count)) => Some(start + (link - generation.whole) % count),
                    None if link > 0 => parents.get(link).map(|&parent| parent as usize),
                    None => None,
                };
                tell(place.own + i, link, parent);
            }
        }
    }
}
