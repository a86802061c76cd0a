//! Taylor series that an expansion stores, and sums of products of their coefficients.
//!
//! Order k of a product of series is a sum over the rows j and k − j.

use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// Number of stored series: ω, γ, σ, X, Y.
pub(super) const SERIES: usize = 5;

/// All series of four links in one order. Row r holds order r of ω, r + 1 of γ and σ, and r − 1 of
/// X and Y, so that all sums of order k run over rows j and k − j. The rows of four links follow
/// each other in memory, order by order.
pub(super) type SeriesRow<T> = [Quad<T>; SERIES];

/// Writes one number, or one pack of numbers, of each series to a row of coefficients.
#[inline(always)]
pub(super) fn store<T: Scalar, P: Simd<T>>(
    values: [P; SERIES],
    row: &mut SeriesRow<T>,
    place: usize,
) {
    for (series, value) in row.iter_mut().zip(values) {
        value.store_quad(core::slice::from_mut(series), place);
    }
}

/// Count of sums in [`SeriesSums`].
pub(super) const SUMS: usize = 4;

/// Sums of products of Taylor coefficients for order k, over 0 < j < k.
#[derive(Clone, Copy)]
pub(super) struct SeriesSums<P> {
    /// The sum Σ ω\[j\] γ\[k+1−j\].
    pub(super) omega_cos: P,
    /// The sum Σ ω\[j\] σ\[k+1−j\].
    pub(super) omega_sin: P,
    /// The sum Σ γ\[k+1−j\] X\[j−1\].
    cos_x: P,
    /// The sum Σ σ\[k+1−j\] Y\[j−1\].
    sin_y: P,
}

impl<P: Scalar> SeriesSums<P> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let zero = P::from_f64(0.0);
        Self {
            omega_cos: zero,
            omega_sin: zero,
            cos_x: zero,
            sin_y: zero,
        }
    }

    /// Creates the sums from the array that [`numbers`](Self::numbers) returns.
    #[inline(always)]
    pub(super) fn from_numbers([omega_cos, omega_sin, cos_x, sin_y]: [P; SUMS]) -> Self {
        Self {
            omega_cos,
            omega_sin,
            cos_x,
            sin_y,
        }
    }

    /// Returns all sums as one array.
    #[inline(always)]
    pub(super) fn numbers(self) -> [P; SUMS] {
        [self.omega_cos, self.omega_sin, self.cos_x, self.sin_y]
    }

    /// Returns Σ σ Y − γ X, the sum in the equation of X.
    #[inline(always)]
    pub(super) fn force(self) -> P {
        self.sin_y - self.cos_x
    }

    /// Returns the sums over all `rows`. Row j is paired with row k − j, from the middle outwards,
    /// so that the newest rows are added last. Each sum has two partial sums that do not wait for
    /// each other: this is faster for a single state, which waits for results longer than it
    /// computes.
    #[inline(always)]
    pub(super) fn of<T: Scalar>(rows: &[SeriesRow<T>], place: usize) -> Self
    where
        P: Simd<T>,
    {
        let (early, rest) = rows.split_at(rows.len() / 2);
        let (middle, late) = rest.split_at(rest.len() - early.len());
        let [mut first, mut second] = [Self::none(); 2];
        for row in middle {
            first.add(
                motion_coefficients(row, place),
                sine_coefficients(row, place),
            );
        }
        for (row, opposite) in early.iter().rev().zip(late) {
            first.add(
                motion_coefficients(row, place),
                sine_coefficients(opposite, place),
            );
            second.add(
                motion_coefficients(opposite, place),
                sine_coefficients(row, place),
            );
        }
        Self {
            omega_cos: first.omega_cos + second.omega_cos,
            omega_sin: first.omega_sin + second.omega_sin,
            cos_x: first.cos_x + second.cos_x,
            sin_y: first.sin_y + second.sin_y,
        }
    }

    /// Returns the sums of order k (which is odd and equals the number of `rows`), and the sums of
    /// order k + 1 without their terms of the newest row. Both use each row while it is loaded,
    /// which is faster for several states: their arithmetic takes longer than the loads.
    #[inline(always)]
    pub(super) fn pair<T: Scalar>(rows: &[SeriesRow<T>], place: usize) -> [Self; 2]
    where
        P: Simd<T>,
    {
        let [mut now, mut next] = [Self::none(); 2];
        let Some((newest, old)) = rows.split_last() else {
            return [now, next];
        };
        // The terms of row 0 are added elsewhere.
        let Some((_, [first, middle @ ..])) = old.split_first() else {
            return [now, next];
        };
        let mut turned = sine_coefficients(newest, place);
        for (row, opposite) in middle.iter().zip(middle.iter().rev()) {
            let moved = motion_coefficients(row, place);
            next.add(moved, turned);
            turned = self::sine_coefficients(opposite, place);
            now.add(moved, turned);
        }
        if let Some(second) = middle.first() {
            next.add(
                self::motion_coefficients(newest, place),
                self::sine_coefficients(second, place),
            );
        } else {
            next.add(
                self::motion_coefficients(newest, place),
                self::sine_coefficients(newest, place),
            );
        }
        now.add(
            self::motion_coefficients(first, place),
            self::sine_coefficients(newest, place),
        );
        now.add(
            self::motion_coefficients(newest, place),
            self::sine_coefficients(first, place),
        );
        [now, next]
    }

    /// Adds the terms that contain coefficients of the newest row.
    #[inline(always)]
    pub(super) fn complete<T: Scalar>(&mut self, rows: &[SeriesRow<T>], place: usize)
    where
        P: Simd<T>,
    {
        let [_, first, others @ ..] = rows else {
            return;
        };
        let newest = others.last().unwrap_or(first);
        self.add(
            motion_coefficients(first, place),
            sine_coefficients(newest, place),
        );
        if !others.is_empty() {
            self.add(
                motion_coefficients(newest, place),
                sine_coefficients(first, place),
            );
        }
    }

    /// Adds the products of ω, X and Y of one row of coefficients with the cosine and sine (γ, σ)
    /// of another row.
    #[inline(always)]
    fn add(&mut self, [omega, x, y]: [P; 3], [cos, sin]: [P; 2]) {
        self.omega_cos = self.omega_cos.plus_product(omega, cos);
        self.omega_sin = self.omega_sin.plus_product(omega, sin);
        self.cos_x = self.cos_x.plus_product(cos, x);
        self.sin_y = self.sin_y.plus_product(sin, y);
    }
}

/// Returns the coefficients of ω, X and Y in a row.
#[inline(always)]
fn motion_coefficients<T: Scalar, P: Simd<T>>(
    [omega, _, _, x, y]: &SeriesRow<T>,
    place: usize,
) -> [P; 3] {
    [load(omega, place), load(x, place), load(y, place)]
}

/// Returns the coefficients of γ and σ in a row.
#[inline(always)]
pub(super) fn sine_coefficients<T: Scalar, P: Simd<T>>(
    [_, cos, sin, _, _]: &SeriesRow<T>,
    place: usize,
) -> [P; 2] {
    [load(cos, place), load(sin, place)]
}

#[inline(always)]
fn load<T: Scalar, P: Simd<T>>(quad: &Quad<T>, place: usize) -> P {
    P::load_quad(core::slice::from_ref(quad), place)
}
