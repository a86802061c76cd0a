//! The threshold of the first branching, for trees given by a rule: 2 to 6 generations of rods, two
//! or three children per rod, and several ratios of masses and lengths.

use branched_pendulum::prelude::*;
use branched_pendulum_frame::Failure;
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

use super::arguments::Arguments;

/// A tree by rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Number of generations.
    pub generations: usize,
    /// Number of rods that hang from each rod.
    pub copies: u32,
    /// Mass of a rod divided by that of its parent.
    pub mass_ratio: f64,
    /// Length of a rod divided by that of its parent.
    pub length_ratio: f64,
}

impl Rule {
    /// Returns the description of a tree of two branches with the same motion, in which each branch
    /// is a chain: its generations in phase. In phase, k rods move like one rod with k times the
    /// mass; and differences of the first branching obey the equations of one of its subtrees, in
    /// which only the ratios of masses matter.
    pub fn description(&self) -> String {
        let mut below = String::new();
        for generation in (0..self.generations).rev() {
            let power = generation as i32;
            let together = f64::from(self.copies) * self.mass_ratio;
            // Half of the first generation is in each branch.
            let part = if generation == 0 { 1.0 } else { 0.5 };
            let mass = 0.12 * part * together.powi(power);
            let length = 0.3 * self.length_ratio.powi(power);
            let copies = if generation == 1 { " * 2" } else { "" };
            let rod = format!("rod{generation}: rod(mass = {mass:e}, length = {length:e})");
            below = match below.as_str() {
                "" => format!("{rod}{copies}"),
                below => format!("{rod} [{below}]{copies}"),
            };
        }
        format!("gravity = 9.80665, {below}")
    }
}

/// The threshold of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// The tree.
    pub rule: Rule,
    /// Smallest angle of the scan (degrees) at which the growth factor is reached; `None` if there
    /// is none.
    pub angle_deg: Option<f64>,
    /// False if the growth factor at that angle is not determined.
    pub determined: bool,
    /// Growth factor at the smallest angle of the scan.
    pub first_factor: f64,
}

/// Growth factor at an angle, and whether it is determined.
type Factor = (f64, bool);

/// Number of periods of the difference at rest over which growth is computed. It corresponds to 10
/// s of the paper's pendulum.
pub const PERIODS: f64 = 12.58;

/// Number of angles that are computed together.
const BLOCK: usize = 16;

/// Numbers of generations.
pub const GENERATIONS: [usize; 5] = [2, 3, 4, 5, 6];
/// Numbers of copies.
pub const COPIES: [u32; 2] = [2, 3];
/// Ratios of masses.
pub const MASSES: [f64; 3] = [0.25, 0.5, 1.0];
/// Ratios of lengths.
pub const LENGTHS: [f64; 3] = [0.5, 0.7, 1.0];

/// Computes the growth factors for releases from rest in which the root has each angle of the scan
/// and all others are vertical. Angles ascend and end soon after the threshold, since motions
/// beyond it are chaotic and expensive.
fn factors(rule: Rule, arguments: &Arguments) -> Result<Vec<Factor>, Failure> {
    let description = rule.description();
    let tree = PendulumTree::parse(&description);
    let tree = tree.map_err(|source| Failure::tree(&description, source))?;
    let copies = tree.all_copies();
    let growth = |horizons| {
        let growth = DifferenceGrowth::new(&tree, &copies, horizons, arguments.tolerance);
        growth.map_err(|source| Failure::tree(&description, source))
    };
    let frequency_hz = growth(Vec::new())?.growth().frequency_hz;
    let growth = growth(vec![PERIODS / frequency_hz])?;
    let release = |degrees: &f64| {
        let mut angles = vec![0.0; tree.links()];
        angles[0] = degrees.to_radians();
        State::at_rest(0.0, &angles)
    };
    let releases: Vec<State<f64>> = arguments.angles_deg.iter().map(release).collect();
    let mut factors: Vec<Factor> = Vec::new();
    for block in releases.chunks(BLOCK) {
        if factors.iter().any(|(factor, _)| *factor >= arguments.level) {
            break;
        }
        let grown = growth.in_lanes(&Ensemble::new(), block);
        let grown = grown.map_err(|source| Failure::tree(&description, source))?;
        // A motion that cannot be followed is not determined.
        factors.extend(grown.into_iter().map(|grown| {
            let factor = grown.ok().and_then(|grown| grown.factors.first().copied());
            factor.map_or((f64::INFINITY, false), |f| (f.value, f.is_determined()))
        }));
    }
    Ok(factors)
}

/// Finds the threshold of a tree.
///
/// # Errors
/// [`Failure`].
pub fn threshold(rule: Rule, arguments: &Arguments) -> Result<Threshold, Failure> {
    let factors = factors(rule, arguments)?;
    let first_factor = factors.first().map_or(f64::NAN, |(factor, _)| *factor);
    let both = arguments.angles_deg.iter().zip(&factors);
    let first = both
        .into_iter()
        .find(|(_, (factor, _))| *factor >= arguments.level);
    Ok(Threshold {
        rule,
        angle_deg: first.map(|(angle, _)| *angle),
        determined: first.is_none_or(|(_, (_, determined))| *determined),
        first_factor,
    })
}
