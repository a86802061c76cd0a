//! The equations, taken through a part: compiled with every model.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::access::Access;
use super::near::Near;
use crate::generations::memory::Sizes;
use crate::generations::recursion::Recursion;
use crate::generations::runs::Run;
use crate::generations::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;

/// From the leaves of a part to its first generation.
pub(in crate::generations) fn up<
    P,
    T,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
>(
    access: &Access<'_, T>,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Up::<P, T, C, L, R, K>(access, PhantomData));
}

/// From the first generation of a part, the accelerations of whose pivots are in
/// memory, to the leaves.
pub(in crate::generations) fn down<
    P,
    T,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
>(
    access: &Access<'_, T>,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    T::over_slices(Down::<P, T, C, L, R, K>(access, PhantomData));
}

pub(super) struct Up<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) &'a Access<'a, T>,
    pub(super) PhantomData<P>,
);

pub(super) struct Down<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) &'a Access<'a, T>,
    pub(super) PhantomData<P>,
);

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Up<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        Typed::<P, T, W::Long, C, L, R, K>::of(self.0).up();
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Down<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        Typed::<P, T, W::Long, C, L, R, K>::of(self.0).down();
    }
}

/// What a part has, in vectors, for one recursion.
struct Typed<'a, P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> {
    access: &'a Access<'a, T>,
    /// None if the part is not one of this recursion.
    runs: &'a [Run],
    constants: &'a [[T; C]],
    types: PhantomData<(P, V)>,
}

// SAFETY, for all of this: there are runs only if the access has the columns of this
// recursion, two of answers at least; all places come from `Near::places`, and copies
// are counted up to `Near::copies`.
impl<'a, P, T, V, const C: usize, const L: usize, const R: usize, const K: usize>
    Typed<'a, P, T, V, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    /// How many copies of children there are everywhere, otherwise 0: what is known
    /// when the equations are compiled takes no loop.
    const BRANCHING: usize = branching(P::COPIES);

    #[inline(always)]
    fn of(access: &'a Access<'_, T>) -> Self {
        const { assert!(R >= 2, "an acceleration takes two columns") };
        let sizes = Sizes {
            answers: R,
            kept: K,
            joints: P::JOINTS,
        };
        let runs = access.runs(sizes, Self::BRANCHING);
        Self {
            access,
            runs,
            constants: access.constants.as_chunks().0,
            types: PhantomData,
        }
    }

    /// The constants of a generation; zeros if it has none.
    #[inline(always)]
    fn constants(&self, generation: usize) -> [V; C] {
        let mut row = match self.constants.get(generation) {
            Some(row) => splat(row),
            None => [V::from_f64(0.0); C],
        };
        if P::TORQUE
            && generation == 0
            && let (Some(torque), Some(last)) = (self.access.torque, row.last_mut())
        {
            *last = V::splat(torque);
        }
        row
    }

    /// The constants of leaves.
    #[inline(always)]
    fn leaf(&self) -> [V; C] {
        self.constants(self.constants.len().wrapping_sub(1))
    }

    /// From the last generation to the first. The equations stand here once, for links
    /// above leaves, in the uppermost generations and between: every copy of them is
    /// compiled with each model, three times.
    #[inline(always)]
    fn up(&self) {
        let leaf = self.leaf();
        let mut answers = [V::from_f64(0.0); R];
        let mut runs = self.runs;
        while let Some((run, before)) = runs.split_last() {
            let constants = self.constants(run.generation);
            let near = Near::of(self.access, run, Self::BRANCHING);
            let mut places = near.places::<V>();
            while let Some(at) = places.next() {
                let below = match run.leaves {
                    true => Self::leaves(&near, at, &leaf),
                    false if run.lanes <= V::LANES => neighbours(&answers, run.length, near.copies),
                    false => sum(&near, at),
                };
                let link = unsafe { near.motion(at, P::JOINTS) };
                let kept;
                (answers, kept) = P::inner(&constants, link, below);
                unsafe { near.answer(at, &answers) };
                unsafe { near.keep(at, &kept) };
            }
            runs = before;
        }
    }

    /// The sum of what children answer that are leaves.
    #[inline(always)]
    fn leaves(near: &Near<'_, T>, at: usize, constants: &[V; C]) -> [V; R] {
        let mut sums = P::leaf(constants, unsafe { near.leaf(at, 0, P::JOINTS) });
        let mut copy = 1;
        while copy < near.copies {
            let link = unsafe { near.leaf(at, copy, P::JOINTS) };
            add(&mut sums, &P::leaf(constants, link));
            copy += 1;
        }
        P::joined(sums)
    }

    /// From the first generation, the acceleration of whose pivots is the root's or in
    /// memory, to the last.
    #[inline(always)]
    fn down(&self) {
        let leaf = self.leaf();
        let mut known = self.access.root.is_some();
        let mut pivot = match &self.access.root {
            Some(root) => splat(root),
            None => [V::from_f64(0.0); 2],
        };
        let mut runs = self.runs;
        while let Some((run, behind)) = runs.split_first() {
            let constants = self.constants(run.generation);
            let near = Near::of(self.access, run, Self::BRANCHING);
            let in_register = run.lanes <= V::LANES;
            let mut places = near.places::<V>();
            while let Some(at) = places.next() {
                if !known {
                    pivot = unsafe { near.answers(at) };
                }
                let (link, kept) = unsafe { (near.motion(at, P::JOINTS), near.kept(at)) };
                let (acceleration, below) = P::turn(&constants, link, kept, pivot);
                unsafe { near.accelerate(at, acceleration) };
                let mut copy = 0;
                if run.leaves {
                    while copy < near.copies {
                        let link = unsafe { near.leaf(at, copy, P::JOINTS) };
                        let acceleration = P::turn_leaf(&leaf, link, below);
                        unsafe { near.accelerate_leaf(at, copy, acceleration) };
                        copy += 1;
                    }
                } else if in_register {
                    pivot = [below[0].repeat(run.length), below[1].repeat(run.length)];
                } else {
                    while copy < near.copies {
                        unsafe { near.give(at, copy, &below) };
                        copy += 1;
                    }
                }
            }
            known = in_register;
            runs = behind;
        }
    }
}

/// As many copies are written one after the other, where all generations have them.
const UNROLLED: usize = 4;

/// Copies of every generation but the root's, 0 if these are not as many everywhere,
/// or too many.
const fn branching(copies: &[usize]) -> usize {
    let mut generation = 2;
    while generation < copies.len() {
        if copies[generation] != copies[1] {
            return 0;
        }
        generation += 1;
    }
    if copies.len() < 2 || copies[1] > UNROLLED {
        return 0;
    }
    copies[1]
}

/// The sum of what children answer that are no leaves.
#[inline(always)]
fn sum<T: Scalar, V: Vector<T>, const R: usize>(near: &Near<'_, T>, at: usize) -> [V; R] {
    let mut sums = unsafe { near.below(at, 0) };
    let mut copy = 1;
    while copy < near.copies {
        add(&mut sums, &unsafe { near.below(at, copy) });
        copy += 1;
    }
    sums
}

/// The same where they are in registers, one child behind the other.
#[inline(always)]
fn neighbours<T: Scalar, V: Vector<T>, const R: usize>(
    answers: &[V; R],
    count: usize,
    copies: usize,
) -> [V; R] {
    let mut sums = *answers;
    let mut copy = 1;
    while copy < copies {
        let mut i = 0;
        while i < R {
            sums[i] = sums[i] + answers[i].behind(copy * count);
            i += 1;
        }
        copy += 1;
    }
    sums
}

// `map`, `from_fn` and iterators are not always inlined, must be, and are many lines
// to compile.
#[inline(always)]
pub(in crate::generations) fn splat<T: Copy, V: Vector<T>, const N: usize>(
    numbers: &[T; N],
) -> [V; N] {
    let mut values = [V::from_f64(0.0); N];
    let mut i = 0;
    while i < N {
        values[i] = V::splat(numbers[i]);
        i += 1;
    }
    values
}

#[inline(always)]
fn add<V: Scalar, const N: usize>(sums: &mut [V; N], terms: &[V; N]) {
    let mut i = 0;
    while i < N {
        sums[i] = sums[i] + terms[i];
        i += 1;
    }
}
