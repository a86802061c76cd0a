//! Purposes of functions: name, arguments and result of each, for models and for stubs that replace
//! a model with errors.

use super::Argument::{
    self, Absolute, AbsoluteMomenta, Actions, Alpha, Body, Constants, Coordinates, Difference,
    DifferenceRate, Forces, Given, Motion, Omega, Rates, SmallDifferences, SmallRates,
    SmallTorques, Symmetric, Theta, Time, Torques,
};
use super::ResultShape::{Budget, Rows, Scalar, Transfer, Transfers, Vector};
use super::naming::arrays;
use super::{
    BodyFunction, CANONICAL, Cause, Counting, DRIVE_WEIGHTS, Differentiated, EnergyDefinition,
    EntryState, LINK_PROPERTIES, LinkFunction, Naming, NormalFormFunction, ObservableForm,
    PointKind, ResultShape, ScaleFunction, Signature, SliceFunction,
};

/// Declares the purposes, each with the signature of its function, in which `$naming` provides
/// names and lengths. `computes FUNCTION[INDEX] -> [RESULTS]` follows for a function that the
/// runtime's `Computes` has on slices: its name in the runtime's `functions`, the name of the index
/// if several functions share it, and the names of the slices that it writes.
macro_rules! purposes {
    ($naming:ident: $(
        $(#[$docs:meta])* $purpose:ident $(($($field:ident: $kind:ty),+))? => $signature:expr
        $(, computes $function:ident $([$index:ident])? -> [$($result:ident),+])?;
    )+) => {
        /// Purpose of a function; the emitter documents the function accordingly.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Purpose {
            $($(#[$docs])* $purpose $(($($kind),+))?,)+
        }

        impl Purpose {
            /// Returns the purposes without parameters, each of which has one function.
            pub(super) fn singles() -> Vec<Self> {
                let all = [$(single!($purpose $(($($field),+))?)),+];
                all.into_iter().flatten().collect()
            }

            /// Returns all functions on slices.
            pub fn all_slices() -> Vec<SliceFunction> {
                let all = [$(slices!($($function $([$index])? -> [$($result),+])?)),+];
                all.into_iter().flatten().collect()
            }

            /// Returns the function on slices that the function with this purpose implements;
            /// `None` if there is none.
            pub fn slices(self) -> Option<SliceFunction> {
                match self {
                    $(Self::$purpose { .. } => {
                        slices!($($function $([$index])? -> [$($result),+])?)
                    })+
                }
            }
        }

        impl Naming {
            /// Returns the signature of the function with a purpose.
            pub fn signature(&self, purpose: Purpose) -> Signature {
                let $naming = self;
                match purpose {
                    $(Purpose::$purpose $(($($field),+))? => $signature,)+
                }
            }
        }
    };
}

macro_rules! slices {
    () => {
        None
    };
    ($function:ident -> [$($result:ident),+]) => {
        Some(SliceFunction {
            name: stringify!($function),
            index: None,
            results: &[$(stringify!($result)),+],
        })
    };
    ($function:ident [$index:ident] -> [$($result:ident),+]) => {
        Some(SliceFunction {
            name: stringify!($function),
            index: Some(stringify!($index)),
            results: &[$(stringify!($result)),+],
        })
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
    /// Accelerations θ̈ from θ, ω.
    Accelerations => naming.timed("accelerations", &[Theta, Omega], Vector);
    /// Accelerations θ̈ from θ, ω and external torques.
    AccelerationsUnder => naming.timed("accelerations_under", &[Theta, Omega, Torques], Vector),
        computes AccelerationsUnderTorques -> [alpha];
    /// Accelerations θ̈ and reaction torques of prescribed links, from θ, ω, external torques and
    /// the accelerations of the prescribed links in the set with this index.
    Prescribed(set: usize) => {
        let (name, count) = &naming.prescribed[set];
        let arguments = [Theta, Omega, Torques, Argument::Prescribed(set)];
        let name = format!("accelerations_prescribed_{name}");
        naming.timed(name, &arguments, arrays([naming.links, *count]))
    }, computes AccelerationsOfHeldLinks[set] -> [alpha, reactions];
    /// Torques Q (N m) that a given motion needs, from θ, ω and θ̈.
    InverseDynamics => naming.timed("inverse_dynamics", &[Theta, Omega, Alpha], Vector),
        computes InverseDynamics -> [torques];
    /// Derivatives of a weighted sum of the accelerations by θ, ω and parameters.
    AccelerationsPullback => naming.pullback(Purpose::Accelerations),
        computes AccelerationsPullback -> [theta_adjoint, omega_adjoint, parameters_adjoint];
    /// Derivatives of a weighted sum of the accelerations under external torques by θ, ω, torques
    /// and parameters.
    AccelerationsUnderPullback => naming.pullback(Purpose::AccelerationsUnder),
        computes AccelerationsUnderTorquesPullback
            -> [theta_adjoint, omega_adjoint, torques_adjoint, parameters_adjoint];
    /// Derivatives of a function with one number as its result, by its arguments and parameters.
    Gradient(of: Differentiated) => naming.gradient(of);
    /// Taylor coefficients of θ and ω in time. The program computes order 0 of the recurrences: θ̈,
    /// and the sines and cosines.
    TaylorCoefficients => naming.timed("taylor_coefficients", &[Theta, Omega], Vector);
    /// Kinetic energy K.
    KineticEnergy => plain("kinetic_energy", &[Theta, Omega], Scalar);
    /// Potential energy U.
    PotentialEnergy => plain("potential_energy", &[Theta], Scalar);
    /// Momenta p from θ, ω.
    AbsoluteMomenta => plain("momenta", &[Theta, Omega], Vector);
    /// Angular velocities ω from θ, p.
    AbsoluteVelocities => plain("velocities", &[Theta, AbsoluteMomenta], Vector);
    /// Rates ω and ṗ from θ, p.
    CanonicalRates => {
        naming.timed("canonical_rates", &[Theta, AbsoluteMomenta], Rows(2, naming.links))
    }, computes CanonicalRates -> [angle_rates, momentum_rates];
    /// Mass matrix M at θ.
    MassMatrix => plain("mass_matrix", &[Theta], Rows(naming.links, naming.links));
    /// Stiffness matrix ∂²U/∂θ∂θ at θ.
    StiffnessMatrix => plain("stiffness_matrix", &[Theta], Rows(naming.links, naming.links));
    /// Symmetric coordinates from absolute angles.
    ToSymmetric => plain("to_symmetric", &[Absolute], Vector);
    /// Absolute angles from symmetric coordinates.
    FromSymmetric => plain("from_symmetric", &[Symmetric], Vector);
    /// Accelerations q̈ from q, q̇, in symmetric coordinates.
    SymmetricAccelerations => {
        naming.timed("symmetric_accelerations", &[Coordinates, Rates], Vector)
    }, computes SymmetricAccelerations -> [accelerations];
    /// Momenta p from q, q̇, in symmetric coordinates.
    SymmetricMomenta => plain("symmetric_momenta", &[Coordinates, Rates], Vector);
    /// Velocities q̇ from q, p, in symmetric coordinates.
    SymmetricVelocities => plain("symmetric_velocities", &CANONICAL.arguments(), Vector);
    /// Hamiltonian H in symmetric coordinates and momenta.
    Hamiltonian => plain("hamiltonian", &CANONICAL.arguments(), Scalar);
    /// Energy H_d of the difference with this index.
    SubHamiltonian(transfer: usize) => {
        plain(naming.about("antiphase_energy", transfer), &CANONICAL.arguments(), Scalar)
    };
    /// Energy transfer W, truncated at an order.
    TruncatedTransfer(transfer: usize, counting: Counting, order: u32) => {
        naming.transfer(&format!("{}_{order}", counting.name()), transfer, CANONICAL)
    };
    /// Coefficients of the quadratic form of W.
    QuadraticForm(transfer: usize) => {
        let name = naming.about("transfer_quadratic_form", transfer);
        plain(name, &CANONICAL.arguments(), Vector)
    };
    /// Energy transfer W without truncation.
    ExactTransfer(transfer: usize, state: EntryState) => naming.transfer("exact", transfer, state);
    /// Part of W with this cause.
    SplitTransfer(transfer: usize, cause: Cause, state: EntryState) => {
        naming.transfer(cause.name(), transfer, state)
    };
    /// Power of friction on H_d.
    AntiphaseFrictionPower(transfer: usize, state: EntryState) => {
        naming.antiphase_power("friction", transfer, &state.arguments(), state)
    };
    /// Energies of all sectors, transfers into them, and powers of other forces.
    Budget(definition: EnergyDefinition, state: EntryState) => {
        let name = format!("{}budget_{}", state.prefix(), definition.name());
        naming.timed(name, &state.arguments(), Budget(naming.sectors))
    };
    /// The budget with the power of external torques, from absolute angles.
    BudgetUnder(definition: EnergyDefinition) => {
        let name = format!("budget_{}_under", definition.name());
        naming.timed(name, &[Theta, Omega, Torques], Budget(naming.sectors))
    };
    /// Transfers W into all sectors, kinetic and potential part of each.
    SectorTransfers(state: EntryState) => {
        let name = format!("{}sector_transfers", state.prefix());
        plain(name, &state.arguments(), Transfers(naming.sectors))
    };
    /// Transfers W into all sectors, kinetic and potential part of each, truncated at an order.
    TruncatedSectorTransfers(counting: Counting, order: u32) => {
        let name = format!("sector_transfers_{}_{order}", counting.name());
        plain(name, &CANONICAL.arguments(), Transfers(naming.sectors))
    };
    /// Energy transfers between pairs of sectors: Poisson brackets {E_s, E_r} of their energies (in
    /// Parseval's form).
    TransferMatrix(state: EntryState) => {
        let name = format!("{}sector_transfer_matrix", state.prefix());
        plain(name, &state.arguments(), Rows(naming.sectors, naming.sectors))
    };
    /// Power of the drive on H_d.
    AntiphaseDrivePower(transfer: usize, state: EntryState) => {
        let [coordinates, motion] = state.arguments();
        naming.antiphase_power("drive", transfer, &[Time, coordinates, motion], state)
    };
    /// Power of external torques on H_d.
    AntiphaseOutsidePower(transfer: usize, state: EntryState) => {
        let [coordinates, motion] = state.arguments();
        naming.antiphase_power("outside", transfer, &[coordinates, motion, Torques], state)
    };
    /// The drive: acceleration of the root's pivot, and torque on the root.
    Drive => plain("drive", &[Time], Vector);
    /// Power of the drive on the whole tree.
    DrivePower => plain("drive_power", &[Time, Theta, Omega], Scalar);
    /// Power of friction and drag on the whole tree.
    TotalFrictionPower => {
        let arguments = [Theta, Omega];
        let rates_alone = usize::from(!naming.damped_by_angle);
        plain("friction_power", &arguments[rates_alone..], Scalar)
    };
    /// Power of external torques on the whole tree.
    OutsidePower => plain("outside_power", &[Omega, Torques], Scalar);
    /// A quantity of the observable with this index.
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
    /// Accelerations of small differences in the transverse sector with this index.
    Transverse(sector: usize) => {
        let name = format!("transverse_accelerations_{}", naming.transverse[sector]);
        naming.timed(name, &along_motion(sector), Vector)
    };
    /// In-phase accelerations θ̈, followed by those of the small differences.
    TransverseMotion(sector: usize) => {
        let name = format!("transverse_motion_{}", naming.transverse[sector]);
        naming.timed(name, &[Theta, Omega, Difference(sector), DifferenceRate(sector)], Vector)
    }, computes LinearDifferences[sector] -> [accelerations];
    /// Energy of the small differences in a transverse sector.
    TransverseEnergy(sector: usize) => {
        let name = format!("transverse_energy_{}", naming.transverse[sector]);
        plain(name, &[Theta, Difference(sector), DifferenceRate(sector)], Scalar)
    };
    /// Rate of that energy without friction.
    TransverseTransfer(sector: usize) => {
        let name = format!("transverse_transfer_{}", naming.transverse[sector]);
        naming.timed(name, &along_motion(sector), Scalar)
    };
    /// Power of friction on that energy; `braked` is true if it depends on the in-phase motion.
    TransverseFriction(sector: usize, braked: bool) => {
        let name = format!("transverse_friction_power_{}", naming.transverse[sector]);
        // The power of viscous friction depends on the rates of the differences only.
        plain(name, &[Omega, DifferenceRate(sector)][usize::from(!braked)..], Scalar)
    };
    /// Accelerations of angles and of small differences that act back.
    SmallAccelerations => {
        let arguments = [Theta, Omega, SmallDifferences, SmallRates];
        naming.timed("small_accelerations", &arguments, Vector)
    }, computes SmallDifferences -> [accelerations];
    /// Accelerations of angles and of small differences that act back, under external torques.
    SmallAccelerationsUnder => {
        let motion = [Theta, Omega, SmallDifferences, SmallRates];
        let arguments = [&motion[..], &[Torques, SmallTorques]].concat();
        naming.timed("small_accelerations_under", &arguments, Vector)
    }, computes SmallDifferencesUnderTorques -> [accelerations];
    /// Energy of the motion with small differences that act back.
    SmallEnergy => {
        plain("small_energy", &[Theta, Omega, SmallDifferences, SmallRates], Scalar)
    };
    /// A function of the resonant normal form of degree 4.
    NormalForm(function: NormalFormFunction) => {
        let name = format!("normal_form_{}", function.name());
        match function {
            NormalFormFunction::Actions | NormalFormFunction::Thresholds => {
                plain(name, &[Theta], Vector)
            }
            NormalFormFunction::Frequencies => plain(name, &[Actions], Vector),
            NormalFormFunction::Coupling | NormalFormFunction::Growth => {
                plain(name, &[Actions], Scalar)
            }
        }
    };
    /// Positions of one point of each link; `kind` is the kind of point.
    Positions(kind: PointKind) => {
        plain(format!("{}s", kind.name()), &[Theta], Rows(naming.links, 2))
    };
    /// Velocities of one point of each link; `kind` is the kind of point.
    PointVelocities(kind: PointKind) => {
        plain(format!("{}_velocities", kind.name()), &[Theta, Omega], Rows(naming.links, 2))
    };
    /// Generalized torques Q of forces on one point of each link; `kind` is the kind of point.
    PointTorques(kind: PointKind) => {
        plain(format!("{}_torques", kind.name()), &[Theta, Forces], Vector)
    };
    /// Masses, moments of inertia and points of the links.
    LinkProperties => plain("link_properties", &[], Rows(naming.links, LINK_PROPERTIES.len()));
    /// A function of the articulated recursion, for one link of a tree in loops.
    Link(function: LinkFunction) => {
        plain(function.name(), &[&[Constants, Motion], function.given()].concat(), Vector)
    };
    /// A function for energies by scale, for one link of a tree in loops.
    Scale(function: ScaleFunction) => {
        of_link(function.name(), &[Constants, Motion], function.given())
    };
    /// A function for energies, powers or positions, for one link of a tree in loops.
    Body(function: BodyFunction) => match function.is_of_point() {
        true => of_link(function.name(), &[Motion], function.given()),
        false => of_link(function.name(), &[Body, Motion], function.given()),
    };
    /// Apparent gravity at the root's pivot of a tree in loops, in reduced units.
    RootGravity => plain("root_gravity", &[], Vector);
    /// Contribution of the drive to the apparent gravity at the root's pivot, and torque of the
    /// drive on the root, in reduced units.
    RootDrive => plain("root_drive", &[Time], Vector);
    /// Derivatives by the parameters of a weighted sum of the drive's components, for a tree in loops.
    DrivePullback => plain("drive_pullback", &[Time, Given(DRIVE_WEIGHTS)], Vector);
}

fn plain(name: impl Into<String>, arguments: &[Argument], shape: ResultShape) -> Signature {
    Signature {
        name: name.into(),
        arguments: arguments.to_vec(),
        shape,
    }
}

/// Returns the signature of a function of one link; `given` names further numbers, if any.
fn of_link(name: &str, arguments: &[Argument], given: &'static [&'static str]) -> Signature {
    let given: &[Argument] = if given.is_empty() {
        &[]
    } else {
        &[Given(given)]
    };
    plain(name, &[arguments, given].concat(), Vector)
}

/// Returns the arguments of functions of small differences that follow an in-phase motion.
fn along_motion(sector: usize) -> [Argument; 5] {
    let (difference, rate) = (Difference(sector), DifferenceRate(sector));
    [Theta, Omega, Alpha, difference, rate]
}

impl Naming {
    /// Returns the signature of a function that takes the time first if there is a drive.
    fn timed(
        &self,
        name: impl Into<String>,
        arguments: &[Argument],
        shape: ResultShape,
    ) -> Signature {
        let time: &[Argument] = if self.driven { &[Time] } else { &[] };
        plain(name, &[time, arguments].concat(), shape)
    }

    /// Returns the name of a function for the difference of a transfer.
    fn about(&self, stem: &str, transfer: usize) -> String {
        format!("{stem}{}", self.places[transfer])
    }

    /// Returns the signature of a form of W.
    fn transfer(&self, form: &str, transfer: usize, state: EntryState) -> Signature {
        let stem = format!("transfer_{form}{}", state.source());
        plain(self.about(&stem, transfer), &state.arguments(), Transfer)
    }

    /// Returns the signature of a power on H_d.
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
