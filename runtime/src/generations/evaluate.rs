//! One evaluation: the whole tree at once, or part by part where it is large.

use core::marker::PhantomData;
use alloc::vec::Vec;

use super::part::{Part, Run, Shape};
use super::recursion::Recursion;
use super::sweep::{Memory, Sweep};
use super::vector::{SliceKernel, Vectors};
use crate::scalar::Scalar;

/// Trees of up to so many links are computed in one piece: their numbers fit
/// into the second cache.
pub(super) const WHOLE: usize = 8192;

/// Neighbours in a part of a larger tree: whole vectors, and runs that are long
/// enough to be fetched ahead.
const WIDTH: usize = 64;

/// How a tree is taken apart.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    pub(super) counts: Vec<usize>,
    pub(super) starts: Vec<usize>,
    /// The generation in which the parts start; none where the tree is one.
    pub(super) cut: Option<usize>,
}

impl Plan {
    pub(super) fn new(copies: &[usize]) -> Self {
        let (mut counts, mut starts) = (Vec::new(), Vec::new());
        let (mut count, mut start) = (1, 0);
        for &copies in copies {
            count *= copies;
            counts.push(count);
            starts.push(start);
            start += count;
        }
        let mut cut = None;
        if start > WHOLE {
            // The longest subtrees that fit, with as many neighbours.
            let last = copies.len().saturating_sub(2);
            let fits = |generation: usize| {
                let below: usize = counts[generation..].iter().sum();
                counts[generation] >= WIDTH
                    && (below / counts[generation]).saturating_mul(WIDTH) <= WHOLE
            };
            cut = (1..=last).find(|&generation| fits(generation)).or((last > 0).then_some(last));
        }
        Self { counts, starts, cut }
    }

    pub(super) fn links(&self) -> usize {
        self.counts.iter().sum()
    }

    fn shape(&self) -> Shape<'_> {
        Shape {
            counts: &self.counts,
            starts: &self.starts,
        }
    }

    /// The generations above the cut, or the whole tree.
    fn top(&self) -> Part<'_> {
        Part {
            shape: self.shape(),
            first: 0,
            end: self.cut.unwrap_or(self.counts.len()),
            start: 0,
            width: 1,
        }
    }

    /// The parts below the cut.
    fn window(&self, cut: usize, start: usize) -> Part<'_> {
        Part {
            shape: self.shape(),
            first: cut,
            end: self.counts.len(),
            start,
            width: WIDTH.min(self.counts[cut] - start),
        }
    }
}

/// Numbers of a part: of all its links, and of those with answers.
fn sizes(part: &Part<'_>) -> (usize, usize) {
    let leaf = part.shape.counts.len() - 1;
    (part.own(part.end), part.own((part.end + 1).min(leaf)))
}

fn length<const R: usize, const K: usize>(part: &Part<'_>, joints: bool) -> usize {
    let (all, inner) = sizes(part);
    all * if joints { 4 } else { 2 } + inner * (R + 2 + K)
}

/// Takes `length` numbers off the front.
fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let (front, rest) = core::mem::take(buffer).split_at_mut(length);
    *buffer = rest;
    front
}

fn memory<'a, T, const R: usize, const K: usize>(
    part: &Part<'_>,
    joints: bool,
    mut buffer: &'a mut [T],
) -> Memory<'a, T, R, K> {
    let (all, inner) = sizes(part);
    let buffer = &mut buffer;
    let bends = if joints { all } else { 0 };
    Memory {
        sines: take(buffer, all),
        cosines: take(buffer, all),
        bends: take(buffer, bends),
        bend_rates: take(buffer, bends),
        answers: core::array::from_fn(|_| take(buffer, inner)),
        pivots: core::array::from_fn(|_| take(buffer, inner)),
        kept: core::array::from_fn(|_| take(buffer, inner)),
    }
}

impl Plan {
    pub(super) fn workspace<const R: usize, const K: usize>(&self, joints: bool) -> usize {
        let top = length::<R, K>(&self.top(), joints);
        match self.cut {
            None => top,
            Some(cut) => {
                let window = self.window(cut, 0);
                top + length::<R, K>(&window, joints) + window.own(window.end)
            }
        }
    }
}

/// An evaluation of accelerations.
pub(super) struct Evaluation<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    pub(super) plan: &'a Plan,
    pub(super) constants: &'a [[T; C]],
    pub(super) root: [T; 2],
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    pub(super) alpha: &'a mut [T],
    pub(super) buffer: &'a mut [T],
    pub(super) recursion: PhantomData<P>,
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Evaluation<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let Self {
            plan,
            constants,
            root,
            theta,
            omega,
            alpha,
            mut buffer,
            recursion,
        } = self;
        let top = plan.top();
        let own = take(&mut buffer, length::<R, K>(&top, P::JOINTS));
        let mut tree = Sweep::<P, T, C, L, R, K> {
            part: top,
            constants,
            theta,
            omega,
            memory: memory(&top, P::JOINTS, own),
            recursion,
        };
        let Some(cut) = plan.cut else {
            tree.prepare::<W>();
            tree.up::<W>();
            for (pivot, value) in tree.memory.pivots.iter_mut().zip(root) {
                pivot[0] = value;
            }
            tree.down::<W>(alpha);
            return;
        };
        let count = plan.counts[cut];
        let window = plan.window(cut, 0);
        let own = take(&mut buffer, length::<R, K>(&window, P::JOINTS));
        let turned = take(&mut buffer, window.own(window.end));
        let boundary = tree.part.own(cut);
        let mut start = 0;
        while start < count {
            let part = plan.window(cut, start);
            let mut subtree = Sweep::<P, T, C, L, R, K> {
                part,
                constants,
                theta,
                omega,
                memory: memory(&part, P::JOINTS, own),
                recursion,
            };
            subtree.prepare::<W>();
            subtree.up::<W>();
            for (all, answers) in tree.memory.answers.iter_mut().zip(&subtree.memory.answers) {
                all[boundary + start..][..part.width].copy_from_slice(&answers[..part.width]);
            }
            start += part.width;
        }
        tree.prepare::<W>();
        tree.up::<W>();
        for (pivot, value) in tree.memory.pivots.iter_mut().zip(root) {
            pivot[0] = value;
        }
        tree.down::<W>(alpha);
        let mut start = 0;
        while start < count {
            let part = plan.window(cut, start);
            let mut subtree = Sweep::<P, T, C, L, R, K> {
                part,
                constants,
                theta,
                omega,
                memory: memory(&part, P::JOINTS, own),
                recursion,
            };
            subtree.prepare::<W>();
            subtree.up::<W>();
            for (pivots, all) in subtree.memory.pivots.iter_mut().zip(&tree.memory.pivots) {
                pivots[..part.width].copy_from_slice(&all[boundary + start..][..part.width]);
            }
            subtree.down::<W>(turned);
            for Run { own, whole, length, .. } in part.all() {
                alpha[whole..][..length].copy_from_slice(&turned[own..][..length]);
            }
            start += part.width;
        }
    }
}
