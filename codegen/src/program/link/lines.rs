//! Constants of the forces along lines between points, for a tree in loops.

use super::loop_tree::{LineConstants, LinePotentialConstants};
use crate::program::ConstantId;
use crate::program::lower::Lowering;
use crate::scene::{DescribedLinePotential, LinkId, Quantity, Scene, SpringLineRun};

impl Lowering<'_> {
    /// Returns the lines of a scene; lines with the same constants are combined.
    pub(super) fn line_constants(&mut self, scene: &Scene) -> Vec<LineConstants> {
        let mut found: Vec<LineConstants> = Vec::new();
        for SpringLineRun { first, count } in scene.line_runs() {
            let own = &scene.translational[first.spring_damper];
            let links = first.arms.iter().map(|(LinkId(link), _)| *link);
            let links: Vec<usize> = links.collect();
            let arms = first.arms.iter();
            let arms = arms.map(|(_, arm)| {
                [&arm.along, &arm.lateral].map(|component| self.quantity(component))
            });
            let arms: Vec<[ConstantId; 2]> = arms.collect();
            let potentials = own.potentials.iter();
            let constants = LineConstants {
                what: own.what.clone(),
                runs: Vec::new(),
                arms,
                offset: first.offset.each_ref().map(|part| self.quantity(part)),
                potentials: potentials
                    .map(|potential| self.line_potential(potential))
                    .collect(),
                friction: self.given(&own.friction),
            };
            match found.last_mut().filter(|last| last.is_like(&constants)) {
                Some(last) => last.runs.push((links, count)),
                None => found.push(LineConstants {
                    runs: vec![(links, count)],
                    ..constants
                }),
            }
        }
        found
    }

    fn line_potential(&mut self, potential: &DescribedLinePotential) -> LinePotentialConstants {
        match potential {
            DescribedLinePotential::Spring { stiffness, rest } => LinePotentialConstants::Spring {
                stiffness: self.quantity(stiffness),
                rest: self.given(rest),
            },
            DescribedLinePotential::InversePower { strength, exponent } => {
                LinePotentialConstants::InversePower {
                    strength: self.quantity(strength),
                    exponent: *exponent,
                }
            }
        }
    }

    fn given(&mut self, quantity: &Quantity) -> Option<ConstantId> {
        (!quantity.is_zero()).then(|| self.quantity(quantity))
    }
}
