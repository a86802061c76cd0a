//! The threshold of the first branching, for trees given by a rule: 2 to 6 generations of rods, two
//! or three children per rod, and several ratios of masses and lengths.

use branched_pendulum::Transverse;
use branched_pendulum::analysis::growth::{Growth, frequency_at_rest};
use branched_pendulum::prelude::*;

use super::arguments::Arguments;
use branched_pendulum::system::TransverseOde;
use branched_pendulum_frame::Failure;

/// Trees of `generations` generations with all copies in phase and two children per rod.
macro_rules! trees {
    ($($name:ident, $parameters:ident, $count:tt;)*) => {
        $(
            /// A tree of rods with all copies in phase.
            #[branched_pendulum(
                gravity = 9.80665,
                tree: generations(count = $count, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                    mass_ratio = mass_ratio, length_ratio = length_ratio),
                in_phase(tree),
                emit(transverse),
            )]
            pub struct $name;
        )*

        /// Numbers of generations.
        pub const GENERATIONS: &[usize] = &[$($count),*];

        fn factors(rule: Rule, arguments: &Arguments) -> Result<Vec<Factor>, Failure> {
            let mass_ratio = rule.pair_ratio();
            match rule.generations {
                $($count => {
                    let parameters = $parameters { mass_ratio, length_ratio: rule.length_ratio };
                    along(&$name::new(parameters)?, arguments)
                })*
                _ => Ok(Vec::new()),
            }
        }
    };
}

trees! {
    Two, TwoParameters, 2;
    Three, ThreeParameters, 3;
    Four, FourParameters, 4;
    Five, FiveParameters, 5;
    Six, SixParameters, 6;
}

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
    /// Returns the ratio of masses of the tree with two children per rod that has the same motion.
    /// In phase, k copies move like one rod with k times the mass; and differences of the first
    /// branching obey the equations of one of its subtrees, in which only the ratios of masses
    /// matter.
    pub fn pair_ratio(&self) -> f64 {
        self.mass_ratio * f64::from(self.copies) / 2.0
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

/// Numbers of copies.
pub const COPIES: [u32; 2] = [2, 3];
/// Ratios of masses.
pub const MASSES: [f64; 3] = [0.25, 0.5, 1.0];
/// Ratios of lengths.
pub const LENGTHS: [f64; 3] = [0.5, 0.7, 1.0];

/// Returns the equations of differences of the first branching.
fn first_branching<P: Transverse<f64>>(model: &P) -> Result<TransverseOde<&P>, Failure> {
    TransverseOde::new(model, 0).ok_or(Failure::NoPair)
}

/// Returns a release from rest in which all rods except the root are vertical, with a unit
/// difference in all rods of the branching.
fn at_rest<P: Transverse<f64>>(ode: &TransverseOde<&P>, model: &P, root: f64) -> State<f64> {
    let mut angles = vec![0.0; model.links()];
    angles[0] = root.to_radians();
    angles.resize(model.links() + ode.sector().links, 1.0);
    State::at_rest(0.0, &angles)
}

/// Computes the growth factors for releases from rest in which the root has each angle of the scan
/// and all others are vertical. Angles ascend and end soon after the threshold, since motions
/// beyond it are chaotic and expensive.
fn along<P: Transverse<f64> + Sync>(
    model: &P,
    arguments: &Arguments,
) -> Result<Vec<Factor>, Failure> {
    let ode = first_branching(model)?;
    let releases = arguments.angles_deg.iter();
    let releases: Vec<_> = releases
        .map(|degrees| (ode, at_rest(&ode, model, *degrees)))
        .collect();
    let frequency_hz = frequency_at_rest(&ode);
    let growth = Growth {
        frequency_hz,
        horizons: vec![PERIODS / frequency_hz],
        tolerance: arguments.tolerance,
    };
    let mut factors: Vec<Factor> = Vec::new();
    for block in releases.chunks(BLOCK) {
        if factors.iter().any(|(factor, _)| *factor >= arguments.level) {
            break;
        }
        let grown = growth.in_lanes(&Ensemble::new(), block).into_iter();
        // A motion that cannot be followed is not determined.
        factors.extend(grown.map(|grown| {
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
