//! Sums over the links, of terms that are formed of several neighbours at once.

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
use crate::tree::sweep::VectorPlaces;

/// A term of each link that is summed over the tree.
pub(super) trait LinkTerm {
    /// The term takes the velocity of the link's pivot.
    const PIVOTS: bool = false;

    /// The term takes the angle of the joint and no velocities; without, velocities and no
    /// joints.
    const AT_REST: bool = false;

    /// Returns the term of a link, of the velocity of its pivot and of what the drive does: the
    /// acceleration of the root's pivot, and the torque on this link.
    fn term<E: BodyEquations, V: Scalar>(
        body: &E::Body<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
        drive: [V; 3],
    ) -> [V; 1];
}

/// Angles and velocities of all links, and the acceleration of the root's pivot and the torque
/// on the root.
#[derive(Clone, Copy)]
pub(super) struct TreeState<'a, T> {
    pub(super) theta: &'a [T],
    /// The angles where terms are those of a tree at rest.
    pub(super) omega: &'a [T],
    pub(super) drive: [T; 3],
}

/// Returns the sum of the terms; NaN for slices of another length than there are links.
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

/// What terms are formed of.
struct LinkSums<'a, S, E, T> {
    bodies: &'a Bodies<E, T>,
    state: TreeState<'a, T>,
    /// Columns of sines and cosines, of terms, and of velocities of pivots where terms take them.
    numbers: &'a mut [T],
    kind: PhantomData<S>,
}

impl<S: LinkTerm, E: BodyEquations, T: Scalar> Kernel<T> for LinkSums<'_, S, E, T> {
    /// None where rows or parents are lacking.
    type Output = Option<T>;

    // Nothing is fused: the terms have the same bits in all registers.
    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Option<T> {
        let (bodies, links) = (self.bodies, self.state.theta.len());
        let (turned, others) = self.numbers.split_at_mut(2 * links);
        let (sines, cosines) = turned.split_at_mut(links);
        turn(self.state.theta, sines, cosines);
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
                    let mut places = VectorPlaces::of::<T, V>(strip.count);
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

/// The way from the root to the leaves.
struct Along<'a, S, E, T> {
    /// Angular velocities, or the angles of a tree at rest.
    given: &'a [T],
    drive: [T; 3],
    /// Sines and cosines.
    turned: Columns<'a, T, 2>,
    pivots: Columns<'a, T, 2>,
    terms: Columns<'a, T, 1>,
    kind: PhantomData<(S, E)>,
}

impl<S: LinkTerm, E: BodyEquations, T: Scalar> Along<'_, S, E, T> {
    /// Forms the velocity of the pivot of a link, or of as many as `V` has lanes, whose
    /// parents have a place in their own columns, and their terms.
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

    /// The columns of so many links, from one on.
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

    /// The motion of links, each as if it hung from the ground.
    #[inline(always)]
    fn motion<V: Simd<T>>(&self, place: usize) -> Option<LinkMotion<V>> {
        let [sine, cosine] = self.turned.load(place)?;
        let given = V::load(self.given.get(place..)?)?;
        Some(LinkMotion::turning(sine, cosine, given))
    }
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Returns a row, if there is one.
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
