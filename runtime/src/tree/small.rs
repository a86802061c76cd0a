//! Trees of few links, computed link by link, because their strips are so short that vector
//! registers would cost more time than they save.

#![allow(unsafe_code)]

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::ApartArguments;
use super::columns::Cells;
use super::equations::{LinkEquations, LinkMotion, Row};
use super::root::RootDrive;
use super::sweep::add;
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Part, Simd, outlined};
use crate::system::Workspace;
use crate::system::pendulum::put;

/// A tree of any shape with few links, whose equations `E` are evaluated one link after the other.
/// For a single state this is faster than a [`Tree`](super::Tree).
///
/// Like a [`Tree`](super::Tree), it uses fused multiply–add if the machine has it, but it adds in
/// another order.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallTree<E, T> {
    /// Links, each after its parent.
    links: Vec<SmallLink>,
    /// Constants of all links, one row after the other.
    rows: Vec<T>,
    /// Acceleration of the root's pivot relative to free fall.
    root: [T; 2],
    /// Workspace length of an evaluation, in numbers.
    buffer: usize,
    equations: PhantomData<E>,
}

/// Topology of a link in a small tree.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SmallLink {
    /// Index of the link's parent; 0 for the root.
    parent: usize,
    /// True if the link has children.
    carries: bool,
    /// True if this link is the last of its siblings.
    is_last: bool,
}

/// State of a tree for an evaluation: angles, angular velocities and, if there are any, external
/// torques.
#[derive(Clone, Copy, Debug)]
pub struct LinkStates<'a, T> {
    /// Angles, in rad.
    pub theta: &'a [T],
    /// Angular velocities, in rad/s.
    pub omega: &'a [T],
    /// Outside torques, in N m.
    pub torques: Option<&'a [T]>,
}

/// Number of angles whose sines are computed at once.
const STEP: usize = 4;

impl<E: LinkEquations, T: Scalar> SmallTree<E, T> {
    /// Creates a tree from the parent of each link (before the link; 0 for the root), a row of
    /// constants for each link, and the acceleration of the root's pivot relative to free fall, in
    /// the units of the equations.
    ///
    /// # Panics
    /// If the tree has more links than fit into memory.
    #[must_use]
    pub fn new(parents: &[u32], mut rows: Vec<T>, root: [T; 2]) -> Self {
        let mut carries = alloc::vec![false; parents.len()];
        let mut links = Vec::with_capacity(parents.len());
        for (link, &parent) in parents.iter().enumerate().rev() {
            // A parent must come before its child.
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
        let buffer = numbers(Self::WORKSPACE_LEN);
        rows.resize(numbers(Self::CONSTANTS), T::from_f64(0.0));
        Self {
            links,
            rows,
            root,
            buffer,
            equations: PhantomData,
        }
    }

    /// Returns the same tree with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SmallTree<E, S> {
        SmallTree {
            links: self.links.clone(),
            rows: self.rows.iter().map(|&x| convert(x)).collect(),
            root: self.root.map(&convert),
            buffer: self.buffer,
            equations: PhantomData,
        }
    }

    /// Writes the angular accelerations at one time of a drive. NaN if a slice does not have one
    /// number per link, or if torques are given but the equations use none.
    // Inlined into its caller, so that the input goes through memory once.
    #[inline(always)]
    pub fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        states: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        let drive = &drive;
        if let Some(state) = self.state(workspace, drive, states, alpha) {
            in_fused_numbers(state);
        }
    }

    /// Writes the same accelerations in the arithmetic of `T`. This is a separate function that all
    /// callers share; it is compiled for the vector instructions of the numbers.
    pub fn evaluate_apart(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        states: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        outlined::<0, T, _, _>(self, (workspace, drive, states, alpha));
    }

    /// Returns the evaluation of a state. If a slice does not have one number per link, or if torques
    /// are given but the equations use none, fills `alpha` with NaN and returns `None`.
    #[inline(always)]
    fn state<'a>(
        &'a self,
        workspace: &'a mut Workspace<T>,
        drive: &'a Option<RootDrive<T>>,
        states: LinkStates<'a, T>,
        alpha: &'a mut [T],
    ) -> Option<SmallTreeState<'a, E, T>> {
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
            return None;
        }
        Some(SmallTreeState {
            tree: self,
            drive,
            states,
            buffer: workspace.numbers(self.buffer),
            alpha,
        })
    }

    const CONSTANTS: usize = <E::Constants<T> as Row<T>>::LENGTH;

    /// Offset, within a link's numbers, of the sums of its children's responses; later the numbers
    /// that it passes to its children are stored there.
    const SHARED: usize = {
        let sums = <E::Sums<T> as Row<T>>::LENGTH;
        let carried = <E::Carried<T> as Row<T>>::LENGTH;
        if sums > carried { sums } else { carried }
    };

    /// Offset, within a link's numbers, of the sine and cosine, which follow the sums and the
    /// elimination.
    const SINE: usize = Self::SHARED + <E::Elimination<T> as Row<T>>::LENGTH;

    /// Number of values per link in the workspace.
    const WORKSPACE_LEN: usize = Self::SINE + 2;

    /// Number of constants per link, and the offsets and size of a link's numbers in the workspace.
    const SIZES: [usize; 4] = [
        Self::CONSTANTS,
        Self::SHARED,
        Self::SINE,
        Self::WORKSPACE_LEN,
    ];
}

impl<E: LinkEquations, T: Scalar> Part<0, ApartArguments<'_, T>> for SmallTree<E, T> {
    type Output = ();

    #[inline(always)]
    fn part(&self, (workspace, drive, states, alpha): ApartArguments<'_, T>) {
        if let Some(state) = self.state(workspace, &drive, states, alpha) {
            state.run::<T>();
        }
    }
}

/// Evaluation of one state, with slices whose lengths have been checked.
struct SmallTreeState<'a, E, T> {
    tree: &'a SmallTree<E, T>,
    drive: &'a Option<RootDrive<T>>,
    states: LinkStates<'a, T>,
    buffer: &'a mut [T],
    alpha: &'a mut [T],
}

impl<E: LinkEquations, T: Scalar> Kernel<T> for SmallTreeState<'_, E, T> {
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
        // The input is only read.
        let column = |numbers: &[T]| Cells::rows(numbers.as_ptr().cast_mut(), 1);
        let width = SmallTree::<E, T>::WORKSPACE_LEN;
        let buffer = self.buffer.as_mut_ptr();
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
            shared: Cells::rows(buffer, width),
            elimination: Cells::rows(buffer.wrapping_add(SmallTree::<E, T>::SHARED), width),
            sincos: Cells::rows(buffer.wrapping_add(SmallTree::<E, T>::SINE), width),
            alpha: Cells::rows(self.alpha.as_mut_ptr(), 1),
            equations: PhantomData,
        };
        let above = RootDrive::apparent_gravity(tree.root, *self.drive).map(V::splat);
        // SAFETY: the tree has a row for each link, the slices fit it, and the workspace has
        // `width` numbers for each link.
        unsafe {
            links.sines::<V>(states.theta);
            links.up::<V>();
            links.down::<V>(above);
        }
    }
}

/// Passes through the tree, with indices that were checked beforehand: checking each access would
/// cost as much as the mechanics.
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

// Holds for all functions: each column of cells has the numbers of all links, as its name says, and
// no other reference to them exists now. The index of a parent is that of a link.
impl<E: LinkEquations, T: Scalar> LinkByLink<'_, E, T> {
    /// Computes the sines and cosines of all angles. The last register may repeat angles of the one
    /// before.
    ///
    /// # Safety The workspace must be that of the tree to which the angles belong.
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
                // SAFETY: the loop is only entered if there is a link, and `link` is at most the
                // last one.
                unsafe { self.sincos.write(link, &[sines[i], cosines[i]]) };
            }
            start += STEP;
        }
    }

    /// Upward pass, from the last link to the root: computes responses and adds them to the sums of
    /// the parents.
    ///
    /// # Safety
    /// The cells must belong to the tree, with sines and cosines computed.
    #[inline(always)]
    unsafe fn up<V: Simd<T>>(&self) {
        for (link, &place) in self.links.iter().enumerate().rev() {
            let parent = place.parent;
            // SAFETY: `link` runs over the links, and each parent is a link. Each link has memory
            // for sums and an elimination that it shares with no other.
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

    /// Downward pass, from the root to the last link: computes accelerations and the numbers that
    /// parents pass to children.
    ///
    /// # Safety
    /// The cells must belong to the tree, with responses computed.
    #[inline(always)]
    unsafe fn down<V: Simd<T>>(&self, above: [V; 2]) {
        for (link, &place) in self.links.iter().enumerate() {
            let parent = place.parent;
            // SAFETY: as in the upward pass. The numbers that a parent passes down take the place
            // of its sums, which is large enough for both; each link has an acceleration.
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

    /// Returns the constants of link number `link`.
    ///
    /// # Safety
    /// `link` must be a link of the tree.
    #[inline(always)]
    unsafe fn constants<V: Simd<T>>(&self, link: usize) -> E::Constants<V> {
        // SAFETY: the tree has this many constants for each link.
        let mut row: E::Constants<V> = unsafe { self.constants.read(link) };
        if E::TORQUE
            && link == 0
            && let (Some(drive), Some(last)) = (self.drive, row.as_mut().last_mut())
        {
            *last = V::splat(drive.torque);
        }
        row
    }

    /// Returns the motion of a link; joint motion and external torque are unspecified.
    ///
    /// # Safety
    /// `link` must be a link of the tree.
    #[inline(always)]
    unsafe fn direction<V: Simd<T>>(&self, link: usize) -> LinkMotion<V> {
        // SAFETY: each link has a sine and a cosine in its workspace, and an angular velocity.
        let ([sine, cosine], [omega]): ([V; 2], [V; 1]) =
            unsafe { (self.sincos.read(link), self.omega.read(link)) };
        LinkMotion {
            prescribed: V::from_f64(0.0),
            ..LinkMotion::turning(sine, cosine, omega)
        }
    }

    /// Returns the motion of a link, including its joint motion and external torque.
    ///
    /// # Safety
    /// Both must be links of the tree.
    #[inline(always)]
    unsafe fn motion<V: Simd<T>>(&self, link: usize, parent: usize) -> LinkMotion<V> {
        // SAFETY: both are links, whose angles and velocities exist. Torques exist for all links,
        // or are a single zero that is read for each.
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
