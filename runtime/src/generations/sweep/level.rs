//! Neighbours of one generation, and the leaves below them.

use crate::generations::columns::{AtCopies, Columns, Copies};
use crate::generations::part::Place;
use crate::generations::recursion::Motion;
use crate::generations::shared::{Copies as SharedCopies, Shared};
use crate::generations::vector::Vector;
use crate::scalar::Scalar;

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
pub(super) fn add<V: Scalar, const N: usize>(sums: &mut [V; N], terms: &[V; N]) {
    let mut i = 0;
    while i < N {
        sums[i] = sums[i] + terms[i];
        i += 1;
    }
}

/// What is known of links before the recursion.
#[derive(Clone, Copy)]
pub(super) struct Links<'a, T> {
    pub(super) turns: Columns<'a, T, 3>,
    pub(super) bends: Columns<'a, T, 2>,
    pub(super) joints: bool,
}

impl<T: Scalar> Links<'_, T> {
    #[inline(always)]
    pub(super) fn window(self, at: usize, rows: usize) -> Option<Self> {
        let bends = match self.joints {
            true => self.bends.window(at, rows)?,
            false => self.bends,
        };
        Some(Self {
            turns: self.turns.window(at, rows)?,
            bends,
            ..self
        })
    }

    #[inline(always)]
    pub(super) fn motion<V: Vector<T>>(self, at: usize) -> Option<Motion<V>> {
        let bends = match self.joints {
            true => Some(self.bends.load(at)?),
            false => None,
        };
        Some(motion(self.turns.load(at)?, bends))
    }
}

#[inline(always)]
fn motion<V: Scalar>([sine, cosine, omega]: [V; 3], bends: Option<[V; 2]>) -> Motion<V> {
    // Where nothing acts in joints nobody reads them.
    let [bend, bend_rate] = match bends {
        Some(bends) => bends,
        None => [omega; 2],
    };
    Motion {
        sine,
        cosine,
        omega,
        bend,
        bend_rate,
    }
}

/// Neighbours of one generation, on the way up or down.
pub(super) struct Level<'a, T, const C: usize, const R: usize, const K: usize> {
    pub(super) constants: [T; C],
    pub(super) length: usize,
    /// The length, or the number of a vector's lanes where that is more.
    pub(super) rows: usize,
    pub(super) own: Links<'a, T>,
    pub(super) answers: Columns<'a, T, R>,
    pub(super) kept: Columns<'a, T, K>,
    pub(super) alpha: Shared<'a, T>,
    /// The first copy of the first one's children.
    pub(super) child: Place,
    /// How many copies there are, and how far from one to the next in the part's own
    /// arrays and in the whole tree's.
    pub(super) copies: [usize; 2],
    pub(super) whole_copies: [usize; 2],
}

impl<T: Scalar, const C: usize, const R: usize, const K: usize> Level<'_, T, C, R, K> {
    /// The last place of a vector: it overlaps the one before where vectors do not
    /// divide the neighbours. Fewer than a vector holds are one step, whose other
    /// lanes mean nothing.
    // From the rows, as windows ask: the compiler then sees that they need not.
    #[inline(always)]
    pub(super) fn last<V: Vector<T>>(&self) -> usize {
        self.rows - V::LANES.min(self.rows)
    }
}

/// The leaves below neighbours.
pub(super) struct Leaves<'a, T, const C: usize> {
    pub(super) constants: [T; C],
    pub(super) turns: Copies<'a, T, 3>,
    pub(super) bends: Option<Copies<'a, T, 2>>,
    pub(super) alpha: SharedCopies<'a, T>,
}

impl<'a, T: Scalar, const C: usize> Leaves<'a, T, C> {
    /// Their motions, copy by copy.
    #[inline(always)]
    pub(super) fn at<V: Vector<T>>(&self, index: usize) -> Option<LeavesAt<'a, T, V>> {
        Some(LeavesAt {
            turns: self.turns.at(index)?,
            bends: match self.bends {
                Some(bends) => Some(bends.at(index)?),
                None => None,
            },
        })
    }
}

/// Leaves at one place, from the first copy on.
pub(super) struct LeavesAt<'a, T, V> {
    turns: AtCopies<'a, T, V, 3>,
    bends: Option<AtCopies<'a, T, V, 2>>,
}

impl<T: Scalar, V: Vector<T>> LeavesAt<'_, T, V> {
    /// The next copy's; none behind the last one.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<Motion<V>> {
        let turns = self.turns.load()?;
        let bends = match &mut self.bends {
            Some(bends) => Some(bends.load()?),
            None => None,
        };
        Some(motion(turns, bends))
    }
}
