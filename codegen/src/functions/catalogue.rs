//! List of all functions and methods that a model may have.

use super::{
    CANONICAL, Cause, Counting, Differentiated, EnergyDefinition, EntryState, Naming,
    NormalFormFunction, ObservableForm, PointKind, Purpose,
};
use std::ops::RangeInclusive;

/// Orders of the truncated forms.
const ORDERS: RangeInclusive<u32> = 1..=8;

impl Naming {
    /// Returns the purposes of all functions that a tree may have if its code is written out link
    /// by link.
    pub fn purposes(&self) -> Vec<Purpose> {
        use Purpose as P;
        let is_of_loops =
            |purpose: &P| matches!(purpose, P::RootGravity | P::RootDrive | P::DrivePullback);
        let mut all = P::singles();
        all.retain(|purpose| !is_of_loops(purpose));
        all.extend((0..self.prescribed.len()).map(P::Prescribed));
        all.extend(NormalFormFunction::ALL.map(P::NormalForm));
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
        let differentiated = all.clone().into_iter().filter_map(Differentiated::of);
        all.extend(differentiated.map(P::Gradient));
        for observable in 0..self.observables.len() {
            all.extend(ObservableForm::ALL.map(|form| P::Observable(observable, form)));
        }
        all
    }
}

/// Names of the models' methods that no purpose describes: methods of traits and constructors. The
/// test `they_have_the_functions_and_traits_of_models` finds methods of traits that are missing
/// here.
#[rustfmt::skip]
const OTHER_METHODS: &[&str] = &[
    "accelerations_into", "accelerations_under_into", "canonical_rates_into", "cast",
    "check_parameters", "children", "clone", "compute", "compute_with", "default", "energy_of", "eq",
    "evaluate", "fmt", "from", "from_parameters_unchecked", "into", "kinetic_energy_of",
    "link_body", "link_name", "link_names", "links", "new", "on", "part", "point_torques",
    "point_torques_into", "point_velocities", "point_velocities_into", "points", "points_into",
    "potential_energy_of", "prescribed_links", "properties_of", "sectors", "small_accelerations_into",
    "small_accelerations_under_into", "small_energy_of", "stands",
    "symmetric_accelerations_into", "symmetric_momenta_into", "taylor_coefficients_into",
    "taylor_coefficients_of", "taylor_workspace", "transfers_into",
    "transverse_accelerations_into", "transverse_energy_of", "transverse_friction_power_of",
    "transverse_transfer_of", "with_parameters",
];

/// Returns true if some model has a method with this name.
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
