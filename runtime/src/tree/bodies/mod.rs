//! Links of a tree in loops as bodies: energies and powers.

mod equations;
mod terms;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub use equations::{BodyEquations, PointEquations};

use super::equations::LinkMotion;
use super::shape::{Neighbours, Shape};
use super::sum::Sum;
use crate::scalar::{Scalar, at};
use crate::system::Workspace;
use terms::{LinkTerm, TreeState, sum_of};

/// The links of a tree in loops as bodies. Emitted models hold them where energies are asked for.
///
/// All functions take O(links), with memory that the caller keeps: up to five numbers
/// for each link. In numbers that do not fuse, values have the same
/// bits on every machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies<E, T> {
    shape: Shape,
    /// Rows of all links or generations, one after the other.
    rows: Vec<T>,
    equations: PhantomData<E>,
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Bodies with the constants of each link or of each generation, one after the
    /// other, as [`BodyEquations::Body`] has them.
    #[must_use]
    pub fn new(shape: Shape, rows: Vec<T>) -> Self {
        Self {
            shape,
            rows,
            equations: PhantomData,
        }
    }

    /// Returns these bodies on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Bodies<E, S> {
        let rows = self.rows.iter().map(|&value| convert(value));
        Bodies::new(self.shape.clone(), rows.collect())
    }

    /// Kinetic energy, J, in the frame of reference that moves with the root's pivot. NaN
    /// for slices of another length than there are links.
    #[must_use]
    pub fn kinetic_energy(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let drive = [T::from_f64(0.0); 3];
        let state = TreeState {
            theta,
            omega,
            drive,
        };
        sum_of::<KineticEnergy, E, T>(self, workspace, state)
    }

    /// Potential energy, J, zero where all angles are zero and springs at rest. NaN for a
    /// slice of another length than there are links.
    #[must_use]
    pub fn potential_energy(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let state = TreeState {
            theta,
            omega: theta,
            drive: [T::from_f64(0.0); 3],
        };
        sum_of::<PotentialEnergy, E, T>(self, workspace, state)
    }

    /// Power, W, of an acceleration of the root's pivot and a torque on the root: the first
    /// by inertial forces in the centres of mass. NaN for slices of another length than there
    /// are links.
    #[must_use]
    pub fn drive_power(
        &self,
        workspace: &mut Workspace<T>,
        drive: [T; 3],
        theta: &[T],
        omega: &[T],
    ) -> T {
        let state = TreeState {
            theta,
            omega,
            drive,
        };
        sum_of::<DrivePower, E, T>(self, workspace, state)
    }

    /// Power, W, of friction and drag, never positive. NaN for a slice of another length than
    /// there are links.
    #[must_use]
    pub fn friction_power(&self, omega: &[T]) -> T {
        -self.powers(omega, |body, strip, index| {
            let rate = at(omega, strip.link + index);
            let relative = match strip.parent {
                Some(parent) => rate - at(omega, parent + index),
                None => rate,
            };
            let joint_rate = relative;
            E::friction_loss(
                body,
                LinkMotion {
                    joint_rate,
                    ..turning_at(rate)
                },
            )
        })
    }

    /// Power Q·ω, W, of torques Q from outside. NaN for slices of another length than
    /// there are links.
    #[must_use]
    pub fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
        if torques.len() != omega.len() {
            return T::from_f64(f64::NAN);
        }
        self.powers(omega, |body, strip, index| {
            let link = strip.link + index;
            let outside_torque = at(torques, link);
            E::outside_power(
                body,
                LinkMotion {
                    outside_torque,
                    ..turning_at(at(omega, link))
                },
            )
        })
    }

    /// The sum of a power of each link; NaN for velocities of another number and where rows
    /// are lacking.
    #[inline(always)]
    fn powers(&self, omega: &[T], power: impl Fn(&E::Body<T>, Neighbours, usize) -> [T; 1]) -> T {
        let nan = T::from_f64(f64::NAN);
        if omega.len() != self.shape.links() {
            return nan;
        }
        let mut sum = Sum::new();
        for strip in self.shape.strips() {
            let Some(body) = self.row::<T>(strip.row) else {
                return nan;
            };
            for index in 0..strip.count {
                let [own] = power(&body, strip, index);
                sum.add(own);
            }
        }
        sum.total()
    }
}

/// A link that turns at this rate, in no direction that is known.
#[inline(always)]
fn turning_at<T: Scalar>(omega: T) -> LinkMotion<T> {
    let unknown = T::from_f64(f64::NAN);
    LinkMotion::turning(unknown, unknown, omega)
}

struct KineticEnergy;

impl LinkTerm for KineticEnergy {
    const PIVOTS: bool = true;

    #[inline(always)]
    fn term<E: BodyEquations, V: Scalar>(
        body: &E::Body<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
        _: [V; 3],
    ) -> [V; 1] {
        E::kinetic_energy(body, link, pivot)
    }
}

struct PotentialEnergy;

impl LinkTerm for PotentialEnergy {
    const AT_REST: bool = true;

    #[inline(always)]
    fn term<E: BodyEquations, V: Scalar>(
        body: &E::Body<V>,
        link: LinkMotion<V>,
        _: [V; 2],
        _: [V; 3],
    ) -> [V; 1] {
        E::potential_energy(body, link)
    }
}

struct DrivePower;

impl LinkTerm for DrivePower {
    #[inline(always)]
    fn term<E: BodyEquations, V: Scalar>(
        body: &E::Body<V>,
        link: LinkMotion<V>,
        _: [V; 2],
        drive: [V; 3],
    ) -> [V; 1] {
        E::drive_power(body, link, drive)
    }
}
