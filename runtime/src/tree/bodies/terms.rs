//! Sums over the links, of terms that are formed of several neighbours at once.

use core::marker::PhantomData;

use super::{Bodies, BodyEquations};
use crate::scalar::Scalar;
use crate::scalar::kind::{compiled, compiled_once};
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
    /// Empty where terms are those of a tree at rest.
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
    let moving = match S::AT_REST {
        true => 0,
        false => links,
    };
    let whole = [state.theta.len(), state.omega.len()] == [links, moving];
    let sum = whole.then(|| {
        let numbers = workspace.numbers((if S::PIVOTS { 5 } else { 3 }) * links);
        let (turned, others) = numbers.split_at_mut(2 * links);
        let (sines, cosines) = turned.split_at_mut(links);
        compiled::<Turned, T>()(state.theta, sines, cosines);
        let (terms, pivots) = others.split_at_mut(links);
        let formed = in_widest::<T, _>(LinkSums {
            bodies,
            state,
            turned,
            pivots,
            terms,
            kind: PhantomData::<S>,
        });
        formed.map(|()| compiled::<Total, T>()(terms))
    });
    sum.flatten().unwrap_or_else(|| T::from_f64(f64::NAN))
}

compiled_once! {
    /// [`turn`].
    Turned<T> = turn_in_widest: fn(&[T], &mut [T], &mut [T])
}

compiled_once! {
    /// [`total`].
    Total<T> = total_in_widest: fn(&[T]) -> T
}

fn turn_in_widest<T: Scalar>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
    in_widest::<T, _>(Turn {
        angles,
        sines,
        cosines,
    });
}

fn total_in_widest<T: Scalar>(terms: &[T]) -> T {
    in_widest::<T, _>(Terms(terms))
}

/// Sines and cosines of angles.
struct Turn<'a, T> {
    angles: &'a [T],
    sines: &'a mut [T],
    cosines: &'a mut [T],
}

impl<T: Scalar> Kernel<T> for Turn<'_, T> {
    type Output = ();

    /// Those of each by itself, sooner.
    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        const BLOCK: usize = 8;
        let (blocks, rest) = self.angles.as_chunks::<BLOCK>();
        let (sine_blocks, sines) = self.sines.as_chunks_mut::<BLOCK>();
        let (cosine_blocks, cosines) = self.cosines.as_chunks_mut::<BLOCK>();
        for ((block, sines), cosines) in blocks.iter().zip(sine_blocks).zip(cosine_blocks) {
            (*sines, *cosines) = T::sin_cos_each(block);
        }
        for ((angle, sine), cosine) in rest.iter().zip(sines).zip(cosines) {
            (*sine, *cosine) = angle.sin_cos();
        }
    }
}

/// A sum of terms.
struct Terms<'a, T>(&'a [T]);

impl<T: Scalar> Kernel<T> for Terms<'_, T> {
    type Output = T;

    #[inline(always)]
    fn run<V: Simd<T>>(self) -> T {
        total(self.0)
    }
}

/// What terms are formed of.
struct LinkSums<'a, S, E, T> {
    bodies: &'a Bodies<E, T>,
    state: TreeState<'a, T>,
    /// Columns of sines and cosines.
    turned: &'a mut [T],
    /// Columns of velocities of pivots, where terms take them.
    pivots: &'a mut [T],
    terms: &'a mut [T],
    kind: PhantomData<S>,
}

impl<S: LinkTerm, E: BodyEquations, T: Scalar> Kernel<T> for LinkSums<'_, S, E, T> {
    /// None where rows or parents are lacking.
    type Output = Option<()>;

    // Nothing is fused: the terms have the same bits in all registers.
    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Option<()> {
        let (bodies, links) = (self.bodies, self.state.theta.len());
        let along = Along::<'_, S, E, T> {
            state: self.state,
            turned: Columns::new(self.turned, links),
            pivots: Columns::new(self.pivots, links),
            terms: Columns::new(self.terms, links),
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
        Some(())
    }
}

/// The way from the root to the leaves.
struct Along<'a, S, E, T> {
    state: TreeState<'a, T>,
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
        let mut link = self.motion::<V>(place)?;
        let (mut pivot, mut drive) = ([V::from_f64(0.0); 2], self.state.drive.map(V::splat));
        if S::AT_REST {
            link.joint_angle = self.angle(place)?;
        }
        if let Some((parents, place)) = parent {
            if S::AT_REST {
                link.joint_angle = link.joint_angle - parents.angle(place)?;
            }
            if S::PIVOTS {
                let above = parents.pivots.load(place)?;
                pivot = E::pivot_velocity(body, parents.motion::<V>(place)?, above);
            }
            drive[2] = V::from_f64(0.0);
        }
        if S::PIVOTS {
            self.pivots.store(place, &pivot)?;
        }
        self.terms
            .store(place, &S::term::<E, V>(body, link, pivot, drive))
    }

    /// The columns of so many links, from one on.
    #[inline(always)]
    fn from(&self, first: usize, count: usize) -> Option<Self> {
        let TreeState {
            theta,
            omega,
            drive,
        } = self.state;
        let links = first..first + count;
        let state = TreeState {
            theta: theta.get(links.clone())?,
            omega: if S::AT_REST { omega } else { omega.get(links)? },
            drive,
        };
        let pivots = match S::PIVOTS {
            true => self.pivots.window(first, count)?,
            false => self.pivots,
        };
        Some(Self {
            state,
            turned: self.turned.window(first, count)?,
            pivots,
            terms: self.terms.window(first, count)?,
            kind: PhantomData,
        })
    }

    /// The motion of links but for that of joints.
    #[inline(always)]
    fn motion<V: Simd<T>>(&self, place: usize) -> Option<LinkMotion<V>> {
        let [sine, cosine] = self.turned.load(place)?;
        let omega = match S::AT_REST {
            true => V::from_f64(0.0),
            false => V::load(self.state.omega.get(place..)?)?,
        };
        Some(LinkMotion::turning(sine, cosine, omega))
    }

    #[inline(always)]
    fn angle<V: Simd<T>>(&self, place: usize) -> Option<V> {
        V::load(self.state.theta.get(place..)?)
    }
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Returns a row, if there is one.
    #[inline(always)]
    pub(super) fn row<V: Simd<T>>(&self, number: usize) -> Option<E::Body<V>> {
        let length = <E::Body<V> as Row<V>>::LENGTH;
        let start = number.checked_mul(length)?;
        let numbers = self.rows.get(start..)?.get(..length)?;
        let mut row = <E::Body<V> as Row<V>>::filled(V::from_f64(0.0));
        for (place, &number) in row.as_mut().iter_mut().zip(numbers) {
            *place = V::splat(number);
        }
        Some(row)
    }
}
