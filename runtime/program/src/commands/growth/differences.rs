//! Differences between copies beside their motions in phase.

use branched_pendulum::analysis::growth::{
    Grown, Growth, GrowthError, SectorDifferences, TransverseSystem, frequency_at_rest,
};
use branched_pendulum::analysis::variational::{ByTangents, Copies, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum_trees::PendulumTree;

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

/// Differences between copies beside a motion in phase, by dual numbers.
pub(in crate::commands) type DifferencesOf<'a> = SectorDifferences<
    ByTangents<
        AbsoluteAngles<&'a PendulumTree>,
        Dual<f64, 1>,
        AbsoluteAngles<PendulumTree<Dual<f64, 1>>>,
    >,
>;

/// Returns the differences between the first two `copies` of a tree, for one thread.
pub(in crate::commands) fn differences_of<'a>(
    tree: &'a PendulumTree,
    copies: &Copies,
) -> DifferencesOf<'a> {
    SectorDifferences::new(linearised(AbsoluteAngles(tree)), &copies.first_difference())
}

/// Growth of a difference between copies beside the motions in phase of one tree.
pub(in crate::commands) struct Differences<'a> {
    tree: &'a PendulumTree,
    copies: Copies,
    growth: Growth,
}

impl<'a> Differences<'a> {
    /// Returns the differences between the first two `copies` of a tree.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where a small difference does not oscillate about the tree at rest
    /// with all angles zero.
    pub(in crate::commands) fn new(
        tree: &'a PendulumTree,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let frequency_hz = frequency_at_rest(&differences_of(tree, copies));
        if frequency_hz.is_nan() || frequency_hz <= 0.0 {
            return Err(Failure::Lacking {
                what: "a small difference of the copies does not oscillate about the tree at rest \
                       with all angles zero: there is no frequency to look at its growth by"
                    .to_owned(),
            });
        }
        Ok(Self {
            tree,
            copies: copies.clone(),
            growth: Growth {
                frequency_hz,
                horizons,
                tolerance,
            },
        })
    }

    /// Returns the growth along the motion from each start, on all cores.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where the copies do not start alike.
    pub(in crate::commands) fn along(
        &self,
        starts: &[State<f64>],
    ) -> Result<Vec<Result<Grown, GrowthError>>, Failure> {
        let system = AbsoluteAngles(self.tree);
        let is_in_phase = |start| self.copies.are_in_phase(&system, start);
        if !starts.iter().all(is_in_phase) {
            return Err(Failure::Lacking {
                what: "the copies do not move alike: give them one angle and one rate by their \
                       common name, as in `--start child=10`, and nothing between them and other \
                       links that one of them lacks"
                    .to_owned(),
            });
        }
        // Memory of derivatives is of one thread: each start has its own.
        Ok(Ensemble::new().map(starts, |_, start| {
            self.growth
                .of_sector(&differences_of(self.tree, &self.copies), start)
        }))
    }

    pub(in crate::commands) fn frequency_hz(&self) -> f64 {
        self.growth.frequency_hz
    }

    /// Returns the rate (1/s) at which friction takes from the rate of a small difference at rest.
    pub(in crate::commands) fn decay(&self) -> f64 {
        let system = differences_of(self.tree, &self.copies);
        let (all, own) = (system.dimension() / 2, system.differences());
        let mut state = vec![0.0; 2 * all];
        state[2 * all - own..].fill(1.0);
        let mut rates = state.clone();
        system.rates(0.0, &state, &mut rates);
        -rates[2 * all - own..].iter().sum::<f64>() / own as f64
    }
}
