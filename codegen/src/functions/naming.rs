//! Names that functions are called after, and all functions that models may have.

use super::{
    Argument, CANONICAL, Cause, Counting, EnergyDefinition, EntryState, PointKind, Purpose,
    ResultShape,
};
use crate::scene::ObservableForm;
use std::ops::RangeInclusive;

/// Orders that any truncated form has.
const ORDERS: RangeInclusive<u32> = 1..=8;

/// Name, arguments and result of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Name of the function.
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
    /// The names of a model about which nothing is known: stars stand for what a
    /// description tells.
    pub(super) fn any() -> Self {
        let star = || "*".to_owned();
        Self {
            driven: false,
            links: 0,
            sectors: 0,
            places: vec![star()],
            prescribed: vec![(star(), 0)],
            observables: Vec::new(),
            transverse: vec![star()],
        }
    }

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
