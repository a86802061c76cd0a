//! Entry points that work on means and differences: the motion of nested trees
//! in symmetric coordinates, and the budgets of sectors.

use super::entries::EntryList;
use super::entry_state::{self, CANONICAL, EntryState, motion, symmetric_tree, values};
use super::symmetric::{
    ConstantValues, Fields, SectorId, Share, SymmetricField, SymmetricMotion, SymmetricTree,
    TruncatedSeries, orbits,
};
use super::{Argument, EnergyDefinition, Purpose, Shape, ValueId};
use crate::mechanics::{Counting, Mechanics, OrbitMechanics};
use crate::scene::{BudgetRequest, Scene};

impl EntryList<'_, '_> {
    /// Motion and momenta in symmetric coordinates, as [`EntryList::symmetric`]
    /// gives them for flat trees.
    pub(super) fn symmetric_of_nested(&mut self, scene: &Scene, sectors: &OrbitMechanics) {
        use Argument::{Coordinates, Momenta, Rates};
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, &orbits, None);
        let motion = motion(&mut tree, scene, mechanics, &values, EntryState::Rates);
        let [conservative, other] = tree.accelerations(&values, &motion);
        let accelerations = tree.sum(&conservative, &other);
        let accelerations = by_coordinate(
            &mut tree,
            mechanics,
            &accelerations,
            SymmetricTree::component,
        );
        let momenta = by_coordinate(
            &mut tree,
            mechanics,
            &motion.momenta,
            SymmetricTree::projected,
        );
        let requests = &scene.requests;
        let canonical = requests.momenta.then(|| {
            let motion = entry_state::motion(&mut tree, scene, mechanics, &values, CANONICAL);
            let hamiltonian = requests.energies.then(|| {
                let energy = tree.hamiltonian(&values, &motion);
                tree.series.total(&energy)
            });
            let velocities = by_coordinate(
                &mut tree,
                mechanics,
                &motion.rates,
                SymmetricTree::component,
            );
            (hamiltonian, velocities)
        });
        for (index, &value) in accelerations.iter().enumerate() {
            let name = format!("alpha_{}", mechanics.coordinates[index].name);
            self.lowering.builder.name(value, &name);
        }
        self.push(
            "symmetric_accelerations",
            Purpose::SymmetricAccelerations,
            &self.timed(&[Coordinates, Rates]),
            accelerations,
            Shape::Vector,
        );
        let Some((hamiltonian, velocities)) = canonical else {
            return;
        };
        self.push(
            "symmetric_momenta",
            Purpose::SymmetricMomenta,
            &[Coordinates, Rates],
            momenta,
            Shape::Vector,
        );
        if let Some(energy) = hamiltonian {
            self.push(
                "hamiltonian",
                Purpose::Hamiltonian,
                &[Coordinates, Momenta],
                vec![energy],
                Shape::Scalar,
            );
        }
        self.push(
            "symmetric_velocities",
            Purpose::SymmetricVelocities,
            &[Coordinates, Momenta],
            velocities,
            Shape::Vector,
        );
    }

    /// Budgets of the sectors, from absolute angles and, where those are asked
    /// for, from symmetric coordinates.
    pub(super) fn budgets(
        &mut self,
        scene: &Scene,
        sectors: &OrbitMechanics,
        request: &BudgetRequest,
    ) {
        let mut states = vec![EntryState::Absolute];
        if scene.requests.symmetric {
            states.push(EntryState::Rates);
        }
        for state in states {
            self.exact_budgets(scene, sectors, request, state, false);
        }
        if scene.requests.forces {
            self.exact_budgets(scene, sectors, request, EntryState::Absolute, true);
        }
        for &order in &request.angle_orders {
            self.truncated_transfers(scene, sectors, Counting::Angle, order);
        }
        for &order in &request.amplitude_orders {
            self.truncated_transfers(scene, sectors, Counting::Amplitude, order);
        }
    }

    fn exact_budgets(
        &mut self,
        scene: &Scene,
        sectors: &OrbitMechanics,
        request: &BudgetRequest,
        state: EntryState,
        under: bool,
    ) {
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, &orbits, None);
        let mut motion = motion(&mut tree, scene, mechanics, &values, state);
        if under {
            let outside = entry_state::outside_torques(&mut tree, scene);
            motion.forces = tree.sum(&motion.forces, &outside);
        }
        let ids: Vec<SectorId> = sectors
            .sectors
            .iter()
            .map(|sector| sector.difference)
            .collect();
        let count = ids.len();
        let mut found: Vec<(&str, Purpose, Vec<ValueId>, Shape)> = Vec::new();
        let mut shares = |tree: &mut SymmetricTree<'_>, name, definition, shares: Vec<Share>| {
            let outputs = flattened(tree, &shares);
            found.push((
                name,
                match under {
                    true => Purpose::BudgetUnder(definition),
                    false => Purpose::Budget(definition),
                },
                outputs,
                Shape::Budget(count),
            ));
        };
        for (wanted, name, definition, at_rest) in [
            (request.rest, "budget_rest", EnergyDefinition::Rest, true),
            (
                request.canonical,
                "budget_canonical",
                EnergyDefinition::Canonical,
                false,
            ),
        ] {
            if wanted {
                let all = ids
                    .iter()
                    .map(|&sector| tree.canonical_share(&values, &motion, sector, at_rest))
                    .collect();
                shares(&mut tree, name, definition, all);
            }
        }
        if request.velocity || request.parseval {
            let [conservative, other] = tree.accelerations(&values, &motion);
            let accelerations = [&conservative, &other];
            if request.velocity {
                let all = ids
                    .iter()
                    .map(|&sector| tree.velocity_share(&values, &motion, sector, accelerations))
                    .collect();
                shares(
                    &mut tree,
                    "budget_velocity",
                    EnergyDefinition::Velocity,
                    all,
                );
            }
            if request.parseval {
                let all = tree.parseval_shares(&values, &motion, &ids, accelerations);
                shares(
                    &mut tree,
                    "budget_parseval",
                    EnergyDefinition::Parseval,
                    all,
                );
            }
        }
        if request.canonical && !under {
            let outputs = transfers(&mut tree, &values, &motion, &ids, |_| false);
            found.push((
                "sector_transfers",
                Purpose::SectorTransfers(None),
                outputs,
                Shape::Transfers(count),
            ));
        }
        if request.matrix && !under {
            let matrix = tree.transfer_matrix(&values, &motion, &ids);
            let outputs = matrix
                .iter()
                .flatten()
                .map(|value| tree.series.total(value))
                .collect();
            found.push((
                "transfer_matrix",
                Purpose::TransferMatrix,
                outputs,
                Shape::Rows(count),
            ));
        }
        for (name, purpose, outputs, shape) in found {
            let (name, mut arguments) = match state {
                EntryState::Absolute if under => (
                    format!("{name}_under"),
                    vec![Argument::Theta, Argument::Omega, Argument::Torques],
                ),
                EntryState::Absolute => (name.to_owned(), vec![Argument::Theta, Argument::Omega]),
                EntryState::Rates | EntryState::Momenta(_) => (
                    format!("symmetric_{name}"),
                    vec![Argument::Coordinates, Argument::Rates],
                ),
            };
            if matches!(purpose, Purpose::Budget(_) | Purpose::BudgetUnder(_)) {
                arguments = self.timed(&arguments);
            }
            self.push(&name, purpose, &arguments, outputs, shape);
        }
    }

    /// W of every sector through an order in all differences.
    fn truncated_transfers(
        &mut self,
        scene: &Scene,
        sectors: &OrbitMechanics,
        counting: Counting,
        order: u32,
    ) {
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, &orbits, Some(order as usize));
        let state = EntryState::Momenta(counting);
        let motion = motion(&mut tree, scene, mechanics, &values, state);
        let ids: Vec<SectorId> = sectors
            .sectors
            .iter()
            .map(|sector| sector.difference)
            .collect();
        let small = scene.requests.budget.as_ref();
        let small = small.map_or(&[][..], |budget| budget.small.as_slice());
        let loses = |sector: SectorId| {
            counting == Counting::Angle
                && sector.is_some_and(|id| small.is_empty() || small.contains(&id))
        };
        let outputs = transfers(&mut tree, &values, &motion, &ids, loses);
        let name = match counting {
            Counting::Angle => "angle",
            Counting::Amplitude => "amplitude",
        };
        self.push(
            &format!("sector_transfers_{name}_{order}"),
            Purpose::SectorTransfers(Some((counting, order))),
            &[Argument::Coordinates, Argument::Momenta],
            outputs,
            Shape::Transfers(ids.len()),
        );
    }
}

/// One value for each symmetric coordinate.
pub(super) fn by_coordinate<'b>(
    tree: &mut SymmetricTree<'b>,
    mechanics: &Mechanics,
    fields: &Fields,
    component: fn(&mut SymmetricTree<'b>, &SymmetricField, SectorId) -> TruncatedSeries,
) -> Vec<ValueId> {
    mechanics
        .coordinates
        .iter()
        .map(|coordinate| {
            let (orbit, sector) = coordinate.kind.orbit_and_difference();
            let value = component(tree, &fields[orbit], sector);
            tree.series.total(&value)
        })
        .collect()
}

/// Energies, then transfers, then powers.
fn flattened(tree: &mut SymmetricTree<'_>, shares: &[Share]) -> Vec<ValueId> {
    let parts: [fn(&Share) -> &TruncatedSeries; 3] = [
        |share| &share.energy,
        |share| &share.transfer,
        |share| &share.power,
    ];
    let mut outputs = Vec::new();
    for part in parts {
        outputs.extend(shares.iter().map(|share| tree.series.total(part(share))));
    }
    outputs
}

/// Kinetic and potential part of W, sector by sector. Where angles alone count,
/// K is meant through the order kept and differentiated then, so that its slope
/// in the differences has one order less.
fn transfers(
    tree: &mut SymmetricTree<'_>,
    values: &ConstantValues,
    motion: &SymmetricMotion,
    ids: &[SectorId],
    loses_an_order: impl Fn(SectorId) -> bool,
) -> Vec<ValueId> {
    let mut outputs = Vec::new();
    for &sector in ids {
        let parts = tree.transfer_parts(values, motion, sector);
        let slopes = if loses_an_order(sector) {
            tree.series.without_highest(&parts.slopes)
        } else {
            parts.slopes
        };
        let kinetic = tree.series.add(&slopes, &parts.kinetic);
        outputs.push(tree.series.total(&kinetic));
        outputs.push(tree.series.total(&parts.potential));
    }
    outputs
}
