//! Growth of small differences between copies that move in phase: its factor and rate, for many
//! releases at once ([`Growth`]), and along periodic motions ([`BrakeOrbit`], [`Floquet`]).
//!
//! Everything is computed at two tolerances, and each result contains the difference between the
//! two ([`Checked`]): where motions are chaotic, no tolerance determines the growth over a long
//! time.

mod brake_orbit;
mod checked;
mod error;
mod floquet;
mod record;
mod rotation;
mod run;
mod transverse;

use std::iter;
use std::ops::Range;
use std::sync::Arc;

pub use self::brake_orbit::{BrakeOrbit, Continuation};
pub use self::checked::Checked;
pub use self::error::GrowthError;
pub use self::floquet::Floquet;
use self::record::GrowthRecord;
pub use self::rotation::turns_a_second;
use self::run::{DifferenceRanges, GrowthRun, follow_in_lanes, scales};
use self::transverse::difference_ranges;
pub use self::transverse::{TransverseSystem, frequency_at_rest};
use super::variational::{Linearised, Variational};
use crate::ensemble::Ensemble;
use crate::integrate::{Dop853, Integrator, Options};
use crate::system::{CastOde, Ode, State};

/// Settings for computing the growth of differences.
///
/// # Examples
///
/// The paper's pendulum, released with vertical children:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::{Growth, GrowthError, frequency_at_rest};
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::TransverseOde;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     in_phase(child),
///     emit(transverse),
/// )]
/// struct InPhase;
///
/// let model = InPhase::new();
/// let ode = TransverseOde::new(&model, 0).unwrap();
/// // Angles of the parent and of both children, and the difference.
/// let releases = [42.0_f64, 44.0].map(|degrees| {
///     (ode, State::at_rest(0.0, &[degrees.to_radians(), 0.0, 1.0]))
/// });
/// let growth = Growth {
///     frequency_hz: frequency_at_rest(&ode),
///     horizons: vec![4.0, 10.0],
///     tolerance: 1e-9,
/// };
/// let grown = growth.in_lanes(&Ensemble::new(), &releases);
/// let grown = grown.into_iter().collect::<Result<Vec<_>, GrowthError>>()?;
/// // Within 10 s.
/// assert!(grown[0].factors[1].value < 10.0 && grown[1].factors[1].value > 16.0);
/// assert!(grown[1].factors[1].is_determined());
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// # Ok::<(), GrowthError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Frequency of small differences at rest ([`frequency_at_rest`]), Hz. Rates of differences are
    /// divided by the corresponding angular frequency ω, and motions are sampled 32 times per
    /// period.
    pub frequency_hz: f64,
    /// Times after the start up to which growth is computed, s, ascending.
    pub horizons: Vec<f64>,
    /// Absolute and relative tolerance of the integration. The integration is repeated with a
    /// hundredth of it, and the result of the repetition is returned.
    pub tolerance: f64,
}

/// Growth of the differences between copies during one motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Grown {
    /// Growth factor up to each horizon: the largest size |δ| of the differences δ, divided by
    /// their amplitude √(|δ|² + |δ'|²/ω²) at the start; infinite above 1e308.
    pub factors: Vec<Checked>,
    /// Growth rate in 1/s over the last horizon T: ln(A₂/A₁)/(T/2) with the largest amplitudes A₁
    /// and A₂ in its two halves. It is near zero if differences keep their size, even if they beat.
    pub rate: Checked,
    /// Frequency of the first difference, Hz: the number of turns per second of (δ, δ'/ω) about the
    /// origin ([`turns_a_second`]).
    pub frequency_hz: Checked,
}

/// Ratio of the tighter tolerance to the looser one.
const FINER: f64 = 0.01;

impl Growth {
    /// Number of samples of a motion in one period of [`frequency_hz`](Self::frequency_hz).
    pub const LOOKS_A_PERIOD: f64 = 32.0;

    /// Number of samples after which differences are rescaled; they grow by less than the factor e
    /// between two samples. That number of states, and the one before them, are stored at a time.
    pub const LOOKS_A_SCALE: usize = 256;

    /// Returns the growth of differences along the motion from each start, computed on all cores
    /// and in the lanes of vector registers. A start is a state of its [`TransverseSystem`], such
    /// as [`TransverseOde`](crate::system::TransverseOde): in-phase angles, differences, in-phase
    /// velocities, rates of the differences. All starts have the same time.
    ///
    /// The result of a start depends neither on the other starts nor on the number of threads.
    ///
    /// # Errors
    ///
    /// Each start has its own result, which may be a [`GrowthError`].
    pub fn in_lanes<O>(
        &self,
        ensemble: &Ensemble<'_>,
        releases: &[(O, State<f64>)],
    ) -> Vec<Result<Grown, GrowthError>>
    where
        O: TransverseSystem + CastOde<f64> + Sync,
    {
        let frequencies_hz = vec![self.frequency_hz; releases.len()];
        self.in_lanes_by_frequency(ensemble, releases, &frequencies_hz)
    }

    /// Returns the growth of differences along motions of systems that differ in their constants.
    /// Each release has its frequency (Hz) in `frequencies`; releases beyond its end use
    /// [`frequency_hz`](Self::frequency_hz). The result of a release is that of
    /// [`in_lanes`](Self::in_lanes) with its frequency.
    ///
    /// # Errors
    ///
    /// Each release has its own result, which may be a [`GrowthError`].
    pub fn in_lanes_by_frequency<O>(
        &self,
        ensemble: &Ensemble<'_>,
        releases: &[(O, State<f64>)],
        frequencies_hz: &[f64],
    ) -> Vec<Result<Grown, GrowthError>>
    where
        O: TransverseSystem + CastOde<f64> + Sync,
    {
        let start = releases.first().map_or(0.0, |(_, start)| start.time);
        let frequencies = frequencies_hz.iter().copied();
        let frequencies = frequencies.chain(iter::repeat(self.frequency_hz));
        let with = |frequency_hz: f64| Self {
            frequency_hz,
            ..self.clone()
        };
        let mut looks: Vec<Arc<[f64]>> = Vec::new();
        let mut before = f64::NAN;
        for frequency in frequencies.clone().take(releases.len()) {
            // Shares sample times with the release before, which often has the same frequency.
            looks.push(match looks.last() {
                Some(last) if frequency == before => last.clone(),
                _ => with(frequency).looks(start).into(),
            });
            before = frequency;
        }
        let [coarse, fine] = self.tolerances().map(|tolerance| {
            let method = Dop853::new(Options::with_tolerance(tolerance));
            let each = releases.iter().zip(frequencies.clone());
            let runs = each.map(|((ode, release), frequency)| {
                if release.time != start {
                    return Err(GrowthError::StartTime(release.time));
                }
                with(frequency).begin(release.clone(), difference_ranges(ode))
            });
            let mut runs: Vec<Result<GrowthRun, GrowthError>> = runs.collect();
            follow_in_lanes(&method, ensemble, releases, &looks, &mut runs);
            runs
        });
        let both = coarse.into_iter().zip(fine);
        both.map(|(coarse, fine)| Ok(Grown::of(&coarse?.record, &fine?.record)))
            .collect()
    }

    /// Returns the growth of a deviation along a motion of any linearised system, for models
    /// without transverse equations. `differences` are two index ranges of the same length:
    /// components of the state that are angles of differences, and their rates. A deviation within
    /// an invariant subspace stays in it up to rounding, so that its growth says nothing about
    /// deviations out of it.
    ///
    /// # Errors
    ///
    /// [`GrowthError`].
    pub fn along<L: Linearised<f64>>(
        &self,
        system: &L,
        start: &State<f64>,
        deviation: &[f64],
        differences: [Range<usize>; 2],
    ) -> Result<Grown, GrowthError> {
        let n = system.dimension();
        let [angles, rates] = differences;
        if start.values.len() != n || deviation.len() != n || rates.end.max(angles.end) > n {
            return Err(GrowthError::Difference);
        }
        let place = DifferenceRanges {
            angles: n + angles.start..n + angles.end,
            rates: n + rates.start..n + rates.end,
        };
        let both = State::new(start.time, [&start.values, deviation].concat());
        // Scales all components of the deviation, since they drive each other.
        let (system, scaled) = (Variational::new(system, 1), n..2 * n);
        self.follow(&system, &both, &place, std::slice::from_ref(&scaled))
    }

    /// Returns the growth along the motion from one start, computed on this thread. To rounding it
    /// is the result of [`in_lanes`](Self::in_lanes).
    ///
    /// # Errors
    ///
    /// [`GrowthError`].
    pub fn of_release<O: TransverseSystem>(
        &self,
        system: &O,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError> {
        let place = difference_ranges(system);
        let scaled = [place.angles.clone(), place.rates.clone()];
        self.follow(system, start, &place, &scaled)
    }

    /// Computes one motion with both tolerances. When differences are rescaled, all components of
    /// `scaled` are divided.
    fn follow<O: Ode<f64>>(
        &self,
        system: &O,
        start: &State<f64>,
        place: &DifferenceRanges,
        scaled: &[Range<usize>],
    ) -> Result<Grown, GrowthError> {
        let [coarse, fine] = self.tolerances().map(|tolerance| {
            let method = Dop853::new(Options::with_tolerance(tolerance));
            let mut run = self.begin(start.clone(), place.clone())?;
            for times in scales(&self.looks(start.time)) {
                let mut number = 0;
                let begin = run.state.clone();
                let end = method.sample(system, &begin, times, |time, state| {
                    if number > 0 {
                        run.add_sample(time, state);
                    }
                    number += 1;
                })?;
                run.state = end.state;
                run.scale(scaled);
            }
            Ok::<GrowthRun, GrowthError>(run)
        });
        Ok(Grown::of(&coarse?.record, &fine?.record))
    }

    fn tolerances(&self) -> [f64; 2] {
        [self.tolerance, FINER * self.tolerance]
    }

    fn begin(&self, start: State<f64>, place: DifferenceRanges) -> Result<GrowthRun, GrowthError> {
        if !(self.frequency_hz.is_finite() && self.frequency_hz > 0.0) {
            return Err(GrowthError::Frequency(self.frequency_hz));
        }
        let ascending = self.horizons.windows(2).all(|pair| pair[0] < pair[1]);
        let valid = |first: &f64| *first > 0.0 && self.horizons.iter().all(|t| t.is_finite());
        if !(ascending && self.horizons.first().is_some_and(valid)) {
            return Err(GrowthError::Horizons);
        }
        let (angles, rates) = (place.angles.clone(), place.rates.clone());
        let parts = start.values.get(angles).zip(start.values.get(rates));
        let (angles, rates) = parts.ok_or(GrowthError::Difference)?;
        let record = GrowthRecord::new(self, start.time, angles, rates)?;
        Ok(GrowthRun {
            state: start,
            place,
            record,
        })
    }

    /// Returns the times of the samples: the start, equal intervals up to each horizon, and the
    /// horizons.
    fn looks(&self, start: f64) -> Vec<f64> {
        let interval = 1.0 / (Self::LOOKS_A_PERIOD * self.frequency_hz);
        let mut times = vec![start];
        let mut before = 0.0;
        for &horizon in &self.horizons {
            let count = ((horizon - before) / interval).ceil().max(1.0);
            let steps = (1..count as usize).map(|k| k as f64 / count);
            times.extend(steps.map(|part| start + before + part * (horizon - before)));
            times.push(start + horizon);
            before = horizon;
        }
        times
    }
}

impl Grown {
    fn of(coarse: &GrowthRecord, fine: &GrowthRecord) -> Self {
        let factors = coarse.factors().iter().zip(fine.factors());
        Self {
            factors: factors
                .map(|(coarse, fine)| Checked::of_logarithms(*coarse, *fine))
                .collect(),
            rate: Checked::of_rates(coarse.rate(), fine.rate(), fine.span()),
            frequency_hz: Checked::of_rates(coarse.turns(), fine.turns(), fine.span()),
        }
    }
}
