//! Trees of any shape whose links carry children at several places: the recursion
//! over a table of links.

use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;

use super::links::{Shape, State, load, store};
use super::pool::Pool;
use super::recursion::Motion;
use super::root::RootDrive;
use super::sweep::splat;
use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;

/// The equations of one link that carries its children where they hang, for
/// [`PlacedTable`].
///
/// A child answers an acceleration of its pivot with `R` numbers, as in
/// [`Recursion`](super::Recursion): a symmetric matrix Φ (xx, xy, yy), a force
/// **β**, and where links pull at each other by torques this torque. About its
/// parent's pivot these are `S` numbers, which are summed over the children. `K`
/// numbers are kept of an inner link on the way from the leaves to the root. `C`
/// constants belong to a link; lengths are in metres.
///
/// Written by the attribute. Featherstone, Rigid Body Dynamics Algorithms, 2008,
/// ch. 7; `docs/physics.md`, section 2.
pub trait PlacedRecursion<const C: usize, const R: usize, const S: usize, const K: usize>:
    Send + Sync + 'static
{
    /// Number of links.
    const LINKS: usize;

    /// Whether the functions read [`Motion::bend`] and [`Motion::bend_rate`].
    const JOINTS: bool;

    /// Whether the last column of the constants is a torque on the root, as in
    /// [`Recursion::TORQUE`](super::Recursion::TORQUE).
    const TORQUE: bool = false;

    /// What a leaf answers: in place of Φ without its isotropic part and of **β**,
    /// (xx, −xy, yy) and (−x, y) over factors of the table.
    fn leaf<V: Scalar>(constants: &[V; C], link: Motion<V>) -> [V; R];

    /// What a child's answer is about the pivot of its parent, `link`, when it
    /// hangs at `place`: along and across the parent.
    fn hang<V: Scalar>(link: Motion<V>, place: [V; 2], answers: [V; R]) -> [V; S];

    /// What a link with children answers, with the sum of these; and what is kept.
    fn inner<V: Scalar>(constants: &[V; C], link: Motion<V>, below: [V; S]) -> ([V; R], [V; K]);

    /// Angular acceleration of an inner link, and what it adds to the acceleration
    /// of a point at distance 1 along the link.
    fn turn<V: Scalar>(link: Motion<V>, kept: [V; K], pivot: [V; 2]) -> (V, [V; 2]);

    /// Angular acceleration of a leaf.
    fn turn_leaf<V: Scalar>(constants: &[V; C], link: Motion<V>, pivot: [V; 2]) -> V;
}

/// What a link is to its parent: factors of what it answers, `square` and `ratio`,
/// and of what it takes, `reach`; the isotropic part of its Φ; its place.
pub(super) const HANGING: usize = 6;

/// A large tree of irregular shape whose links carry children at several places, or
/// in their own pivot: the parent and the constants of each link, and room for
/// evaluations.
///
/// Emitted models hold one where a [`Table`](super::Table), all children of whose
/// links hang at one place, does not do: there a link forms Φ **v** once for all
/// of its children, here for each of them. Room is allocated as there.
///
/// # Cost
/// O(links), in the order of their depth.
///
/// # Source
/// R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7
/// (articulated-body algorithm), in the plane.
pub struct PlacedTable<P, T, const C: usize, const R: usize, const S: usize, const K: usize> {
    pub(super) shape: Shape,
    pub(super) constants: Vec<[T; C]>,
    pub(super) hanging: Vec<[T; HANGING]>,
    pub(super) root: [T; 2],
    pub(super) pool: Pool<T>,
    pub(super) recursion: PhantomData<P>,
}

impl<P, T, const C: usize, const R: usize, const S: usize, const K: usize>
    PlacedTable<P, T, C, R, S, K>
where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
{
    /// A tree with the parent of each link, the constants of each, what each is to
    /// its parent, and what the root takes from above.
    ///
    /// A row of `hanging` has `square`, `ratio`, `reach`, the isotropic part of Φ,
    /// and the place along and across the parent.
    #[must_use]
    pub fn new(
        parents: &'static [u32],
        constants: Vec<[T; C]>,
        hanging: Vec<[T; HANGING]>,
        root: [T; 2],
    ) -> Self {
        const { assert!(R >= 5 && S >= 4, "numbers that have meanings here") };
        Self {
            shape: Shape::new(parents),
            constants,
            hanging,
            root,
            pool: Pool::new(),
            recursion: PhantomData,
        }
    }

    /// Writes the angular accelerations, as
    /// [`Pendulum::accelerations_into`](crate::Pendulum::accelerations_into).
    pub fn accelerations_into(&self, theta: &[T], omega: &[T], alpha: &mut [T]) {
        self.accelerate(None, theta, omega, alpha);
    }

    /// The same for a driven tree, at a time of this drive.
    pub fn driven_accelerations_into(
        &self,
        drive: RootDrive<T>,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.accelerate(Some(drive), theta, omega, alpha);
    }

    fn accelerate(&self, drive: Option<RootDrive<T>>, theta: &[T], omega: &[T], alpha: &mut [T]) {
        if [theta.len(), omega.len(), alpha.len()] != [P::LINKS; 3] {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        let room = (2 + S + K) * P::LINKS;
        self.pool.lend(room, T::from_f64(0.0), |buffer| {
            T::over_slices(Accelerations {
                table: self,
                drive,
                theta,
                omega,
                alpha,
                buffer,
            });
        });
    }
}

/// One evaluation.
struct Accelerations<'a, P, T, const C: usize, const R: usize, const S: usize, const K: usize> {
    table: &'a PlacedTable<P, T, C, R, S, K>,
    drive: Option<RootDrive<T>>,
    theta: &'a [T],
    omega: &'a [T],
    alpha: &'a mut [T],
    buffer: &'a mut [T],
}

impl<P, T, const C: usize, const R: usize, const S: usize, const K: usize> SliceKernel<T>
    for Accelerations<'_, P, T, C, R, S, K>
where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let (state, buffer) =
            State::new::<W::Wide>(&self.table.shape, self.theta, self.omega, self.buffer);
        let n = self.alpha.len();
        let (below, buffer) = buffer.split_at_mut(S * n);
        let kept = buffer.get_mut(..K * n).unwrap_or_default();
        let torque = self.drive.map(|drive| drive.torque);
        up::<P, T, W::One, C, R, S, K>(self.table, torque, &state, below, kept);
        let root = RootDrive::above(self.table.root, self.drive);
        down::<P, T, W::One, C, R, S, K>(self.table, root, &state, below, kept, self.alpha);
    }
}

/// From the leaves to the root. `below` sums what each link's children are about
/// its pivot.
#[inline(always)]
fn up<P, T, V, const C: usize, const R: usize, const S: usize, const K: usize>(
    table: &PlacedTable<P, T, C, R, S, K>,
    torque: Option<T>,
    state: &State<'_, T>,
    below: &mut [T],
    kept: &mut [T],
) where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
    V: Vector<T>,
{
    below.fill(T::from_f64(0.0));
    for &link in table.shape.order.iter().rev() {
        let link = link as usize;
        let (Some(constants), Some(hanging)) = (table.constants.get(link), table.hanging.get(link))
        else {
            return;
        };
        let constants = match torque {
            Some(torque) if P::TORQUE && link == 0 => RootDrive::row(torque, constants),
            _ => *constants,
        };
        let constants = splat::<T, V, C>(&constants);
        let [square, ratio, _, rest, along, across] = splat::<T, V, HANGING>(hanging);
        let motion = state.motion::<V>(link, P::JOINTS);
        let (mut answers, sign);
        if table.shape.is_leaf(link) {
            answers = P::leaf(&constants, motion);
            sign = V::from_f64(-1.0);
        } else {
            let (own, own_kept) = P::inner(&constants, motion, load::<T, V, S>(below, link));
            store(own_kept, kept, link);
            answers = own;
            sign = V::from_f64(1.0);
        }
        if link == 0 {
            return;
        }
        answers[0] = square.mul_add(answers[0], rest);
        answers[1] = sign * square * answers[1];
        answers[2] = square.mul_add(answers[2], rest);
        answers[3] = sign * ratio * answers[3];
        answers[4] = ratio * answers[4];
        let parent = table.shape.parent(link);
        let carrier = state.motion::<V>(parent, false);
        let mut sums = load::<T, V, S>(below, parent);
        let own = P::hang(carrier, [along, across], answers);
        for i in 0..S {
            sums[i] = sums[i] + own[i];
        }
        store(sums, below, parent);
    }
}

/// From the root to the leaves. The acceleration of a link's pivot, and what the
/// link's motion adds at distance 1 along it, take the place of what hangs on it.
#[inline(always)]
fn down<P, T, V, const C: usize, const R: usize, const S: usize, const K: usize>(
    table: &PlacedTable<P, T, C, R, S, K>,
    root: [T; 2],
    state: &State<'_, T>,
    ends: &mut [T],
    kept: &[T],
    alpha: &mut [T],
) where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
    V: Vector<T>,
{
    for &link in &table.shape.order {
        let link = link as usize;
        let (Some(constants), Some(hanging)) = (table.constants.get(link), table.hanging.get(link))
        else {
            return;
        };
        let constants = splat::<T, V, C>(constants);
        let motion = state.motion::<V>(link, P::JOINTS);
        let pivot = if link == 0 {
            splat::<T, V, 2>(&root)
        } else {
            let [_, _, reach, _, along, across] = splat::<T, V, HANGING>(hanging);
            let row = ends.get(table.shape.parent(link) * S..).unwrap_or_default();
            let [x, y, turn_x, turn_y] = load::<T, V, 4>(row, 0);
            [
                reach * along.mul_add(turn_x, (-across).mul_add(turn_y, x)),
                reach * along.mul_add(turn_y, across.mul_add(turn_x, y)),
            ]
        };
        let acceleration = if table.shape.is_leaf(link) {
            P::turn_leaf(&constants, motion, pivot)
        } else {
            let [x, y] = pivot;
            let own_kept = load::<T, V, K>(kept, link);
            let (acceleration, [turn_x, turn_y]) = P::turn(motion, own_kept, pivot);
            let row = ends.get_mut(link * S..).unwrap_or_default();
            store([x, y, turn_x, turn_y], row, 0);
            acceleration
        };
        acceleration.store(alpha, link);
    }
}

impl<P, T: Clone, const C: usize, const R: usize, const S: usize, const K: usize> Clone
    for PlacedTable<P, T, C, R, S, K>
{
    /// The copy has room of its own.
    fn clone(&self) -> Self {
        let Self {
            shape,
            constants,
            hanging,
            root,
            pool: _,
            recursion,
        } = self;
        Self {
            shape: shape.clone(),
            constants: constants.clone(),
            hanging: hanging.clone(),
            root: root.clone(),
            pool: Pool::new(),
            recursion: *recursion,
        }
    }
}

impl<P, T: PartialEq, const C: usize, const R: usize, const S: usize, const K: usize> PartialEq
    for PlacedTable<P, T, C, R, S, K>
{
    fn eq(&self, other: &Self) -> bool {
        let Self {
            shape,
            constants,
            hanging,
            root,
            pool: _,
            recursion: _,
        } = self;
        *shape == other.shape
            && *constants == other.constants
            && *hanging == other.hanging
            && *root == other.root
    }
}

impl<P, T: fmt::Debug, const C: usize, const R: usize, const S: usize, const K: usize> fmt::Debug
    for PlacedTable<P, T, C, R, S, K>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            shape,
            constants,
            hanging,
            root,
            pool: _,
            recursion: _,
        } = self;
        f.debug_struct("PlacedTable")
            .field("parents", &shape.parents)
            .field("constants", constants)
            .field("hanging", hanging)
            .field("root", root)
            .finish_non_exhaustive()
    }
}
