//! Errors and costs of the forms of W of one tree.

use branched_pendulum::TransferForms;
use branched_pendulum::analysis::truncation::{
    AlongTrajectories, Background, ErrorCurve, PhaseAverage, logarithmic,
};

use super::cost::Costs;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Progress;

/// Smallest and largest amplitude looked at, rad.
pub const AMPLITUDES: [f64; 2] = [1e-3, 1.5];

/// Amplitudes of the phase average, and bins of the trajectories.
const POINTS: usize = 45;

/// Number of disturbances, their range in rad, and the time followed after each
/// release in s: the span of the paper's spectrum.
const RELEASES: usize = 49;
const DISTURBANCES: [f64; 2] = [1e-4, 1.0];
const DURATION: f64 = 32.0;

/// Time over which the background is looked at, s.
const BACKGROUND: f64 = 10.0;

/// The ingredients of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Short name, for files.
    pub name: &'static str,
    /// Description of the tree and of its release.
    pub title: &'static str,
    /// States with random phases.
    pub phase_average: PhaseAverage,
    /// States along exact motions.
    pub trajectories: AlongTrajectories,
}

impl Settings {
    /// For a tree that is released from rest at the symmetric coordinates
    /// `release`, rad: random states within what it goes through in 10 s, and
    /// 49 disturbances followed for 32 s.
    ///
    /// # Errors
    /// [`Failure::Truncation`].
    pub fn released<M: TransferForms<f64>>(
        name: &'static str,
        title: &'static str,
        model: &M,
        release: &[f64],
        states: usize,
    ) -> Result<Self, Failure> {
        Ok(Self {
            name,
            title,
            phase_average: PhaseAverage {
                amplitudes: logarithmic(AMPLITUDES, POINTS),
                states,
                seed: 0,
                background: Background::visited(model, release, BACKGROUND)?,
            },
            trajectories: AlongTrajectories {
                release: release.to_vec(),
                disturbances: logarithmic(DISTURBANCES, RELEASES),
                duration: DURATION,
                sampling: 1000.0,
                amplitudes: AMPLITUDES,
                bins: POINTS,
            },
        })
    }

    /// With random states of another seed.
    #[must_use]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.phase_average.seed = seed;
        self
    }
}

/// Errors and costs of the forms of W of one tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The settings asked for.
    pub settings: Settings,
    /// Over states with random phases, one curve for each receiver.
    pub phase_average: Vec<ErrorCurve>,
    /// Along exact motions, likewise.
    pub trajectories: Vec<ErrorCurve>,
    /// Time for one evaluation.
    pub costs: Costs,
}

/// Parts of the progress that a study shows.
pub const PARTS: usize = 3;

impl Study {
    /// Computes everything, one thing after the other, as the next [`PARTS`] of
    /// `progress`.
    ///
    /// # Errors
    /// [`Failure::Truncation`].
    pub fn of<M: TransferForms<f64>>(
        model: &M,
        settings: Settings,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let Settings {
            name,
            phase_average,
            trajectories,
            ..
        } = &settings;
        progress.begin(&format!("{name}: phase average"));
        let average = by_amplitude(model, phase_average, progress)?;
        progress.begin(&format!("{name}: trajectories"));
        let along = progress.ticking(|| trajectories.curves(model))?;
        progress.next();
        progress.begin(&format!("{name}: cost"));
        let costs = Costs::measure(model, phase_average)?;
        progress.next();
        Ok(Self {
            phase_average: average,
            trajectories: along,
            costs,
            settings,
        })
    }
}

/// The curves of a phase average, one amplitude after the other: each takes the
/// same random states, so that the points are those of all at once.
fn by_amplitude<M: TransferForms<f64>>(
    model: &M,
    average: &PhaseAverage,
    progress: &Progress,
) -> Result<Vec<ErrorCurve>, Failure> {
    let count = average.amplitudes.len();
    let mut all: Vec<ErrorCurve> = Vec::new();
    for &amplitude in &average.amplitudes {
        let one = PhaseAverage {
            amplitudes: vec![amplitude],
            ..average.clone()
        };
        let curves = one.curves(model)?;
        if all.is_empty() {
            all = curves;
        } else {
            for (curve, next) in all.iter_mut().zip(curves) {
                curve.points.extend(next.points);
            }
        }
        progress.advance(1.0 / count as f64);
    }
    Ok(all)
}
