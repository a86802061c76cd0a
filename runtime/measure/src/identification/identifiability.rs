//! Combinations of the unknowns that the data determine, and changes that they leave open.

use core::fmt;

use nalgebra::DMatrix;

use super::convergence::digits;
use super::task::FitTask;

/// Relative size below which a singular value counts as zero: exact dependences are disturbed by
/// the finite tolerance of the integration.
const ZERO: f64 = 1e-7;
/// Squared share, relative to that of the largest one, from which on it counts as large.
const LARGE: f64 = 0.1;
/// Smallest share in an open change that is reported.
pub(super) const SHARE: f64 = 1e-3;

/// Combinations of unknowns that the data determine, by a singular value decomposition of the
/// derivatives of all data with respect to relative changes of the parameters (and to offsets,
/// rad).
///
/// Equations of motion depend on ratios only: if all masses, inertias and friction coefficients are
/// doubled, the motion stays the same. Such changes are listed, and so are changes whose effect is
/// hidden by the noise of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Number of unknowns.
    pub unknown: usize,
    /// Singular values in descending order. The inverse of each is the standard deviation of a
    /// combination of relative changes.
    pub singular_values: Vec<f64>,
    /// Changes that the data leave open; all changes orthogonal to them are determined.
    pub open: Vec<OpenChange>,
}

/// A change of several unknowns together that has no effect on the data.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenChange {
    /// Name of the unknown that is fixed at its start value, so that the others can be determined.
    pub held: String,
    /// Relative changes (for offsets in rad) of the other unknowns, for a relative change of 1 of
    /// the fixed unknown.
    pub others: Vec<(String, f64)>,
}

/// Directions that the data leave open, and the unknowns that are fixed because of them.
pub(super) struct OpenDirections {
    /// Singular values in descending order.
    singular_values: Vec<f64>,
    /// Relative changes (for offsets in rad) of all unknowns, one column per fixed unknown, which
    /// itself changes by 1.
    pub(super) changes: DMatrix<f64>,
    pub(super) held: Vec<usize>,
}

impl FitTask<'_> {
    /// Decomposes the triangle of the normal equations of these globals. `deviation` is the
    /// standard deviation of the data, in units of the given ones. Unknowns in `first`, which were
    /// fixed before, are fixed again if possible.
    pub(super) fn open_directions(
        &self,
        globals: &[f64],
        triangle: &DMatrix<f64>,
        deviation: f64,
        first: &[usize],
    ) -> OpenDirections {
        let count = globals.len();
        let mut matrix = triangle.columns(0, count).into_owned();
        for (index, scale) in self.scales.iter().enumerate() {
            let unit = self.unit(globals, index);
            matrix.column_mut(index).scale_mut(unit / scale);
        }
        let decomposed = matrix.svd(false, true);
        let values = decomposed.singular_values.as_slice();
        // A combination is open if its standard deviation exceeds its size.
        let largest = values
            .iter()
            .fold(0.0, |most, &value| f64::max(most, value));
        let floor = f64::max(deviation, ZERO * largest);
        let is_open = |value: f64| value.is_nan() || value <= floor;
        let mut basis = DMatrix::zeros(count, values.iter().filter(|&&v| is_open(v)).count());
        if let Some(directions) = &decomposed.v_t {
            let open = values.iter().zip(directions.row_iter());
            let open = open.filter(|(value, _)| is_open(**value));
            for (column, (_, direction)) in open.enumerate() {
                basis.column_mut(column).copy_from(&direction.transpose());
            }
        }
        let held = held(&basis, first);
        let mut sorted = values.to_vec();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let inverse = basis.select_rows(&held).try_inverse();
        OpenDirections {
            singular_values: sorted,
            changes: inverse.map_or_else(|| basis.clone(), |inverse| &basis * inverse),
            held,
        }
    }

    /// Returns the change of a global that counts as a relative change of 1: the size of a
    /// parameter, or 1 rad for an offset.
    pub(super) fn unit(&self, globals: &[f64], index: usize) -> f64 {
        match self.unknown.get(index) {
            Some(_) if globals[index] != 0.0 => globals[index].abs(),
            Some(_) => self.scales[index],
            None => 1.0,
        }
    }
}

impl OpenDirections {
    /// Converts the result to one with the names of the unknowns.
    pub(super) fn with_names(self, names: &[String]) -> Identifiability {
        let Self {
            singular_values,
            changes,
            held,
        } = self;
        let change = |(column, &own): (usize, &usize)| OpenChange {
            held: names[own].clone(),
            others: (0..names.len())
                .filter(|&row| row != own && changes[(row, column)].abs() > SHARE)
                .map(|row| (names[row].clone(), changes[(row, column)]))
                .collect(),
        };
        Identifiability {
            unknown: names.len(),
            singular_values,
            open: held.iter().enumerate().map(change).collect(),
        }
    }
}

/// Selects the unknowns to fix, one for each column of `basis`. Each has a large share in the part
/// of the columns that the ones before do not explain; unknowns in `first` are preferred, otherwise
/// the first in their order is taken. (The one with the largest share might be an inertia, which
/// leads to infinite masses if the true inertia is zero.)
fn held(basis: &DMatrix<f64>, first: &[usize]) -> Vec<usize> {
    let mut rest = basis.clone();
    let mut held = Vec::new();
    for _ in 0..basis.ncols() {
        let length = |row: usize| rest.row(row).norm_squared();
        let rows = || (0..rest.nrows()).filter(|row| !held.contains(row));
        let longest = rows().map(length).fold(0.0, f64::max);
        let before = rows().filter(|row| first.contains(row) && length(*row) > SHARE * SHARE);
        let before = before.max_by(|&a, &b| length(a).total_cmp(&length(b)));
        let Some(most) = before.or_else(|| rows().find(|&row| length(row) >= LARGE * longest))
        else {
            break;
        };
        let direction = rest.row(most).into_owned();
        let square = direction.norm_squared();
        let shares = &rest * direction.transpose() / square;
        rest -= shares * direction;
        held.push(most);
    }
    held.sort_unstable();
    held
}

impl OpenChange {
    fn has_one_of(&self, names: &[String]) -> bool {
        let mut own = self.others.iter().map(|(name, _)| name).chain([&self.held]);
        own.any(|name| names.contains(name))
    }
}

impl Identifiability {
    /// Returns the number of combinations that the data determine.
    #[must_use]
    pub fn determined(&self) -> usize {
        self.unknown - self.open.len()
    }

    /// Returns the names of the unknowns that can change together with this one without effect on
    /// the data; empty if it is determined individually.
    #[must_use]
    pub fn together_with(&self, name: &str) -> Vec<String> {
        let mut all = vec![name.to_owned()];
        let mut changes: Vec<&OpenChange> = self.open.iter().collect();
        // Two changes one after the other are a change, too.
        while let Some(place) = changes.iter().position(|change| change.has_one_of(&all)) {
            let OpenChange { held, others } = changes.swap_remove(place);
            all.extend(others.iter().map(|(name, _)| name).chain([held]).cloned());
        }
        all.retain(|other| other != name);
        all.sort();
        all.dedup();
        all
    }
}

impl fmt::Display for Identifiability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (determined, unknown) = (self.determined(), self.unknown);
        write!(
            f,
            "The data determine {determined} combinations of {unknown} unknowns."
        )?;
        for OpenChange { held, others } in &self.open {
            write!(f, "\n  open: {held} +1 %")?;
            for (name, change) in others {
                let sign = if *change < 0.0 { "" } else { "+" };
                write!(f, ", {name} {sign}{} %", digits(*change))?;
            }
        }
        if !self.open.is_empty() {
            write!(
                f,
                "\n  One of each line has to be known, and the others follow; as they are, they go \
                 with the first, which is held."
            )?;
        }
        Ok(())
    }
}
