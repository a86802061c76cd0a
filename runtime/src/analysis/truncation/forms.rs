//! Trees that have several forms of the energy transfer W to compare.

use crate::model::Transfer;
use crate::sectors::Sectors;
use crate::system::{Ode, SymmetricCoordinates, Workspace};
use crate::transfer::{StateInput, SymmetricTree, TransfersByForm};
use crate::transfer_forms::{TransferForm, TransferForms};

/// A tree with several forms of the energy transfer W, one of them exact. Implemented by compiled
/// models with [`TransferForms`], and any other tree as [`TreeForms`].
///
/// States are symmetric coordinates (rad) with their rates (rad/s) or momenta (kg m²/s).
pub trait ComparedForms {
    /// Returns the number of symmetric coordinates.
    fn coordinates(&self) -> usize;

    /// Returns the forms of the energy transfer W that the tree has.
    fn forms(&self) -> Vec<TransferForm>;

    /// Returns the names of the sectors into which W transfers energy.
    fn receivers(&self) -> Vec<String>;

    /// Returns the sectors whose differences are small in truncated forms.
    fn truncated_sectors(&self) -> Vec<TruncatedSector>;

    /// Returns the equations of motion, whose state is the symmetric coordinates followed by their
    /// rates.
    fn motion(&self) -> impl Ode<f64>;

    /// Returns a function that computes the momenta from the coordinates and their rates, and
    /// writes them to its second argument.
    fn momenta(&self) -> impl FnMut([&[f64]; 2], &mut [f64]);

    /// Returns a function that computes the energy transfers W (watts) into all receiving sectors.
    /// The function takes the index of a form, coordinates and momenta, and a slice for the results.
    fn transfers(&self) -> impl FnMut(usize, [&[f64]; 2], &mut [Transfer<f64>]);
}

/// A sector whose differences are small in truncated forms of W.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TruncatedSector {
    /// Name of the sector.
    pub sector: String,
    /// Indices of the sector's symmetric coordinates.
    pub coordinates: Vec<usize>,
}

impl<M: TransferForms<f64>> ComparedForms for M {
    fn coordinates(&self) -> usize {
        self.links()
    }

    fn forms(&self) -> Vec<TransferForm> {
        M::TRANSFER_FORMS.to_vec()
    }

    fn receivers(&self) -> Vec<String> {
        M::RECEIVERS.iter().map(ToString::to_string).collect()
    }

    fn truncated_sectors(&self) -> Vec<TruncatedSector> {
        let sectors = M::SMALL_SECTORS.iter();
        let small = sectors.map(|sector| TruncatedSector {
            sector: sector.name.to_owned(),
            coordinates: sector.coordinates.to_vec(),
        });
        small.collect()
    }

    fn motion(&self) -> impl Ode<f64> {
        SymmetricCoordinates(self)
    }

    fn momenta(&self) -> impl FnMut([&[f64]; 2], &mut [f64]) {
        |[coordinates, rates], momenta| self.symmetric_momenta_into(coordinates, rates, momenta)
    }

    fn transfers(&self) -> impl FnMut(usize, [&[f64]; 2], &mut [Transfer<f64>]) {
        |form, [coordinates, momenta], transfers| {
            self.transfers_into(form, coordinates, momenta, transfers);
        }
    }
}

/// Forms of the energy transfer W of a tree given by numbers at run time. All differences count as
/// small.
#[derive(Clone, Debug)]
pub struct TreeForms<'a, O> {
    /// The tree, with its symmetry.
    pub tree: &'a SymmetricTree<f64>,
    /// Equations of motion, whose state is the symmetric coordinates followed by their rates.
    pub motion: O,
    /// The forms of W to compare; truncated ones have orders up to 15.
    pub forms: Vec<TransferForm>,
}

impl<O: Ode<f64>> ComparedForms for TreeForms<'_, O> {
    fn coordinates(&self) -> usize {
        self.tree.links()
    }

    fn forms(&self) -> Vec<TransferForm> {
        self.forms.clone()
    }

    fn receivers(&self) -> Vec<String> {
        let sectors = self.tree.sectors().iter().skip(1);
        sectors.map(|sector| sector.name().to_owned()).collect()
    }

    fn truncated_sectors(&self) -> Vec<TruncatedSector> {
        let mut first = 0;
        let all = self.tree.sectors().iter().map(|sector| {
            let own = first..first + sector.coordinates().len();
            first = own.end;
            TruncatedSector {
                sector: sector.name().to_owned(),
                coordinates: own.collect(),
            }
        });
        all.skip(1).collect()
    }

    fn motion(&self) -> impl Ode<f64> {
        &self.motion
    }

    fn momenta(&self) -> impl FnMut([&[f64]; 2], &mut [f64]) {
        let mut workspace = Workspace::new();
        move |[coordinates, rates], momenta| {
            let given = StateInput::Rates { coordinates, rates };
            self.tree.momenta(&mut workspace, given, momenta);
        }
    }

    fn transfers(&self) -> impl FnMut(usize, [&[f64]; 2], &mut [Transfer<f64>]) {
        let forms = self.forms.iter();
        let mut forms: Vec<Option<TransfersByForm<'_, f64>>> =
            forms.map(|form| self.tree.by_form(*form)).collect();
        let mut all = vec![Transfer::default(); self.tree.sectors().len()];
        move |form, state, transfers| match forms.get_mut(form) {
            Some(Some(own)) => {
                own.transfers(state, &mut all);
                for (into, found) in transfers.iter_mut().zip(&all[1..]) {
                    *into = *found;
                }
            }
            _ => transfers.fill(Transfer {
                kinetic: f64::NAN,
                potential: f64::NAN,
            }),
        }
    }
}
