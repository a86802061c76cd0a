//! Entry points that work on means and differences: the motion of nested trees
//! in symmetric coordinates, and the budgets of sectors.

use super::copies::{Copies, Field, Fields, Motion, Series, Share, Values, Which, orbits};
use super::entries::EntryList;
use super::handed::{self, CANONICAL, State, copies, motion, values};
use super::{Argument, EnergyDefinition, Purpose, Shape, ValueId};
use crate::mechanics::{Counting, Mechanics, Sectors};
use crate::scene::{BudgetRequest, Scene};

impl EntryList<'_, '_> {
    /// Motion and momenta in symmetric coordinates, as [`EntryList::symmetric`]
    /// gives them for flat trees.
    pub(super) fn symmetric_by_copies(&mut self, scene: &Scene, sectors: &Sectors) {
        use Argument::{Coordinates, Momenta, Rates};
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut copies = copies(self.lowering, &orbits, None);
        let motion = motion(&mut copies, scene, mechanics, &values, State::Rates);
        let [conservative, other] = copies.accelerations(&values, &motion);
        let accelerations = copies.sum(&conservative, &other);
        let accelerations =
            by_coordinate(&mut copies, mechanics, &accelerations, Copies::component);
        let momenta = by_coordinate(&mut copies, mechanics, &motion.momenta, Copies::projected);
        let requests = &scene.requests;
        let canonical = requests.momenta.then(|| {
            let motion = handed::motion(&mut copies, scene, mechanics, &values, CANONICAL);
            let hamiltonian = requests.energies.then(|| {
                let energy = copies.hamiltonian(&values, &motion);
                copies.graded.total(&energy)
            });
            let velocities =
                by_coordinate(&mut copies, mechanics, &motion.rates, Copies::component);
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
    pub(super) fn budgets(&mut self, scene: &Scene, sectors: &Sectors, request: &BudgetRequest) {
        let mut states = vec![State::Absolute];
        if scene.requests.symmetric {
            states.push(State::Rates);
        }
        for state in states {
            self.exact_budgets(scene, sectors, request, state);
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
        sectors: &Sectors,
        request: &BudgetRequest,
        state: State,
    ) {
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut copies = copies(self.lowering, &orbits, None);
        let motion = motion(&mut copies, scene, mechanics, &values, state);
        let places: Vec<Which> = sectors.sectors.iter().map(|sector| sector.place).collect();
        let count = places.len();
        let mut found: Vec<(&str, Purpose, Vec<ValueId>, Shape)> = Vec::new();
        let mut shares = |copies: &mut Copies<'_>, name, definition, shares: Vec<Share>| {
            let outputs = flattened(copies, &shares);
            found.push((
                name,
                Purpose::Budget(definition),
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
                let all = places
                    .iter()
                    .map(|&which| copies.canonical_share(&values, &motion, which, at_rest))
                    .collect();
                shares(&mut copies, name, definition, all);
            }
        }
        if request.velocity || request.parseval {
            let [conservative, other] = copies.accelerations(&values, &motion);
            let accelerations = [&conservative, &other];
            if request.velocity {
                let all = places
                    .iter()
                    .map(|&which| copies.velocity_share(&values, &motion, which, accelerations))
                    .collect();
                shares(
                    &mut copies,
                    "budget_velocity",
                    EnergyDefinition::Velocity,
                    all,
                );
            }
            if request.parseval {
                let all = copies.parseval_shares(&values, &motion, &places, accelerations);
                shares(
                    &mut copies,
                    "budget_parseval",
                    EnergyDefinition::Parseval,
                    all,
                );
            }
        }
        if request.canonical {
            let outputs = transfers(&mut copies, &values, &motion, &places, |_| false);
            found.push((
                "sector_transfers",
                Purpose::SectorTransfers(None),
                outputs,
                Shape::Transfers(count),
            ));
        }
        if request.matrix {
            let matrix = copies.transfer_matrix(&values, &motion, &places);
            let outputs = matrix
                .iter()
                .flatten()
                .map(|value| copies.graded.total(value))
                .collect();
            found.push((
                "transfer_matrix",
                Purpose::TransferMatrix,
                outputs,
                Shape::Matrix(count),
            ));
        }
        for (name, purpose, outputs, shape) in found {
            let (name, mut arguments) = match state {
                State::Absolute => (name.to_owned(), vec![Argument::Theta, Argument::Omega]),
                State::Rates | State::Momenta(_) => (
                    format!("symmetric_{name}"),
                    vec![Argument::Coordinates, Argument::Rates],
                ),
            };
            if matches!(purpose, Purpose::Budget(_)) {
                arguments = self.timed(&arguments);
            }
            self.push(&name, purpose, &arguments, outputs, shape);
        }
    }

    /// W of every sector through an order in all differences.
    fn truncated_transfers(
        &mut self,
        scene: &Scene,
        sectors: &Sectors,
        counting: Counting,
        order: u32,
    ) {
        let mechanics = self.lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(self.lowering, sectors);
        let mut copies = copies(self.lowering, &orbits, Some(order as usize));
        let state = State::Momenta(counting);
        let motion = motion(&mut copies, scene, mechanics, &values, state);
        let places: Vec<Which> = sectors.sectors.iter().map(|sector| sector.place).collect();
        let small = scene.requests.budget.as_ref();
        let small = small.map_or(&[][..], |budget| budget.small.as_slice());
        let loses = |which: Which| {
            counting == Counting::Angle
                && which.is_some_and(|place| small.is_empty() || small.contains(&place))
        };
        let outputs = transfers(&mut copies, &values, &motion, &places, loses);
        let name = match counting {
            Counting::Angle => "angle",
            Counting::Amplitude => "amplitude",
        };
        self.push(
            &format!("sector_transfers_{name}_{order}"),
            Purpose::SectorTransfers(Some((counting, order))),
            &[Argument::Coordinates, Argument::Momenta],
            outputs,
            Shape::Transfers(places.len()),
        );
    }
}

/// One value for each symmetric coordinate.
pub(super) fn by_coordinate<'b>(
    copies: &mut Copies<'b>,
    mechanics: &Mechanics,
    fields: &Fields,
    component: fn(&mut Copies<'b>, &Field, Which) -> Series,
) -> Vec<ValueId> {
    mechanics
        .coordinates
        .iter()
        .map(|coordinate| {
            let (orbit, which) = coordinate.kind.place();
            let value = component(copies, &fields[orbit], which);
            copies.graded.total(&value)
        })
        .collect()
}

/// Energies, then transfers, then powers.
fn flattened(copies: &mut Copies<'_>, shares: &[Share]) -> Vec<ValueId> {
    let parts: [fn(&Share) -> &Series; 3] = [
        |share| &share.energy,
        |share| &share.transfer,
        |share| &share.power,
    ];
    let mut outputs = Vec::new();
    for part in parts {
        outputs.extend(shares.iter().map(|share| copies.graded.total(part(share))));
    }
    outputs
}

/// Kinetic and potential part of W, sector by sector. Where angles alone count,
/// K is meant through the order kept and differentiated then, so that its slope
/// in the differences has one order less.
fn transfers(
    copies: &mut Copies<'_>,
    values: &Values,
    motion: &Motion,
    places: &[Which],
    loses_an_order: impl Fn(Which) -> bool,
) -> Vec<ValueId> {
    let mut outputs = Vec::new();
    for &which in places {
        let parts = copies.transfer_parts(values, motion, which);
        let slopes = if loses_an_order(which) {
            copies.graded.without_highest(&parts.slopes)
        } else {
            parts.slopes
        };
        let kinetic = copies.graded.add(&slopes, &parts.kinetic);
        outputs.push(copies.graded.total(&kinetic));
        outputs.push(copies.graded.total(&parts.potential));
    }
    outputs
}
