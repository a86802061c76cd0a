//! Differences between copies beside their motions in phase.

use branched_pendulum::analysis::growth::{
    Grown, Growth, GrowthError, TransverseSystem, frequency_at_rest,
};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::{InPhaseTree, PendulumTree};

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

/// Returns the differences between the first two `copies` of a tree beside its motion in phase.
///
/// # Errors
/// [`Failure::Lacking`] where the copies do not move alike.
pub(in crate::commands) fn differences_of(
    tree: &PendulumTree,
    copies: &Copies,
) -> Result<InPhaseTree, Failure> {
    let in_phase = tree.in_phase(copies).map_err(|_| out_of_phase())?;
    Ok(in_phase.with_differences())
}

fn out_of_phase() -> Failure {
    Failure::Lacking {
        what: "the copies do not move alike: give them one angle and one rate by their common \
               name, as in `--start child=10`, and nothing between them and other links that one \
               of them lacks"
            .to_owned(),
    }
}

/// Growth of a difference between copies beside the motions in phase of one tree.
pub(in crate::commands) struct Differences {
    system: InPhaseTree,
    growth: Growth,
}

impl Differences {
    /// Returns the differences between the first two `copies` of a tree.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where the copies do not move alike, and where a small difference does
    /// not oscillate about the tree at rest with all angles zero.
    pub(in crate::commands) fn new(
        tree: &PendulumTree,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let system = differences_of(tree, copies)?;
        let frequency_hz = frequency_at_rest(&system);
        if frequency_hz.is_nan() || frequency_hz <= 0.0 {
            return Err(Failure::Lacking {
                what: "a small difference of the copies does not oscillate about the tree at rest \
                       with all angles zero: there is no frequency to look at its growth by"
                    .to_owned(),
            });
        }
        Ok(Self {
            system,
            growth: Growth {
                frequency_hz,
                horizons,
                tolerance,
            },
        })
    }

    /// Returns the growth along the motion from each start, in lanes.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where the copies do not start alike.
    pub(in crate::commands) fn along(
        &self,
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
    ) -> Result<Vec<Result<Grown, GrowthError>>, Failure> {
        let releases = starts.iter().map(|start| {
            let start = self.system.start(start).ok_or_else(out_of_phase)?;
            Ok((&self.system, start))
        });
        let releases: Vec<_> = releases.collect::<Result<_, Failure>>()?;
        Ok(self.growth.in_lanes(ensemble, &releases))
    }

    pub(in crate::commands) fn frequency_hz(&self) -> f64 {
        self.growth.frequency_hz
    }

    /// Returns the rate (1/s) at which friction takes from the rate of a small difference at rest.
    pub(in crate::commands) fn decay(&self) -> f64 {
        let (all, own) = (self.system.dimension() / 2, self.system.differences());
        let mut state = vec![0.0; 2 * all];
        state[2 * all - own..].fill(1.0);
        let mut rates = state.clone();
        self.system.rates(0.0, &state, &mut rates);
        -rates[2 * all - own..].iter().sum::<f64>() / own as f64
    }
}
