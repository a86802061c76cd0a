//! The drive: external torque on the root and motion of its pivot, as functions of time.

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::taylor::Quad;
use branched_pendulum::tree::RootDrive;
use branched_pendulum_codegen::scene::{Drive, Quantity, Scene, Signal, SignalAtom, TimeFunction};

use crate::numbers::evaluate;
use crate::signal_series::{buffer_series, quads, series};

/// The functions of time of a drive, with constants of type `T`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Courses<T> {
    drive: Drive<T>,
    /// True if angles are measured from the upward vertical.
    stands: bool,
    /// Acceleration of gravity, along the axes of the equations.
    gravity: T,
}

/// Returns the value of a function of time in the scalar type `S`; `lift` converts constants to it.
fn value_at<T: Scalar, S: Scalar>(signal: &Signal<T>, time: S, lift: &impl Fn(T) -> S) -> S {
    evaluate(signal, &|atom| match atom {
        SignalAtom::Constant(value) => lift(*value),
        SignalAtom::Time => time,
        SignalAtom::Function(TimeFunction::Sin, angle) => value_at(angle, time, lift).sin_cos().0,
        SignalAtom::Function(TimeFunction::Cos, angle) => value_at(angle, time, lift).sin_cos().1,
    })
}

/// Returns the second derivative of a function of time, computed with nested dual numbers: exact up
/// to rounding.
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
    /// Returns the drive of a scene, with each quantity converted to a number by `constant`; `None`
    /// if it has no drive.
    pub(crate) fn of(scene: &Scene, constant: &impl Fn(&Quantity) -> T) -> Option<Self> {
        let drive = scene.drive.as_ref()?.map(constant);
        Some(Self {
            drive,
            stands: scene.stands(),
            gravity: constant(&scene.gravity),
        })
    }

    pub(crate) fn cast<S>(&self, convert: &dyn Fn(T) -> S) -> Courses<S> {
        Courses {
            drive: self.drive.map(&|value| convert(*value)),
            stands: self.stands,
            gravity: convert(self.gravity),
        }
    }

    /// Returns the length of the buffer, in quads (groups of four numbers), that
    /// [`series`](Self::series) needs.
    pub(crate) fn workspace_len(&self, order: usize) -> usize {
        let Drive { torque, x, y } = &self.drive;
        let signals = [torque, x, y].into_iter().flatten();
        let beside = signals.map(buffer_series).max().unwrap_or(0);
        order + 1 + (1 + beside) * quads(order + 3)
    }

    /// Returns, for each order up to `order`, the Taylor coefficients of the acceleration of the
    /// root's pivot (including gravity) and of the torque, along the axes of the equations.
    pub(crate) fn series<'a>(
        &self,
        time: T,
        order: usize,
        buffer: &'a mut [Quad<T>],
    ) -> &'a [Quad<T>] {
        let zero = T::from_f64(0.0);
        let count = order + 3;
        let (orders, buffer) = buffer.split_at_mut((order + 1).min(buffer.len()));
        let (result, beside) = buffer.split_at_mut(quads(count).min(buffer.len()));
        orders.fill(Quad::splat(zero));
        let Drive { torque, x, y } = &self.drive;
        for (lane, signal) in [x, y, torque].into_iter().enumerate() {
            let Some(signal) = signal else { continue };
            series(signal, time, count, result, beside);
            let upwards = lane == 1 && self.stands;
            for (k, own) in orders.iter_mut().enumerate() {
                let at = |order: usize| match result.get(order / 4) {
                    Some(quad) => quad.0[order % 4],
                    None => zero,
                };
                // Second derivative of the position.
                let factor = T::from_f64(((k + 1) * (k + 2)) as f64);
                let value = if lane == 2 { at(k) } else { factor * at(k + 2) };
                own.0[lane] = if upwards { -value } else { value };
            }
        }
        if let Some(first) = orders.first_mut() {
            first.0[1] = first.0[1] + self.gravity;
        }
        orders
    }

    /// Returns the drive at a time: acceleration \[x, y\] of the root's pivot (m/s²), with y
    /// upwards, and torque (N m) on the root.
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

    /// Returns the drive at a time along the axes of the equations, whose y axis is opposite to
    /// links at angle 0.
    pub(crate) fn inner(&self, time: T) -> [T; 3] {
        let [x, y, torque] = self.at(time);
        [x, if self.stands { -y } else { y }, torque]
    }

    /// Returns the drive at a time in the type that the equations expect, in SI units.
    pub(crate) fn root(&self, time: T) -> RootDrive<T> {
        let [x, y, torque] = self.inner(time);
        RootDrive {
            pivot: [-x, -y],
            torque,
        }
    }
}
