//! Growth that the resonant normal form predicts in the trees of the table, and its rate by
//! simulation.

use std::fmt::Write;

use branched_pendulum::analysis::normal_form::{
    NormalFormOptions, Prediction, Refusal, Tongue, Tongues,
};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_frame::{Failure, Job};
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree, TreeError};

use super::trees::Rule;

/// Settings of the normal forms. Degree 8 takes minutes for trees of four generations.
fn options() -> NormalFormOptions {
    NormalFormOptions {
        degree: 6,
        following: 20.0,
        ..NormalFormOptions::default()
    }
}

/// Distance between the angles of the root at which growth is predicted, degrees.
const STEP: f64 = 0.2;
/// Number of these angles.
const ANGLES: usize = 150;
/// Smallest growth rate that counts, 1/s.
const LEAST: f64 = 0.02;
/// Exponents by which the predicted growth begins and ends the simulation of its rate. At the
/// first one, parts of a difference that do not grow are small.
const EXPONENTS: [f64; 2] = [4.0, 9.0];
/// Tolerance of a step of the simulation.
const TOLERANCE: f64 = 1e-10;

/// Predictions for a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicted {
    /// The tree.
    pub rule: Rule,
    /// Largest angle of the root, in degrees, up to which each release has a prediction; zero if
    /// there is none.
    pub limit_deg: f64,
    /// Why there is no prediction at the next angle; `None` if all angles have one.
    pub refusal: Option<Refusal>,
    /// The tongues up to there, with their largest growth rate by simulation, in 1/s.
    pub tongues: Vec<(Tongue, f64)>,
}

/// Predicts growth between the first two branches of a tree by rule, for releases in which the root
/// has ascending angles and all other rods are vertical, up to the first one that is refused. Each
/// tongue is simulated at the angle where its rate is largest.
///
/// # Errors
/// [`TreeError`].
pub fn predicted(rule: Rule) -> Result<Predicted, TreeError> {
    let tree = PendulumTree::parse(&description(rule))?;
    let copies = tree.all_copies();
    let form = tree.normal_form(&copies, options())?;
    let mut predictions: Vec<(f64, Prediction)> = Vec::new();
    let mut refusal = None;
    for angle in (1..=ANGLES).map(|step| STEP * step as f64) {
        match form.predict(&at_rest(&tree, angle)) {
            Ok(prediction) => predictions.push((angle, prediction)),
            Err(reason) => {
                refusal = Some(reason);
                break;
            }
        }
    }
    let angles: Vec<f64> = predictions.iter().map(|(angle, _)| *angle).collect();
    let predict = |angle: f64| -> Result<Prediction, Refusal> {
        let known = predictions.iter().find(|(known, _)| *known == angle);
        match known {
            Some((_, prediction)) => Ok(prediction.clone()),
            None => form.predict(&at_rest(&tree, angle)),
        }
    };
    let found = Tongues::along(&angles, LEAST, predict);
    // Growth by one of the two degrees alone is no prediction either.
    let cut = found.refused.first();
    let limit_deg = match cut {
        Some(([from, _], _)) => from - STEP,
        None => angles.last().copied().unwrap_or(0.0),
    };
    refusal = cut.map(|(_, reason)| reason.clone()).or(refusal);
    let tongues = found.tongues.into_iter();
    let tongues = tongues.filter(|tongue| tongue.at <= limit_deg);
    let tongues = tongues.map(|tongue| {
        let rate = simulated_rate(&tree, &copies, &tongue)?;
        Ok((tongue, rate))
    });
    Ok(Predicted {
        rule,
        limit_deg,
        refusal,
        tongues: tongues.collect::<Result<_, TreeError>>()?,
    })
}

/// Returns the growth rate of a difference, in 1/s, by simulation; NaN if it is not determined.
fn simulated_rate(tree: &PendulumTree, copies: &Copies, tongue: &Tongue) -> Result<f64, TreeError> {
    let horizons = EXPONENTS.map(|exponent| exponent / tongue.largest.growth_rate.value);
    let differences = DifferenceGrowth::new(tree, copies, horizons.to_vec(), TOLERANCE)?;
    let grown = differences.in_lanes(&Ensemble::new(), &[at_rest(tree, tongue.at)])?;
    Ok(match grown.first() {
        Some(Ok(grown)) => match grown.factors.as_slice() {
            [first, last] if last.is_determined() => {
                (last.value / first.value).ln() / (horizons[1] - horizons[0])
            }
            _ => f64::NAN,
        },
        _ => f64::NAN,
    })
}

/// Returns the release in which the root has this angle, in degrees, and all other rods are
/// vertical.
fn at_rest(tree: &PendulumTree, root: f64) -> State<f64> {
    let mut angles = vec![0.0; tree.links()];
    angles[0] = root.to_radians();
    State::at_rest(0.0, &angles)
}

/// Returns the description of a tree of two branches, in which each chain of rods is the generations
/// of one branch in phase: k rods in phase move like one of k times the mass.
fn description(rule: Rule) -> String {
    let mut below = String::new();
    for generation in (0..rule.generations).rev() {
        let together = f64::from(1_u32 << generation.saturating_sub(1));
        let power = generation as i32;
        let mass = 0.12 * rule.pair_ratio().powi(power) * together;
        let length = 0.3 * rule.length_ratio.powi(power);
        let copies = if generation == 1 { " * 2" } else { "" };
        let rod = format!("rod{generation}: rod(mass = {mass:e}, length = {length:e})");
        below = match below.as_str() {
            "" => format!("{rod}{copies}"),
            below => format!("{rod} [{below}]{copies}"),
        };
    }
    format!("gravity = 9.80665, {below}")
}

/// Predicts, prints and writes the growth in all trees.
///
/// # Errors
/// [`Failure`].
pub fn run(rules: &[Rule], job: &Job) -> Result<(), Failure> {
    let progress = job.progress(rules.len());
    progress.begin("trees");
    let mut all = Vec::new();
    for rule in rules {
        if job.is_interrupted() {
            break;
        }
        let tree = predicted(*rule).map_err(|error| Failure::tree(&name(rule), error))?;
        progress.show_message(&name(rule));
        all.push(tree);
        job.take_interruption();
        progress.next();
    }
    job.print(&report(&all))?;
    let columns = [
        Column::new("copies", ""),
        Column::new("mass ratio", ""),
        Column::new("length ratio", ""),
        Column::new("generations", ""),
        Column::new("predicted up to", "degrees"),
        Column::new("lower edge", "degrees"),
        Column::new("upper edge", "degrees"),
        Column::new("at the largest rate", "degrees"),
        Column::new("growth rate", "1/s"),
        Column::new("growth rate by the degree before", "1/s"),
        Column::new("growth rate by simulation", "1/s"),
        Column::new("resonance", ""),
    ];
    job.csv("theory.csv", &columns, |csv| {
        let rows = all.iter().flat_map(|tree| {
            let tongues = tree.tongues.iter().map(Some);
            let none = tree.tongues.is_empty().then_some(None);
            tongues.chain(none).map(move |tongue| (tree, tongue))
        });
        rows.into_iter().try_for_each(|(tree, tongue)| {
            let rule = tree.rule;
            let numbers = match tongue {
                Some((tongue, simulated)) => {
                    let [from, to] = tongue.edges;
                    let rate = tongue.largest.growth_rate;
                    [
                        from.value,
                        to.value,
                        tongue.at,
                        rate.value,
                        rate.before,
                        *simulated,
                    ]
                }
                None => [f64::NAN; 6],
            };
            let name = tongue
                .and_then(|(tongue, _)| tongue.resonance())
                .map_or(String::new(), ToString::to_string);
            let head = [
                Cell::from(u64::from(rule.copies)),
                rule.mass_ratio.into(),
                rule.length_ratio.into(),
                (rule.generations as u64).into(),
                tree.limit_deg.into(),
            ];
            let numbers = numbers.map(Cell::from);
            csv.row(
                head.into_iter()
                    .chain(numbers)
                    .chain([Cell::from(name.as_str())]),
            )
        })
    })
}

/// Returns a line for each tree, with the reason where predictions end.
fn report(all: &[Predicted]) -> String {
    let mut text = format!(
        "Growth of differences of the first branching by the normal form of degree {}, from \
         {LEAST} 1/s on\n(root as released, all other rods vertical; rates at the largest one)\n",
        options().degree
    );
    for tree in all {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n{}: predicted up to {:.1}°",
            name(&tree.rule),
            tree.limit_deg
        );
        for (tongue, simulated) in &tree.tongues {
            let [from, to] = [0, 1].map(|side| match tongue.is_cut[side] {
                true => "open".to_owned(),
                false => format!("{:.2}°", tongue.edges[side].value),
            });
            let rate = tongue.largest.growth_rate;
            let simulated = match simulated.is_finite() {
                true => format!("{simulated:.4}"),
                false => "not determined".to_owned(),
            };
            let resonance = tongue
                .resonance()
                .map_or(String::new(), ToString::to_string);
            let _ = writeln!(
                text,
                "  {from} to {to}: {:.4} ± {:.4} 1/s at {:.1}°, by simulation {simulated}, {resonance}",
                rate.value,
                rate.error(),
                tongue.at
            );
        }
        if let Some(refusal) = &tree.refusal {
            let _ = writeln!(text, "  then: {refusal}");
        }
    }
    text
}

/// Returns the name of a tree in messages.
fn name(rule: &Rule) -> String {
    let Rule {
        generations,
        copies,
        mass_ratio,
        length_ratio,
    } = rule;
    format!(
        "{copies} copies, masses by {mass_ratio}, lengths by {length_ratio}, {generations} generations"
    )
}
