//! The drive: torque and motion from outside as functions of time.

use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::tree::RootDrive;
use branched_pendulum_codegen::scene::{Drive, Signal, TimeFunction};

use crate::numbers::{power, value};

/// A function of time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Course<T> {
    Constant(T),
    Time,
    Sum(Vec<Course<T>>),
    Product(Vec<Course<T>>),
    Power(Box<Course<T>>, u32),
    Sine(Box<Course<T>>),
    Cosine(Box<Course<T>>),
}

/// Torque on the root, and position x, y of its pivot.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Courses<T> {
    torque: Option<Course<T>>,
    pivot: [Option<Course<T>>; 2],
}

impl<T: Scalar> Course<T> {
    fn of(signal: &Signal, parameters: &[Double]) -> Self {
        let all = |parts: &[Signal]| {
            parts
                .iter()
                .map(|part| Self::of(part, parameters))
                .collect()
        };
        let one = |part: &Signal| Box::new(Self::of(part, parameters));
        match signal {
            Signal::Constant(quantity) => {
                let number = value(quantity, parameters);
                Self::Constant(T::from_parts(number.high(), number.low()))
            }
            Signal::Time => Self::Time,
            Signal::Sum(parts) => Self::Sum(all(parts)),
            Signal::Product(parts) => Self::Product(all(parts)),
            Signal::Power(base, exponent) => Self::Power(one(base), *exponent),
            Signal::Function(TimeFunction::Sin, angle) => Self::Sine(one(angle)),
            Signal::Function(TimeFunction::Cos, angle) => Self::Cosine(one(angle)),
        }
    }

    fn cast<S>(&self, convert: &impl Fn(T) -> S) -> Course<S> {
        let all = |parts: &[Self]| parts.iter().map(|part| part.cast(convert)).collect();
        let one = |part: &Self| Box::new(part.cast(convert));
        match self {
            Self::Constant(value) => Course::Constant(convert(*value)),
            Self::Time => Course::Time,
            Self::Sum(parts) => Course::Sum(all(parts)),
            Self::Product(parts) => Course::Product(all(parts)),
            Self::Power(base, exponent) => Course::Power(one(base), *exponent),
            Self::Sine(angle) => Course::Sine(one(angle)),
            Self::Cosine(angle) => Course::Cosine(one(angle)),
        }
    }

    /// Returns the value at a time in any numbers that constants can be taken to.
    fn at<S: Scalar>(&self, time: S, lift: &impl Fn(T) -> S) -> S {
        match self {
            Self::Constant(value) => lift(*value),
            Self::Time => time,
            Self::Sum(parts) => {
                let zero = S::from_f64(0.0);
                let parts = parts.iter();
                parts.fold(zero, |sum, part| sum + part.at(time, lift))
            }
            Self::Product(parts) => {
                let one = S::from_f64(1.0);
                let parts = parts.iter();
                parts.fold(one, |product, part| product * part.at(time, lift))
            }
            Self::Power(base, exponent) => power(base.at(time, lift), *exponent),
            Self::Sine(angle) => angle.at(time, lift).sin_cos().0,
            Self::Cosine(angle) => angle.at(time, lift).sin_cos().1,
        }
    }

    /// Returns the second derivative, by dual numbers of dual numbers: exact to rounding.
    fn acceleration(&self, time: T) -> T {
        let inner = Dual::<T, 1>::variable(time, 0);
        let outer = Dual::<Dual<T, 1>, 1>::variable(inner, 0);
        let result = self.at(outer, &|constant| {
            Dual::constant(Dual::<T, 1>::constant(constant))
        });
        let [first] = result.tangents;
        let [second] = first.tangents;
        second
    }
}

impl<T: Scalar> Courses<T> {
    pub(crate) fn of(drive: &Drive, parameters: &[Double]) -> Self {
        let course = |signal: &Option<Signal>| {
            let signal = signal.as_ref()?;
            Some(Course::of(signal, parameters))
        };
        Self {
            torque: course(&drive.torque),
            pivot: [&drive.x, &drive.y].map(course),
        }
    }

    pub(crate) fn cast<S>(&self, convert: &impl Fn(T) -> S) -> Courses<S> {
        let cast = |course: &Option<Course<T>>| course.as_ref().map(|course| course.cast(convert));
        Courses {
            torque: cast(&self.torque),
            pivot: self.pivot.each_ref().map(cast),
        }
    }

    /// Returns the drive at a time: acceleration x, y of the root's pivot, torque.
    pub(crate) fn at(&self, time: T) -> [T; 3] {
        let zero = T::from_f64(0.0);
        let [x, y] = self.pivot.each_ref().map(|course| match course {
            Some(course) => course.acceleration(time),
            None => zero,
        });
        let torque = match &self.torque {
            Some(course) => course.at(time, &|constant| constant),
            None => zero,
        };
        [x, y, torque]
    }

    /// Returns that drive as the equations take it, which are in SI units.
    pub(crate) fn root(&self, time: T) -> RootDrive<T> {
        let [x, y, torque] = self.at(time);
        RootDrive {
            pivot: [-x, -y],
            torque,
        }
    }
}
