//! All functions and methods that models may have.

use super::{
    CANONICAL, Cause, Counting, EnergyDefinition, EntryState, Naming, ObservableForm, PointKind,
    Purpose,
};
use std::ops::RangeInclusive;

/// Orders that any truncated form has.
const ORDERS: RangeInclusive<u32> = 1..=8;

impl Naming {
    /// The functions that a tree which is written out may have.
    pub fn purposes(&self) -> Vec<Purpose> {
        use Purpose as P;
        let is_of_loops = |purpose: &P| matches!(purpose, P::RootGravity | P::RootDrive);
        let mut all = P::singles();
        all.retain(|purpose| !is_of_loops(purpose));
        all.extend((0..self.prescribed.len()).map(P::Prescribed));
        for kind in PointKind::ALL {
            all.extend([
                P::Positions(kind),
                P::PointVelocities(kind),
                P::PointTorques(kind),
            ]);
        }
        let orders = Counting::ALL
            .into_iter()
            .flat_map(|counting| ORDERS.map(move |order| (counting, order)));
        for transfer in 0..self.places.len() {
            all.extend([P::SubHamiltonian(transfer), P::QuadraticForm(transfer)]);
            let truncated = orders.clone();
            all.extend(truncated.map(|(of, order)| P::TruncatedTransfer(transfer, of, order)));
            for state in [CANONICAL, EntryState::Rates] {
                all.push(P::ExactTransfer(transfer, state));
                all.extend(Cause::ALL.map(|cause| P::SplitTransfer(transfer, cause, state)));
                all.extend([
                    P::AntiphaseFrictionPower(transfer, state),
                    P::AntiphaseDrivePower(transfer, state),
                    P::AntiphaseOutsidePower(transfer, state),
                ]);
            }
        }
        all.extend(orders.map(|(of, order)| P::TruncatedSectorTransfers(of, order)));
        for state in [EntryState::Absolute, EntryState::Rates] {
            all.extend([P::SectorTransfers(state), P::TransferMatrix(state)]);
            all.extend(EnergyDefinition::ALL.map(|definition| P::Budget(definition, state)));
        }
        all.extend(EnergyDefinition::ALL.map(P::BudgetUnder));
        for sector in 0..self.transverse.len() {
            all.extend([
                P::Transverse(sector),
                P::TransverseMotion(sector),
                P::TransverseEnergy(sector),
                P::TransverseTransfer(sector),
                P::TransverseFriction(sector, true),
            ]);
        }
        for observable in 0..self.observables.len() {
            all.extend(ObservableForm::ALL.map(|form| P::Observable(observable, form)));
        }
        all
    }
}

/// Methods of models that are no functions of a program: those of traits, and what makes a
/// model.
#[rustfmt::skip]
const OTHER_METHODS: &[&str] = &[
    "accelerations_into", "accelerations_under_into", "cast", "check_parameters", "children",
    "clone", "compute", "compute_with", "default", "degrees_of_freedom", "energy_of", "eq",
    "evaluate", "fmt", "from", "from_parameters_unchecked", "into", "kinetic_energy_of",
    "link_body", "link_name", "link_names", "links", "new", "on", "part", "point_torques",
    "point_torques_into", "point_velocities", "point_velocities_into", "points", "points_into",
    "potential_energy_of", "prescribed_links", "properties_of", "small_accelerations_into",
    "small_accelerations_under_into", "small_energy_of", "stands",
    "symmetric_accelerations_into", "symmetric_momenta_into", "taylor_coefficients_into",
    "taylor_coefficients_of", "taylor_workspace", "transfers_into", "with_parameters",
];

/// Returns true if models may have a method of that name, asked for or not.
pub fn is_method(name: &str) -> bool {
    let naming = Naming::any();
    let is_function = |purpose| {
        let function = naming.signature(purpose).name;
        match function.split_once('*') {
            Some((stem, _)) => name.starts_with(stem),
            None => name == function,
        }
    };
    OTHER_METHODS.contains(&name) || naming.purposes().into_iter().any(is_function)
}
