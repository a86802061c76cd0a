//! Leaves to root, and back: the recursion over a part of the tree.

mod level;
mod steps;

use core::marker::PhantomData;

use super::columns::{Columns, Copies};
use super::memory::Storage;
use super::part::{Part, Place};
use super::recursion::Recursion;
use super::root::RootDrive;
use super::shared::Shared;
use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;
pub(super) use level::splat;
use level::{Leaves, Level, Links};
use steps::Children;

/// A part with its state.
#[derive(Debug)]
pub(super) struct Sweep<'a, T> {
    pub(super) part: Part<'a>,
    /// Rows of all generations.
    pub(super) constants: &'a [T],
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    pub(super) storage: Storage<'a, T>,
    /// Acceleration of the root's pivot, where the root is in the part.
    pub(super) root: Option<[T; 2]>,
    /// Torque on the root, where the root is in the part.
    pub(super) torque: Option<T>,
    pub(super) alpha: Shared<'a, T>,
}

impl<T: Scalar> Sweep<'_, T> {
    /// Angles and velocities relative to the parents.
    pub(super) fn bend(&mut self) {
        let part = self.part;
        for stage in part.own_stages() {
            let parents = stage.above.map(|start| {
                let count = stage.whole_count / stage.copies.max(1);
                (start, count.max(1))
            });
            for run in 0..stage.runs {
                let place = part.place(stage, run);
                for i in 0..stage.length {
                    let index = place.whole + i;
                    let (mut bend, mut rate) =
                        (T::load(self.theta, index), T::load(self.omega, index));
                    if let Some((start, count)) = parents {
                        let parent = start + (index - stage.whole) % count;
                        bend = bend - T::load(self.theta, parent);
                        rate = rate - T::load(self.omega, parent);
                    }
                    let own = self.storage.lead + place.own + i;
                    let _ = self.storage.bends.store(own, &[bend, rate]);
                }
            }
        }
    }
}

/// From the leaves of a part to its first generation.
pub(super) fn up<P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    sweep: &mut Sweep<'_, T>,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Up::<P, T, C, L, R, K>(sweep, PhantomData));
}

/// From the first generation of a part, the accelerations of whose pivots are in
/// memory, to the leaves.
pub(super) fn down<P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    sweep: &mut Sweep<'_, T>,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Down::<P, T, C, L, R, K>(sweep, PhantomData));
}

// The sweep itself goes to the copy that is compiled for the machine's instructions
// by reference: moved, it would be read in other widths than it was just written
// in, and a processor waits for that.
struct Up<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    &'a mut Sweep<'b, T>,
    PhantomData<P>,
);

struct Down<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    &'a mut Sweep<'b, T>,
    PhantomData<P>,
);

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Up<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let typed = Typed::<P, T, C, L, R, K>::of(self.0);
        let _ = typed.and_then(|typed| typed.up::<W::Long>());
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Down<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let typed = Typed::<P, T, C, L, R, K>::of(self.0);
        let _ = typed.and_then(|mut typed| typed.down::<W::Long>());
    }
}

/// A sweep of a recursion.
struct Typed<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    part: Part<'a>,
    constants: &'a [[T; C]],
    links: Links<'a, T>,
    answers: Columns<'a, T, R>,
    kept: Columns<'a, T, K>,
    root: Option<[T; 2]>,
    /// The constants of a root with a torque on it.
    root_row: Option<[T; C]>,
    alpha: Shared<'a, T>,
    recursion: PhantomData<P>,
}

impl<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Typed<'a, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn of(sweep: &'a mut Sweep<'_, T>) -> Option<Self> {
        let Sweep {
            part,
            constants,
            storage,
            root,
            torque,
            alpha,
            ..
        } = sweep;
        let lead = storage.lead;
        let constants: &[[T; C]] = constants.as_chunks().0;
        let root_row = match (P::TORQUE, *torque, constants.first()) {
            (true, Some(torque), Some(row)) => Some(RootDrive::row(torque, row)),
            _ => None,
        };
        let links = Links {
            turns: storage.turns.from(lead)?,
            bends: match P::JOINTS {
                true => storage.bends.from(lead)?,
                false => storage.bends,
            },
            joints: P::JOINTS,
        };
        Some(Self {
            part: *part,
            constants,
            links,
            answers: Columns::new(storage.answers, storage.slots),
            kept: Columns::new(storage.kept, storage.slots),
            root: *root,
            root_row,
            alpha: *alpha,
            recursion: PhantomData,
        })
    }

    /// The constants of a generation.
    #[inline(always)]
    fn row(&self, generation: usize) -> Option<&[T; C]> {
        match &self.root_row {
            Some(row) if P::TORQUE && generation == 0 => Some(row),
            _ => self.constants.get(generation),
        }
    }

    /// What neighbours are computed from.
    #[inline(always)]
    fn level<V: Vector<T>>(&self, stage: usize, run: usize) -> Option<Level<'a, T, C, R, K>> {
        let constants = *self.row(self.part.first + stage)?;
        let (stage, below) = (
            self.part.stages.get(stage)?,
            self.part.stages.get(stage + 1)?,
        );
        let (first, rows) = (self.part.place(stage, run), stage.length.max(V::LANES));
        Some(Level {
            constants,
            length: stage.length,
            rows,
            own: self.links.window(first.own, rows)?,
            answers: self.answers.window(first.slot, rows)?,
            kept: self.kept.window(first.slot, rows)?,
            alpha: self.alpha.from(first.whole)?,
            child: Place {
                own: below.own + run * stage.length,
                slot: below.slot + run * stage.length,
                whole: below.whole + self.part.start + run * stage.stride,
            },
            copies: [below.copies, stage.count],
            whole_copies: [below.copies, stage.whole_count],
        })
    }

    /// Answers of the children, on the way down the accelerations of their pivots.
    #[inline(always)]
    fn below(&self, level: &Level<'a, T, C, R, K>) -> Option<Copies<'a, T, R>> {
        let Level { child, rows, .. } = level;
        self.answers.copies(child.slot, *rows, level.copies)
    }

    /// The children that are leaves.
    #[inline(always)]
    fn leaves(&self, level: &Level<'a, T, C, R, K>) -> Option<Leaves<'a, T, C>> {
        let &Level {
            child,
            rows,
            length,
            copies,
            whole_copies,
            ..
        } = level;
        Some(Leaves {
            constants: *self.constants.last()?,
            turns: self.links.turns.copies(child.own, rows, copies)?,
            bends: match P::JOINTS {
                true => Some(self.links.bends.copies(child.own, rows, copies)?),
                false => None,
            },
            alpha: self.alpha.copies(child.whole, length, whole_copies)?,
        })
    }

    /// Whether the children of a generation are leaves of this part.
    #[inline(always)]
    fn above_leaves(&self, stage: usize) -> bool {
        self.part.has_leaves && stage + 1 == self.part.inner
    }

    /// Where the children of neighbours are.
    #[inline(always)]
    fn children(
        &self,
        stage: usize,
        level: &Level<'a, T, C, R, K>,
    ) -> Option<Children<'a, T, C, R>> {
        let (mut leaves, mut inner) = (None, None);
        match self.above_leaves(stage) {
            true => leaves = Some(self.leaves(level)?),
            false => inner = Some(self.below(level)?),
        }
        Some(Children { leaves, inner })
    }

    /// From the last generation to the first. The equations stand here once, for links
    /// above leaves and others, and once for the uppermost generations: every copy of
    /// them is compiled with each model, three times.
    #[inline(always)]
    fn up<V: Vector<T>>(&self) -> Option<()> {
        let crown = self.part.crown(V::LANES);
        let mut stage = self.part.inner;
        while stage > crown {
            stage -= 1;
            let mut run = 0;
            while run < self.part.stages.get(stage)?.runs {
                let level = self.level::<V>(stage, run)?;
                let children = self.children(stage, &level)?;
                let constants = splat(&level.constants);
                let mut index = 0;
                while index < level.length {
                    let at = index.min(level.last::<V>());
                    let below = children.answers::<V, P, L, K>(at)?;
                    let (answers, kept) = P::inner(&constants, level.own.motion(at)?, below);
                    level.answers.store(at, &answers)?;
                    level.kept.store(at, &kept)?;
                    index += V::LANES;
                }
                run += 1;
            }
        }
        self.crown_up::<V>(crown)
    }

    /// The generations above `crown`.
    #[inline(always)]
    fn crown_up<V: Vector<T>>(&self, crown: usize) -> Option<()> {
        let part = self.part;
        let mut below = part.stages.get(crown)?;
        let mut answers: [V; R] = self.answers.load(below.slot)?;
        for generation in (0..crown).rev() {
            let stage = part.stages.get(generation)?;
            let mut sums = answers;
            for copy in 1..below.copies {
                for i in 0..R {
                    sums[i] = sums[i] + answers[i].behind(copy * stage.count);
                }
            }
            let constants = splat(self.row(part.first + generation)?);
            let kept;
            (answers, kept) = P::inner(&constants, self.links.motion(stage.own)?, sums);
            self.kept.store(stage.slot, &kept)?;
            below = stage;
        }
        self.answers.store(below.slot, &answers)
    }

    /// From the first generation, the acceleration of whose pivots is the root's or in
    /// memory, to the last.
    #[inline(always)]
    fn down<V: Vector<T>>(&mut self) -> Option<()> {
        let crown = self.part.crown(V::LANES);
        self.crown_down::<V>(crown)?;
        let mut stage = crown;
        while stage < self.part.inner {
            let mut run = 0;
            while run < self.part.stages.get(stage)?.runs {
                let level = self.level::<V>(stage, run)?;
                let children = self.children(stage, &level)?;
                let constants = splat(&level.constants);
                let mut index = 0;
                while index < level.length {
                    let at = index.min(level.last::<V>());
                    let (link, kept) = (level.own.motion(at)?, level.kept.load(at)?);
                    let pivot = level.answers.load(at)?;
                    let (acceleration, below) = P::turn(&constants, link, kept, pivot);
                    level.alpha.store(at, acceleration, level.length);
                    children.turn::<V, P, L, K>(at, below)?;
                    index += V::LANES;
                }
                run += 1;
            }
            stage += 1;
        }
        Some(())
    }

    #[inline(always)]
    fn crown_down<V: Vector<T>>(&mut self, crown: usize) -> Option<()> {
        let part = self.part;
        let mut pivot = match &self.root {
            Some(root) => splat::<T, V, 2>(root),
            None => self.answers.load(part.stages.first()?.slot)?,
        };
        for generation in 0..crown {
            let stage = part.stages.get(generation)?;
            let constants = splat(self.constants.get(part.first + generation)?);
            let kept: [V; K] = self.kept.load(stage.slot)?;
            let link = self.links.motion(stage.own)?;
            let (acceleration, [x, y]) = P::turn(&constants, link, kept, pivot);
            self.alpha.store(stage.whole, acceleration, stage.count);
            pivot = [x.repeat(stage.count), y.repeat(stage.count)];
        }
        self.answers.store(part.stages.get(crown)?.slot, &pivot)
    }
}

#[cfg(test)]
pub(super) mod tests;

#[cfg(test)]
mod driven_tests;
