//! Growth of small differences over the plane of releases.

use branched_pendulum::analysis::growth::{BetweenCopies, Growth};
use branched_pendulum::analysis::variational::{ByTangents, Copies, linearised};
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{AbsoluteAngles, Model, Positions, State};
use branched_pendulum_trees::PendulumTree;
use wasm_bindgen::prelude::wasm_bindgen;

/// A tree with its derivatives.
type LinearisedTree = ByTangents<
    AbsoluteAngles<PendulumTree>,
    Dual<f64, 1>,
    AbsoluteAngles<PendulumTree<Dual<f64, 1>>>,
>;

/// The plane of releases from rest of a tree with two equal branches: angle of the root, and
/// common angle of all that hangs from it.
#[wasm_bindgen]
#[derive(Debug)]
pub struct ReleaseMap {
    copies: BetweenCopies<LinearisedTree>,
    growth: Growth,
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

/// Returns a release from rest: angles of the root and of all other links (rad).
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
        let copies = BetweenCopies::new(linearised(AbsoluteAngles(tree.clone())), branches);
        let frequency = copies.frequency_at_rest();
        Ok(Self {
            growth: Growth {
                frequency_hz: frequency.ok_or("differences of the branches do not oscillate")?,
                horizons: vec![span],
                tolerance,
            },
            copies,
            links: tree.links(),
        })
    }
}

#[wasm_bindgen]
impl ReleaseMap {
    /// Returns the growth rate (1/s) of a small difference after a release from rest with the
    /// root and all other links at these angles (rad), and by how much it differs from that of a
    /// hundred times the tolerance, as a part of it; NaN where the motion could not be followed.
    pub fn rate(&self, root: f64, rest: f64) -> Vec<f64> {
        let start = in_phase(self.links, root, rest);
        match self.growth.between_copies(&self.copies, &start) {
            Ok(grown) => vec![grown.rate.value, grown.rate.difference],
            Err(_) => vec![f64::NAN; 2],
        }
    }
}
