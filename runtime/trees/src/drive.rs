//! The drive: torque and motion from outside as functions of time.

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::tree::RootDrive;
use branched_pendulum_codegen::scene::{Drive, Quantity, Scene, Signal, SignalAtom, TimeFunction};

use crate::numbers::evaluate;

/// The drive in numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Courses<T> {
    drive: Drive<T>,
    /// True if angles are those from the upward vertical.
    stands: bool,
}

/// Returns the value of a function of time in any numbers that constants can be taken to.
fn value_at<T: Scalar, S: Scalar>(signal: &Signal<T>, time: S, lift: &impl Fn(T) -> S) -> S {
    evaluate(signal, &|atom| match atom {
        SignalAtom::Constant(value) => lift(*value),
        SignalAtom::Time => time,
        SignalAtom::Function(TimeFunction::Sin, angle) => value_at(angle, time, lift).sin_cos().0,
        SignalAtom::Function(TimeFunction::Cos, angle) => value_at(angle, time, lift).sin_cos().1,
    })
}

/// Returns the second derivative, by dual numbers of dual numbers: exact to rounding.
fn acceleration<T: Scalar>(signal: &Signal<T>, time: T) -> T {
    let inner = Dual::<T, 1>::variable(time, 0);
    let outer = Dual::<Dual<T, 1>, 1>::variable(inner, 0);
    let result = value_at(signal, outer, &|constant| {
        Dual::constant(Dual::<T, 1>::constant(constant))
    });
    let [first] = result.tangents;
    let [second] = first.tangents;
    second
}

impl<T: Scalar> Courses<T> {
    /// Returns the drive of a scene, whose quantities `constant` takes to numbers.
    pub(crate) fn of(scene: &Scene, constant: &impl Fn(&Quantity) -> T) -> Option<Self> {
        let drive = scene.drive.as_ref()?.map(constant);
        let stands = scene.stands();
        Some(Self { drive, stands })
    }

    pub(crate) fn cast<S>(&self, convert: &impl Fn(T) -> S) -> Courses<S> {
        Courses {
            drive: self.drive.map(&|value| convert(*value)),
            stands: self.stands,
        }
    }

    /// Returns the drive at a time: acceleration x, y of the root's pivot, torque.
    pub(crate) fn at(&self, time: T) -> [T; 3] {
        let zero = T::from_f64(0.0);
        let Drive { torque, x, y } = &self.drive;
        let [x, y] = [x, y].map(|position| match position {
            Some(position) => acceleration(position, time),
            None => zero,
        });
        let torque = match torque {
            Some(torque) => value_at(torque, time, &|constant| constant),
            None => zero,
        };
        [x, y, torque]
    }

    /// Returns that drive in the directions of the equations: y against that of links of
    /// angle 0.
    pub(crate) fn inner(&self, time: T) -> [T; 3] {
        let [x, y, torque] = self.at(time);
        [x, if self.stands { -y } else { y }, torque]
    }

    /// Returns that drive as the equations take it, which are in SI units.
    pub(crate) fn root(&self, time: T) -> RootDrive<T> {
        let [x, y, torque] = self.inner(time);
        RootDrive {
            pivot: [-x, -y],
            torque,
        }
    }
}
