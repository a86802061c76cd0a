//! Amplitudes of small differences, and all forms of W at a state.

use super::error::TruncationError;
use crate::model::Transfer;
use crate::transfer_forms::{TransferForm, TransferForms};

/// Difference at which the restoring acceleration is measured, rad: emitted
/// code keeps the digits of small differences, and their cubes are lost.
const SMALL: f64 = 1e-5;

/// Angular frequency Ω of each of [`TransferForms::SMALL_SECTORS`], in rad/s:
/// the root of the mean square over its linear modes about the hanging tree, at
/// the time zero. Ω² is −tr(∂q̈/∂q)/n over the sector's n differences, by central
/// differences.
///
/// # Errors
///
/// [`TruncationError::NoFrequency`] if the mean square is not positive.
pub fn sector_frequencies<M: TransferForms<f64>>(model: &M) -> Result<Vec<f64>, TruncationError> {
    let n = model.links();
    let (mut coordinates, rates) = (vec![0.0; n], vec![0.0; n]);
    let mut accelerations = vec![0.0; n];
    let mut frequencies = Vec::new();
    for sector in M::SMALL_SECTORS {
        let mut sum = 0.0;
        for &index in sector.coordinates {
            let mut at = |value: f64| {
                if let Some(coordinate) = coordinates.get_mut(index) {
                    *coordinate = value;
                }
                model.symmetric_accelerations_into(0.0, &coordinates, &rates, &mut accelerations);
                accelerations.get(index).copied().unwrap_or(f64::NAN)
            };
            sum += (at(-SMALL) - at(SMALL)) / (2.0 * SMALL);
            at(0.0);
        }
        let square = sum / sector.coordinates.len() as f64;
        if !(square.is_finite() && square > 0.0) {
            return Err(TruncationError::NoFrequency {
                sector: sector.name,
                square,
            });
        }
        frequencies.push(square.sqrt());
    }
    Ok(frequencies)
}

/// Amplitude of a state in rad: the largest √(q² + (q̇/Ω)²) of all small
/// differences, with the `frequencies` Ω that [`sector_frequencies`] gives.
/// Coordinates that the slices lack count as zero.
#[must_use]
pub fn amplitude<M: TransferForms<f64>>(
    frequencies: &[f64],
    coordinates: &[f64],
    rates: &[f64],
) -> f64 {
    let sectors = M::SMALL_SECTORS.iter().zip(frequencies);
    let differences = sectors.flat_map(|(sector, frequency)| {
        let all = sector.coordinates.iter();
        all.map(move |&index| (index, *frequency))
    });
    differences.fold(0.0, |largest, (index, frequency)| {
        match (coordinates.get(index), rates.get(index)) {
            (Some(q), Some(rate)) => largest.max(q.hypot(rate / frequency)),
            _ => largest,
        }
    })
}

/// Room for all forms of W at one state.
pub(super) struct Powers<'m, M> {
    model: &'m M,
    /// Indices of the truncated forms.
    indices: Vec<usize>,
    /// Index of the exact form.
    reference: usize,
    momenta: Vec<f64>,
    found: Vec<Transfer<f64>>,
    /// W exact, by sector.
    pub(super) exact: Vec<f64>,
    /// W of the truncated forms, by form, then by sector.
    pub(super) truncated: Vec<f64>,
}

impl<'m, M: TransferForms<f64>> Powers<'m, M> {
    pub(super) fn new(model: &'m M) -> Result<Self, TruncationError> {
        let is_exact = |form: &usize| M::TRANSFER_FORMS[*form] == TransferForm::Exact;
        let (exact, indices): (Vec<usize>, Vec<usize>) =
            (0..M::TRANSFER_FORMS.len()).partition(is_exact);
        let reference = *exact.first().ok_or(TruncationError::NoExactForm)?;
        let receivers = M::RECEIVERS.len();
        Ok(Self {
            model,
            momenta: vec![0.0; model.links()],
            found: vec![Transfer::default(); receivers],
            exact: vec![0.0; receivers],
            truncated: vec![0.0; receivers * indices.len()],
            indices,
            reference,
        })
    }

    /// The truncated forms.
    pub(super) fn forms(&self) -> Vec<TransferForm> {
        let forms = self.indices.iter().map(|&form| M::TRANSFER_FORMS[form]);
        forms.collect()
    }

    /// Evaluates all forms at symmetric coordinates and their rates.
    pub(super) fn evaluate(&mut self, coordinates: &[f64], rates: &[f64]) {
        self.model
            .symmetric_momenta_into(coordinates, rates, &mut self.momenta);
        self.model
            .transfers_into(self.reference, coordinates, &self.momenta, &mut self.found);
        for (exact, found) in self.exact.iter_mut().zip(&self.found) {
            *exact = found.total();
        }
        let receivers = self.found.len().max(1);
        let rows = self.truncated.chunks_mut(receivers);
        for (&form, row) in self.indices.iter().zip(rows) {
            self.model
                .transfers_into(form, coordinates, &self.momenta, &mut self.found);
            for (power, found) in row.iter_mut().zip(&self.found) {
                *power = found.total();
            }
        }
    }
}
