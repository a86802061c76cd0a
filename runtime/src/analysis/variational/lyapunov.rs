//! Computes Lyapunov exponents.

use super::deviations::Deviations;
use super::error::LyapunovError;
use super::{Copies, Linearised, Variational};
use crate::analysis::random::Random;
use crate::analysis::statistics::Estimate;
use crate::integrate::Integrator;
use crate::system::State;

/// Settings for computing the Lyapunov exponents of a motion.
///
/// Deviations are integrated together with the motion over equal intervals. They are made
/// orthonormal again after each interval, and earlier when one has grown by a factor of a thousand;
/// the exponents are the mean logarithms of the lengths by which they are divided, per unit of
/// time, the largest first. Source: G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn,
/// *Lyapunov characteristic exponents for smooth dynamical systems*, Meccanica 15 (1980) 9–30.
///
/// Deviations start in general position, in the same directions at each call: a component of each
/// grows as fast as the fastest deviation, even if the motion stays in an invariant subspace.
/// Neither the motion nor the first deviation depends on the number of deviations.
///
/// # Exponents within a subspace
///
/// A motion of [`Copies`] in phase stays in phase, and small deviations from it are of two kinds
/// that do not drive each other. [`within`](Self::within) computes the exponents of those that keep
/// the copies in phase: they show whether the in-phase motion by itself is chaotic, and are those
/// of the tree in which the copies are one link. [`transverse`](Self::transverse) computes those of
/// the differences between copies: if the largest is positive, a difference grows and the copies
/// separate. Both together are the exponents of the whole, which [`spectrum`](Self::spectrum)
/// computes. (J. C. Alexander, J. A. Yorke, Z. You, I. Kan, *Riddled basins*, International Journal
/// of Bifurcation and Chaos 2 (1992) 795–813.)
///
/// # Examples
///
/// The paper's pendulum in phase, whose in-phase motion is regular while a difference between the
/// children grows:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::variational::{Copies, Lyapunov, linearised};
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::<f64>::new();
/// let system = linearised(AbsoluteAngles(&model));
/// let method = Dop853::new(Options::with_tolerance(1e-9));
/// // In phase, where a difference of the children grows.
/// let start = State::at_rest(0.0, &[44_f64.to_radians(), 0.0, 0.0]);
/// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
/// let lyapunov = Lyapunov { count: 1, interval: 0.5, settling: 40, intervals: 400 };
/// let all = lyapunov.spectrum(&method, &system, &start)?.exponents[0];
/// let within = lyapunov.within(&children, &method, &system, &start)?.exponents[0];
/// let transverse = lyapunov.transverse(&children, &method, &system, &start)?.exponents[0];
/// assert!((all - transverse).abs() < 0.01 && transverse > 0.2 && within < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lyapunov {
    /// Number of exponents to compute, beginning with the largest; at most the number of
    /// independent deviations.
    pub count: usize,
    /// Time between two orthonormalisations in s; it must be positive and should be at most a few
    /// times the inverse of the exponents.
    pub interval: f64,
    /// Number of initial intervals that are not counted, in which deviations turn to the directions
    /// of growth.
    pub settling: u32,
    /// Number of intervals whose logarithms are counted.
    pub intervals: u32,
}

/// The exponents of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovSpectrum {
    /// Exponents in 1/s, the largest first. They are sorted because a finite run may find two
    /// nearly equal exponents in either order.
    pub exponents: Vec<f64>,
    /// Standard error of each exponent, in the same order, from the spread of ten equal parts of
    /// the run. It is valid if the parts are independent, and decreases with the length of the run.
    /// NaN for fewer than ten intervals.
    pub standard_errors: Vec<f64>,
    /// State at the end of the run.
    pub end: State<f64>,
}

impl LyapunovSpectrum {
    /// Returns the time (s) in which an error grows from `error` to `allowed` at the rate of the
    /// largest exponent; `None` if errors do not grow.
    pub fn horizon(&self, error: f64, allowed: f64) -> Option<f64> {
        let largest = *self.exponents.first()?;
        (largest > 0.0).then(|| (allowed / error).ln() / largest)
    }
}

/// Number of parts of a run from whose spread the standard error is computed.
const PARTS: usize = 10;

impl Lyapunov {
    /// Returns the Lyapunov exponents of the motion of `system` that starts at `start`, for
    /// deviations in all directions.
    ///
    /// # Errors
    ///
    /// [`LyapunovError`] if the settings are invalid, if an interval is too long, or if the
    /// integration fails.
    pub fn spectrum<L, M>(
        &self,
        method: &M,
        system: &L,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.of(Deviations::All, method, system, start)
    }

    /// Returns the Lyapunov exponents of an in-phase motion for deviations that are equal in all
    /// copies.
    ///
    /// # Errors
    ///
    /// As [`spectrum`](Self::spectrum), and [`LyapunovError::NotInPhase`].
    pub fn within<L, M>(
        &self,
        copies: &Copies,
        method: &M,
        system: &L,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.of(Deviations::Within(copies), method, system, start)
    }

    /// Returns the Lyapunov exponents of an in-phase motion for differences between the copies.
    ///
    /// # Errors
    ///
    /// As [`within`](Self::within).
    pub fn transverse<L, M>(
        &self,
        copies: &Copies,
        method: &M,
        system: &L,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.of(Deviations::Transverse(copies), method, system, start)
    }

    fn of<L, M>(
        &self,
        kept: Deviations<'_>,
        method: &M,
        system: &L,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let Self {
            count,
            interval,
            settling,
            intervals,
        } = *self;
        self.check(kept, system, start)?;
        let dimension = system.dimension();
        // Integrates the motion separately, so that it is the same with any number of deviations.
        let [alone, all] = [0, count].map(|deviations| Variational::new(system, deviations));
        let mut motion = start.clone();
        let mut random = Random::new(0);
        let parts = (0..count * dimension).map(|_| random.within(1.0));
        let mut vectors: Vec<f64> = parts.collect();
        // Logarithms of growth: one row for each interval that is counted.
        let mut logarithms: Vec<Vec<f64>> = Vec::new();
        let settling = u64::from(settling);
        kept.keep_motion(&mut motion.values);
        kept.orthonormalise(&mut vectors, start.time, dimension)?;
        for number in 1..=settling + u64::from(intervals) {
            let end = start.time + number as f64 * interval;
            let row = kept.grow(method, &all, &motion, &mut vectors, end)?;
            motion = method.run(&alone, &motion, end)?.state;
            kept.keep_motion(&mut motion.values);
            if number > settling {
                logarithms.push(row);
            }
        }
        let (exponents, standard_errors) = self.averages(&logarithms);
        Ok(LyapunovSpectrum {
            exponents,
            standard_errors,
            end: motion,
        })
    }

    /// Checks that the settings are valid and suit the system and the start.
    fn check<L: Linearised<f64>>(
        &self,
        kept: Deviations<'_>,
        system: &L,
        start: &State<f64>,
    ) -> Result<(), LyapunovError> {
        let Self {
            count,
            interval,
            intervals,
            ..
        } = *self;
        let deviations = kept.count(system.dimension());
        if count == 0 || count > deviations {
            return Err(LyapunovError::Count { count, deviations });
        }
        if !(interval.is_finite() && interval > 0.0 && intervals > 0) {
            return Err(LyapunovError::Interval {
                interval,
                intervals,
            });
        }
        super::check_dimension(system, start)?;
        let in_phase = match kept {
            Deviations::All => true,
            Deviations::Within(copies) | Deviations::Transverse(copies) => {
                copies.are_in_phase(system, start)
            }
        };
        in_phase.then_some(()).ok_or(LyapunovError::NotInPhase)
    }

    /// Returns the mean growth rates (1/s) and their standard errors, from one row of logarithms
    /// per interval. Sorted by rate, the largest first.
    fn averages(&self, logarithms: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
        let mean = |rows: &[Vec<f64>], index: usize| {
            let sum: f64 = rows.iter().map(|row| row[index]).sum();
            sum / (rows.len() as f64 * self.interval)
        };
        let standard_error = |index: usize| {
            let length = logarithms.len() / PARTS;
            if length == 0 {
                return f64::NAN;
            }
            let parts = logarithms.chunks_exact(length).take(PARTS);
            let means: Vec<f64> = parts.map(|rows| mean(rows, index)).collect();
            Estimate::of_independent(&means).error
        };
        let found = (0..self.count).map(|index| (mean(logarithms, index), standard_error(index)));
        let mut found: Vec<(f64, f64)> = found.collect();
        found.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        found.into_iter().unzip()
    }
}
