//! Entry points that compute on means and differences of copies: the motion of nested copies in
//! symmetric coordinates, and the energy budgets of sectors (sets of symmetric coordinates: all
//! means, or one difference between copies).

use super::ValueId;
use super::entry_list::EntryList;
use super::entry_state::{self, motion, symmetric_tree, values};
use super::symmetric::{
    ConstantValues, Fields, SectorId, Share, SymmetricField, SymmetricMotion, SymmetricTree,
    TruncatedSeries,
};
use crate::functions::{CANONICAL, Counting, EnergyDefinition, EntryState, Purpose};
use crate::mechanics::{Mechanics, OrbitMechanics};
use crate::scene::{BudgetRequest, Scene};

impl EntryList<'_, '_> {
    /// Adds motion and momenta in symmetric coordinates, the counterpart of
    /// [`EntryList::symmetric`] for nested copies.
    pub(super) fn symmetric_of_nested(&mut self, scene: &Scene, sectors: &OrbitMechanics) {
        let mechanics = self.lowering.mechanics;
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, None);
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
        self.push(Purpose::SymmetricAccelerations, accelerations);
        let Some((hamiltonian, velocities)) = canonical else {
            return;
        };
        self.push(Purpose::SymmetricMomenta, momenta);
        if let Some(energy) = hamiltonian {
            self.push(Purpose::Hamiltonian, vec![energy]);
        }
        self.push(Purpose::SymmetricVelocities, velocities);
    }

    /// Adds the budgets of the sectors from absolute angles, and from symmetric coordinates if
    /// those are requested.
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
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, None);
        let mut motion = motion(&mut tree, scene, mechanics, &values, state);
        if under {
            let outside = entry_state::outside_torques(&mut tree, scene);
            motion.forces = tree.sum(&motion.forces, &outside);
        }
        let ids = sectors.differences();
        let budget = |definition| match under {
            true => Purpose::BudgetUnder(definition),
            false => Purpose::Budget(definition, state),
        };
        let mut shares = momentum_shares(&mut tree, request, &values, &motion, &ids);
        shares.extend(velocity_shares(&mut tree, request, &values, &motion, &ids));
        let found = shares.into_iter();
        let mut found: Vec<(Purpose, Vec<ValueId>)> = found
            .map(|(definition, outputs)| (budget(definition), outputs))
            .collect();
        if request.canonical && !under {
            let outputs = transfers(&mut tree, &values, &motion, &ids, |_| false);
            found.push((Purpose::SectorTransfers(state), outputs));
        }
        if request.matrix && !under {
            let matrix = tree.transfer_matrix(&values, &motion, &ids);
            let outputs = matrix.iter().flatten();
            let outputs = outputs.map(|value| tree.series.total(value)).collect();
            found.push((Purpose::TransferMatrix(state), outputs));
        }
        for (purpose, outputs) in found {
            self.push(purpose, outputs);
        }
    }

    /// Adds W of every sector, truncated at an order in all differences.
    fn truncated_transfers(
        &mut self,
        scene: &Scene,
        sectors: &OrbitMechanics,
        counting: Counting,
        order: u32,
    ) {
        let mechanics = self.lowering.mechanics;
        let values = values(self.lowering, sectors);
        let mut tree = symmetric_tree(self.lowering, Some(order as usize));
        let state = EntryState::Momenta(counting);
        let motion = motion(&mut tree, scene, mechanics, &values, state);
        let ids = sectors.differences();
        let small = scene.requests.budget.as_ref();
        let small = small.map_or(&[][..], |budget| budget.small.as_slice());
        let loses = |sector: SectorId| {
            counting == Counting::Angle
                && sector.is_some_and(|id| small.is_empty() || small.contains(&id))
        };
        let outputs = transfers(&mut tree, &values, &motion, &ids, loses);
        self.push(Purpose::TruncatedSectorTransfers(counting, order), outputs);
    }
}

/// Returns one value per symmetric coordinate.
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

/// Returns energies, then transfers, then powers.
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

/// Returns kinetic and potential part of W, sector by sector. If only angles count as small, K is
/// truncated at the given order and then differentiated, so that its slope in the differences has
/// one order less.
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

/// Returns the requested shares (energy, transfer and power of each sector) of the forms whose
/// energies depend on momenta.
fn momentum_shares(
    tree: &mut SymmetricTree<'_>,
    request: &BudgetRequest,
    values: &ConstantValues,
    motion: &SymmetricMotion,
    ids: &[SectorId],
) -> Vec<(EnergyDefinition, Vec<ValueId>)> {
    let mut found = Vec::new();
    for (wanted, definition) in [
        (request.rest, EnergyDefinition::Rest),
        (request.canonical, EnergyDefinition::Canonical),
    ] {
        if wanted {
            let at_rest = definition == EnergyDefinition::Rest;
            let shares: Vec<Share> = ids
                .iter()
                .map(|&sector| tree.canonical_share(values, motion, sector, at_rest))
                .collect();
            found.push((definition, flattened(tree, &shares)));
        }
    }
    found
}

/// Returns the requested shares (energy, transfer and power of each sector) of the forms whose
/// energies depend on velocities.
fn velocity_shares(
    tree: &mut SymmetricTree<'_>,
    request: &BudgetRequest,
    values: &ConstantValues,
    motion: &SymmetricMotion,
    ids: &[SectorId],
) -> Vec<(EnergyDefinition, Vec<ValueId>)> {
    let mut found = Vec::new();
    if !request.velocity && !request.parseval {
        return found;
    }
    let [conservative, other] = tree.accelerations(values, motion);
    let accelerations = [&conservative, &other];
    if request.velocity {
        let shares: Vec<Share> = ids
            .iter()
            .map(|&sector| tree.velocity_share(values, motion, sector, accelerations))
            .collect();
        found.push((EnergyDefinition::Velocity, flattened(tree, &shares)));
    }
    if request.parseval {
        let shares = tree.parseval_shares(values, motion, ids, accelerations);
        found.push((EnergyDefinition::Parseval, flattened(tree, &shares)));
    }
    found
}
