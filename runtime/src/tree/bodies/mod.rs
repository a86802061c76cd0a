//! Energies and powers of trees in loops.

mod equations;
mod slopes;
mod terms;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub use equations::{BodyEquations, PointEquations};
pub use slopes::LinkSlopes;

use super::equations::LinkMotion;
use super::shape::{Neighbours, Shape};
use super::sum::Sum;
use crate::scalar::{Scalar, at};
use crate::system::Workspace;
use terms::{LinkTerm, TreeState, sum_of};

/// Links of a large tree as rigid bodies, for energies and powers computed in loops over the links.
/// Emitted models contain them if energies are requested.
///
/// All functions take O(links) operations and a workspace from the caller, of up to five numbers
/// per link. Without fused multiply–add, values have the same bits on every machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies<E, T> {
    shape: Shape,
    /// Constants, one row per link or per generation, stored one after the other.
    rows: Vec<T>,
    equations: PhantomData<E>,
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Creates bodies from the rows of constants of all links or of all generations, in the order
    /// of [`BodyEquations::Body`].
    #[must_use]
    pub fn new(shape: Shape, rows: Vec<T>) -> Self {
        Self {
            shape,
            rows,
            equations: PhantomData,
        }
    }

    /// Returns these bodies with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Bodies<E, S> {
        let rows = self.rows.iter().map(|&value| convert(value));
        Bodies::new(self.shape.clone(), rows.collect())
    }

    /// Returns the kinetic energy, in J, in the frame of reference of the root's pivot. NaN if a
    /// slice does not have one number per link.
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

    /// Returns the potential energy, in J; zero if all angles are zero and all springs relaxed. NaN
    /// if the slice does not have one number per link.
    #[must_use]
    pub fn potential_energy(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let state = TreeState {
            theta,
            omega: theta,
            drive: [T::from_f64(0.0); 3],
        };
        sum_of::<PotentialEnergy, E, T>(self, workspace, state)
    }

    /// Returns the power of the drive, in W. `drive` is the acceleration x, y of the root's pivot
    /// (m/s²), which acts by inertial forces at the centres of mass, and a torque on the root (N
    /// m). NaN if a slice does not have one number per link.
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

    /// Returns the power of friction and drag, in W, which is never positive. NaN if the slice does
    /// not have one number per link.
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

    /// Returns the power Q·ω, in W, of external torques Q (N m). NaN if a slice does not have one
    /// number per link.
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

    /// Returns the sum of `power` over all links, in W; NaN if the number of velocities is wrong or
    /// constants are missing.
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

/// Returns the motion of a link with the angular velocity `omega` (rad/s) and an unspecified angle.
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
