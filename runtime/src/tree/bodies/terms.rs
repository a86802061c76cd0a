//! Sums over the links, of terms that are formed of several neighbours at once.

use core::marker::PhantomData;

use super::{Bodies, ROW};
use crate::scalar::Scalar;
use crate::simd::dispatch::in_widest;
use crate::simd::{Kernel, Simd};
use crate::system::Workspace;
use crate::tree::columns::Columns;
use crate::tree::sum::total;
use crate::tree::sweep::VectorPlaces;

/// A link, or as many as `V` has lanes.
pub(super) struct TurnedLink<V, const P: usize> {
    /// What is known of its pivot.
    pub(super) pivot: [V; P],
    pub(super) sine: V,
    pub(super) cosine: V,
    /// Angle or angular velocity of the link: whichever the terms are formed of.
    pub(super) given: V,
}

/// Terms of each link, `N` of them, that are summed over the tree, and what has to be known
/// of its pivot for them: `P` numbers, zero for the root.
pub(super) trait LinkTerms<const P: usize, const N: usize> {
    /// Returns what is known of a child's pivot.
    fn pivot<V: Scalar>(child: &[V; ROW], parent: TurnedLink<V, P>) -> [V; P];

    /// Returns the terms of a link; `joint` is what it is given less what its parent is, and
    /// less the angle at which its spring is at rest.
    fn terms<V: Scalar>(row: &[V; ROW], link: TurnedLink<V, P>, joint: V) -> [V; N];
}

/// Returns the sums of the terms; NaN for slices of another length than there are links.
pub(super) fn sums<S: LinkTerms<P, N>, T: Scalar, const P: usize, const N: usize>(
    bodies: &Bodies<T>,
    workspace: &mut Workspace<T>,
    theta: &[T],
    given: &[T],
) -> [T; N] {
    let links = bodies.shape.links();
    let whole = [theta.len(), given.len()] == [links; 2];
    let sums = whole.then(|| {
        in_widest::<T, _>(LinkSums {
            bodies,
            theta,
            given,
            numbers: workspace.numbers((2 + P + N) * links),
            kind: PhantomData::<S>,
        })
    });
    sums.flatten().unwrap_or([T::from_f64(f64::NAN); N])
}

/// What they are formed of.
struct LinkSums<'a, S, T, const P: usize, const N: usize> {
    bodies: &'a Bodies<T>,
    theta: &'a [T],
    given: &'a [T],
    /// Columns of sines and cosines, of pivots, of terms.
    numbers: &'a mut [T],
    kind: PhantomData<S>,
}

impl<S: LinkTerms<P, N>, T: Scalar, const P: usize, const N: usize> Kernel<T>
    for LinkSums<'_, S, T, P, N>
{
    /// None where rows or parents are lacking.
    type Output = Option<[T; N]>;

    // Nothing is fused: the sums have the same bits in all registers.
    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Option<[T; N]> {
        let (bodies, links) = (self.bodies, self.theta.len());
        let (turned, others) = self.numbers.split_at_mut(2 * links);
        let (sines, cosines) = turned.split_at_mut(links);
        turn(self.theta, sines, cosines);
        let (pivots, terms) = others.split_at_mut(P * links);
        let along = Along::<'_, S, T, P, N> {
            given: self.given,
            turned: Columns::new(turned, links),
            pivots: Columns::new(pivots, links),
            terms: Columns::new(&mut *terms, links),
            kind: PhantomData,
        };
        for strip in bodies.shape.strips() {
            let (row, rest) = (bodies.row(strip.row)?, bodies.rests.get(strip.row));
            match strip.parent {
                Some(parent) if strip.count >= V::LANES => {
                    let constants = WideRow::<V>::of(row, rest);
                    let own = along.from(strip.link, strip.count)?;
                    let parents = along.from(parent, strip.count)?;
                    let mut places = VectorPlaces::of::<T, V>(strip.count);
                    while let Some(place) = places.next() {
                        own.form(&constants, place, Some((&parents, place)))?;
                    }
                }
                _ => {
                    let constants = WideRow::<V::One>::of(row, rest);
                    for (link, parent) in strip.each() {
                        let parent = parent.map(|parent| (&along, parent));
                        along.form(&constants, link, parent)?;
                    }
                }
            }
        }
        let mut sums = [T::from_f64(0.0); N];
        for (term, sum) in sums.iter_mut().enumerate() {
            *sum = total(terms.get(term * links..(term + 1) * links)?);
        }
        Some(sums)
    }
}

/// Writes sines and cosines of angles: those of each by itself, sooner.
#[inline(always)]
fn turn<T: Scalar>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
    const BLOCK: usize = 8;
    let (blocks, rest) = angles.as_chunks::<BLOCK>();
    let (sine_blocks, sines) = sines.as_chunks_mut::<BLOCK>();
    let (cosine_blocks, cosines) = cosines.as_chunks_mut::<BLOCK>();
    for ((block, sines), cosines) in blocks.iter().zip(sine_blocks).zip(cosine_blocks) {
        (*sines, *cosines) = T::sin_cos_each(block);
    }
    for ((angle, sine), cosine) in rest.iter().zip(sines).zip(cosines) {
        (*sine, *cosine) = angle.sin_cos();
    }
}

/// A row, and the angle at which the spring is at rest unless it is zero for all.
struct WideRow<V> {
    row: [V; ROW],
    rest: Option<V>,
}

impl<V> WideRow<V> {
    #[inline(always)]
    fn of<T: Scalar>(row: &[T; ROW], rest: Option<&T>) -> Self
    where
        V: Simd<T>,
    {
        let mut constants = [V::from_f64(0.0); ROW];
        for (constant, &value) in constants.iter_mut().zip(row) {
            *constant = V::splat(value);
        }
        Self {
            row: constants,
            rest: rest.map(|&rest| V::splat(rest)),
        }
    }
}

/// The way from the root to the leaves.
struct Along<'a, S, T, const P: usize, const N: usize> {
    given: &'a [T],
    /// Sines and cosines.
    turned: Columns<'a, T, 2>,
    pivots: Columns<'a, T, P>,
    terms: Columns<'a, T, N>,
    kind: PhantomData<S>,
}

impl<S: LinkTerms<P, N>, T: Scalar, const P: usize, const N: usize> Along<'_, S, T, P, N> {
    /// Forms what is known of the pivots of a link, or of as many as `V` has lanes, whose
    /// parents have a place in their own columns, and their terms.
    #[inline(always)]
    fn form<V: Simd<T>>(
        &self,
        constants: &WideRow<V>,
        place: usize,
        parent: Option<(&Self, usize)>,
    ) -> Option<()> {
        let WideRow { row, rest } = constants;
        let mut link = self.link::<V>(place, [V::from_f64(0.0); P])?;
        let mut joint = link.given;
        if let Some((parents, place)) = parent {
            let parent = parents.link::<V>(place, parents.pivots.load(place)?)?;
            joint = joint - parent.given;
            link.pivot = S::pivot(row, parent);
        }
        if let &Some(rest) = rest {
            joint = joint - rest;
        }
        self.pivots.store(place, &link.pivot)?;
        self.terms.store(place, &S::terms(row, link, joint))
    }

    /// The columns of so many links, from one on.
    #[inline(always)]
    fn from(&self, first: usize, count: usize) -> Option<Self> {
        Some(Self {
            given: self.given.get(first..first + count)?,
            turned: self.turned.window(first, count)?,
            pivots: self.pivots.window(first, count)?,
            terms: self.terms.window(first, count)?,
            kind: PhantomData,
        })
    }

    #[inline(always)]
    fn link<V: Simd<T>>(&self, place: usize, pivot: [V; P]) -> Option<TurnedLink<V, P>> {
        let [sine, cosine] = self.turned.load(place)?;
        Some(TurnedLink {
            pivot,
            sine,
            cosine,
            given: V::load(self.given.get(place..)?)?,
        })
    }
}
