//! The recurrences of [`expand`](super::expand) in numbers that are several
//! already, one of each state in the lanes of a register.
//!
//! Links then follow one after the other, and what counts is how many products a
//! second the machine forms, not how long one waits for the next. The sums over
//! products of series, nearly all of the work, run for two orders at a time: what
//! is loaded serves both. Terms with coefficients of the two orders before join
//! last, so that the sums of a pair are formed while the machine waits for the
//! results of the one before.

mod inverse;
#[cfg(test)]
mod tests;

use self::inverse::negative_inverse;
use super::expand::{Known, Start, Tree};
use super::levers::Coupling;
use super::matrix::Vector;
use super::rows::SERIES;
use crate::scalar::Scalar;

/// Places of the series in a row; the first is not used here.
const COS: usize = 1;
const SIN: usize = 2;
const X: usize = 3;
const Y: usize = 4;

/// Orders whose sums are formed each by itself, before orders go in pairs.
const SINGLE: usize = 4;

/// The series of one order.
type Row<T, const M: usize> = [Vector<T, M>; SERIES];

/// An expansion from order 1 on.
pub(super) struct Orders<'a, T, F, const N: usize, const M: usize> {
    pub(super) start: &'a Start<'a, T, N>,
    pub(super) tree: &'a Tree<'a, T, N>,
    pub(super) coefficients: &'a mut [[[T; N]; 2]],
    pub(super) rows: &'a mut [Row<T, M>],
    pub(super) bias: Option<F>,
}

/// Sums of products in one order of one link.
#[derive(Clone, Copy)]
struct Sums<T> {
    /// Σ ω\[j\] cos\[k+1−j\]
    omega_cos: T,
    /// Σ ω\[j\] sin\[k+1−j\]
    omega_sin: T,
    /// Σ cos\[k+1−j\] X\[j−1\]
    along: T,
    /// Σ sin\[k+1−j\] Y\[j−1\]
    across: T,
}

// One index into all arrays at once.
#[allow(clippy::needless_range_loop)]
impl<T: Scalar, F, const N: usize, const M: usize> Orders<'_, T, F, N, M>
where
    F: FnMut(&Known<T, N>) -> [T; N],
{
    /// Forms them. No closure takes part but the caller's: what is not inlined is
    /// compiled without the registers.
    #[inline(always)]
    pub(super) fn run(mut self) {
        let last = self.coefficients.len().saturating_sub(1);
        if last == 0 {
            return;
        }
        let inverse = negative_inverse(self.start, self.tree);
        for i in 0..N {
            let (sine, cosine) = (self.start.sines[i], self.start.cosines[i]);
            let omega = self.start.omega[i];
            put(&mut self.rows[0], COS, i, cosine);
            put(&mut self.rows[0], SIN, i, sine);
            put(&mut self.rows[1], COS, i, -(sine * omega));
            put(&mut self.rows[1], SIN, i, cosine * omega);
        }
        if self.bias.is_some() {
            self.in_turn(last, &inverse);
        } else {
            self.unrolled(last, &inverse);
        }
    }

    /// The orders where the bias has none beyond 0.
    #[inline(always)]
    fn unrolled(&mut self, last: usize, inverse: &[[T; N]; N]) {
        self.single::<0>(inverse);
        self.single::<1>(inverse);
        self.single::<2>(inverse);
        self.single::<3>(inverse);
        let none = [T::from_f64(0.0); N];
        let [mut now, mut next] = [[Sums::none(); N]; 2];
        let mut k = SINGLE;
        while k < last {
            for i in 0..N {
                [now[i], next[i]] = self.pair(k, i);
            }
            self.order::<false>(k, &now, none, inverse);
            if k + 1 == last {
                return;
            }
            for i in 0..N {
                self.add(&mut next[i], k + 1, 0, i);
                self.add(&mut next[i], k + 1, k + 1, i);
            }
            self.order::<false>(k + 1, &next, none, inverse);
            k += 2;
        }
    }

    /// All of order K, if it is wanted.
    #[inline(always)]
    fn single<const K: usize>(&mut self, inverse: &[[T; N]; N]) {
        if K + 1 >= self.coefficients.len() {
            return;
        }
        let mut sums = [Sums::none(); N];
        for i in 0..N {
            for j in 0..=K {
                self.add(&mut sums[i], K, j, i);
            }
        }
        let none = [T::from_f64(0.0); N];
        let bias = if K == 0 { self.start.bias } else { none };
        self.order::<true>(K, &sums, bias, inverse);
    }

    /// The orders where the bias has all: one loop, so that the function that gives
    /// it is called in one place. Called in several it is not inlined, and compiled
    /// without the registers.
    #[inline(always)]
    fn in_turn(&mut self, last: usize, inverse: &[[T; N]; N]) {
        let [mut now, mut next] = [[Sums::none(); N]; 2];
        for k in 0..last {
            let single = k < SINGLE;
            if single {
                for i in 0..N {
                    now[i] = Sums::none();
                    for j in 0..=k {
                        self.add(&mut now[i], k, j, i);
                    }
                }
            } else if k % 2 == SINGLE % 2 {
                for i in 0..N {
                    [now[i], next[i]] = self.pair(k, i);
                }
            } else {
                now = next;
                for i in 0..N {
                    self.add(&mut now[i], k, 0, i);
                    self.add(&mut now[i], k, k, i);
                }
            }
            let bias = self.bias(k);
            if single {
                self.order::<true>(k, &now, bias, inverse);
            } else {
                self.order::<false>(k, &now, bias, inverse);
            }
        }
    }

    /// The bias of order k.
    #[inline(always)]
    fn bias(&mut self, k: usize) -> [T; N] {
        if k == 0 {
            return self.start.bias;
        }
        let Some(others) = &mut self.bias else {
            return [T::from_f64(0.0); N];
        };
        let row = &self.rows[k];
        let [theta, omega] = self.coefficients[k];
        let (mut sines, mut cosines) = (theta, theta);
        for i in 0..N {
            sines[i] = at(row, SIN, i);
            cosines[i] = at(row, COS, i);
        }
        others(&Known {
            order: k,
            theta,
            omega,
            sines,
            cosines,
        })
    }

    /// Adds the terms with index j to the sums of order k of link i.
    #[inline(always)]
    fn add(&self, sums: &mut Sums<T>, k: usize, j: usize, i: usize) {
        let omega = self.coefficients[j][1][i];
        let opposite = &self.rows[k + 1 - j];
        let (cos, sin) = (at(opposite, COS, i), at(opposite, SIN, i));
        sums.omega_cos = omega.mul_add(cos, sums.omega_cos);
        sums.omega_sin = omega.mul_add(sin, sums.omega_sin);
        if j > 0 {
            let forces = &self.rows[j - 1];
            sums.along = cos.mul_add(at(forces, X, i), sums.along);
            sums.across = sin.mul_add(at(forces, Y, i), sums.across);
        }
    }

    /// The sums of orders k and k + 1 of link i, as far as their terms are there.
    #[inline(always)]
    fn pair(&self, k: usize, i: usize) -> [Sums<T>; 2] {
        let (mut now, mut next) = (Sums::none(), Sums::none());
        let (mut cos, mut sin) = (at(&self.rows[k - 1], COS, i), at(&self.rows[k - 1], SIN, i));
        let omegas = &self.coefficients[3..k - 1];
        let forces = &self.rows[2..k - 2];
        let opposites = self.rows[3..k - 1].iter().rev();
        for ((omega, forces), opposite) in omegas.iter().zip(forces).zip(opposites) {
            let omega = omega[1][i];
            let (x, y) = (at(forces, X, i), at(forces, Y, i));
            next.omega_cos = omega.mul_add(cos, next.omega_cos);
            next.omega_sin = omega.mul_add(sin, next.omega_sin);
            next.along = cos.mul_add(x, next.along);
            next.across = sin.mul_add(y, next.across);
            cos = at(opposite, COS, i);
            sin = at(opposite, SIN, i);
            now.omega_cos = omega.mul_add(cos, now.omega_cos);
            now.omega_sin = omega.mul_add(sin, now.omega_sin);
            now.along = cos.mul_add(x, now.along);
            now.across = sin.mul_add(y, now.across);
        }
        self.add(&mut now, k, 2, i);
        self.add(&mut next, k + 1, 2, i);
        self.add(&mut now, k, 1, i);
        self.add(&mut next, k + 1, 1, i);
        self.add(&mut now, k, 0, i);
        self.add(&mut now, k, k - 1, i);
        self.add(&mut next, k + 1, k - 1, i);
        self.add(&mut now, k, k, i);
        self.add(&mut next, k + 1, k, i);
        [now, next]
    }

    /// Order k + 1 of the angles and velocities, order k + 2 of their sines and
    /// cosines, order k of the forces. Divides exactly but for rounding if `EXACT`.
    #[inline(always)]
    fn order<const EXACT: bool>(
        &mut self,
        k: usize,
        sums: &[Sums<T>; N],
        bias: [T; N],
        inverse: &[[T; N]; N],
    ) {
        let number = T::from_f64((k + 1) as f64);
        // S and C without their terms in α.
        let (mut s, mut c) = (bias, bias);
        for i in 0..N {
            s[i] = number * sums[i].omega_cos;
            c[i] = -(number * sums[i].omega_sin);
        }
        let (x, y) = forces(self.tree.couplings, &s, &c);
        let mut torque = bias;
        for i in 0..N {
            let row = &self.rows[k];
            torque[i] = torque[i] + (sums[i].along - sums[i].across);
            torque[i] = self.tree.weights[i].mul_add(at(row, SIN, i), torque[i]);
            torque[i] = self.tree.lateral_weights[i].mul_add(at(row, COS, i), torque[i]);
            torque[i] = self.start.cosines[i].mul_add(x[i], torque[i]);
            torque[i] = (-self.start.sines[i]).mul_add(y[i], torque[i]);
        }
        let mut alpha = bias;
        for i in 0..N {
            alpha[i] = inverse[i][0] * torque[0];
            for j in 1..N {
                alpha[i] = inverse[i][j].mul_add(torque[j], alpha[i]);
            }
        }
        let over = Reciprocal::<T, EXACT>::of((k + 1) as f64);
        for i in 0..N {
            let velocity = self.coefficients[k][1][i];
            self.coefficients[k + 1][0][i] = over.times(velocity);
            self.coefficients[k + 1][1][i] = over.times(alpha[i]);
        }
        if k + 2 >= self.coefficients.len() {
            return;
        }
        for i in 0..N {
            s[i] = self.start.cosines[i].mul_add(alpha[i], s[i]);
            c[i] = (-self.start.sines[i]).mul_add(alpha[i], c[i]);
        }
        let (x, y) = forces(self.tree.couplings, &s, &c);
        let over = Reciprocal::<T, EXACT>::of(((k + 1) * (k + 2)) as f64);
        for i in 0..N {
            put(&mut self.rows[k], X, i, x[i]);
            put(&mut self.rows[k], Y, i, y[i]);
            put(&mut self.rows[k + 2], COS, i, over.times(c[i]));
            put(&mut self.rows[k + 2], SIN, i, over.times(s[i]));
        }
    }
}

impl<T: Scalar> Sums<T> {
    #[inline(always)]
    fn none() -> Self {
        let zero = T::from_f64(0.0);
        Self {
            omega_cos: zero,
            omega_sin: zero,
            along: zero,
            across: zero,
        }
    }
}

/// X = A S + B C, Y = A C − B S.
#[inline(always)]
fn forces<T: Scalar, const N: usize>(
    couplings: &[Coupling<T>],
    s: &[T; N],
    c: &[T; N],
) -> ([T; N], [T; N]) {
    let zero = T::from_f64(0.0);
    let (mut x, mut y) = ([zero; N], [zero; N]);
    for coupling in couplings {
        let ([i, j], along) = (coupling.links, coupling.cosine);
        x[i] = along.mul_add(s[j], x[i]);
        x[j] = along.mul_add(s[i], x[j]);
        y[i] = along.mul_add(c[j], y[i]);
        y[j] = along.mul_add(c[i], y[j]);
        // Antisymmetric.
        if let Some(across) = coupling.sine {
            x[i] = across.mul_add(c[j], x[i]);
            x[j] = (-across).mul_add(c[i], x[j]);
            y[i] = (-across).mul_add(s[j], y[i]);
            y[j] = across.mul_add(s[i], y[j]);
        }
    }
    (x, y)
}

#[inline(always)]
fn at<T: Scalar, const M: usize>(row: &Row<T, M>, series: usize, link: usize) -> T {
    row[series][link / 4].0[link % 4]
}

#[inline(always)]
fn put<T, const M: usize>(row: &mut Row<T, M>, series: usize, link: usize, value: T) {
    row[series][link / 4].0[link % 4] = value;
}

/// 1/n, in two parts if `EXACT`: a rounded reciprocal is wrong by the same amount
/// in every step of a run. In higher orders that is too little to count.
#[derive(Clone, Copy)]
struct Reciprocal<T, const EXACT: bool> {
    high: T,
    low: T,
}

impl<T: Scalar, const EXACT: bool> Reciprocal<T, EXACT> {
    #[inline(always)]
    fn of(number: f64) -> Self {
        let high = T::from_f64(1.0 / number);
        let rest = (-T::from_f64(number)).mul_add(high, T::from_f64(1.0));
        Self {
            high,
            low: rest * high,
        }
    }

    #[inline(always)]
    fn times(self, value: T) -> T {
        if EXACT {
            value.mul_add(self.high, value * self.low)
        } else {
            value * self.high
        }
    }
}
