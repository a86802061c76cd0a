//! Differences between copies beside their motions in phase.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

use crate::Failure;
use crate::subject::Subject;

/// Options that name the copies between which a difference grows.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub(in crate::commands) struct PairArguments {
    /// the copies that differ, by their names; those nearest to the root, unless they are
    /// named. Whatever hangs from them differs with them
    #[arg(verbatim_doc_comment, long, value_name = "LINK,LINK[,..]")]
    pair: Option<String>,
}

impl PairArguments {
    /// Returns true where copies are named.
    pub(in crate::commands) fn is_given(&self) -> bool {
        self.pair.is_some()
    }

    /// Returns the copies.
    ///
    /// # Errors
    /// [`Failure::Lacking`] for a tree without copies and for links that are none.
    pub(in crate::commands) fn copies(&self, subject: &Subject) -> Result<Copies, Failure> {
        let lacking = |what: String| Failure::Lacking { what };
        let links: Vec<usize> = match &self.pair {
            None => subject.first_copies().ok_or_else(|| {
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
                    "`--pair`: {} are no copies of each other",
                    names.join(", ")
                ))
            })
    }
}

/// Returns the growth of a difference between the first two `copies` of a tree.
///
/// # Errors
/// [`Failure::Lacking`] where the copies do not move alike, and where a small difference does
/// not oscillate about the tree at rest with all angles zero.
pub(in crate::commands) fn differences_of(
    tree: &PendulumTree,
    copies: &Copies,
    horizons: Vec<f64>,
    tolerance: f64,
) -> Result<DifferenceGrowth, Failure> {
    let differences = DifferenceGrowth::new(tree, copies, horizons, tolerance);
    let differences = differences.map_err(|_| out_of_phase())?;
    let frequency_hz = differences.growth().frequency_hz;
    if frequency_hz.is_nan() || frequency_hz <= 0.0 {
        return Err(Failure::Lacking {
            what: "a small difference of the copies does not oscillate about the tree at rest \
                   with all angles zero: there is no frequency to look at its growth by"
                .to_owned(),
        });
    }
    Ok(differences)
}

/// Returns the refusal of copies that do not move or start alike.
pub(in crate::commands) fn out_of_phase() -> Failure {
    Failure::Lacking {
        what: "the copies do not move alike: give them one angle and one rate by their common \
               name, as in `--start child=10`, and nothing between them and other links that one \
               of them lacks"
            .to_owned(),
    }
}
