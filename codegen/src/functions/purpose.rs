//! Purposes of functions: name, arguments and result of each, for models and for what stands
//! in for a wrong one.

use super::Argument::{
    self, Absolute, AbsoluteMomenta, Alpha, Body, Constants, Coordinates, Difference,
    DifferenceRate, Forces, Given, Motion, Omega, Rates, SmallDifferences, SmallRates,
    SmallTorques, Symmetric, Theta, Time, Torques,
};
use super::ResultShape::{Arrays, Budget, Rows, Scalar, Transfer, Transfers, Vector};
use super::{
    BodyFunction, CANONICAL, Cause, Counting, EnergyDefinition, EntryState, LINK_PROPERTIES,
    LinkFunction, Naming, ObservableForm, PointKind, ResultShape, ScaleFunction, Signature,
};

/// Declares the purposes, each with the signature of its function among those that `$naming`
/// gives names and lengths.
macro_rules! purposes {
    ($naming:ident: $($(#[$docs:meta])* $purpose:ident $(($($field:ident: $kind:ty),+))? => $signature:expr;)+) => {
        /// Purpose of a function; the emitter documents it accordingly.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Purpose {
            $($(#[$docs])* $purpose $(($($kind),+))?,)+
        }

        impl Purpose {
            /// Purposes of one function each.
            pub(super) fn singles() -> Vec<Self> {
                let all = [$(single!($purpose $(($($field),+))?)),+];
                all.into_iter().flatten().collect()
            }
        }

        impl Naming {
            /// The function with a purpose.
            pub fn signature(&self, purpose: Purpose) -> Signature {
                let $naming = self;
                match purpose {
                    $(Purpose::$purpose $(($($field),+))? => $signature,)+
                }
            }
        }
    };
}

macro_rules! single {
    ($purpose:ident) => {
        Some(Purpose::$purpose)
    };
    ($purpose:ident ($($field:ident),+)) => {
        None
    };
}

purposes! { naming:
    /// θ̈ from θ, ω.
    Accelerations => naming.timed("accelerations", &[Theta, Omega], Vector);
    /// θ̈ from θ, ω and torques from outside.
    AccelerationsUnder => naming.timed("accelerations_under", &[Theta, Omega, Torques], Vector);
    /// θ̈ and the reactions of prescribed links, from θ, ω, torques from outside and the
    /// accelerations of the prescribed links of the set with that number.
    Prescribed(set: usize) => {
        let (name, count) = &naming.prescribed[set];
        let arguments = [Theta, Omega, Torques, Argument::Prescribed(set)];
        let name = format!("accelerations_prescribed_{name}");
        naming.timed(name, &arguments, Arrays(naming.links, *count))
    };
    /// The coefficients of θ and ω in powers of the time: order 0 of the
    /// recurrences, which is θ̈ and the sines and cosines that it goes without.
    TaylorCoefficients => naming.timed("taylor_coefficients", &[Theta, Omega], Vector);
    /// K.
    KineticEnergy => plain("kinetic_energy", &[Theta, Omega], Scalar);
    /// U.
    PotentialEnergy => plain("potential_energy", &[Theta], Scalar);
    /// p from θ, ω.
    AbsoluteMomenta => plain("momenta", &[Theta, Omega], Vector);
    /// ω from θ, p.
    AbsoluteVelocities => plain("velocities", &[Theta, AbsoluteMomenta], Vector);
    /// ω and ṗ from θ, p.
    CanonicalRates => {
        naming.timed("canonical_rates", &[Theta, AbsoluteMomenta], Rows(2, naming.links))
    };
    /// M at θ.
    MassMatrix => plain("mass_matrix", &[Theta], Rows(naming.links, naming.links));
    /// ∂²U/∂θ∂θ at θ.
    StiffnessMatrix => plain("stiffness_matrix", &[Theta], Rows(naming.links, naming.links));
    /// Symmetric coordinates from absolute angles.
    ToSymmetric => plain("to_symmetric", &[Absolute], Vector);
    /// Absolute angles from symmetric coordinates.
    FromSymmetric => plain("from_symmetric", &[Symmetric], Vector);
    /// q̈ from q, q̇.
    SymmetricAccelerations => {
        naming.timed("symmetric_accelerations", &[Coordinates, Rates], Vector)
    };
    /// p from q, q̇.
    SymmetricMomenta => plain("symmetric_momenta", &[Coordinates, Rates], Vector);
    /// q̇ from q, p.
    SymmetricVelocities => plain("symmetric_velocities", &CANONICAL.arguments(), Vector);
    /// H in symmetric coordinates and momenta.
    Hamiltonian => plain("hamiltonian", &CANONICAL.arguments(), Scalar);
    /// H_d of the transfer with that number.
    SubHamiltonian(transfer: usize) => {
        plain(naming.about("antiphase_energy", transfer), &CANONICAL.arguments(), Scalar)
    };
    /// W through an order.
    TruncatedTransfer(transfer: usize, counting: Counting, order: u32) => {
        naming.transfer(&format!("{}_{order}", counting.name()), transfer, CANONICAL)
    };
    /// The coefficients of that quadratic form.
    QuadraticForm(transfer: usize) => {
        let name = naming.about("transfer_quadratic_form", transfer);
        plain(name, &CANONICAL.arguments(), Vector)
    };
    /// W exactly.
    ExactTransfer(transfer: usize, state: EntryState) => naming.transfer("exact", transfer, state);
    /// The part of W that has this cause.
    SplitTransfer(transfer: usize, cause: Cause, state: EntryState) => {
        naming.transfer(cause.name(), transfer, state)
    };
    /// Power of friction on H_d.
    AntiphaseFrictionPower(transfer: usize, state: EntryState) => {
        naming.antiphase_power("friction", transfer, &state.arguments(), state)
    };
    /// Energies of all sectors, the transfers into them and the power of other
    /// forces.
    Budget(definition: EnergyDefinition, state: EntryState) => {
        let name = format!("{}budget_{}", state.prefix(), definition.name());
        naming.timed(name, &state.arguments(), Budget(naming.sectors))
    };
    /// The same budget with the power of torques from outside, from absolute angles.
    BudgetUnder(definition: EnergyDefinition) => {
        let name = format!("budget_{}_under", definition.name());
        naming.timed(name, &[Theta, Omega, Torques], Budget(naming.sectors))
    };
    /// W of all sectors by parts.
    SectorTransfers(state: EntryState) => {
        let name = format!("{}sector_transfers", state.prefix());
        plain(name, &state.arguments(), Transfers(naming.sectors))
    };
    /// W of all sectors by parts, through an order.
    TruncatedSectorTransfers(counting: Counting, order: u32) => {
        let name = format!("sector_transfers_{}_{order}", counting.name());
        plain(name, &CANONICAL.arguments(), Transfers(naming.sectors))
    };
    /// {E_s, E_r} of the sectors by Parseval.
    TransferMatrix(state: EntryState) => {
        let name = format!("{}sector_transfer_matrix", state.prefix());
        plain(name, &state.arguments(), Rows(naming.sectors, naming.sectors))
    };
    /// Power of the drive on H_d.
    AntiphaseDrivePower(transfer: usize, state: EntryState) => {
        let [coordinates, motion] = state.arguments();
        naming.antiphase_power("drive", transfer, &[Time, coordinates, motion], state)
    };
    /// Power of torques from outside on H_d.
    AntiphaseOutsidePower(transfer: usize, state: EntryState) => {
        let [coordinates, motion] = state.arguments();
        naming.antiphase_power("outside", transfer, &[coordinates, motion, Torques], state)
    };
    /// The drive itself: acceleration of the root's pivot, torque on the root.
    Drive => plain("drive", &[Time], Vector);
    /// Power of the drive on the whole tree.
    DrivePower => plain("drive_power", &[Time, Theta, Omega], Scalar);
    /// Power of friction and drag on the whole tree.
    TotalFrictionPower => {
        let arguments = [Theta, Omega];
        let rates_alone = usize::from(!naming.damped_by_angle);
        plain("friction_power", &arguments[rates_alone..], Scalar)
    };
    /// Power of torques from outside on the whole tree.
    OutsidePower => plain("outside_power", &[Omega, Torques], Scalar);
    /// The observable with that number.
    Observable(number: usize, form: ObservableForm) => {
        let (name, symmetric) = &naming.observables[number];
        let name = format!("{name}{}", form.name());
        let arguments = match (form.is_from_momenta(), symmetric) {
            (true, true) => CANONICAL.arguments(),
            (true, false) => [Theta, AbsoluteMomenta],
            (false, true) => EntryState::Rates.arguments(),
            (false, false) => EntryState::Absolute.arguments(),
        };
        match form.is_rate() {
            true => naming.timed(name, &arguments, Scalar),
            false => plain(name, &arguments, Scalar),
        }
    };
    /// Accelerations of small differences in the transverse sector with that number.
    Transverse(sector: usize) => {
        let name = format!("transverse_accelerations_{}", naming.transverse[sector]);
        naming.timed(name, &along_motion(sector), Vector)
    };
    /// θ̈ of the motion in phase, and those accelerations after them.
    TransverseMotion(sector: usize) => {
        let name = format!("transverse_motion_{}", naming.transverse[sector]);
        naming.timed(name, &[Theta, Omega, Difference(sector), DifferenceRate(sector)], Vector)
    };
    /// Their energy.
    TransverseEnergy(sector: usize) => {
        let name = format!("transverse_energy_{}", naming.transverse[sector]);
        plain(name, &[Theta, Difference(sector), DifferenceRate(sector)], Scalar)
    };
    /// Rate of that energy without friction.
    TransverseTransfer(sector: usize) => {
        let name = format!("transverse_transfer_{}", naming.transverse[sector]);
        naming.timed(name, &along_motion(sector), Scalar)
    };
    /// The power of friction on it; true where that depends on the motion in phase.
    TransverseFriction(sector: usize, braked: bool) => {
        let name = format!("transverse_friction_power_{}", naming.transverse[sector]);
        // Viscous friction takes the rates of the differences alone.
        plain(name, &[Omega, DifferenceRate(sector)][usize::from(!braked)..], Scalar)
    };
    /// Accelerations of angles and of small differences that act back.
    SmallAccelerations => {
        let arguments = [Theta, Omega, SmallDifferences, SmallRates];
        naming.timed("small_accelerations", &arguments, Vector)
    };
    /// The same accelerations under torques from outside.
    SmallAccelerationsUnder => {
        let motion = [Theta, Omega, SmallDifferences, SmallRates];
        let arguments = [&motion[..], &[Torques, SmallTorques]].concat();
        naming.timed("small_accelerations_under", &arguments, Vector)
    };
    /// Their energy.
    SmallEnergy => {
        plain("small_energy", &[Theta, Omega, SmallDifferences, SmallRates], Scalar)
    };
    /// Positions of these points of all links.
    Positions(kind: PointKind) => {
        plain(format!("{}s", kind.name()), &[Theta], Rows(naming.links, 2))
    };
    /// Their velocities.
    PointVelocities(kind: PointKind) => {
        plain(format!("{}_velocities", kind.name()), &[Theta, Omega], Rows(naming.links, 2))
    };
    /// Generalized torques Q of forces there.
    PointTorques(kind: PointKind) => {
        plain(format!("{}_torques", kind.name()), &[Theta, Forces], Vector)
    };
    /// Masses, moments of inertia and places of the links.
    LinkProperties => plain("link_properties", &[], Rows(naming.links, LINK_PROPERTIES.len()));
    /// A function of the recursion, for one link of a tree in loops.
    Link(function: LinkFunction) => {
        plain(function.name(), &[&[Constants, Motion], function.given()].concat(), Vector)
    };
    /// A function of energies by scale, for one link of a tree in loops.
    Scale(function: ScaleFunction) => {
        of_link(function.name(), &[Constants, Motion], function.given())
    };
    /// A function of energies, powers or positions, for one link of a tree in loops.
    Body(function: BodyFunction) => match function.is_of_point() {
        true => of_link(function.name(), &[Motion], function.given()),
        false => of_link(function.name(), &[Body, Motion], function.given()),
    };
    /// Apparent gravity at the root's pivot of a tree in loops, in reduced units.
    RootGravity => plain("root_gravity", &[], Vector);
    /// Contribution of the drive to that, and its torque on the root, in reduced units.
    RootDrive => plain("root_drive", &[Time], Vector);
}

fn plain(name: impl Into<String>, arguments: &[Argument], shape: ResultShape) -> Signature {
    Signature {
        name: name.into(),
        arguments: arguments.to_vec(),
        shape,
    }
}

/// A function of one link, with what it is given where that is anything.
fn of_link(name: &str, arguments: &[Argument], given: &'static [&'static str]) -> Signature {
    let given: &[Argument] = if given.is_empty() {
        &[]
    } else {
        &[Given(given)]
    };
    plain(name, &[arguments, given].concat(), Vector)
}

/// Small differences along a motion in phase.
fn along_motion(sector: usize) -> [Argument; 5] {
    let (difference, rate) = (Difference(sector), DifferenceRate(sector));
    [Theta, Omega, Alpha, difference, rate]
}

impl Naming {
    /// A function that takes the time first, where there is a drive.
    fn timed(
        &self,
        name: impl Into<String>,
        arguments: &[Argument],
        shape: ResultShape,
    ) -> Signature {
        let time: &[Argument] = if self.driven { &[Time] } else { &[] };
        plain(name, &[time, arguments].concat(), shape)
    }

    /// The name of a function about the difference of a transfer.
    fn about(&self, stem: &str, transfer: usize) -> String {
        format!("{stem}{}", self.places[transfer])
    }

    /// A form of W.
    fn transfer(&self, form: &str, transfer: usize, state: EntryState) -> Signature {
        let stem = format!("transfer_{form}{}", state.source());
        plain(self.about(&stem, transfer), &state.arguments(), Transfer)
    }

    /// A power on H_d.
    fn antiphase_power(
        &self,
        of: &str,
        transfer: usize,
        arguments: &[Argument],
        state: EntryState,
    ) -> Signature {
        let stem = format!("antiphase_{of}_power{}", state.source());
        plain(self.about(&stem, transfer), arguments, Scalar)
    }
}
