//! Sums over all links, whose terms are computed for several neighbouring links at once.

use core::marker::PhantomData;

use super::{Bodies, BodyEquations};
use crate::scalar::Scalar;
use crate::simd::dispatch::in_widest;
use crate::simd::{Kernel, Simd};
use crate::system::Workspace;
use crate::tree::LinkMotion;
use crate::tree::columns::Columns;
use crate::tree::equations::Row;
use crate::tree::sum::total;
use crate::tree::sweep::VectorIndices;

/// A term of one link, such as its kinetic energy, that is summed over all links of a tree.
pub(super) trait LinkTerm {
    /// True if the term depends on the velocity of the link's pivot.
    const PIVOTS: bool = false;

    /// True if the term depends on the joint angle but not on velocities; otherwise it depends on
    /// velocities but not on the joint angle.
    const AT_REST: bool = false;

    /// Returns the term of a link, given the velocity of its pivot and the drive: the acceleration
    /// of the root's pivot, and the torque on this link.
    fn term<E: BodyEquations, V: Scalar>(
        body: &E::Body<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
        drive: [V; 3],
    ) -> [V; 1];
}

/// Angles and velocities of all links, the acceleration of the root's pivot, and the torque on the
/// root.
#[derive(Clone, Copy)]
pub(super) struct TreeState<'a, T> {
    pub(super) theta: &'a [T],
    /// Angular velocities; for a term without velocities, the angles.
    pub(super) omega: &'a [T],
    pub(super) drive: [T; 3],
}

/// Returns the sum of the terms; NaN if a slice has another length than the number of links.
pub(super) fn sum_of<S: LinkTerm, E: BodyEquations, T: Scalar>(
    bodies: &Bodies<E, T>,
    workspace: &mut Workspace<T>,
    state: TreeState<'_, T>,
) -> T {
    let links = bodies.shape.links();
    let whole = [state.theta.len(), state.omega.len()] == [links; 2];
    let sum = whole.then(|| {
        in_widest::<T, _>(LinkSums {
            bodies,
            state,
            numbers: workspace.numbers((if S::PIVOTS { 5 } else { 3 }) * links),
            kind: PhantomData::<S>,
        })
    });
    sum.flatten().unwrap_or_else(|| T::from_f64(f64::NAN))
}

/// Sum of a term over all links, with its input and workspace, as an operation that runs in vector
/// registers.
struct LinkSums<'a, S, E, T> {
    bodies: &'a Bodies<E, T>,
    state: TreeState<'a, T>,
    /// Workspace columns of sines, cosines, terms and, if the term needs them, pivot velocities.
    numbers: &'a mut [T],
    kind: PhantomData<S>,
}

impl<S: LinkTerm, E: BodyEquations, T: Scalar> Kernel<T> for LinkSums<'_, S, E, T> {
    /// The sum; `None` if constants or parents are missing.
    type Output = Option<T>;

    // No operation is fused: the terms have the same bits in all registers.
    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Option<T> {
        let (bodies, links) = (self.bodies, self.state.theta.len());
        let (turned, others) = self.numbers.split_at_mut(2 * links);
        let (sines, cosines) = turned.split_at_mut(links);
        write_sines(self.state.theta, sines, cosines);
        let (terms, pivots) = others.split_at_mut(links);
        let along = Along::<'_, S, E, T> {
            given: self.state.omega,
            drive: self.state.drive,
            turned: Columns::new(turned, links),
            pivots: Columns::new(pivots, links),
            terms: Columns::new(&mut *terms, links),
            kind: PhantomData,
        };
        for strip in bodies.shape.strips() {
            match strip.parent {
                Some(parent) if strip.count >= V::LANES => {
                    let body = bodies.row::<V>(strip.row)?;
                    let own = along.from(strip.link, strip.count)?;
                    let parents = along.from(parent, strip.count)?;
                    let mut places = VectorIndices::of::<T, V>(strip.count);
                    while let Some(place) = places.next() {
                        own.form(&body, place, Some((&parents, place)))?;
                    }
                }
                _ => {
                    let body = bodies.row::<V::One>(strip.row)?;
                    for (link, parent) in strip.each() {
                        let parent = parent.map(|parent| (&along, parent));
                        along.form(&body, link, parent)?;
                    }
                }
            }
        }
        Some(total(terms))
    }
}

/// Writes sines and cosines of all angles. The results have the same bits as if each angle were
/// evaluated alone.
#[inline(always)]
fn write_sines<T: Scalar>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
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

/// Columns of a tree's links for the downward pass, from the root to the leaves.
struct Along<'a, S, E, T> {
    /// Angular velocities; for a term without velocities, the angles.
    given: &'a [T],
    drive: [T; 3],
    /// Columns of sines and cosines.
    turned: Columns<'a, T, 2>,
    pivots: Columns<'a, T, 2>,
    terms: Columns<'a, T, 1>,
    kind: PhantomData<(S, E)>,
}

impl<S: LinkTerm, E: BodyEquations, T: Scalar> Along<'_, S, E, T> {
    /// Computes the pivot velocities and the terms of one link, or of several links, one in each
    /// lane of `V`. The values of their parents are in the same columns.
    #[inline(always)]
    fn form<V: Simd<T>>(
        &self,
        body: &E::Body<V>,
        place: usize,
        parent: Option<(&Self, usize)>,
    ) -> Option<()> {
        let zero = V::from_f64(0.0);
        let mut link = self.motion::<V>(place)?;
        let (mut pivot, mut drive) = ([zero; 2], self.drive.map(V::splat));
        if let Some((parents, place)) = parent {
            let above = parents.motion::<V>(place)?;
            link.joint_angle = link.joint_angle - above.joint_angle;
            if S::PIVOTS {
                let velocity = parents.pivots.load(place)?;
                pivot = E::pivot_velocity(body, above, velocity);
            }
            drive[2] = zero;
        }
        if S::PIVOTS {
            self.pivots.store(place, &pivot)?;
        }
        if S::AT_REST {
            [link.omega, link.joint_rate] = [zero; 2];
        }
        let term = S::term::<E, V>(body, link, pivot, drive);
        self.terms.store(place, &term)
    }

    /// Returns the columns restricted to `count` links from index `first` on.
    #[inline(always)]
    fn from(&self, first: usize, count: usize) -> Option<Self> {
        Some(Self {
            given: self.given.get(first..first + count)?,
            drive: self.drive,
            turned: self.turned.window(first, count)?,
            pivots: match S::PIVOTS {
                true => self.pivots.window(first, count)?,
                false => self.pivots,
            },
            terms: self.terms.window(first, count)?,
            kind: PhantomData,
        })
    }

    /// Returns the motion of the links at index `place`, each as if it hung directly from the
    /// ground.
    #[inline(always)]
    fn motion<V: Simd<T>>(&self, place: usize) -> Option<LinkMotion<V>> {
        let [sine, cosine] = self.turned.load(place)?;
        let given = V::load(self.given.get(place..)?)?;
        Some(LinkMotion::turning(sine, cosine, given))
    }
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Returns the row of constants with this number, if it exists.
    #[inline(always)]
    pub(super) fn row<V: Simd<T>>(&self, number: usize) -> Option<E::Body<V>> {
        let start = number * <E::Body<T> as Row<T>>::LENGTH;
        let numbers = <E::Body<T> as Row<T>>::first_of(self.rows.get(start..)?)?;
        let mut row = <E::Body<V> as Row<V>>::filled(V::from_f64(0.0));
        for (place, &number) in row.as_mut().iter_mut().zip(numbers.as_ref()) {
            *place = V::splat(number);
        }
        Some(row)
    }
}
