//! The series that an expansion keeps, and the sums of their products.
//!
//! Order k of a product of series is a sum over the rows j and k − j.

use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// Series that are kept: ω, γ, σ, X, Y.
pub(super) const SERIES: usize = 5;

/// All series of four links in one order. Row r has order r of ω, r + 1 of γ and σ,
/// r − 1 of X and Y, so that all sums of order k run over rows j and k − j. The rows of
/// four links follow each other in memory, order by order.
pub(super) type SeriesRow<T> = [Quad<T>; SERIES];

/// Writes one number, or pack of numbers, of each series to a row.
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

/// Number of [`SeriesSums`].
pub(super) const SUMS: usize = 4;

/// Sums of products in one order, over 0 < j < k.
#[derive(Clone, Copy)]
pub(super) struct SeriesSums<P> {
    /// Σ ω\[j\] γ\[k+1−j\]
    pub(super) omega_cos: P,
    /// Σ ω\[j\] σ\[k+1−j\]
    pub(super) omega_sin: P,
    /// Σ γ\[k+1−j\] X\[j−1\]
    cos_x: P,
    /// Σ σ\[k+1−j\] Y\[j−1\]
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

    /// Takes the sums from the numbers that [`numbers`](Self::numbers) returns.
    #[inline(always)]
    pub(super) fn from_numbers([omega_cos, omega_sin, cos_x, sin_y]: [P; SUMS]) -> Self {
        Self {
            omega_cos,
            omega_sin,
            cos_x,
            sin_y,
        }
    }

    /// Returns all of them, side by side.
    #[inline(always)]
    pub(super) fn numbers(self) -> [P; SUMS] {
        [self.omega_cos, self.omega_sin, self.cos_x, self.sin_y]
    }

    /// Σ σ Y − γ X
    #[inline(always)]
    pub(super) fn force(self) -> P {
        self.sin_y - self.cos_x
    }

    /// Returns the sums over all `rows`, each with the one as far from the other end, from
    /// the middle outwards: what was formed last is added last. There are two partial
    /// sums of each, so that none waits for the other: for a single state, which waits for
    /// results more than it computes.
    #[inline(always)]
    pub(super) fn of<T: Scalar>(rows: &[SeriesRow<T>], place: usize) -> Self
    where
        P: Simd<T>,
    {
        let (early, rest) = rows.split_at(rows.len() / 2);
        let (middle, late) = rest.split_at(rest.len() - early.len());
        let [mut first, mut second] = [Self::none(); 2];
        for row in middle {
            first.add(moved(row, place), turned(row, place));
        }
        for (row, opposite) in early.iter().rev().zip(late) {
            first.add(moved(row, place), turned(opposite, place));
            second.add(moved(opposite, place), turned(row, place));
        }
        Self {
            omega_cos: first.omega_cos + second.omega_cos,
            omega_sin: first.omega_sin + second.omega_sin,
            cos_x: first.cos_x + second.cos_x,
            sin_y: first.sin_y + second.sin_y,
        }
    }

    /// Returns the sums of order k, the number of `rows` and odd, and those of order
    /// k + 1 but for their terms with the newest row. What is loaded serves both: for
    /// several states, which compute more than they wait.
    #[inline(always)]
    pub(super) fn pair<T: Scalar>(rows: &[SeriesRow<T>], place: usize) -> [Self; 2]
    where
        P: Simd<T>,
    {
        let [mut now, mut next] = [Self::none(); 2];
        let Some((newest, old)) = rows.split_last() else {
            return [now, next];
        };
        // SeriesRow 0 has its terms elsewhere.
        let Some((_, [first, middle @ ..])) = old.split_first() else {
            return [now, next];
        };
        let mut turned = turned(newest, place);
        for (row, opposite) in middle.iter().zip(middle.iter().rev()) {
            let moved = moved(row, place);
            next.add(moved, turned);
            turned = self::turned(opposite, place);
            now.add(moved, turned);
        }
        if let Some(second) = middle.first() {
            next.add(self::moved(newest, place), self::turned(second, place));
        } else {
            next.add(self::moved(newest, place), self::turned(newest, place));
        }
        now.add(self::moved(first, place), self::turned(newest, place));
        now.add(self::moved(newest, place), self::turned(first, place));
        [now, next]
    }

    /// Adds the terms with the newest row.
    #[inline(always)]
    pub(super) fn complete<T: Scalar>(&mut self, rows: &[SeriesRow<T>], place: usize)
    where
        P: Simd<T>,
    {
        let [_, first, others @ ..] = rows else {
            return;
        };
        let newest = others.last().unwrap_or(first);
        self.add(moved(first, place), turned(newest, place));
        if !others.is_empty() {
            self.add(moved(newest, place), turned(first, place));
        }
    }

    /// Adds the products of ω, X, Y of one row with γ, σ of another.
    #[inline(always)]
    fn add(&mut self, [omega, x, y]: [P; 3], [cos, sin]: [P; 2]) {
        self.omega_cos = self.omega_cos.plus_product(omega, cos);
        self.omega_sin = self.omega_sin.plus_product(omega, sin);
        self.cos_x = self.cos_x.plus_product(cos, x);
        self.sin_y = self.sin_y.plus_product(sin, y);
    }
}

/// ω, X, Y
#[inline(always)]
fn moved<T: Scalar, P: Simd<T>>([omega, _, _, x, y]: &SeriesRow<T>, place: usize) -> [P; 3] {
    [load(omega, place), load(x, place), load(y, place)]
}

/// γ, σ
#[inline(always)]
pub(super) fn turned<T: Scalar, P: Simd<T>>(
    [_, cos, sin, _, _]: &SeriesRow<T>,
    place: usize,
) -> [P; 2] {
    [load(cos, place), load(sin, place)]
}

#[inline(always)]
fn load<T: Scalar, P: Simd<T>>(quad: &Quad<T>, place: usize) -> P {
    P::load_quad(core::slice::from_ref(quad), place)
}
