//! Functions of time as power series.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::taylor::Quad;
use branched_pendulum_codegen::scene::{RationalExpression, Signal, SignalAtom, TimeFunction};

/// The first coefficients of a series, four in each SIMD quad.
struct Coefficients<'a, T> {
    quads: &'a mut [Quad<T>],
    count: usize,
}

impl<T: Scalar> Coefficients<'_, T> {
    fn at(&self, order: usize) -> T {
        match self.quads.get(order / 4) {
            Some(quad) => quad.0[order % 4],
            None => T::from_f64(f64::NAN),
        }
    }

    fn put(&mut self, order: usize, value: T) {
        if let Some(quad) = self.quads.get_mut(order / 4) {
            quad.0[order % 4] = value;
        }
    }

    fn set_constant(&mut self, value: T) {
        self.quads.fill(Quad::splat(T::from_f64(0.0)));
        self.put(0, value);
    }

    fn add(&mut self, other: &Coefficients<'_, T>) {
        for k in 0..self.count {
            self.put(k, self.at(k) + other.at(k));
        }
    }

    fn negate(&mut self) {
        for k in 0..self.count {
            self.put(k, -self.at(k));
        }
    }

    /// Computes the product Σ a\[j\] b\[k−j\] of two series in place, beginning with the highest
    /// order, since no order depends on higher ones.
    fn multiply(&mut self, other: &Coefficients<'_, T>) {
        for k in (0..self.count).rev() {
            let zero = T::from_f64(0.0);
            let sum = (0..=k).fold(zero, |sum, j| sum + self.at(j) * other.at(k - j));
            self.put(k, sum);
        }
    }

    fn square(&mut self) {
        for k in (0..self.count).rev() {
            let zero = T::from_f64(0.0);
            let sum = (0..=k).fold(zero, |sum, j| sum + self.at(j) * self.at(k - j));
            self.put(k, sum);
        }
    }

    /// Solves a = q b for the series q in place, order by order.
    fn divide(&mut self, other: &Coefficients<'_, T>) {
        for k in 0..self.count {
            let own = self.at(k);
            let rest = (0..k).fold(own, |rest, j| rest - self.at(j) * other.at(k - j));
            self.put(k, rest / other.at(0));
        }
    }

    /// Writes the series of the sine s and the cosine c of an angle a: k s\[k\] = Σ j a\[j\]
    /// c\[k−j\], and k c\[k\] = −Σ j a\[j\] s\[k−j\].
    fn turn(
        angle: &Coefficients<'_, T>,
        sine: &mut Coefficients<'_, T>,
        cosine: &mut Coefficients<'_, T>,
    ) {
        let (sin, cos) = angle.at(0).sin_cos();
        sine.put(0, sin);
        cosine.put(0, cos);
        for k in 1..angle.count {
            let zero = T::from_f64(0.0);
            let (mut of_sine, mut of_cosine) = (zero, zero);
            for j in 1..=k {
                let rate = T::from_f64(j as f64) * angle.at(j);
                of_sine = of_sine + rate * cosine.at(k - j);
                of_cosine = of_cosine - rate * sine.at(k - j);
            }
            let order = T::from_f64(k as f64);
            sine.put(k, of_sine / order);
            cosine.put(k, of_cosine / order);
        }
    }
}

/// Returns the number of quads for `count` coefficients.
pub(crate) fn quads(count: usize) -> usize {
    count.div_ceil(4)
}

/// Returns the number of additional series that the computation of a signal needs as a buffer.
pub(crate) fn buffer_series<V>(signal: &Signal<V>) -> usize {
    let of_all = |parts: &[Signal<V>]| parts.iter().map(buffer_series).max().unwrap_or(0);
    match signal {
        RationalExpression::Atom(SignalAtom::Function(_, angle)) => 2.max(1 + buffer_series(angle)),
        RationalExpression::Atom(_) => 0,
        RationalExpression::Sum(parts) | RationalExpression::Product(parts) => 1 + of_all(parts),
        RationalExpression::Quotient(above, below) => {
            buffer_series(above).max(1 + buffer_series(below))
        }
        RationalExpression::Power(base, _) => 1 + buffer_series(base),
        RationalExpression::Negative(value) => buffer_series(value),
    }
}

/// Writes the first `count` Taylor coefficients of a signal about a time. `beside` is a buffer for
/// [`buffer_series`] series.
pub(crate) fn series<T: Scalar>(
    signal: &Signal<T>,
    time: T,
    count: usize,
    result: &mut [Quad<T>],
    beside: &mut [Quad<T>],
) {
    let mut result = Coefficients {
        quads: result,
        count,
    };
    write(signal, time, &mut result, beside);
}

fn write<T: Scalar>(
    signal: &Signal<T>,
    time: T,
    result: &mut Coefficients<'_, T>,
    beside: &mut [Quad<T>],
) {
    let count = result.count;
    let one = T::from_f64(1.0);
    let parts = match signal {
        RationalExpression::Atom(SignalAtom::Constant(value)) => {
            return result.set_constant(*value);
        }
        RationalExpression::Atom(SignalAtom::Time) => {
            result.set_constant(time);
            return result.put(1, one);
        }
        RationalExpression::Negative(value) => {
            write(value, time, result, beside);
            return result.negate();
        }
        RationalExpression::Quotient(above, _) => {
            write(above, time, result, beside);
            &[]
        }
        RationalExpression::Sum(parts) | RationalExpression::Product(parts) => parts.as_slice(),
        RationalExpression::Atom(SignalAtom::Function(..)) | RationalExpression::Power(..) => &[],
    };
    let Some((own, beside)) = beside.split_at_mut_checked(quads(count)) else {
        return result.set_constant(T::from_f64(f64::NAN));
    };
    let mut part = Coefficients { quads: own, count };
    match signal {
        RationalExpression::Sum(_) => {
            result.set_constant(T::from_f64(0.0));
            for own in parts {
                write(own, time, &mut part, beside);
                result.add(&part);
            }
        }
        RationalExpression::Product(_) => {
            result.set_constant(one);
            for own in parts {
                write(own, time, &mut part, beside);
                result.multiply(&part);
            }
        }
        RationalExpression::Quotient(_, below) => {
            write(below, time, &mut part, beside);
            result.divide(&part);
        }
        RationalExpression::Power(base, exponent) => {
            write(base, time, &mut part, beside);
            result.set_constant(one);
            let mut rest = exponent.unsigned_abs();
            while rest > 0 {
                match (rest % 2 == 1, *exponent < 0) {
                    (true, false) => result.multiply(&part),
                    (true, true) => result.divide(&part),
                    (false, _) => {}
                }
                rest /= 2;
                part.square();
            }
        }
        RationalExpression::Atom(SignalAtom::Function(function, angle)) => {
            write(angle, time, &mut part, beside);
            let mut other = Coefficients {
                quads: beside,
                count,
            };
            match function {
                TimeFunction::Sin => Coefficients::turn(&part, result, &mut other),
                TimeFunction::Cos => Coefficients::turn(&part, &mut other, result),
            }
        }
        RationalExpression::Atom(_) | RationalExpression::Negative(_) => {}
    }
}
