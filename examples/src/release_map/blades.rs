//! The tongues of instability between the two modes: where the growth rate is largest
//! across them, and the frequencies there.

use branched_pendulum::analysis::growth::{Checked, Growth, frequency_at_rest, turns_a_second};
use branched_pendulum::prelude::*;

use super::arguments::Arguments;
use super::map::{at_rest, first_sector};
use super::normal_modes::NormalMode;
use crate::critical_angle::scene::InPhase;
use crate::failure::Failure;

/// A place of largest growth across a tongue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    /// Angles of release of parent and children, degrees.
    pub release: [f64; 2],
    /// Growth rate, 1/s.
    pub rate: Checked,
    /// Turns of the difference a second, f_eff, Hz.
    pub effective: Checked,
    /// Frequencies f_+ and f_− of the motion itself, Hz.
    pub modes: [f64; 2],
}

impl Ridge {
    /// f_eff − (f_+ + f_−)/2, Hz.
    pub fn mismatch(&self) -> f64 {
        self.effective.value - 0.5 * (self.modes[0] + self.modes[1])
    }
}

/// Angles of the parent at which tongues are crossed, degrees.
const PARENTS: [f64; 6] = [15.0, 20.0, 25.0, 30.0, 40.0, 50.0];

/// Angles of the children at which they are, degrees.
const CHILDREN: [f64; 2] = [-60.0, 110.0];

/// Step of the children's angle, degrees.
const STEP: f64 = 0.25;

/// Time over which frequencies are taken, s.
const SPAN: f64 = 120.0;

/// Growth rate from which on a place counts as unstable, 1/s.
const LEAST: f64 = 0.02;

/// Finds the places of largest growth across the tongues.
///
/// # Errors
/// [`Failure::Growth`].
pub fn find(
    arguments: &Arguments,
    model: &InPhase,
    modes: &[NormalMode],
) -> Result<Vec<Ridge>, Failure> {
    let ode = first_sector(model)?;
    let growth = Growth {
        frequency_hz: frequency_at_rest(&ode),
        horizons: vec![SPAN],
        tolerance: arguments.tolerance,
    };
    let mut ridges = Vec::new();
    for parent in PARENTS {
        let count = ((CHILDREN[1] - CHILDREN[0]) / STEP) as usize;
        let children = (0..=count).map(|k| CHILDREN[0] + k as f64 * STEP);
        let children: Vec<f64> = children.collect();
        let releases = children
            .iter()
            .map(|&c| (ode, at_rest::<InPhase>(parent, c)));
        let releases: Vec<_> = releases.collect();
        let grown = growth.in_lanes(&Ensemble::new(), &releases).into_iter();
        let grown = grown.collect::<Result<Vec<_>, _>>()?;
        for index in 1..count {
            let [before, here, after] = [index - 1, index, index + 1].map(|i| grown[i].rate.value);
            if here < LEAST || here < before || here <= after {
                continue;
            }
            ridges.push(Ridge {
                release: [parent, children[index]],
                rate: grown[index].rate,
                effective: grown[index].frequency_hz,
                modes: frequencies(model, modes, [parent, children[index]])?,
            });
        }
    }
    Ok(ridges)
}

/// Frequencies of an in-phase motion: turns of the parts of the modes in it.
fn frequencies(
    model: &InPhase,
    modes: &[NormalMode],
    release: [f64; 2],
) -> Result<[f64; 2], Failure> {
    const STEPS: usize = 6000;
    let times: Vec<f64> = (0..=STEPS)
        .map(|k| k as f64 * SPAN / STEPS as f64)
        .collect();
    let start = State::at_rest(0.0, &release.map(f64::to_radians));
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let mut states = Vec::new();
    let all = method.sample(&AbsoluteAngles(model), &start, &times, |_, state| {
        states.push([[state[0], state[1]], [state[2], state[3]]]);
    });
    all.map_err(|error| Failure::integration(release[0], error))?;
    let mass = model.mass_matrix(&[0.0; 2]);
    let mut found = [f64::NAN; 2];
    for (mode, found) in modes.iter().zip(&mut found) {
        let pace = std::f64::consts::TAU * mode.frequency_hz;
        let points = states
            .iter()
            .map(|&[angles, rates]| (mode.part(&mass, angles), mode.part(&mass, rates) / pace));
        *found = turns_a_second(&times, points);
    }
    Ok(found)
}
