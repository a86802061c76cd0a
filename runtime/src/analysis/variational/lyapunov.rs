//! Lyapunov exponents.

use super::deviations::Deviations;
use super::error::LyapunovError;
use super::{Copies, Linearised, Variational};
use crate::analysis::random::Random;
use crate::analysis::statistics::Estimate;
use crate::integrate::Integrator;
use crate::system::State;

/// Computation of the exponents of a motion.
///
/// Deviations are integrated beside the motion over equal intervals, after each
/// of which they are made orthonormal again, and before where one has grown a thousandfold; the
/// mean logarithms of what that takes are the exponents, the largest first. Source: G. Benettin, L. Galgani,
/// A. Giorgilli, J.-M. Strelcyn, *Lyapunov characteristic exponents for smooth
/// dynamical systems*, Meccanica 15 (1980) 9–30.
///
/// Deviations start in general position, in the same directions at each call: a part of each
/// grows as fast as anything does, also where the motion stays in an invariant subspace.
/// Neither the motion nor the first of them depends on how many there are.
///
/// # Exponents within a subspace
///
/// A motion of [`Copies`] in phase stays in phase, and small deviations from it are of two
/// kinds that do not drive each other. [`within`](Self::within) are the exponents of those
/// that keep the copies in phase: they tell whether the in-phase motion by itself is chaotic,
/// and are those of the tree whose copies are one link. [`transverse`](Self::transverse) are
/// those of the differences between copies: where the largest is positive, a difference grows
/// and the copies part. Both together are the exponents of the whole, which
/// [`spectrum`](Self::spectrum) gives. (J. C. Alexander, J. A. Yorke, Z. You, I. Kan, *Riddled
/// basins*, International Journal of Bifurcation and Chaos 2 (1992) 795–813.)
///
/// # Examples
///
/// The paper's pendulum in phase, which by itself is regular, and the difference that grows
/// beside it:
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
    /// Number of exponents, from the largest on: at most the number of independent
    /// deviations.
    pub count: usize,
    /// Time (s) between two orthonormalisations, positive, some inverse exponents at most.
    pub interval: f64,
    /// Intervals before the logarithms count: deviations turn into the
    /// directions of growth meanwhile.
    pub settling: u32,
    /// Intervals whose logarithms count.
    pub intervals: u32,
}

/// The exponents of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovSpectrum {
    /// Exponents, in 1/s, the largest first: sorted, as a finite run may find two that are
    /// near each other in either order.
    pub exponents: Vec<f64>,
    /// Standard error of each, in the same order, from the spread of ten equal parts of the run:
    /// what a longer run would narrow, if the parts were independent. NaN for
    /// fewer than ten intervals.
    pub standard_errors: Vec<f64>,
    /// State at the end of the run.
    pub end: State<f64>,
}

impl LyapunovSpectrum {
    /// Time in which an error grows from `error` to `allowed` at the mean rate
    /// of the largest exponent; none if it does not grow.
    pub fn horizon(&self, error: f64, allowed: f64) -> Option<f64> {
        let largest = *self.exponents.first()?;
        (largest > 0.0).then(|| (allowed / error).ln() / largest)
    }
}

/// Parts of a run whose spread gives the standard error.
const PARTS: usize = 10;

impl Lyapunov {
    /// Returns the exponents of the motion of `system` from `start`: of all deviations.
    ///
    /// # Errors
    ///
    /// [`LyapunovError`]: a request that makes no sense, an interval that is
    /// too long, a failed integration.
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

    /// Returns the exponents of a motion in phase within the motions in phase: of deviations
    /// that are equal in all copies.
    ///
    /// # Errors
    ///
    /// As [`spectrum`](Self::spectrum); [`LyapunovError::NotInPhase`].
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

    /// Returns the exponents of a motion in phase out of the motions in phase: of
    /// differences between the copies.
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
        // The motion is followed by itself, so that it is the same beside any deviations.
        let [alone, all] = [0, count].map(|deviations| Variational::new(system, deviations));
        let mut motion = start.clone();
        let mut random = Random::new(0);
        let parts = (0..count * dimension).map(|_| random.within(1.0));
        let mut vectors: Vec<f64> = parts.collect();
        // One row of logarithms for each interval that counts.
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

    /// Refuses what no exponents can be found of.
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
        match kept {
            Deviations::Within(copies) | Deviations::Transverse(copies)
                if !copies.are_in_phase(system, start) =>
            {
                Err(LyapunovError::NotInPhase)
            }
            _ => Ok(()),
        }
    }

    /// Mean rates of growth by rows of logarithms, one for each interval, and the standard
    /// errors of these: the largest first.
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
