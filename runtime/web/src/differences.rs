//! Differences between copies: at the release, in the energies, and in the picture of the in-phase
//! motion.

use std::f64::consts::TAU;

use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{
    EnergyDefinition, StateInput, NonConservative, SectorBudget, SymmetricTree,
};
use branched_pendulum_trees::{PendulumTree, TreeError};

use crate::budget::Budget;
use crate::path::down_the_tree;

/// A tree with copies, in its symmetric coordinates. A scale is the generation in which copies
/// differ: scale s is the motion of the copies of generation s relative to each other, scale 0 the
/// motion that all copies have in common.
#[derive(Debug)]
pub(crate) struct Differences {
    symmetric: SymmetricTree<f64>,
    /// Scale of each sector (set of symmetric coordinates of one difference).
    scales: Vec<usize>,
    count: usize,
    workspace: Workspace<f64>,
    budget: SectorBudget<f64>,
}

impl Differences {
    /// Returns the differences of a tree.
    ///
    /// # Errors
    /// [`TreeError::NoCopies`] if the tree has no copies, and [`TreeError::CoupledSectors`] if
    /// springs couple the differences so that these have no separate energies.
    pub(crate) fn of(tree: &PendulumTree) -> Result<Self, TreeError> {
        let symmetric = tree.symmetric()?;
        let generations = down_the_tree(tree, 0, |above, _| above + 1);
        let sectors = symmetric.sectors().iter().enumerate();
        let scales = sectors.map(|(number, sector)| {
            let links = sector.coordinates().iter().flat_map(|own| own.weights());
            let scales = links.filter_map(|(link, _)| generations.get(*link));
            // Means of all links are no difference.
            scales.min().copied().filter(|_| number > 0).unwrap_or(0)
        });
        let scales: Vec<usize> = scales.collect();
        Ok(Self {
            count: scales.iter().max().ok_or(TreeError::NoCopies)? + 1,
            scales,
            symmetric,
            workspace: Workspace::new(),
            budget: SectorBudget::new(),
        })
    }

    /// Returns true if copies have different properties; there are no energies in Parseval's form
    /// then.
    pub(crate) fn are_of_unequal_copies(&self) -> bool {
        self.symmetric.has_unequal_copies()
    }

    /// Returns the energies of the scales, the power that each receives from the others, and the
    /// powers of the non-conservative torques `acting`.
    pub(crate) fn budget(
        &mut self,
        definition: EnergyDefinition,
        acting: &[NonConservative<'_, f64>],
        [theta, omega]: [&[f64]; 2],
    ) -> Budget {
        let given = StateInput::Absolute { theta, omega };
        let sums = &mut self.budget;
        self.symmetric
            .budget(&mut self.workspace, definition, acting, given, sums);
        let by_scale = |values: &[f64]| {
            let mut sums = vec![0.0; self.count];
            for (value, scale) in values.iter().zip(&self.scales) {
                if let Some(sum) = sums.get_mut(*scale) {
                    *sum += value;
                }
            }
            sums
        };
        Budget {
            energies: by_scale(&sums.energies),
            received: by_scale(&sums.transfers),
            powers: by_scale(&sums.powers),
        }
    }
}

/// Adds a difference to the angles of in-phase copies at every branching. It is added to every
/// difference coordinate: of two copies, one is turned by it and the other by the opposite angle.
pub(crate) fn set_apart(tree: &PendulumTree, difference: f64, angles: &mut [f64]) {
    let coordinates = tree
        .sectors()
        .iter()
        .skip(1)
        .flat_map(|own| own.coordinates());
    for coordinate in coordinates {
        let weights = coordinate.weights();
        let largest = weights
            .iter()
            .fold(0.0, |most: f64, own| most.max(own.1.abs()));
        for &(link, weight) in weights {
            if let Some(angle) = angles.get_mut(link) {
                *angle += difference * weight / largest;
            }
        }
    }
}

/// Returns the angles of the in-phase motion: copies have the mean of their angles, where full
/// turns are ignored.
pub(crate) fn in_phase_part(tree: &PendulumTree, theta: &[f64]) -> Vec<f64> {
    let mut angles = theta.to_vec();
    let means = tree.sectors().iter().take(1);
    for coordinate in means.flat_map(|sector| sector.coordinates()) {
        let links = coordinate.weights().iter().map(|(link, _)| *link);
        let own: Vec<f64> = links
            .clone()
            .filter_map(|link| theta.get(link).copied())
            .collect();
        let Some(&first) = own.first() else {
            continue;
        };
        let apart = own.iter().map(|angle| within_half_a_turn(angle - first));
        let mean = first + apart.sum::<f64>() / own.len() as f64;
        for link in links {
            if let Some(angle) = angles.get_mut(link) {
                *angle = mean;
            }
        }
    }
    angles
}

fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
