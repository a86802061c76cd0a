//! Differences between copies that otherwise move in phase.

use branched_pendulum::Positions;
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::system::Model;
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

use crate::Failure;
use crate::subject::Subject;

/// Command-line options that select the copies between which a difference grows.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub(super) struct PairArguments {
    /// names of the copies that differ; by default those nearest to the root. The links below them
    /// differ with them
    #[arg(verbatim_doc_comment, long, value_name = "LINK,LINK[,..]")]
    pair: Option<String>,
}

impl PairArguments {
    /// Returns true if the copies are named on the command line.
    pub(super) fn is_given(&self) -> bool {
        self.pair.is_some()
    }

    /// Returns the copies that differ.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if the tree has no copies, or if the named links are not copies.
    pub(super) fn copies(&self, subject: &Subject) -> Result<Copies, Failure> {
        let lacking = |what: String| Failure::Lacking { what };
        let links: Vec<usize> = match &self.pair {
            None => subject.tree.first_copies().ok_or_else(|| {
                lacking(format!(
                    "{} has no copies between which differences could grow: write equal subtrees \
                     once, with `* 2` or `generations(...)`",
                    subject.name
                ))
            })?,
            Some(names) => subject.all_links_named(names)?,
        };
        Copies::of_links(&subject.parents(), &[&links])
            .filter(|_| links.len() > 1)
            .ok_or_else(|| {
                let names = links
                    .iter()
                    .map(|link| subject.tree.names()[*link].as_str());
                let names: Vec<&str> = names.collect();
                lacking(format!(
                    "`--pair`: {} are not copies of each other",
                    names.join(", ")
                ))
            })
    }
}

/// Prepares the computation of the growth of a difference between the first two `copies` of a tree.
///
/// # Errors
/// [`Failure::Lacking`] if the copies do not stay in phase, or if a small difference does not
/// oscillate about the equilibrium with all angles zero.
pub(super) fn differences_of(
    tree: &PendulumTree,
    copies: &Copies,
    horizons: Vec<f64>,
    tolerance: f64,
) -> Result<DifferenceGrowth, Failure> {
    let differences = DifferenceGrowth::new(tree, copies, horizons, tolerance);
    let differences = differences.map_err(|_| no_motion_in_phase(tree, copies))?;
    let frequency_hz = differences.growth().frequency_hz;
    if frequency_hz.is_nan() || frequency_hz <= 0.0 {
        return Err(Failure::Lacking {
            what: format!(
                "a small difference of the copies does not oscillate about the tree with all \
                 angles zero: there is no frequency to look at its growth by{}",
                rest_apart(tree, copies)
            ),
        });
    }
    Ok(differences)
}

/// Smallest angle (rad) by which the equilibrium angles of copies differ if they count as
/// different.
const APART: f64 = 1e-6;

/// Describes the equilibrium of the tree if its copies have different angles there.
fn rest_apart(tree: &PendulumTree, copies: &Copies) -> String {
    let rest = tree.stable_equilibrium(&vec![0.0; tree.links()]).ok();
    let apart = rest.and_then(|rest| {
        let mut pairs = pairs(tree, copies);
        let angle = |link: usize| rest.theta.get(link).copied().unwrap_or(0.0);
        let [one, other] =
            pairs.find(|[one, other]| (angle(*one) - angle(*other)).abs() > APART)?;
        let [first, second] = [one, other].map(|link| angle(link).to_degrees());
        let [one, other] = [one, other].map(|link| &tree.names()[link]);
        Some(format!(
            ". The tree rests with its copies apart, `{one}` at {first:.2}° and `{other}` at \
             {second:.2}°, and in phase it is at most in an unstable equilibrium; `describe` \
             lists its rests"
        ))
    });
    apart.unwrap_or_default()
}

/// Returns pairs of links that are copies of each other: the first of each set with each of the
/// others.
fn pairs(tree: &PendulumTree, copies: &Copies) -> impl Iterator<Item = [usize; 2]> {
    let links = tree.links();
    let angles = copies.groups().iter().filter_map(move |group| {
        let (&first, others) = group.split_first()?;
        (first < links).then(|| others.iter().map(move |&other| [first, other]))
    });
    angles.flatten().collect::<Vec<_>>().into_iter()
}

/// Returns the error for copies that do not stay in phase when they start in phase, with the cause.
fn no_motion_in_phase(tree: &PendulumTree, copies: &Copies) -> Failure {
    let differing = pairs(tree, copies).find_map(|[one, other]| {
        let own = [one, other].map(|link| tree.properties_of(link));
        let [Some(first), Some(second)] = own else {
            return None;
        };
        let length = |end: [f64; 2]| f64::hypot(end[0], end[1]);
        let quantities = [
            ("mass", "kg", first.mass, second.mass),
            ("moment of inertia", "kg m²", first.inertia, second.inertia),
            (
                "distance of the centre of mass",
                "m",
                length(first.centre),
                length(second.centre),
            ),
            ("length", "m", length(first.end), length(second.end)),
            ("place of the pivot", "m", first.pivot[0], second.pivot[0]),
        ];
        // A length is more to the point than the inertia that follows from it.
        let found = quantities.iter().rev().find(|(.., a, b)| a != b)?;
        let &(quantity, unit, a, b) = found;
        let [one, other] = [one, other].map(|link| tree.names()[link].clone());
        Some(format!(
            "`{one}` and `{other}` differ by `each(…)` ({quantity} {a} and {b} {unit}): they do \
             not stay in phase when they start in phase, so that a small difference has no \
             equation of growth; help: give both the mean value, or see growth and forcing of W by \
             `simulate` and `transfer`, which know copies that differ"
        ))
    });
    let what = differing.unwrap_or_else(|| {
        "the copies do not stay in phase when they start in phase: a spring or friction acts \
         between one of them and other links, or differs between them; help: write \
         `siblings(NODE, ...)`, which acts between all copies"
            .to_owned()
    });
    Failure::Lacking { what }
}

/// Returns the error for copies that do not start in phase.
pub(in crate::commands) fn start_apart() -> Failure {
    Failure::Lacking {
        what: "the copies do not start in phase: give them the same angle and rate by their \
            common name, as in `--start child=10`"
            .to_owned(),
    }
}
