//! Trees of any shape: the recursion over a table of links.

use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;

use super::links::{Shape, State, load, store};
use super::pool::Pool;
use super::recursion::Recursion;
use super::root::RootDrive;
use super::sweep::splat;
use super::table_energy as energy;
use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;

/// The columns of a link's constants that say how it acts on its parent.
pub(super) const HANGING: usize = 3;

/// A large tree of irregular shape: the parent and the constants of each link, and
/// room for evaluations.
///
/// Emitted models hold one. `P` are the equations, and `C`, `R` and `K` their
/// numbers; see [`Recursion`]. All children of a link hang at one place, their
/// distance is the link's unit of length. Room is allocated by the first
/// evaluation, and again by evaluations at the same time in other threads; nothing
/// is allocated after that. (Without the feature `std` every evaluation
/// allocates.)
///
/// # Cost
/// O(links). Sines and cosines are computed several at a time, the recursion link
/// by link, in the order of their depth: links of one depth do not wait for each
/// other.
///
/// # Source
/// R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7
/// (articulated-body algorithm), in the plane.
pub struct Table<P, T, const C: usize, const R: usize, const K: usize> {
    pub(super) shape: Shape,
    /// What the equations of a link read.
    pub(super) constants: Vec<[T; C]>,
    /// The factors of what it answers, and of what it takes from its parent:
    /// `square`, `ratio`, `reach`.
    pub(super) hanging: Vec<[T; HANGING]>,
    pub(super) root: [T; 2],
    pub(super) energies: Vec<[T; 7]>,
    pub(super) pool: Pool<T>,
    pub(super) recursion: PhantomData<P>,
}

/// Rows of a table in a model's scalar. Each number is given as the `f64` nearest
/// to it and the `f64` nearest to the rest.
#[must_use]
pub fn rows<T: Scalar, const N: usize>(exact: &[[[f64; 2]; N]]) -> Vec<[T; N]> {
    let mut rows = Vec::with_capacity(exact.len());
    for exact in exact {
        let mut row = [T::from_f64(0.0); N];
        for i in 0..N {
            let [high, low] = exact[i];
            row[i] = T::from_parts(high, low);
        }
        rows.push(row);
    }
    rows
}

impl<P, T, const C: usize, const R: usize, const K: usize> Table<P, T, C, R, K>
where
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    /// A tree with the parent of each link, the constants of each, what the root
    /// takes from above, and the constants of the energies, none where these are
    /// not asked for.
    ///
    /// A row of `motion` has `rest`, `inertia` and `moment` of the link, then
    /// `square`, `ratio` and `reach` of the link on its parent, then its forces.
    /// One of `energies` has half of the mass, the first moment and half of the
    /// moment of inertia about the pivot, the pivot's distance from the parent's,
    /// weight, gravity's first moment, and half of the spring's stiffness.
    #[must_use]
    pub fn new(
        parents: &'static [u32],
        motion: Vec<[T; C]>,
        root: [T; 2],
        energies: Vec<[T; 7]>,
    ) -> Self {
        const { assert!(C >= 6 && R >= 5, "columns that have meanings here") };
        let (mut constants, one) = (motion, T::from_f64(1.0));
        let mut hanging = Vec::with_capacity(constants.len());
        for row in &mut constants {
            // A link's own answers and accelerations are in its own unit.
            hanging.push([row[3], row[4], row[5]]);
            (row[3], row[4], row[5]) = (one, one, one);
        }
        Self {
            shape: Shape::new(parents),
            constants,
            hanging,
            root,
            energies,
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
        let zero = T::from_f64(0.0);
        if [theta.len(), omega.len(), alpha.len()] != [P::LINKS; 3] {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        self.pool.lend((2 + R + K) * P::LINKS, zero, |buffer| {
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

    /// Kinetic energy, J. NaN for slices of another length than there are links.
    #[must_use]
    pub fn kinetic_energy(&self, theta: &[T], omega: &[T]) -> T {
        if [theta.len(), omega.len()] != [P::LINKS; 2] {
            return T::from_f64(f64::NAN);
        }
        let room = energy::KINETIC * P::LINKS;
        self.pool.lend(room, T::from_f64(0.0), |buffer| {
            energy::kinetic(self.shape.parents, &self.energies, theta, omega, buffer)
        })
    }

    /// Potential energy, J, zero where every link hangs straight down. NaN for a
    /// slice of another length than there are links.
    #[must_use]
    pub fn potential_energy(&self, theta: &[T]) -> T {
        if theta.len() != P::LINKS {
            return T::from_f64(f64::NAN);
        }
        let room = energy::POTENTIAL * P::LINKS;
        self.pool.lend(room, T::from_f64(0.0), |buffer| {
            energy::potential(self.shape.parents, &self.energies, theta, buffer)
        })
    }
}

/// One evaluation.
struct Accelerations<'a, P, T, const C: usize, const R: usize, const K: usize> {
    table: &'a Table<P, T, C, R, K>,
    drive: Option<RootDrive<T>>,
    theta: &'a [T],
    omega: &'a [T],
    alpha: &'a mut [T],
    buffer: &'a mut [T],
}

impl<P, T, const C: usize, const R: usize, const K: usize> SliceKernel<T>
    for Accelerations<'_, P, T, C, R, K>
where
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let (state, buffer) =
            State::new::<W::Wide>(&self.table.shape, self.theta, self.omega, self.buffer);
        let n = self.alpha.len();
        let (below, buffer) = buffer.split_at_mut(R * n);
        let kept = buffer.get_mut(..K * n).unwrap_or_default();
        let torque = self.drive.map(|drive| drive.torque);
        up::<P, T, W::One, C, R, K>(self.table, torque, &state, below, kept);
        let root = RootDrive::above(self.table.root, self.drive);
        down::<P, T, W::One, C, R, K>(self.table, root, &state, below, kept, self.alpha);
    }
}

/// From the leaves to the root. `below` sums the answers of each link's children,
/// in the link's unit of length.
#[inline(always)]
fn up<P, T, V, const C: usize, const R: usize, const K: usize>(
    table: &Table<P, T, C, R, K>,
    torque: Option<T>,
    state: &State<'_, T>,
    below: &mut [T],
    kept: &mut [T],
) where
    P: Recursion<C, R, R, K>,
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
        let [square, ratio, _] = splat::<T, V, HANGING>(hanging);
        let motion = state.motion::<V>(link, P::JOINTS);
        let (mut answers, across, along);
        if table.shape.is_leaf(link) {
            answers = P::leaf(&constants, motion);
            (across, along) = (-square, -ratio);
        } else {
            let (own, own_kept) = P::inner(&constants, motion, load::<T, V, R>(below, link));
            store(own_kept, kept, link);
            answers = own;
            (across, along) = (square, ratio);
        }
        if link == 0 {
            return;
        }
        let factors = [square, across, square, along, ratio];
        let parent = table.shape.parent(link);
        let sums = load::<T, V, R>(below, parent);
        for i in 0..R {
            answers[i] = match factors.get(i) {
                Some(&factor) => factor.mul_add(answers[i], sums[i]),
                // Torques have no unit of length.
                None => answers[i] + sums[i],
            };
        }
        store(answers, below, parent);
    }
}

/// From the root to the leaves. The accelerations of the children's pivots take
/// the place of the children's answers.
#[inline(always)]
fn down<P, T, V, const C: usize, const R: usize, const K: usize>(
    table: &Table<P, T, C, R, K>,
    root: [T; 2],
    state: &State<'_, T>,
    ends: &mut [T],
    kept: &[T],
    alpha: &mut [T],
) where
    P: Recursion<C, R, R, K>,
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
            let reach = V::splat(hanging[2]);
            let [x, y] = load::<T, V, 2>(ends, table.shape.parent(link));
            [reach * x, reach * y]
        };
        let acceleration = if table.shape.is_leaf(link) {
            P::turn_leaf(&constants, motion, pivot)
        } else {
            let (acceleration, end) =
                P::turn(&constants, motion, load::<T, V, K>(kept, link), pivot);
            store(end, ends, link);
            acceleration
        };
        acceleration.store(alpha, link);
    }
}

impl<P, T: Clone, const C: usize, const R: usize, const K: usize> Clone for Table<P, T, C, R, K> {
    /// The copy has room of its own.
    fn clone(&self) -> Self {
        let Self {
            shape,
            constants,
            hanging,
            root,
            energies,
            pool: _,
            recursion,
        } = self;
        Self {
            shape: shape.clone(),
            constants: constants.clone(),
            hanging: hanging.clone(),
            root: root.clone(),
            energies: energies.clone(),
            pool: Pool::new(),
            recursion: *recursion,
        }
    }
}

impl<P, T: PartialEq, const C: usize, const R: usize, const K: usize> PartialEq
    for Table<P, T, C, R, K>
{
    fn eq(&self, other: &Self) -> bool {
        let Self {
            shape,
            constants,
            hanging,
            root,
            energies,
            pool: _,
            recursion: _,
        } = self;
        *shape == other.shape
            && *constants == other.constants
            && *hanging == other.hanging
            && *root == other.root
            && *energies == other.energies
    }
}

impl<P, T: fmt::Debug, const C: usize, const R: usize, const K: usize> fmt::Debug
    for Table<P, T, C, R, K>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            shape,
            constants,
            hanging,
            root,
            energies,
            pool: _,
            recursion: _,
        } = self;
        f.debug_struct("Table")
            .field("parents", &shape.parents)
            .field("constants", constants)
            .field("hanging", hanging)
            .field("root", root)
            .field("energies", energies)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
