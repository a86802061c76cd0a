//! Map of releases: growth of small differences, depending on the angles of release.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::system::{AbsoluteAngles, Model, Positions, State};
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};
use wasm_bindgen::prelude::wasm_bindgen;

/// Map of the releases from rest of a tree with two equal branches. Its axes are the angle of the
/// root and the common angle of all other links.
#[wasm_bindgen]
#[derive(Debug)]
pub struct ReleaseMap {
    differences: DifferenceGrowth,
    links: usize,
}

/// Returns the first two equal branches of a tree.
pub(crate) fn copies(tree: &PendulumTree) -> Option<Copies> {
    let parents: Vec<Option<usize>> = (0..tree.links())
        .map(|link| tree.properties_of(link)?.parent)
        .collect();
    let mut generations: Vec<f64> = Vec::with_capacity(parents.len());
    for parent in &parents {
        let above = parent.and_then(|parent| generations.get(parent));
        generations.push(above.map_or(0.0, |above| above + 1.0));
    }
    // A motion in phase like any other: what is equal in it is equal in all.
    let angles = generations.iter().map(|generation| 0.7 - 0.4 * generation);
    let rates = generations.iter().map(|generation| 0.3 + 0.5 * generation);
    let motion = State::new(0.0, angles.chain(rates).collect());
    let siblings = (0..parents.len()).flat_map(|one| {
        let others = one + 1..parents.len();
        others.map(move |other| [one, other])
    });
    let mut siblings =
        siblings.filter(|[one, other]| parents[*one].is_some() && parents[*one] == parents[*other]);
    siblings.find_map(|links| {
        let both = Copies::of_links(&parents, &[&links])?;
        both.are_in_phase(&AbsoluteAngles(tree), &motion)
            .then_some(both)
    })
}

/// Returns a state of release from rest with these angles of the root and of all other links (rad).
pub(crate) fn in_phase(links: usize, root: f64, rest: f64) -> State<f64> {
    let mut angles = vec![rest; links];
    if let Some(first) = angles.first_mut() {
        *first = root;
    }
    State::at_rest(0.0, &angles)
}

impl ReleaseMap {
    pub(crate) fn of(tree: &PendulumTree, span: f64, tolerance: f64) -> Result<Self, String> {
        let branches = copies(tree).ok_or("the map is one of a tree with two equal branches")?;
        let differences = DifferenceGrowth::new(tree, &branches, vec![span], tolerance);
        let differences = differences.map_err(|error| error.to_string())?;
        let frequency_hz = differences.growth().frequency_hz;
        if frequency_hz.is_nan() || frequency_hz <= 0.0 {
            return Err("differences of the branches do not oscillate".to_owned());
        }
        Ok(Self {
            differences,
            links: tree.links(),
        })
    }
}

#[wasm_bindgen]
impl ReleaseMap {
    /// Returns two numbers: the growth rate (1/s) of a small difference after a release from rest
    /// with the root and all other links at these angles (rad), and its relative change if the
    /// tolerance is a hundred times as large. NaN if the motion could not be integrated.
    pub fn rate(&self, root: f64, rest: f64) -> Vec<f64> {
        match self
            .differences
            .of_release(&in_phase(self.links, root, rest))
        {
            Ok(Ok(grown)) => vec![grown.rate.value, grown.rate.difference],
            _ => vec![f64::NAN; 2],
        }
    }
}
