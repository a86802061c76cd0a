//! Leaves to root, and back: the recursion over a part of the tree.

use core::marker::PhantomData;

use super::memory::Storage;
use super::part::{Part, Run};
use super::recursion::{Motion, Recursion};
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
}

impl<T: Scalar> Sweep<'_, T> {
    /// Angles and velocities relative to the parents.
    pub(super) fn bend(&mut self) {
        let mut own = 0;
        for generation in self.part.first..self.part.end {
            let above = generation.checked_sub(1);
            let above = above.map(|g| (self.part.shape.start(g), self.part.shape.count(g)));
            let first = self.part.shape.start(generation);
            for run in self.part.runs(generation, own) {
                for i in 0..run.length {
                    let index = run.whole + i;
                    let (mut bend, mut rate) =
                        (T::load(self.theta, index), T::load(self.omega, index));
                    if let Some((start, count)) = above {
                        let parent = start + (index - first) % count.max(1);
                        bend = bend - T::load(self.theta, parent);
                        rate = rate - T::load(self.omega, parent);
                    }
                    bend.store(self.storage.bends, run.own + i);
                    rate.store(self.storage.bend_rates, run.own + i);
                }
            }
            own += self.part.count(generation);
        }
    }
}

/// The numbers of a part, those of the links' own in arrays of known number.
#[derive(Debug)]
struct Memory<'a, T, const R: usize, const K: usize> {
    sines: &'a mut [T],
    cosines: &'a mut [T],
    bends: &'a mut [T],
    bend_rates: &'a mut [T],
    answers: [&'a mut [T]; R],
    kept: [&'a mut [T]; K],
}

impl<T, const R: usize, const K: usize> Memory<'_, T, R, K> {
    #[inline(always)]
    fn pivots_mut(&mut self) -> [&mut [T]; 2] {
        const { assert!(R >= 2, "two numbers must have room") };
        match &mut self.answers[..] {
            [x, y, ..] => [x, y],
            _ => [&mut [], &mut []],
        }
    }

    #[inline(always)]
    fn pivots<V: Vector<T>>(&self, own: usize) -> [V; 2] {
        const { assert!(R >= 2, "two numbers must have room") };
        [V::load(self.answers[0], own), V::load(self.answers[1], own)]
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

/// From the first generation of a part, whose pivots' accelerations are in
/// memory, to the leaves. `alpha` holds the part's links as memory does.
pub(super) fn down<P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    sweep: &mut Sweep<'_, T>,
    alpha: &mut [T],
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Down(Typed::<P, T, C, L, R, K>::of(sweep), alpha));
}

/// A sweep of a recursion.
struct Typed<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    part: Part<'a>,
    constants: &'a [[T; C]],
    theta: &'a [T],
    omega: &'a [T],
    memory: Memory<'a, T, R, K>,
    recursion: PhantomData<P>,
}

struct Up<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    Typed<'a, P, T, C, L, R, K>,
);

struct Down<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    Typed<'a, P, T, C, L, R, K>,
    &'a mut [T],
);

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Up<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(mut self) {
        self.0.up::<W>();
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Down<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(mut self) {
        self.0.down::<W>(self.1);
    }
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
            theta,
            omega,
            storage,
        } = sweep;
        Self {
            part: *part,
            constants: constants.as_chunks().0,
            theta,
            omega,
            memory: Memory {
                sines: storage.sines,
                cosines: storage.cosines,
                bends: storage.bends,
                bend_rates: storage.bend_rates,
                answers: storage.answers.first(),
                kept: storage.kept.first(),
            },
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

    /// From the last generation to the first.
    #[inline(always)]
    fn up<W: Vectors<T>>(&mut self) {
        let leaf = P::COPIES.len() - 1;
        for generation in self.inner().rev() {
            let own = self.part.own(generation);
            let (constants, copies) = (self.constants(generation), Self::copies(generation));
            if generation + 1 == leaf {
                let leaf_constants = self.constants(leaf);
                for run in self.part.runs(generation, own) {
                    let step = &mut Stems::<P, T, C, L, R, K> {
                        constants,
                        leaf_constants,
                        copies,
                        run,
                        theta: self.theta,
                        omega: self.omega,
                        memory: &mut self.memory,
                        recursion: PhantomData,
                    };
                    each::<T, W>(run.length, step);
                }
            } else {
                for run in self.part.runs(generation, own) {
                    let step = &mut Inners::<P, T, C, L, R, K> {
                        constants,
                        copies,
                        run,
                        theta: self.theta,
                        omega: self.omega,
                        memory: &mut self.memory,
                        recursion: PhantomData,
                    };
                    each::<T, W>(run.length, step);
                }
            }
        }
    }

    /// From the first generation, whose pivots' accelerations are in memory, to
    /// the last. `alpha` holds the part's links as memory does.
    #[inline(always)]
    fn down<W: Vectors<T>>(&mut self, alpha: &mut [T]) {
        let leaf = P::COPIES.len() - 1;
        let mut own = 0;
        for generation in self.inner() {
            let (constants, copies) = (self.constants(generation), Self::copies(generation));
            let stem = generation + 1 == leaf;
            let leaf_constants = self.constants(leaf);
            for run in self.part.runs(generation, own) {
                if stem {
                    let step = &mut TurnStems::<P, T, C, L, R, K> {
                        constants,
                        leaf_constants,
                        copies,
                        run,
                        theta: self.theta,
                        omega: self.omega,
                        memory: &mut self.memory,
                        alpha,
                        recursion: PhantomData,
                    };
                    each::<T, W>(run.length, step);
                } else {
                    let step = &mut TurnInners::<P, T, C, L, R, K> {
                        constants,
                        copies,
                        run,
                        theta: self.theta,
                        omega: self.omega,
                        memory: &mut self.memory,
                        alpha,
                        recursion: PhantomData,
                    };
                    each::<T, W>(run.length, step);
                }
            }
            own += self.part.count(generation);
        }
    }
}

#[inline(always)]
fn motion<T, V: Vector<T>, const R: usize, const K: usize>(
    memory: &Memory<'_, T, R, K>,
    theta: &[T],
    omega: &[T],
    own: usize,
    whole: usize,
) -> Motion<V> {
    Motion {
        sine: V::load(memory.sines, own),
        cosine: V::load(memory.cosines, own),
        theta: V::load(theta, whole),
        omega: V::load(omega, whole),
        bend: V::load(memory.bends, own),
        bend_rate: V::load(memory.bend_rates, own),
    }
}

#[inline(always)]
fn load_all<T, V: Vector<T>, const N: usize>(arrays: &[&mut [T]; N], at: usize) -> [V; N] {
    let mut values = [V::from_f64(0.0); N];
    for i in 0..N {
        values[i] = V::load(arrays[i], at);
    }
    values
}

#[inline(always)]
fn store_all<T, V: Vector<T>, const N: usize>(
    values: [V; N],
    arrays: &mut [&mut [T]; N],
    at: usize,
) {
    for i in 0..N {
        values[i].store(arrays[i], at);
    }
}

#[inline(always)]
fn sum<V: Scalar, const N: usize>(mut a: [V; N], b: [V; N]) -> [V; N] {
    for i in 0..N {
        a[i] = a[i] + b[i];
    }
    a
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

/// Links above leaves, and these, on the way up.
struct Stems<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    constants: [T; C],
    leaf_constants: [T; C],
    copies: usize,
    run: Run,
    theta: &'a [T],
    omega: &'a [T],
    memory: &'a mut Memory<'b, T, R, K>,
    recursion: PhantomData<P>,
}

impl<P, T: Scalar, const C: usize, const L: usize, const R: usize, const K: usize>
    Stems<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn leaf<V: Vector<T>>(&self, copy: usize, index: usize) -> [V; L] {
        let own = self.run.child_own + copy * self.run.next_own + index;
        let whole = self.run.child_whole + copy * self.run.next_whole + index;
        let link = motion(self.memory, self.theta, self.omega, own, whole);
        P::leaf(&splat::<T, V, C>(&self.leaf_constants), link)
    }
}

impl<P, T: Scalar, const C: usize, const L: usize, const R: usize, const K: usize> Step<T>
    for Stems<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn at<V: Vector<T>>(&mut self, index: usize) {
        let run = self.run;
        let mut below = self.leaf(0, index);
        for copy in 1..self.copies {
            below = sum(below, self.leaf(copy, index));
        }
        let (own, whole) = (run.own + index, run.whole + index);
        let link = motion(self.memory, self.theta, self.omega, own, whole);
        let (answers, kept) = P::stem(&splat::<T, V, C>(&self.constants), link, below);
        store_all(answers, &mut self.memory.answers, own);
        store_all(kept, &mut self.memory.kept, own);
    }
}

/// Links above inner links, on the way up.
struct Inners<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    constants: [T; C],
    copies: usize,
    run: Run,
    theta: &'a [T],
    omega: &'a [T],
    memory: &'a mut Memory<'b, T, R, K>,
    recursion: PhantomData<P>,
}

impl<P, T: Scalar, const C: usize, const L: usize, const R: usize, const K: usize> Step<T>
    for Inners<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn at<V: Vector<T>>(&mut self, index: usize) {
        let run = self.run;
        let mut child = run.child_own + index;
        let mut below = load_all(&self.memory.answers, child);
        for _ in 1..self.copies {
            child += run.next_own;
            below = sum(below, load_all(&self.memory.answers, child));
        }
        let (own, whole) = (run.own + index, run.whole + index);
        let link = motion(self.memory, self.theta, self.omega, own, whole);
        let (answers, kept) = P::inner(&splat::<T, V, C>(&self.constants), link, below);
        store_all(answers, &mut self.memory.answers, own);
        store_all(kept, &mut self.memory.kept, own);
    }
}

/// Links above leaves, and these, on the way down.
struct TurnStems<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    constants: [T; C],
    leaf_constants: [T; C],
    copies: usize,
    run: Run,
    theta: &'a [T],
    omega: &'a [T],
    memory: &'a mut Memory<'b, T, R, K>,
    alpha: &'a mut [T],
    recursion: PhantomData<P>,
}

impl<P, T: Scalar, const C: usize, const L: usize, const R: usize, const K: usize> Step<T>
    for TurnStems<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn at<V: Vector<T>>(&mut self, index: usize) {
        let run = self.run;
        let (own, whole) = (run.own + index, run.whole + index);
        let link = motion(self.memory, self.theta, self.omega, own, whole);
        let kept: [V; K] = load_all(&self.memory.kept, own);
        let pivot = self.memory.pivots(own);
        let (acceleration, below) = P::turn(&splat::<T, V, C>(&self.constants), link, kept, pivot);
        acceleration.store(self.alpha, own);
        let constants = splat::<T, V, C>(&self.leaf_constants);
        for copy in 0..self.copies {
            let own = run.child_own + copy * run.next_own + index;
            let whole = run.child_whole + copy * run.next_whole + index;
            let link = motion(self.memory, self.theta, self.omega, own, whole);
            P::turn_leaf(&constants, link, below).store(self.alpha, own);
        }
    }
}

/// Links above inner links, on the way down.
struct TurnInners<'a, 'b, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    constants: [T; C],
    copies: usize,
    run: Run,
    theta: &'a [T],
    omega: &'a [T],
    memory: &'a mut Memory<'b, T, R, K>,
    alpha: &'a mut [T],
    recursion: PhantomData<P>,
}

impl<P, T: Scalar, const C: usize, const L: usize, const R: usize, const K: usize> Step<T>
    for TurnInners<'_, '_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn at<V: Vector<T>>(&mut self, index: usize) {
        let run = self.run;
        let (own, whole) = (run.own + index, run.whole + index);
        let link = motion(self.memory, self.theta, self.omega, own, whole);
        let kept: [V; K] = load_all(&self.memory.kept, own);
        let pivot = self.memory.pivots(own);
        let (acceleration, below) = P::turn(&splat::<T, V, C>(&self.constants), link, kept, pivot);
        acceleration.store(self.alpha, own);
        for copy in 0..self.copies {
            let own = run.child_own + copy * run.next_own + index;
            let [x, y] = self.memory.pivots_mut();
            below[0].store(x, own);
            below[1].store(y, own);
        }
    }
}
