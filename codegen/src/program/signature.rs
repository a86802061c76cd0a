//! Names, arguments and results of the functions of a model, by their purpose: the one
//! list of them, for models and for what stands in for a wrong one.

use super::entry::CANONICAL;
use super::{
    Argument, Cause, EnergyDefinition, Entry, EntryState, LinkFunction, PointKind, Purpose,
    ResultShape,
};
use crate::mechanics::{Counting, Mechanics};
use crate::scene::{Coordinate, CoordinateKind, LINK_PROPERTIES, ObservableForm, Scene};
use std::ops::RangeInclusive;

/// Orders that any truncated form has.
const ORDERS: RangeInclusive<u32> = 1..=8;

/// Name, arguments and result of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Its name.
    pub name: String,
    /// Arguments in order.
    pub arguments: Vec<Argument>,
    /// Shape of the result.
    pub shape: ResultShape,
}

/// Names that the functions of a model are called after, and lengths of their arrays.
#[derive(Clone, Debug)]
pub struct Naming {
    /// True if there is a drive: functions of all forces take the time then.
    pub driven: bool,
    /// Number of links.
    pub links: usize,
    /// Number of sectors.
    pub sectors: usize,
    /// Ends of the names of functions about one difference, transfer by transfer.
    pub places: Vec<String>,
    /// Sets of prescribed links: their names, and the number of links in each.
    pub prescribed: Vec<(String, usize)>,
    /// Names of observables, and whether symmetric coordinates are their variables.
    pub observables: Vec<(String, bool)>,
    /// Names of the sectors of small differences.
    pub transverse: Vec<String>,
}

impl Naming {
    pub(super) fn of(scene: &Scene, mechanics: &Mechanics) -> Self {
        let coordinates = &mechanics.coordinates;
        let is_difference = |c: &&Coordinate| matches!(c.kind, CoordinateKind::Difference { .. });
        let several = coordinates.iter().filter(is_difference).count() > 1;
        let place = |coordinate: usize| match several {
            true => format!("_{}", coordinates[coordinate].name),
            false => String::new(),
        };
        let transfers = mechanics.transfers.iter();
        let prescribed = scene.prescribed.iter();
        let observables = mechanics.observables.list.iter();
        let transverse = mechanics.transverse.iter().flat_map(|all| &all.sectors);
        Self {
            driven: mechanics.drive.is_some(),
            links: scene.links.len(),
            sectors: mechanics
                .sectors
                .as_ref()
                .map_or(0, |all| all.sectors.len()),
            places: transfers
                .map(|transfer| place(transfer.coordinate))
                .collect(),
            prescribed: prescribed
                .map(|set| (set.name.clone(), set.links.len()))
                .collect(),
            observables: observables.map(|o| (o.name.clone(), o.symmetric)).collect(),
            transverse: transverse.map(|of| of.sector.name.clone()).collect(),
        }
    }

    /// The function with a purpose.
    pub fn signature(&self, purpose: Purpose) -> Signature {
        use Argument::{
            Absolute, AbsoluteMomenta, Alpha, Constants, Coordinates, Difference, DifferenceRate,
            Forces, Given, Motion, Omega, Prescribed, Rates, SmallDifferences, SmallRates,
            SmallTorques, Symmetric, Theta, Time, Torques,
        };
        use Purpose as P;
        use ResultShape::{Arrays, Budget, Rows, Scalar, Transfer, Transfers, Vector};
        let plain = |name: &str, arguments: &[Argument], shape| Signature {
            name: name.to_owned(),
            arguments: arguments.to_vec(),
            shape,
        };
        let timed = |name: &str, arguments: &[Argument], shape| {
            let mut signature = plain(name, arguments, shape);
            if self.driven {
                signature.arguments.insert(0, Time);
            }
            signature
        };
        let of = |stem: &str, transfer: usize| format!("{stem}{}", self.places[transfer]);
        let (links, sectors) = (self.links, self.sectors);
        let canonical = CANONICAL.arguments();
        match purpose {
            P::Accelerations => timed("accelerations", &[Theta, Omega], Vector),
            P::AccelerationsUnder => timed("accelerations_under", &[Theta, Omega, Torques], Vector),
            P::Prescribed(set) => {
                let (name, count) = &self.prescribed[set];
                let name = format!("accelerations_prescribed_{name}");
                let arguments = [Theta, Omega, Torques, Prescribed(set)];
                timed(&name, &arguments, Arrays(links, *count))
            }
            P::TaylorCoefficients => timed("taylor_coefficients", &[Theta, Omega], Vector),
            P::KineticEnergy => plain("kinetic_energy", &[Theta, Omega], Scalar),
            P::PotentialEnergy => plain("potential_energy", &[Theta], Scalar),
            P::AbsoluteMomenta => plain("momenta", &[Theta, Omega], Vector),
            P::AbsoluteVelocities => plain("velocities", &[Theta, AbsoluteMomenta], Vector),
            P::CanonicalRates => {
                timed("canonical_rates", &[Theta, AbsoluteMomenta], Rows(2, links))
            }
            P::MassMatrix => plain("mass_matrix", &[Theta], Rows(links, links)),
            P::StiffnessMatrix => plain("stiffness_matrix", &[Theta], Rows(links, links)),
            P::ToSymmetric => plain("to_symmetric", &[Absolute], Vector),
            P::FromSymmetric => plain("from_symmetric", &[Symmetric], Vector),
            P::SymmetricAccelerations => {
                timed("symmetric_accelerations", &[Coordinates, Rates], Vector)
            }
            P::SymmetricMomenta => plain("symmetric_momenta", &[Coordinates, Rates], Vector),
            P::SymmetricVelocities => plain("symmetric_velocities", &canonical, Vector),
            P::Hamiltonian => plain("hamiltonian", &canonical, Scalar),
            P::SubHamiltonian(n) => plain(&of("antiphase_energy", n), &canonical, Scalar),
            P::AngleTransfer(n) => plain(&of("transfer_angle_1", n), &canonical, Transfer),
            P::AmplitudeTransfer(n) => plain(&of("transfer_amplitude_2", n), &canonical, Transfer),
            P::HigherTransfer(n, counting, order) => {
                let stem = format!("transfer_{}_{order}", counting.name());
                plain(&of(&stem, n), &canonical, Transfer)
            }
            P::QuadraticForm(n) => plain(&of("transfer_quadratic_form", n), &canonical, Vector),
            P::ExactTransfer(n, state) => {
                let stem = format!("transfer_exact{}", state.source());
                plain(&of(&stem, n), &state.arguments(), Transfer)
            }
            P::SplitTransfer(n, cause, state) => {
                let stem = format!("transfer_{}{}", cause.name(), state.source());
                plain(&of(&stem, n), &state.arguments(), Transfer)
            }
            P::FrictionPower(n) => plain(
                &of("antiphase_friction_power", n),
                &[Coordinates, Rates],
                Scalar,
            ),
            P::AntiphaseDrivePower(n) => {
                let arguments = [Time, Coordinates, Rates];
                plain(&of("antiphase_drive_power", n), &arguments, Scalar)
            }
            P::AntiphaseOutsidePower(n) => {
                let arguments = [Coordinates, Rates, Torques];
                plain(&of("antiphase_outside_power", n), &arguments, Scalar)
            }
            P::Budget(definition, state) => {
                let name = format!("{}budget_{}", state.prefix(), definition.name());
                timed(&name, &state.arguments(), Budget(sectors))
            }
            P::BudgetUnder(definition) => {
                let name = format!("budget_{}_under", definition.name());
                timed(&name, &[Theta, Omega, Torques], Budget(sectors))
            }
            P::SectorTransfers(state) => {
                let name = format!("{}sector_transfers", state.prefix());
                plain(&name, &state.arguments(), Transfers(sectors))
            }
            P::TruncatedSectorTransfers(counting, order) => {
                let name = format!("sector_transfers_{}_{order}", counting.name());
                plain(&name, &canonical, Transfers(sectors))
            }
            P::TransferMatrix(state) => {
                let name = format!("{}transfer_matrix", state.prefix());
                plain(&name, &state.arguments(), Rows(sectors, sectors))
            }
            P::Drive => plain("drive", &[Time], Vector),
            P::DrivePower => plain("drive_power", &[Time, Theta, Omega], Scalar),
            P::TotalFrictionPower => plain("friction_power", &[Omega], Scalar),
            P::OutsidePower => plain("outside_power", &[Omega, Torques], Scalar),
            P::Observable(number, form) => {
                let (name, symmetric) = &self.observables[number];
                let name = format!("{name}{}", form.name());
                let (motion, phase) = match symmetric {
                    true => (EntryState::Rates.arguments(), canonical),
                    false => (EntryState::Absolute.arguments(), [Theta, AbsoluteMomenta]),
                };
                let arguments = if form.is_from_momenta() {
                    phase
                } else {
                    motion
                };
                match form.is_rate() {
                    true => timed(&name, &arguments, Scalar),
                    false => plain(&name, &arguments, Scalar),
                }
            }
            P::Transverse(sector) => {
                let name = format!("transverse_accelerations_{}", self.transverse[sector]);
                let (delta, rate) = (Difference(sector), DifferenceRate(sector));
                timed(&name, &[Theta, Omega, Alpha, delta, rate], Vector)
            }
            P::TransverseEnergy(sector) => {
                let name = format!("transverse_energy_{}", self.transverse[sector]);
                let arguments = [Theta, Difference(sector), DifferenceRate(sector)];
                plain(&name, &arguments, Scalar)
            }
            P::TransverseTransfer(sector) => {
                let name = format!("transverse_transfer_{}", self.transverse[sector]);
                let (delta, rate) = (Difference(sector), DifferenceRate(sector));
                timed(&name, &[Theta, Omega, Alpha, delta, rate], Scalar)
            }
            P::TransverseFriction(sector, braked) => {
                let name = format!("transverse_friction_power_{}", self.transverse[sector]);
                // Viscous friction takes the rates of the differences alone.
                let arguments = [Omega, DifferenceRate(sector)];
                plain(&name, &arguments[usize::from(!braked)..], Scalar)
            }
            P::SmallAccelerations => {
                let arguments = [Theta, Omega, SmallDifferences, SmallRates];
                timed("small_accelerations", &arguments, Vector)
            }
            P::SmallAccelerationsUnder => {
                let motion = [Theta, Omega, SmallDifferences, SmallRates];
                let arguments = [&motion[..], &[Torques, SmallTorques]].concat();
                timed("small_accelerations_under", &arguments, Vector)
            }
            P::SmallEnergy => {
                let arguments = [Theta, Omega, SmallDifferences, SmallRates];
                plain("small_energy", &arguments, Scalar)
            }
            P::Positions(kind) => plain(&format!("{}s", kind.name()), &[Theta], Rows(links, 2)),
            P::PointVelocities(kind) => {
                let name = format!("{}_velocities", kind.name());
                plain(&name, &[Theta, Omega], Rows(links, 2))
            }
            P::PointTorques(kind) => plain(
                &format!("{}_torques", kind.name()),
                &[Theta, Forces],
                Vector,
            ),
            P::LinkProperties => plain("link_properties", &[], Rows(links, LINK_PROPERTIES.len())),
            P::Link(function) => {
                let own: &[Argument] = match function {
                    LinkFunction::Leaf => &[],
                    LinkFunction::Attach => &[Argument::Response],
                    LinkFunction::Inner => &[Argument::Sums],
                    LinkFunction::Pivot => &[Argument::Carried],
                    LinkFunction::Accelerate => &[Argument::Elimination, Argument::Pivot],
                    LinkFunction::AccelerateLeaf => &[Argument::Pivot],
                };
                plain(
                    function.name(),
                    &[&[Constants, Motion], own].concat(),
                    Vector,
                )
            }
            P::Scale(function) => {
                let arguments = [Constants, Motion, Given(function)];
                let given = usize::from(!function.given().is_empty());
                plain(function.name(), &arguments[..2 + given], Vector)
            }
            P::RootGravity => plain("root_gravity", &[], Vector),
            P::RootDrive => plain("root_drive", &[Time], Vector),
        }
    }
}

impl Naming {
    /// The functions that a tree which is written out may have, but for Taylor coefficients
    /// and small differences.
    pub fn purposes(&self) -> Vec<Purpose> {
        use Purpose as P;
        let mut all = vec![
            P::Accelerations,
            P::AccelerationsUnder,
            P::KineticEnergy,
            P::PotentialEnergy,
            P::AbsoluteMomenta,
            P::AbsoluteVelocities,
            P::CanonicalRates,
            P::MassMatrix,
            P::StiffnessMatrix,
            P::ToSymmetric,
            P::FromSymmetric,
            P::SymmetricAccelerations,
            P::SymmetricMomenta,
            P::SymmetricVelocities,
            P::Hamiltonian,
            P::DrivePower,
            P::TotalFrictionPower,
            P::OutsidePower,
            P::LinkProperties,
        ];
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
            all.extend([
                P::SubHamiltonian(transfer),
                P::QuadraticForm(transfer),
                P::FrictionPower(transfer),
                P::AntiphaseDrivePower(transfer),
                P::AntiphaseOutsidePower(transfer),
            ]);
            let truncated = orders.clone();
            all.extend(truncated.map(|(of, order)| P::HigherTransfer(transfer, of, order)));
            for state in [CANONICAL, EntryState::Rates] {
                all.push(P::ExactTransfer(transfer, state));
                all.extend(Cause::ALL.map(|cause| P::SplitTransfer(transfer, cause, state)));
            }
        }
        all.extend(orders.map(|(of, order)| P::TruncatedSectorTransfers(of, order)));
        for state in [EntryState::Absolute, EntryState::Rates] {
            all.extend([P::SectorTransfers(state), P::TransferMatrix(state)]);
            all.extend(EnergyDefinition::ALL.map(|definition| P::Budget(definition, state)));
        }
        all.extend(EnergyDefinition::ALL.map(P::BudgetUnder));
        for observable in 0..self.observables.len() {
            all.extend(ObservableForm::ALL.map(|form| P::Observable(observable, form)));
        }
        all
    }
}

impl Signature {
    /// The entry point with these outputs.
    pub(super) fn entry(self, purpose: Purpose, outputs: Vec<super::ValueId>) -> Entry {
        let Self {
            name,
            arguments,
            shape,
        } = self;
        Entry {
            name,
            purpose,
            arguments,
            outputs,
            shape,
        }
    }
}
