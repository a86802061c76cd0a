//! Trees of some links, link by link: strips as short as theirs cost more to take through
//! registers than they save.

#![allow(unsafe_code)]

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::columns::Cells;
use super::equations::{LinkEquations, LinkMotion, Row};
use super::root::RootDrive;
use super::sweep::add;
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd};
use crate::system::Workspace;
use crate::system::pendulum::put;

/// A tree of any shape and of some links, its equations `E` taken through it one link after
/// the other. Faster than a [`Tree`](super::Tree) for one state of few links.
///
/// Evaluations fuse products with sums where the machine can, as those of a
/// [`Tree`](super::Tree) do; they add up in another order.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallTree<E, T> {
    /// Each stands behind its parent.
    links: Vec<SmallLink>,
    /// Rows of all links, one after the other.
    rows: Vec<T>,
    /// Acceleration of the root's pivot against gravity.
    root: [T; 2],
    /// How many numbers an evaluation needs room for.
    room: usize,
    equations: PhantomData<E>,
}

/// A link's place in a small tree.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SmallLink {
    /// Number of the parent; of the root 0.
    parent: usize,
    /// Others hang from it.
    carries: bool,
    /// No sibling stands behind it.
    is_last: bool,
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
    ///
    /// # Panics
    /// Of more links than memory has room for, as a vector of so many numbers does.
    #[must_use]
    pub fn new(parents: &[u32], mut rows: Vec<T>, root: [T; 2]) -> Self {
        let mut carries = alloc::vec![false; parents.len()];
        let mut links = Vec::with_capacity(parents.len());
        for (link, &parent) in parents.iter().enumerate().rev() {
            // One that stands elsewhere would be no parent.
            let parent = (parent as usize).min(link.saturating_sub(1));
            let has = |link: usize| carries.get(link).copied().unwrap_or_default();
            links.push(SmallLink {
                parent,
                carries: has(link),
                is_last: !has(parent),
            });
            put(&mut carries, parent, true);
        }
        links.reverse();
        let numbers = |of_link| links.len().saturating_mul(of_link);
        let room = numbers(Self::ROOM);
        rows.resize(numbers(Self::CONSTANTS), T::from_f64(0.0));
        Self {
            links,
            rows,
            root,
            room,
            equations: PhantomData,
        }
    }

    /// Returns the same tree on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SmallTree<E, S> {
        SmallTree {
            links: self.links.clone(),
            rows: self.rows.iter().map(|&x| convert(x)).collect(),
            root: self.root.map(&convert),
            room: self.room,
            equations: PhantomData,
        }
    }

    /// Writes the angular accelerations at one time of a drive: NaN for slices of another
    /// length than there are links, and under torques where the equations read none.
    // With its caller, so that what is given goes through memory once.
    #[inline(always)]
    pub fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        states: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        let links = self.links.len();
        let LinkStates {
            theta,
            omega,
            torques,
        } = states;
        let fits = |numbers: &[T]| numbers.len() == links;
        let torques_fit = torques.is_none_or(|torques| E::FORCED && fits(torques));
        if !(fits(theta) && fits(omega) && fits(alpha) && torques_fit) {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        in_fused_numbers(OneState {
            tree: self,
            drive: &drive,
            states,
            room: workspace.numbers(self.room),
            alpha,
        });
    }

    const CONSTANTS: usize = <E::Constants<T> as Row<T>>::LENGTH;

    /// Sums of responses, in whose place a link's numbers for its children stand later.
    const SHARED: usize = {
        let sums = <E::Sums<T> as Row<T>>::LENGTH;
        let carried = <E::Carried<T> as Row<T>>::LENGTH;
        if sums > carried { sums } else { carried }
    };

    /// Place of the sine and the cosine: behind these and the elimination.
    const SINE: usize = Self::SHARED + <E::Elimination<T> as Row<T>>::LENGTH;

    /// Numbers of a link.
    const ROOM: usize = Self::SINE + 2;

    /// All of them.
    const SIZES: [usize; 4] = [Self::CONSTANTS, Self::SHARED, Self::SINE, Self::ROOM];
}

/// One evaluation, whose slices fit the tree.
struct OneState<'a, E, T> {
    tree: &'a SmallTree<E, T>,
    drive: &'a Option<RootDrive<T>>,
    states: LinkStates<'a, T>,
    room: &'a mut [T],
    alpha: &'a mut [T],
}

impl<E: LinkEquations, T: Scalar> Kernel<T> for OneState<'_, E, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        const {
            assert!(V::LANES == 1);
            let (own, of_tree) = (SmallTree::<E, V>::SIZES, SmallTree::<E, T>::SIZES);
            let mut size = 0;
            while size < own.len() {
                assert!(own[size] == of_tree[size]);
                size += 1;
            }
        }
        let (tree, states) = (self.tree, self.states);
        let none = [T::from_f64(0.0)];
        // Nobody writes to what is given.
        let column = |numbers: &[T]| Cells::rows(numbers.as_ptr().cast_mut(), 1);
        let width = SmallTree::<E, T>::ROOM;
        let room = self.room.as_mut_ptr();
        let links = LinkByLink::<E, T> {
            links: &tree.links,
            drive: self.drive,
            constants: Cells::rows(tree.rows.as_ptr().cast_mut(), SmallTree::<E, T>::CONSTANTS),
            theta: column(states.theta),
            omega: column(states.omega),
            torque: match states.torques {
                Some(torques) => column(torques),
                None => Cells::rows(none.as_ptr().cast_mut(), 0),
            },
            shared: Cells::rows(room, width),
            elimination: Cells::rows(room.wrapping_add(SmallTree::<E, T>::SHARED), width),
            sincos: Cells::rows(room.wrapping_add(SmallTree::<E, T>::SINE), width),
            alpha: Cells::rows(self.alpha.as_mut_ptr(), 1),
            equations: PhantomData,
        };
        let above = RootDrive::above(tree.root, *self.drive).map(V::splat);
        // SAFETY: the tree has a row for each link, the slices fit it, and in the room there
        // are `width` numbers for each.
        unsafe {
            links.sines::<V>(states.theta);
            links.up::<V>();
            links.down::<V>(above);
        }
    }
}

/// The ways through a tree, with places that were checked: asking for each would be as much
/// as the mechanics.
struct LinkByLink<'a, E, T> {
    links: &'a [SmallLink],
    drive: &'a Option<RootDrive<T>>,
    constants: Cells<T>,
    theta: Cells<T>,
    omega: Cells<T>,
    torque: Cells<T>,
    shared: Cells<T>,
    elimination: Cells<T>,
    sincos: Cells<T>,
    alpha: Cells<T>,
    equations: PhantomData<E>,
}

// Of all functions: each column of cells has the numbers of all links, as its name says, and
// nothing else refers to them now. The number of a parent is that of a link.
impl<E: LinkEquations, T: Scalar> LinkByLink<'_, E, T> {
    /// Forms the sines and cosines. The last angles may be those before once more.
    ///
    /// # Safety
    /// The cells are those of the tree, whose angles these are.
    #[inline(always)]
    unsafe fn sines<V: Simd<T>>(&self, theta: &[T]) {
        let last = theta.len().saturating_sub(1);
        let mut start = 0;
        while start < theta.len() {
            let first = start.min(theta.len().saturating_sub(STEP));
            let mut angles = [V::from_f64(0.0); STEP];
            match theta.get(first..first + STEP) {
                Some(theta) => {
                    for (angle, &theta) in angles.iter_mut().zip(theta) {
                        *angle = V::splat(theta);
                    }
                }
                None => {
                    for (i, angle) in angles.iter_mut().enumerate() {
                        *angle = V::splat(at(theta, i.min(last)));
                    }
                }
            }
            let (sines, cosines) = V::sin_cos_each(&angles);
            for i in 0..STEP {
                let link = (first + i).min(last);
                // SAFETY: there is a link, or the loop would not be entered, and `link` is at
                // most the last one.
                unsafe { self.sincos.write(link, &[sines[i], cosines[i]]) };
            }
            start += STEP;
        }
    }

    /// From the last link to the root: responses, added to the sums of the parents.
    ///
    /// # Safety
    /// The cells are those of the tree; sines and cosines have been formed.
    #[inline(always)]
    unsafe fn up<V: Simd<T>>(&self) {
        for (link, &place) in self.links.iter().enumerate().rev() {
            let parent = place.parent;
            // SAFETY: `link` counts the links, and the parent of each is one: each has places
            // for sums, and for an elimination that no other shares.
            unsafe {
                let constants = self.constants::<V>(link);
                let motion = self.motion(link, parent);
                let response = if place.carries {
                    let sums: E::Sums<V> = self.shared.read(link);
                    let (response, elimination) = E::inner(&constants, motion, sums);
                    self.elimination.write(link, &elimination);
                    response
                } else {
                    E::leaf(&constants, motion)
                };
                if link == 0 {
                    continue;
                }
                let mut sums = E::attach(&constants, self.direction(parent), response);
                if !place.is_last {
                    add(&mut sums, &self.shared.read(parent));
                }
                self.shared.write(parent, &sums);
            }
        }
    }

    /// From the root to the last link: accelerations, and what parents hand to children.
    ///
    /// # Safety
    /// The cells are those of the tree, and responses have been formed.
    #[inline(always)]
    unsafe fn down<V: Simd<T>>(&self, above: [V; 2]) {
        for (link, &place) in self.links.iter().enumerate() {
            let parent = place.parent;
            // SAFETY: as on the way up. What a parent hands down stands in the places of its
            // sums, which are as many as the longer of the two takes; there is an acceleration
            // for each link.
            unsafe {
                let constants = self.constants::<V>(link);
                let motion = self.motion(link, parent);
                let pivot = match link {
                    0 => above,
                    _ => E::pivot(&constants, self.direction(parent), self.shared.read(parent)),
                };
                let acceleration = if place.carries {
                    let elimination = self.elimination.read(link);
                    let (acceleration, carried) =
                        E::accelerate(&constants, motion, elimination, pivot);
                    self.shared.write(link, &carried);
                    acceleration
                } else {
                    E::accelerate_leaf(&constants, motion, pivot)
                };
                self.alpha.write(link, &[acceleration]);
            }
        }
    }

    /// # Safety
    /// It is a link of the tree.
    #[inline(always)]
    unsafe fn constants<V: Simd<T>>(&self, link: usize) -> E::Constants<V> {
        // SAFETY: the tree has so many constants for each link.
        let mut row: E::Constants<V> = unsafe { self.constants.read(link) };
        if E::TORQUE
            && link == 0
            && let (Some(drive), Some(last)) = (self.drive, row.as_mut().last_mut())
        {
            *last = V::splat(drive.torque);
        }
        row
    }

    /// The motion of a link, where what acts in its joint and from outside is left open.
    ///
    /// # Safety
    /// It is a link of the tree.
    #[inline(always)]
    unsafe fn direction<V: Simd<T>>(&self, link: usize) -> LinkMotion<V> {
        // SAFETY: each link has a sine and a cosine in its room, and an angular velocity.
        let ([sine, cosine], [omega]): ([V; 2], [V; 1]) =
            unsafe { (self.sincos.read(link), self.omega.read(link)) };
        LinkMotion {
            held: V::from_f64(0.0),
            ..LinkMotion::turning(sine, cosine, omega)
        }
    }

    /// # Safety
    /// Both are links of the tree.
    #[inline(always)]
    unsafe fn motion<V: Simd<T>>(&self, link: usize, parent: usize) -> LinkMotion<V> {
        // SAFETY: both are links, of which angles and velocities are given. Torques are given for
        // all links, or are one zero, which is read for each.
        unsafe {
            let mut motion: LinkMotion<V> = self.direction(link);
            [motion.outside_torque] = self.torque.read(link);
            if E::JOINTS {
                [motion.joint_angle] = self.theta.read(link);
                if link > 0 {
                    let ([angle], [rate]): ([V; 1], [V; 1]) =
                        (self.theta.read(parent), self.omega.read(parent));
                    motion.joint_angle = motion.joint_angle - angle;
                    motion.joint_rate = motion.joint_rate - rate;
                }
            }
            motion
        }
    }
}
