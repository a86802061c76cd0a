//! Amplitudes of small differences, and all forms of W at a state.

use super::error::TruncationError;
use super::forms::{ComparedForms, TruncatedSector};
use crate::model::Transfer;
use crate::system::{Ode, Workspace};
use crate::transfer_forms::TransferForm;

/// Difference (rad) at which the restoring acceleration is measured. Emitted code keeps the digits
/// of such small differences, and their cubes are below rounding.
const SMALL: f64 = 1e-5;

/// Returns the angular frequency Ω (rad/s) of the [differences](ComparedForms::truncated_sectors)
/// of each sector: the root of the mean square over its linear modes about the hanging tree, at
/// time zero. Ω² is −tr(∂q̈/∂q)/n over the sector's n differences q, by central differences.
///
/// # Errors
///
/// [`TruncationError::NoFrequency`] if the mean square is not positive.
pub fn sector_frequencies(model: &impl ComparedForms) -> Result<Vec<f64>, TruncationError> {
    let n = model.coordinates();
    let (motion, mut workspace) = (model.motion(), Workspace::new());
    let (mut state, mut state_rates) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
    let mut frequencies = Vec::new();
    for TruncatedSector {
        sector,
        coordinates,
    } in model.truncated_sectors()
    {
        let mut sum = 0.0;
        for &index in &coordinates {
            let mut at = |value: f64| {
                if let Some(coordinate) = state.get_mut(index) {
                    *coordinate = value;
                }
                motion.rates_with(&mut workspace, 0.0, &state, &mut state_rates);
                state_rates.get(n + index).copied().unwrap_or(f64::NAN)
            };
            sum += (at(-SMALL) - at(SMALL)) / (2.0 * SMALL);
            at(0.0);
        }
        let square = sum / coordinates.len() as f64;
        if !(square.is_finite() && square > 0.0) {
            return Err(TruncationError::NoFrequency { sector, square });
        }
        frequencies.push(square.sqrt());
    }
    Ok(frequencies)
}

/// Returns the amplitude of a state in rad: the largest √(q² + (q̇/Ω)²) of all small differences q,
/// with the `frequencies` Ω (rad/s) from [`sector_frequencies`]. Coordinates beyond the end of the
/// slices count as zero.
#[must_use]
pub fn amplitude(
    small: &[TruncatedSector],
    frequencies: &[f64],
    coordinates: &[f64],
    rates: &[f64],
) -> f64 {
    let differences = small.iter().zip(frequencies).flat_map(|(own, frequency)| {
        let all = own.coordinates.iter();
        all.map(move |&index| (index, *frequency))
    });
    differences.fold(0.0, |largest, (index, frequency)| {
        match (coordinates.get(index), rates.get(index)) {
            (Some(q), Some(rate)) => largest.max(q.hypot(rate / frequency)),
            _ => largest,
        }
    })
}

/// A function that computes the momenta from the coordinates and their rates, and writes them to
/// its second argument.
type MomentaOf<'m> = Box<dyn FnMut([&[f64]; 2], &mut [f64]) + 'm>;

/// A function that computes the energy transfers W (watts) into all receivers, given the index of a
/// form, and coordinates and momenta.
type TransfersOf<'m> = Box<dyn FnMut(usize, [&[f64]; 2], &mut [Transfer<f64>]) + 'm>;

/// Evaluates all forms of W at a state, and stores the results.
pub(super) struct Powers<'m> {
    momenta_of: MomentaOf<'m>,
    transfers_of: TransfersOf<'m>,
    forms: Vec<TransferForm>,
    /// Indices of the truncated forms.
    indices: Vec<usize>,
    /// Index of the exact form.
    reference: usize,
    momenta: Vec<f64>,
    found: Vec<Transfer<f64>>,
    /// W exact (watts), by sector.
    pub(super) exact: Vec<f64>,
    /// W (watts) by the truncated forms, by form, then by sector.
    pub(super) truncated: Vec<f64>,
}

impl<'m> Powers<'m> {
    pub(super) fn new<M: ComparedForms>(model: &'m M) -> Result<Self, TruncationError> {
        let forms = model.forms();
        let is_exact = |form: &usize| forms[*form] == TransferForm::Exact;
        let (exact, indices): (Vec<usize>, Vec<usize>) = (0..forms.len()).partition(is_exact);
        let reference = *exact.first().ok_or(TruncationError::NoExactForm)?;
        let receivers = model.receivers().len();
        Ok(Self {
            momenta_of: Box::new(model.momenta()),
            transfers_of: Box::new(model.transfers()),
            momenta: vec![0.0; model.coordinates()],
            found: vec![Transfer::default(); receivers],
            exact: vec![0.0; receivers],
            truncated: vec![0.0; receivers * indices.len()],
            forms,
            indices,
            reference,
        })
    }

    /// Returns the truncated forms.
    pub(super) fn forms(&self) -> Vec<TransferForm> {
        self.indices.iter().map(|&form| self.forms[form]).collect()
    }

    /// Evaluates all forms of W at symmetric coordinates (rad) and their rates (rad/s).
    pub(super) fn evaluate(&mut self, coordinates: &[f64], rates: &[f64]) {
        (self.momenta_of)([coordinates, rates], &mut self.momenta);
        let state = [coordinates, &self.momenta];
        (self.transfers_of)(self.reference, state, &mut self.found);
        for (exact, found) in self.exact.iter_mut().zip(&self.found) {
            *exact = found.total();
        }
        let receivers = self.found.len().max(1);
        let rows = self.truncated.chunks_mut(receivers);
        for (&form, row) in self.indices.iter().zip(rows) {
            (self.transfers_of)(form, state, &mut self.found);
            for (power, found) in row.iter_mut().zip(&self.found) {
                *power = found.total();
            }
        }
    }
}
