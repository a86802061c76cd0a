//! Errors and costs of the forms of W of one tree.

use branched_pendulum::TransferForms;
use branched_pendulum::analysis::truncation::{
    AlongTrajectories, Background, ErrorCurve, PhaseAverage, logarithmic,
};

use super::cost::Costs;
use crate::branched_double::Failure;

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

/// What a study is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Short name, for files.
    pub name: &'static str,
    /// What the tree is, and how it was released.
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
}

/// Errors and costs of the forms of W of one tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// What was asked.
    pub settings: Settings,
    /// Over states with random phases, one curve for each receiver.
    pub phase_average: Vec<ErrorCurve>,
    /// Along exact motions, likewise.
    pub trajectories: Vec<ErrorCurve>,
    /// Time for one evaluation.
    pub costs: Costs,
}

impl Study {
    /// Computes everything, one thing after the other.
    ///
    /// # Errors
    /// [`Failure::Truncation`].
    pub fn of<M: TransferForms<f64>>(model: &M, settings: Settings) -> Result<Self, Failure> {
        Ok(Self {
            phase_average: settings.phase_average.curves(model)?,
            trajectories: settings.trajectories.curves(model)?,
            costs: Costs::measure(model, &settings.phase_average)?,
            settings,
        })
    }
}
