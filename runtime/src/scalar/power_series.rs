//! Truncated power series.

use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;

/// A truncated power series in one small variable, with `N` coefficients of orders 0 to `N` − 1.
///
/// A function that is computed with such numbers returns its power series, exact up to rounding,
/// without differentiating a formula: for example energy transfers by orders of the amplitude
/// ([`SymmetricTree`](crate::transfer::SymmetricTree)). A product takes N²/2 products of
/// coefficients; quotients, sines and roots take a multiple of that. A. Griewank and A. Walther,
/// Evaluating Derivatives, 2nd ed. 2008, ch. 13.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::{PowerSeries, Scalar};
///
/// // sin ε / (1 + ε) = ε − ε² + 5/6 ε³ − …
/// let epsilon = PowerSeries::<f64, 4>::variable(0.0);
/// let one = PowerSeries::constant(1.0);
/// let quotient = epsilon.sin_cos().0 / (one + epsilon);
/// for (own, known) in quotient.coefficients.iter().zip([0.0, 1.0, -1.0, 5.0 / 6.0]) {
///     assert!((own - known).abs() < 1e-15);
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerSeries<T, const N: usize> {
    /// Coefficients, beginning with order 0.
    pub coefficients: [T; N],
}

impl<T: Scalar, const N: usize> PowerSeries<T, N> {
    /// Creates a number that does not depend on the variable.
    #[inline(always)]
    #[must_use]
    pub fn constant(value: T) -> Self {
        Self::of(value, |_, _| T::from_f64(0.0))
    }

    /// Creates the series `value` + ε, with the variable ε.
    #[inline(always)]
    #[must_use]
    pub fn variable(value: T) -> Self {
        Self::linear(value, T::from_f64(1.0))
    }

    /// Creates the series `value` + `slope` ε, with the variable ε.
    #[inline(always)]
    #[must_use]
    pub fn linear(value: T, slope: T) -> Self {
        let mut result = Self::constant(value);
        if let Some(first) = result.coefficients.get_mut(1) {
            *first = slope;
        }
        result
    }

    /// Returns the sum of the coefficients of the given orders, which is the value of these terms
    /// if the variable is 1.
    #[must_use]
    pub fn sum(&self, orders: core::ops::RangeInclusive<usize>) -> T {
        let own = self.coefficients.iter().enumerate();
        let own = own.filter(|(order, _)| orders.contains(order));
        own.fold(T::from_f64(0.0), |sum, (_, &value)| sum + value)
    }

    /// Creates a series with constant term `first`; `next` computes each further coefficient from
    /// the previous ones.
    #[inline(always)]
    fn of(first: T, mut next: impl FnMut(&[T; N], usize) -> T) -> Self {
        let mut coefficients = [T::from_f64(0.0); N];
        for order in 0..N {
            coefficients[order] = match order {
                0 => first,
                _ => next(&coefficients, order),
            };
        }
        Self { coefficients }
    }

    #[inline(always)]
    fn first(&self) -> T {
        super::at(&self.coefficients, 0)
    }
}

/// Returns Σ a_j b_{order−j} over a range of j, one coefficient of a product of two series.
#[inline(always)]
fn folded<T: Scalar>(
    range: core::ops::Range<usize>,
    order: usize,
    a: impl Fn(usize) -> T,
    b: &[T],
) -> T {
    let mut sum = T::from_f64(0.0);
    let mut j = range.start;
    // A range as an iterator is slow in tests, where this is compiled with little inlining.
    while j < range.end {
        sum = sum + a(j) * b[order - j];
        j += 1;
    }
    sum
}

impl<T: Scalar, const N: usize> Add for PowerSeries<T, N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.coefficients, other.coefficients);
        Self {
            coefficients: array::from_fn(|order| a[order] + b[order]),
        }
    }
}

impl<T: Scalar, const N: usize> Sub for PowerSeries<T, N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let (a, b) = (self.coefficients, other.coefficients);
        Self {
            coefficients: array::from_fn(|order| a[order] - b[order]),
        }
    }
}

impl<T: Scalar, const N: usize> Mul for PowerSeries<T, N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.coefficients, other.coefficients);
        Self {
            coefficients: array::from_fn(|order| folded(0..order + 1, order, |j| a[j], &b)),
        }
    }
}

impl<T: Scalar, const N: usize> Div for PowerSeries<T, N> {
    type Output = Self;

    // From quotient · divisor = self, order by order.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (a, b) = (self.coefficients, other.coefficients);
        let divisor = other.first();
        Self::of(self.first() / divisor, |quotient, order| {
            (a[order] - folded(0..order, order, |j| quotient[j], &b)) / divisor
        })
    }
}

impl<T: Scalar, const N: usize> Neg for PowerSeries<T, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            coefficients: self.coefficients.map(|value| -value),
        }
    }
}

impl<T: Scalar, const N: usize> Scalar for PowerSeries<T, N> {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }

    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::constant(T::from_parts(high, low))
    }

    // From s' = c a' and c' = −s a'.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let a = self.coefficients;
        let (sine, cosine) = self.first().sin_cos();
        let (mut s, mut c) = (Self::constant(sine), Self::constant(cosine));
        for order in 1..N {
            let slope = |j: usize| T::from_f64(j as f64) * a[j];
            let turned = |of: &Self| folded(1..order + 1, order, slope, &of.coefficients);
            let share = T::from_f64(1.0 / order as f64);
            let (up, down) = (turned(&c), turned(&s));
            s.coefficients[order] = share * up;
            c.coefficients[order] = -(share * down);
        }
        (s, c)
    }

    /// Returns the square root, computed order by order from root² = self. If the constant term is
    /// zero, the coefficients from order 1 on are infinite or NaN.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let a = self.coefficients;
        let root = self.first().sqrt();
        let half = T::from_f64(0.5) / root;
        Self::of(root, |own, order| {
            (a[order] - folded(1..order, order, |j| own[j], own)) * half
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{PowerSeries, Scalar};

    type Series = PowerSeries<f64, 6>;

    fn assert_close(own: Series, other: Series) {
        for (a, b) in own.coefficients.iter().zip(other.coefficients) {
            assert!((a - b).abs() < 1e-14, "{own:?} {other:?}");
        }
    }

    #[test]
    fn arithmetic_undoes_itself() {
        let x = Series {
            coefficients: [0.7, -0.3, 0.2, 0.5, -0.1, 0.4],
        };
        let y = Series {
            coefficients: [1.3, 0.6, -0.2, 0.1, 0.9, -0.7],
        };
        assert_close(x * y / y, x);
        assert_close((y * y).sqrt(), y);
        assert_close(x + y - y, x);
        let (sine, cosine) = x.sin_cos();
        assert_close(sine * sine + cosine * cosine, Series::constant(1.0));
        // sin (x + y) by angle addition.
        let (sine_y, cosine_y) = y.sin_cos();
        assert_close((x + y).sin_cos().0, sine * cosine_y + cosine * sine_y);
    }

    #[test]
    fn sums_are_of_the_orders_in_the_range() {
        let x = PowerSeries {
            coefficients: [1.0, 2.0, 4.0],
        };
        assert_eq!(x.sum(1..=2), 6.0);
        assert_eq!(x.sum(2..=9), 4.0);
    }
}
