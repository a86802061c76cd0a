//! Trees of some links, link by link: strips as short as theirs cost more to take through
//! registers than they save.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::equations::{LinkEquations, LinkMotion, Row};
use super::root::RootDrive;
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd};
use crate::system::Workspace;
use crate::system::cast::put;

/// A tree of any shape and of some links, its equations `E` taken through it one link after
/// the other. Faster than a [`Tree`](super::Tree) for one state of few links.
///
/// Evaluations fuse products with sums where the machine can, as those of a
/// [`Tree`](super::Tree) do; they add up in another order.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallTree<E, T> {
    parents: Vec<u32>,
    /// By link.
    carries: Vec<bool>,
    /// Rows of all links, one after the other.
    rows: Vec<T>,
    /// Acceleration of the root's pivot against gravity.
    root: [T; 2],
    equations: PhantomData<E>,
}

/// State of an evaluation: angles, angular velocities, and torques from outside where
/// there are any.
#[derive(Clone, Copy, Debug)]
pub struct LinkStates<'a, T> {
    /// Angles, rad.
    pub theta: &'a [T],
    /// Angular velocities, rad/s.
    pub omega: &'a [T],
    /// Torques from outside, N m.
    pub torques: Option<&'a [T]>,
}

/// Angles whose sines are formed at once.
const STEP: usize = 4;

impl<E: LinkEquations, T: Scalar> SmallTree<E, T> {
    /// A tree with the parent of each link, which stands before it (the root's own is 0),
    /// a row of constants for each, and the acceleration of the root's pivot against
    /// gravity, in the unit of the equations.
    #[must_use]
    pub fn new(parents: &[u32], rows: Vec<T>, root: [T; 2]) -> Self {
        let mut carries = alloc::vec![false; parents.len()];
        for &parent in parents.iter().skip(1) {
            put(&mut carries, parent as usize, true);
        }
        Self {
            parents: parents.to_vec(),
            carries,
            rows,
            root,
            equations: PhantomData,
        }
    }

    /// Returns the same tree on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SmallTree<E, S> {
        SmallTree {
            parents: self.parents.clone(),
            carries: self.carries.clone(),
            rows: self.rows.iter().map(|&x| convert(x)).collect(),
            root: self.root.map(&convert),
            equations: PhantomData,
        }
    }

    /// Writes the angular accelerations at one time of a drive: NaN for slices of another
    /// length than there are links, and under torques where the equations read none.
    pub fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        states: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        let links = self.parents.len();
        let torques = states.torques.map_or(links, <[T]>::len);
        let lengths = [states.theta.len(), states.omega.len(), torques, alpha.len()];
        if lengths != [links; 4] || (states.torques.is_some() && !E::FORCED) {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        let room = workspace.numbers(links * Self::ROOM);
        in_fused_numbers(OneState {
            tree: self,
            drive,
            states,
            room,
            alpha,
        });
    }

    const SUMS: usize = <E::Sums<T> as Row<T>>::LENGTH;
    const CARRIED: usize = <E::Carried<T> as Row<T>>::LENGTH;
    const ELIMINATION: usize = <E::Elimination<T> as Row<T>>::LENGTH;

    /// Sums of responses, in whose place a link's numbers for its children stand later.
    const SHARED: usize = if Self::SUMS > Self::CARRIED {
        Self::SUMS
    } else {
        Self::CARRIED
    };

    /// Numbers of a link: these, the elimination, sine and cosine.
    const ROOM: usize = Self::SHARED + Self::ELIMINATION + 2;
}

/// One evaluation.
struct OneState<'a, E, T> {
    tree: &'a SmallTree<E, T>,
    drive: Option<RootDrive<T>>,
    states: LinkStates<'a, T>,
    room: &'a mut [T],
    alpha: &'a mut [T],
}

impl<E: LinkEquations, T: Scalar> Kernel<T> for OneState<'_, E, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(mut self) {
        self.sines::<V>();
        let links = self.tree.parents.len();
        // Sums of responses start at zero.
        for (link, carries) in self.tree.carries.iter().enumerate() {
            if *carries {
                let place = link * SmallTree::<E, T>::ROOM;
                let sums = self.room.get_mut(place..place + SmallTree::<E, T>::SUMS);
                sums.unwrap_or_default().fill(T::from_f64(0.0));
            }
        }
        for link in (0..links).rev() {
            self.up::<V>(link);
        }
        let above = RootDrive::above(self.tree.root, self.drive).map(V::splat);
        for link in 0..links {
            self.down::<V>(link, above);
        }
    }
}

impl<E: LinkEquations, T: Scalar> OneState<'_, E, T> {
    /// Forms the sines and cosines.
    #[inline(always)]
    fn sines<V: Simd<T>>(&mut self) {
        let place = SmallTree::<E, T>::SHARED + SmallTree::<E, T>::ELIMINATION;
        let rooms = self.room.chunks_mut(STEP * SmallTree::<E, T>::ROOM);
        for (theta, room) in self.states.theta.chunks(STEP).zip(rooms) {
            let mut angles = [V::from_f64(0.0); STEP];
            for (angle, &theta) in angles.iter_mut().zip(theta) {
                *angle = V::splat(theta);
            }
            let (sines, cosines) = V::sin_cos_each(&angles);
            let room = room.chunks_mut(SmallTree::<E, T>::ROOM);
            for ((room, sine), cosine) in room.zip(sines).zip(cosines) {
                put(room, place, sine.first());
                put(room, place + 1, cosine.first());
            }
        }
    }

    /// A row of numbers of a link from a place in its room on.
    #[inline(always)]
    fn read<V: Simd<T>, R: Row<V>>(&self, link: usize, place: usize) -> R {
        row::<T, V, R>(self.room, link * SmallTree::<E, T>::ROOM + place)
    }

    #[inline(always)]
    fn write<V: Simd<T>, R: Row<V>>(&mut self, link: usize, place: usize, row: &R) {
        let start = link * SmallTree::<E, T>::ROOM + place;
        let Some(room) = self.room.get_mut(start..start + R::LENGTH) else {
            return;
        };
        let mut i = 0;
        while i < R::LENGTH {
            room[i] = row.as_ref()[i].first();
            i += 1;
        }
    }

    #[inline(always)]
    fn constants<V: Simd<T>>(&self, link: usize) -> E::Constants<V> {
        let length = <E::Constants<V> as Row<V>>::LENGTH;
        let mut row = row::<T, V, E::Constants<V>>(&self.tree.rows, link * length);
        if E::TORQUE
            && link == 0
            && let (Some(drive), Some(last)) = (self.drive, row.as_mut().last_mut())
        {
            *last = V::splat(drive.torque);
        }
        row
    }

    #[inline(always)]
    fn parent(&self, link: usize) -> usize {
        match self.tree.parents.get(link) {
            Some(&parent) => parent as usize,
            None => 0,
        }
    }

    #[inline(always)]
    fn motion<V: Simd<T>>(&self, link: usize) -> LinkMotion<V> {
        let place = SmallTree::<E, T>::SHARED + SmallTree::<E, T>::ELIMINATION;
        let [sine, cosine] = self.read::<V, [V; 2]>(link, place);
        let LinkStates {
            theta,
            omega,
            torques,
        } = self.states;
        let (mut joint_angle, mut joint_rate) = (at(theta, link), at(omega, link));
        if E::JOINTS && link > 0 {
            let parent = self.parent(link);
            joint_angle = joint_angle - at(theta, parent);
            joint_rate = joint_rate - at(omega, parent);
        }
        let outside_torque = match torques {
            Some(torques) => at(torques, link),
            None => T::from_f64(0.0),
        };
        LinkMotion {
            sine,
            cosine,
            omega: V::splat(at(omega, link)),
            joint_angle: V::splat(joint_angle),
            joint_rate: V::splat(joint_rate),
            outside_torque: V::splat(outside_torque),
            held: V::from_f64(0.0),
        }
    }

    #[inline(always)]
    fn carries(&self, link: usize) -> bool {
        self.tree.carries.get(link).copied().unwrap_or_default()
    }

    /// The response of a link, added to the sums of its parent.
    #[inline(always)]
    fn up<V: Simd<T>>(&mut self, link: usize) {
        let (constants, motion) = (self.constants::<V>(link), self.motion::<V>(link));
        let response = if self.carries(link) {
            let sums = self.read::<V, E::Sums<V>>(link, 0);
            let (response, elimination) = E::inner(&constants, motion, sums);
            self.write(link, SmallTree::<E, T>::SHARED, &elimination);
            response
        } else {
            E::leaf(&constants, motion)
        };
        if link == 0 {
            return;
        }
        let parent = self.parent(link);
        let attached = E::attach(&constants, self.motion::<V>(parent), response);
        let mut sums = self.read::<V, E::Sums<V>>(parent, 0);
        let mut i = 0;
        while i < <E::Sums<V> as Row<V>>::LENGTH {
            sums.as_mut()[i] = sums.as_ref()[i] + attached.as_ref()[i];
            i += 1;
        }
        self.write(parent, 0, &sums);
    }

    /// The acceleration of a link, and what it hands to its children.
    #[inline(always)]
    fn down<V: Simd<T>>(&mut self, link: usize, above: [V; 2]) {
        let (constants, motion) = (self.constants::<V>(link), self.motion::<V>(link));
        let pivot = match link {
            0 => above,
            _ => {
                let parent = self.parent(link);
                let carried = self.read::<V, E::Carried<V>>(parent, 0);
                E::pivot(&constants, self.motion::<V>(parent), carried)
            }
        };
        let acceleration = if self.carries(link) {
            let elimination = self.read::<V, E::Elimination<V>>(link, SmallTree::<E, T>::SHARED);
            let (acceleration, carried) = E::accelerate(&constants, motion, elimination, pivot);
            self.write(link, 0, &carried);
            acceleration
        } else {
            E::accelerate_leaf(&constants, motion, pivot)
        };
        put(self.alpha, link, acceleration.first());
    }
}

/// A row from a place in a list of numbers on; zeros where it is not there.
#[inline(always)]
fn row<T: Scalar, V: Simd<T>, R: Row<V>>(numbers: &[T], start: usize) -> R {
    let mut row = R::filled(V::from_f64(0.0));
    if let Some(numbers) = numbers.get(start..start + R::LENGTH) {
        let mut i = 0;
        while i < R::LENGTH {
            row.as_mut()[i] = V::splat(numbers[i]);
            i += 1;
        }
    }
    row
}
