//! Tongues of instability along lines through the plane: where the growth rate is largest, and the
//! frequencies there.

use std::fmt::Write;

use branched_pendulum::analysis::growth::turns_a_second;
use branched_pendulum::prelude::*;
use branched_pendulum_measure::CombinationTone;

use super::normal_modes::InPhaseModes;
use super::rates::Rates;
use crate::Failure;
use crate::commands::plane::Point;
use crate::frame::windows::windows;

/// A tongue of instability on a line.
pub(super) struct Tongue {
    /// First and last point of the line from which differences grow.
    edges: [Point; 2],
    /// The place of largest growth.
    place: Point,
    /// Growth rate there, 1/s.
    rate: f64,
    /// Frequency of the difference, in turns per second, f_eff (Hz).
    effective: f64,
    /// Frequencies of the in-phase motion, one for each of its linear modes, in Hz.
    modes: Vec<f64>,
    /// The resonance with a mismatch of at most [`CLOSE`], if there is one.
    resonance: Option<Resonance>,
}

/// A resonance f_eff = Σ n f/2 with an even Σ n, where f are the frequencies of the in-phase
/// motion.
struct Resonance {
    tone: CombinationTone,
    /// Mismatch f_eff − Σ n f/2, in Hz.
    mismatch: f64,
}

/// Largest mismatch at which frequencies count as resonant, in Hz.
const CLOSE: f64 = 2e-3;

/// Largest Σ |n|.
const HIGHEST: u32 = 4;

/// Time over which frequencies are measured, relative to the duration of the map's motions.
const SPANS: f64 = 8.0;

/// Growth rate (1/s) from which on a point counts as unstable.
const LEAST: f64 = 0.02;

/// Finds the tongues along a line; there are none where the motion is chaotic.
///
/// # Errors
/// [`Failure`].
pub(super) fn along(rates: &Rates<'_>, line: &[Point]) -> Result<Vec<Tongue>, Failure> {
    let span = SPANS * rates.duration;
    let grown = rates.within(span, line)?;
    let rate = |index: usize| grown[index].as_ref().map_or(0.0, |own| own.rate.value);
    let mut tongues = Vec::new();
    for [first, last] in windows(line.len(), |index| rate(index) >= LEAST) {
        let highest = (first..=last).max_by(|a, b| rate(*a).total_cmp(&rate(*b)));
        let Some((place, Some(grown))) = highest.map(|index| (line[index], &grown[index])) else {
            continue;
        };
        // A chaotic motion has no frequencies.
        if !(grown.rate.is_determined() && grown.frequency_hz.is_determined()) {
            continue;
        }
        let effective = grown.frequency_hz.value;
        let modes = frequencies(rates, place, span)?;
        tongues.push(Tongue {
            edges: [line[first], line[last]],
            place,
            rate: grown.rate.value,
            effective,
            resonance: Resonance::of(effective, &modes),
            modes,
        });
    }
    Ok(tongues)
}

impl Resonance {
    /// Returns the lowest-order resonance that is close enough.
    fn of(effective: f64, modes: &[f64]) -> Option<Self> {
        let tone = CombinationTone::find(2.0 * effective, modes, HIGHEST, 2.0 * CLOSE)?;
        let sum = tone.multiples.iter().zip(modes);
        let sum: f64 = sum.map(|(n, f)| f64::from(*n) * f).sum();
        let is_even = tone.multiples.iter().sum::<i32>() % 2 == 0;
        is_even.then_some(Self {
            mismatch: effective - 0.5 * sum,
            tone,
        })
    }
}

/// Measures the frequencies of an in-phase motion: the turns per second of its component in each
/// mode.
fn frequencies(rates: &Rates<'_>, place: Point, span: f64) -> Result<Vec<f64>, Failure> {
    const LOOKS_A_SECOND: f64 = 50.0;
    let looks = (LOOKS_A_SECOND * span).ceil();
    let times: Vec<f64> = (0..=looks as usize)
        .map(|k| k as f64 * span / looks)
        .collect();
    let tree = rates.plane.tree_at(&place)?;
    let modes = InPhaseModes::of(&tree)?;
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let mut states = Vec::new();
    let start = rates.plane.start_at(&place);
    let run = method.sample(&AbsoluteAngles(&tree), &start, &times, |_, state| {
        let (theta, omega) = state.split_at(state.len() / 2);
        states.push((modes.coordinates(theta), modes.rates(omega)));
    });
    run.map_err(|error| Failure::Motion(Box::new(error)))?;
    let both = modes.frequencies_hz().iter().enumerate();
    let found = both.map(|(mode, frequency_hz)| {
        let pace = std::f64::consts::TAU * frequency_hz;
        let points = states.iter().map(|(coordinates, rates)| {
            (
                modes.part(mode, coordinates),
                modes.part(mode, rates) / pace,
            )
        });
        turns_a_second(&times, points)
    });
    Ok(found.collect())
}

/// Returns a table of the points at which differences grow most, with the frequencies of the modes
/// there.
pub(super) fn text(rates: &Rates<'_>) -> String {
    let Some(first) = rates.tongues.first() else {
        return String::new();
    };
    let [x, y] = rates.plane.names();
    let names: Vec<String> = (1..=first.modes.len()).map(|n| format!("f_{n}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut text = format!(
        "\nTongues of instability on lines across the plane: where differences grow most, over {} s\n  \
         {y:20}  {x:24}  rate 1/s  f_eff Hz",
        SPANS * rates.duration
    );
    for name in &names {
        let _ = write!(text, "{:>10}", format!("{name} Hz"));
    }
    text.push_str("  resonance\n");
    let mut worst = (0, 0.0_f64);
    for tongue in &rates.tongues {
        let [from, to] = tongue.edges;
        let [x, y] = [0, 1].map(|axis| {
            let words = |value: f64| rates.plane.words(axis, value);
            match words(tongue.place[axis]) {
                place if from[axis] == to[axis] => place,
                place => format!("{place} ({} to {})", words(from[axis]), words(to[axis])),
            }
        });
        let resonance = match &tongue.resonance {
            None => "-".to_owned(),
            Some(Resonance { tone, mismatch }) => {
                if tone.multiples == [1, 1] {
                    worst = (worst.0 + 1, worst.1.max(mismatch.abs()));
                }
                format!("f_eff − ({})/2 = {mismatch:.0e} Hz", tone.named(&names))
            }
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "  {y:20}  {x:24}  {:8.4}  {:8.5}",
            tongue.rate, tongue.effective
        );
        for frequency in &tongue.modes {
            let _ = write!(text, "  {frequency:8.5}");
        }
        let _ = writeln!(text, "  {resonance}");
    }
    if let (count @ 1.., most) = worst {
        let _ = writeln!(
            text,
            "At {count} places |f_eff − (f_1 + f_2)/2| is {most:.1e} Hz at most: twice the frequency \
             of the\ndifference is the sum of those of the two modes"
        );
    }
    text
}
