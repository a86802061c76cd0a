//! Tongues of instability along lines through the plane of releases: where the growth
//! rate is largest across them, and the frequencies there.

use branched_pendulum::analysis::growth::{Growth, frequency_at_rest, turns_a_second};
use branched_pendulum::prelude::*;

use super::arguments::Arguments;
use super::normal_modes::NormalMode;
use crate::critical_angle::scene::{InPhase, at_rest, first_sector};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::windows::windows;

/// A tongue of instability, crossed by a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tongue {
    /// First and last release on the line from which differences grow: angles of parent
    /// and children, degrees.
    pub edges: [[f64; 2]; 2],
    /// The place of largest growth.
    pub ridge: Ridge,
}

/// A place of the plane, and the frequencies there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    /// Angles of release of parent and children, degrees.
    pub release: [f64; 2],
    /// Growth rate, 1/s.
    pub rate: f64,
    /// Turns of the difference a second, f_eff, Hz.
    pub effective: f64,
    /// Frequencies f_+ and f_− of the motion itself, Hz.
    pub modes: [f64; 2],
    /// The resonance, if one is within [`CLOSE`].
    pub resonance: Option<Resonance>,
}

/// A resonance f_eff = (n_+ f_+ + n_− f_−)/2 with n_+ + n_− even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// n_+ and n_−.
    pub numbers: [i32; 2],
    /// f_eff − (n_+ f_+ + n_− f_−)/2, Hz.
    pub mismatch: f64,
}

/// Largest mismatch of a resonance, Hz.
pub const CLOSE: f64 = 2e-3;

/// Largest |n_+| + |n_−|.
const HIGHEST: i32 = 4;

/// Angles of the parent at which tongues are crossed, degrees.
const PARENTS: [f64; 7] = [15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0];

/// Angles of the children at which they are, degrees.
const CHILDREN: std::ops::RangeInclusive<f64> = -60.0..=110.0;

/// Time over which frequencies are taken, in spans of the map.
const SPANS: f64 = 8.0;

/// Growth rate from which on a place counts as unstable, 1/s.
const LEAST: f64 = 0.02;

/// Returns the time over which frequencies are taken, s.
pub fn span(arguments: &Arguments) -> f64 {
    SPANS * arguments.span
}

/// The lines that are looked along: across the plane at some angles of the parent, and
/// the releases of the paper.
pub fn lines(arguments: &Arguments) -> Vec<Vec<[f64; 2]>> {
    let mut children = arguments.children();
    children.retain(|angle| CHILDREN.contains(angle));
    let shown = PARENTS.iter().filter(|parent| **parent <= arguments.parent);
    let across = shown.map(|&parent| children.iter().map(|&child| [parent, child]).collect());
    let paper = arguments.parents().into_iter().map(|parent| [parent, 0.0]);
    across.chain([paper.collect()]).collect()
}

/// Finds the tongues along a line of releases; none where the motion is chaotic.
///
/// # Errors
/// [`Failure::Growth`] or [`Failure::Integration`].
pub fn along(
    line: &[[f64; 2]],
    arguments: &Arguments,
    model: &InPhase,
    modes: &[NormalMode],
) -> Result<Vec<Tongue>, Failure> {
    let ode = first_sector(model)?;
    let growth = growth(model, span(arguments), arguments.tolerance)?;
    let starts = line.iter();
    let starts = starts.map(|&[parent, child]| (ode, at_rest(model, parent, child)));
    let grown = growth.in_lanes(&Ensemble::new(), &starts.collect::<Vec<_>>());
    let rates = grown.into_iter().map(|grown| Ok(grown?.rate.value));
    let rates = rates.collect::<Result<Vec<f64>, Failure>>()?;
    let settings = (span(arguments), arguments.tolerance);
    let mut tongues = Vec::new();
    for [first, last] in windows(rates.len(), |index| rates[index] >= LEAST) {
        let highest = (first..=last).max_by(|a, b| rates[*a].total_cmp(&rates[*b]));
        let ridge = match highest {
            Some(highest) => Ridge::at(model, modes, line[highest], settings)?,
            None => None,
        };
        tongues.extend(ridge.map(|ridge| Tongue {
            edges: [line[first], line[last]],
            ridge,
        }));
    }
    Ok(tongues)
}

fn growth(model: &InPhase, span: f64, tolerance: f64) -> Result<Growth, Failure> {
    Ok(Growth {
        frequency_hz: frequency_at_rest(&first_sector(model)?),
        horizons: vec![span],
        tolerance,
    })
}

impl Ridge {
    /// Looks at one release over a time, with a tolerance; none for a chaotic motion,
    /// which has no frequencies.
    ///
    /// # Errors
    /// [`Failure::Growth`] or [`Failure::Integration`].
    pub fn at(
        model: &InPhase,
        modes: &[NormalMode],
        release: [f64; 2],
        (span, tolerance): (f64, f64),
    ) -> Result<Option<Self>, Failure> {
        let start = (first_sector(model)?, at_rest(model, release[0], release[1]));
        let growth = growth(model, span, tolerance)?;
        let Some(grown) = growth.in_lanes(&Ensemble::new(), &[start]).pop() else {
            return Ok(None);
        };
        let grown = grown?;
        if !(grown.rate.is_determined() && grown.frequency_hz.is_determined()) {
            return Ok(None);
        }
        let modes = frequencies(model, modes, release, span)?;
        Ok(Some(Self {
            release,
            rate: grown.rate.value,
            effective: grown.frequency_hz.value,
            modes,
            resonance: Resonance::of(grown.frequency_hz.value, modes),
        }))
    }
}

impl Resonance {
    /// The lowest one that is close.
    fn of(effective: f64, [plus, minus]: [f64; 2]) -> Option<Self> {
        let all = -HIGHEST..=HIGHEST;
        let pairs = all.clone().flat_map(|n| all.clone().map(move |m| [n, m]));
        let even = pairs.filter(|[n, m]| (n + m) % 2 == 0 && n.abs() + m.abs() <= HIGHEST);
        let known = even.map(|numbers| {
            let [n, m] = numbers.map(f64::from);
            let mismatch = effective - 0.5 * (n * plus + m * minus);
            Self { numbers, mismatch }
        });
        let close = known.filter(|resonance| resonance.mismatch.abs() <= CLOSE);
        close.min_by_key(
            |Self {
                 numbers: [n, m], ..
             }| n.abs() + m.abs(),
        )
    }
}

/// Frequencies of an in-phase motion: turns of the parts of the modes in it.
fn frequencies(
    model: &InPhase,
    modes: &[NormalMode],
    release: [f64; 2],
    span: f64,
) -> Result<[f64; 2], Failure> {
    const LOOKS_A_SECOND: f64 = 50.0;
    let looks = (LOOKS_A_SECOND * span).ceil();
    let times = (0..=looks as usize).map(|k| k as f64 * span / looks);
    let times: Vec<f64> = times.collect();
    let start = State::at_rest(0.0, &release.map(f64::to_radians));
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let mut states = Vec::new();
    let run = method.sample(&AbsoluteAngles(model), &start, &times, |_, state| {
        states.push([[state[0], state[1]], [state[2], state[3]]]);
    });
    run.map_err(|error| Failure::integration(release[0], error))?;
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
