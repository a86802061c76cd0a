//! Combinations of the unknowns that the data determine, and changes that they leave open.

use core::fmt;

use nalgebra::DMatrix;

use super::task::FitTask;

/// Relative size of a singular value that is taken for zero: what is left of exact
/// dependences after integration with a finite tolerance.
const ZERO: f64 = 1e-7;
/// Share in an open change that counts.
const SHARE: f64 = 1e-3;

/// Combinations that the data determine, by a singular value decomposition of the derivatives
/// of all data with respect to relative changes of the parameters (and to offsets, rad).
///
/// Equations of motion know ratios only: masses, inertias and friction may all be twice as
/// large. Such changes are told, and those that data with this noise cannot tell from none.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Number of unknown numbers.
    pub unknown: usize,
    /// Singular values in falling order: one over each is the standard deviation of a
    /// combination of relative changes.
    pub singular_values: Vec<f64>,
    /// Changes that the data leave open; all others are determined.
    pub open: Vec<OpenChange>,
}

/// A change of several unknowns together of which the data show nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenChange {
    /// The unknown that is held where it was, so that the others have values.
    pub held: String,
    /// Relative changes (of offsets: rad) of the others, for one of the unknown that is held.
    pub others: Vec<(String, f64)>,
}

impl FitTask<'_> {
    /// Decomposes the triangle of the normal equations of these globals, in standard
    /// deviations of the data, whose own is `deviation` in those that were given. Returns
    /// the indices of the unknowns that are held, too: `first` those that were held already.
    pub(super) fn identifiability(
        &self,
        globals: &[f64],
        triangle: &DMatrix<f64>,
        deviation: f64,
        first: &[usize],
    ) -> (Identifiability, Vec<usize>) {
        let count = globals.len();
        let mut matrix = triangle.columns(0, count).into_owned();
        for (index, (&value, scale)) in globals.iter().zip(&self.scales).enumerate() {
            // Unit of a parameter is its size, of an offset 1 rad.
            let unit = match self.unknown.get(index) {
                Some(_) if value != 0.0 => value.abs(),
                Some(_) => *scale,
                None => 1.0,
            };
            matrix.column_mut(index).scale_mut(unit / scale);
        }
        let decomposed = matrix.svd(false, true);
        let values = decomposed.singular_values.as_slice();
        // Open is what is not known to its own size.
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
        let found = Identifiability {
            unknown: count,
            singular_values: sorted,
            open: self.open_changes(&basis, &held),
        };
        (found, held)
    }

    fn open_changes(&self, basis: &DMatrix<f64>, held: &[usize]) -> Vec<OpenChange> {
        let Some(inverse) = basis.select_rows(held).try_inverse() else {
            return Vec::new();
        };
        let changes = basis * inverse;
        let change = |(column, &own): (usize, &usize)| OpenChange {
            held: self.names[own].clone(),
            others: (0..self.names.len())
                .filter(|&row| row != own && changes[(row, column)].abs() > SHARE)
                .map(|row| (self.names[row].clone(), changes[(row, column)]))
                .collect(),
        };
        held.iter().enumerate().map(change).collect()
    }
}

/// One unknown for each column: the first ones, and those with the largest share, each in
/// what the ones before leave of the columns.
fn held(basis: &DMatrix<f64>, first: &[usize]) -> Vec<usize> {
    let mut rest = basis.clone();
    let mut held = Vec::new();
    for _ in 0..basis.ncols() {
        let length = |row: usize| rest.row(row).norm_squared();
        let rows = (0..rest.nrows()).filter(|row| !held.contains(row));
        let rows = rows.map(|row| (first.contains(&row) && length(row) > SHARE * SHARE, row));
        let order = |a: &(bool, usize), b: &(bool, usize)| {
            a.0.cmp(&b.0).then(length(a.1).total_cmp(&length(b.1)))
        };
        let Some((_, most)) = rows.max_by(order) else {
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

impl Identifiability {
    /// Number of combinations that the data determine.
    #[must_use]
    pub fn determined(&self) -> usize {
        self.unknown - self.open.len()
    }

    /// Unknowns that can change together with this one, of which the data then show nothing:
    /// none where it is determined by itself.
    #[must_use]
    pub fn together_with(&self, name: &str) -> Vec<String> {
        let mut all = Vec::new();
        for change in &self.open {
            let names = || {
                change
                    .others
                    .iter()
                    .map(|(name, _)| name)
                    .chain([&change.held])
            };
            if names().any(|other| other == name) {
                all.extend(names().filter(|other| *other != name).cloned());
            }
        }
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
                write!(f, ", {name} {change:+.2} %")?;
            }
        }
        if !self.open.is_empty() {
            let held: Vec<&str> = self
                .open
                .iter()
                .map(|change| change.held.as_str())
                .collect();
            write!(
                f,
                "\n  Measure {} (scale, ruler), and the others follow; as they are, they go with \
                 its value.",
                held.join(", ")
            )?;
        }
        Ok(())
    }
}
