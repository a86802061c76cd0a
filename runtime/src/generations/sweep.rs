//! Leaves to root, and back: the recursion over a part of the tree.

use core::marker::PhantomData;

use super::columns::Columns;
use super::memory::Storage;
use super::part::{Part, Run};
use super::recursion::{Motion, Recursion};
use super::shared::Shared;
use super::vector::{SliceKernel, Step, Vector, Vectors, each};
use crate::scalar::Scalar;

/// A part with its state.
#[derive(Debug)]
pub(super) struct Sweep<'a, T> {
    pub(super) part: Part<'a>,
    /// Rows of all generations.
    pub(super) constants: &'a [T],
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    pub(super) storage: Storage<'a, T>,
    pub(super) alpha: Shared<'a, T>,
}

impl<T: Scalar> Sweep<'_, T> {
    /// Angles and velocities relative to the parents.
    pub(super) fn bend(&mut self) {
        let part = self.part;
        for generation in part.first..part.end {
            let above = generation.checked_sub(1);
            let above = above.map(|g| (part.shape.start(g), part.shape.count(g)));
            let first = part.shape.start(generation);
            for run in part.runs(generation) {
                for i in 0..run.length {
                    let index = run.first.whole + i;
                    let (mut bend, mut rate) =
                        (T::load(self.theta, index), T::load(self.omega, index));
                    if let Some((start, count)) = above {
                        let parent = start + (index - first) % count.max(1);
                        bend = bend - T::load(self.theta, parent);
                        rate = rate - T::load(self.omega, parent);
                    }
                    let own = self.storage.lead + run.first.own + i;
                    if let Some(mut row) = self.storage.bends.row_mut::<T>(own) {
                        row.store([bend, rate]);
                    }
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
    T::over_slices(Up(Typed::<P, T, C, L, R, K>::of(sweep)));
}

/// From the first generation of a part, the accelerations of whose pivots are in
/// memory, to the leaves.
pub(super) fn down<P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    sweep: &mut Sweep<'_, T>,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Down(Typed::<P, T, C, L, R, K>::of(sweep)));
}

struct Up<S>(S);

struct Down<S>(S);

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Up<Typed<'_, P, T, C, L, R, K>>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(mut self) {
        self.0.up::<W::Long>();
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Down<Typed<'_, P, T, C, L, R, K>>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(mut self) {
        self.0.down::<W::Long>();
    }
}

/// A sweep of a recursion.
struct Typed<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    part: Part<'a>,
    constants: &'a [[T; C]],
    turns: &'a Columns<'a, T, 3>,
    bends: &'a Columns<'a, T, 2>,
    lead: usize,
    answers: Columns<'a, T, R>,
    kept: Columns<'a, T, K>,
    alpha: Shared<'a, T>,
    recursion: PhantomData<P>,
}

impl<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Typed<'a, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    fn of(sweep: &'a mut Sweep<'_, T>) -> Self {
        let Sweep {
            part,
            constants,
            storage,
            alpha,
            ..
        } = sweep;
        Self {
            part: *part,
            constants: constants.as_chunks().0,
            turns: &storage.turns,
            bends: &storage.bends,
            lead: storage.lead,
            answers: Columns::new(storage.answers, storage.slots),
            kept: Columns::new(storage.kept, storage.slots),
            alpha: *alpha,
            recursion: PhantomData,
        }
    }

    fn constants(&self, generation: usize) -> [T; C] {
        match self.constants.get(generation) {
            Some(row) => *row,
            None => [T::from_f64(f64::NAN); C],
        }
    }

    /// Copies of children under a link of a generation.
    fn copies(generation: usize) -> usize {
        P::COPIES.get(generation + 1).copied().unwrap_or(0)
    }

    /// The generations of the part that have children.
    fn inner(&self) -> core::ops::Range<usize> {
        self.part.first..self.part.end.min(P::COPIES.len().saturating_sub(1))
    }

    /// The last generation with children that fits a vector, if this is the top of
    /// the tree: those above it go from one to the next in registers.
    #[inline(always)]
    fn crown<V: Vector<T>>(&self) -> usize {
        let narrow = |&generation: &usize| self.part.count(generation) <= V::LANES;
        let last = self.inner().take_while(narrow).last();
        last.unwrap_or(self.part.first)
    }

    #[inline(always)]
    fn motion<V: Vector<T>>(&self, own: usize) -> Option<Motion<V>> {
        let own = self.lead + own;
        let [sine, cosine, omega] = self.turns.row(own)?.load();
        let [bend, bend_rate] = match P::JOINTS {
            true => self.bends.row(own)?.load(),
            false => [omega; 2],
        };
        Some(Motion {
            sine,
            cosine,
            omega,
            bend,
            bend_rate,
        })
    }

    /// From the last generation to the first.
    #[inline(always)]
    fn up<V: Vector<T>>(&mut self) {
        let (part, leaf) = (self.part, P::COPIES.len() - 1);
        let crown = self.crown::<V>();
        for generation in (crown..self.inner().end).rev() {
            let (constants, copies) = (self.constants(generation), Self::copies(generation));
            let leaf_constants = self.constants(leaf);
            for run in part.runs(generation) {
                let step = Level {
                    constants,
                    leaf_constants,
                    copies,
                    run,
                    sweep: self,
                };
                match generation + 1 == leaf {
                    true => each::<T, V>(run.length, &mut Stems(step)),
                    false => each::<T, V>(run.length, &mut Inners(step)),
                }
            }
        }
        let _ = self.crown_up::<V>(crown);
    }

    /// The generations above `crown`. There is room for all of it: none is missing.
    #[inline(always)]
    fn crown_up<V: Vector<T>>(&mut self, crown: usize) -> Option<()> {
        let part = self.part;
        let mut answers: [V; R] = self.answers.row(part.slot(crown))?.load();
        for generation in (part.first..crown).rev() {
            let (place, count) = (part.place(generation), part.count(generation));
            let mut below = answers;
            for copy in 1..Self::copies(generation) {
                for i in 0..R {
                    below[i] = below[i] + answers[i].behind(copy * count);
                }
            }
            let constants = splat(&self.constants(generation));
            let kept;
            (answers, kept) = P::inner(&constants, self.motion(place.own)?, below);
            self.kept.row_mut(place.slot)?.store(kept);
        }
        self.answers.row_mut(part.slot(part.first))?.store(answers);
        Some(())
    }

    /// From the first generation, the acceleration of whose pivots is in memory, to
    /// the last.
    #[inline(always)]
    fn down<V: Vector<T>>(&mut self) {
        let (part, leaf) = (self.part, P::COPIES.len() - 1);
        let crown = self.crown::<V>();
        let _ = self.crown_down::<V>(crown);
        for generation in crown..self.inner().end {
            let (constants, copies) = (self.constants(generation), Self::copies(generation));
            let leaf_constants = self.constants(leaf);
            for run in part.runs(generation) {
                let step = Level {
                    constants,
                    leaf_constants,
                    copies,
                    run,
                    sweep: self,
                };
                match generation + 1 == leaf {
                    true => each::<T, V>(run.length, &mut TurnStems(step)),
                    false => each::<T, V>(run.length, &mut TurnInners(step)),
                }
            }
        }
    }

    #[inline(always)]
    fn crown_down<V: Vector<T>>(&mut self, crown: usize) -> Option<()> {
        let part = self.part;
        let mut pivot: [V; 2] = self.answers.row(part.slot(part.first))?.load();
        for generation in part.first..crown {
            let (place, count) = (part.place(generation), part.count(generation));
            let constants = splat(&self.constants(generation));
            let kept: [V; K] = self.kept.row(place.slot)?.load();
            let (acceleration, [x, y]) = P::turn(&constants, self.motion(place.own)?, kept, pivot);
            self.alpha.store(place.whole, acceleration, count);
            pivot = [x.repeat(count), y.repeat(count)];
        }
        self.answers.row_mut(part.slot(crown))?.store(pivot);
        Some(())
    }
}

// Loops: `map` and `from_fn` are not always inlined, and must be.
#[inline(always)]
pub(super) fn splat<T: Copy, V: Vector<T>, const N: usize>(numbers: &[T; N]) -> [V; N] {
    let mut values = [V::from_f64(0.0); N];
    for i in 0..N {
        values[i] = V::splat(numbers[i]);
    }
    values
}

#[inline(always)]
fn sum<V: Scalar, const N: usize>(mut a: [V; N], b: [V; N]) -> [V; N] {
    for i in 0..N {
        a[i] = a[i] + b[i];
    }
    a
}

/// Neighbours of one generation, on the way up or down.
struct Level<'a, S, T, const C: usize> {
    sweep: &'a mut S,
    constants: [T; C],
    leaf_constants: [T; C],
    copies: usize,
    run: Run,
}

/// Links above leaves, and these, on the way up.
struct Stems<'a, S, T, const C: usize>(Level<'a, S, T, C>);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for Stems<'_, Typed<'_, P, T, C, L, R, K>, T, C>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Level {
            sweep,
            run,
            copies,
            constants,
            leaf_constants,
        } = &mut self.0;
        let leaf_constants = splat::<T, V, C>(leaf_constants);
        let mut child = run.child.plus(index, index);
        let mut below = P::leaf(&leaf_constants, sweep.motion(child.own)?);
        for _ in 1..*copies {
            child = child.plus(run.next_own, run.next_whole);
            below = sum(below, P::leaf(&leaf_constants, sweep.motion(child.own)?));
        }
        let place = run.first.plus(index, index);
        let constants = splat(constants);
        let (answers, kept) = P::stem(&constants, sweep.motion(place.own)?, below);
        sweep.answers.row_mut(place.slot)?.store(answers);
        sweep.kept.row_mut(place.slot)?.store(kept);
        Some(())
    }
}

/// Links above inner links, on the way up.
struct Inners<'a, S, T, const C: usize>(Level<'a, S, T, C>);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for Inners<'_, Typed<'_, P, T, C, L, R, K>, T, C>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Level {
            sweep,
            run,
            copies,
            constants,
            ..
        } = &mut self.0;
        let mut child = run.child.slot + index;
        let mut below: [V; R] = sweep.answers.row(child)?.load();
        for _ in 1..*copies {
            child += run.next_own;
            below = sum(below, sweep.answers.row(child)?.load());
        }
        let place = run.first.plus(index, index);
        let constants = splat(constants);
        let (answers, kept) = P::inner(&constants, sweep.motion(place.own)?, below);
        sweep.answers.row_mut(place.slot)?.store(answers);
        sweep.kept.row_mut(place.slot)?.store(kept);
        Some(())
    }
}

/// Links above leaves, and these, on the way down.
struct TurnStems<'a, S, T, const C: usize>(Level<'a, S, T, C>);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for TurnStems<'_, Typed<'_, P, T, C, L, R, K>, T, C>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Level {
            sweep,
            run,
            copies,
            constants,
            leaf_constants,
        } = &mut self.0;
        let place = run.first.plus(index, index);
        let kept = sweep.kept.row(place.slot)?.load();
        let pivot = sweep.answers.row(place.slot)?.load();
        let constants = splat::<T, V, C>(constants);
        let (acceleration, below) = P::turn(&constants, sweep.motion(place.own)?, kept, pivot);
        sweep.alpha.store(place.whole, acceleration, run.length);
        let mut child = run.child.plus(index, index);
        let constants = splat(leaf_constants);
        for _ in 0..*copies {
            let acceleration = P::turn_leaf(&constants, sweep.motion(child.own)?, below);
            sweep.alpha.store(child.whole, acceleration, run.length);
            child = child.plus(run.next_own, run.next_whole);
        }
        Some(())
    }
}

/// Links above inner links, on the way down.
struct TurnInners<'a, S, T, const C: usize>(Level<'a, S, T, C>);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for TurnInners<'_, Typed<'_, P, T, C, L, R, K>, T, C>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Level {
            sweep,
            run,
            copies,
            constants,
            ..
        } = &mut self.0;
        let place = run.first.plus(index, index);
        let kept = sweep.kept.row(place.slot)?.load();
        let pivot = sweep.answers.row(place.slot)?.load();
        let constants = splat::<T, V, C>(constants);
        let (acceleration, below) = P::turn(&constants, sweep.motion(place.own)?, kept, pivot);
        sweep.alpha.store(place.whole, acceleration, run.length);
        let mut child = run.child.slot + index;
        for _ in 0..*copies {
            sweep.answers.row_mut(child)?.store(below);
            child += run.next_own;
        }
        Some(())
    }
}
