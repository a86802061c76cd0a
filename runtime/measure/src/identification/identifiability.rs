//! Combinations of the unknowns that the data determine, and changes that they leave open.

use core::fmt;

use nalgebra::DMatrix;

use super::convergence::digits;
use super::task::FitTask;

/// Relative size of a singular value that is taken for zero: what is left of exact
/// dependences after integration with a finite tolerance.
const ZERO: f64 = 1e-7;
/// Square of a share, of that of the largest one, that is large.
const LARGE: f64 = 0.1;
/// Share in an open change that counts.
pub(super) const SHARE: f64 = 1e-3;

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

/// Directions that the data leave open, and the unknowns that are held for them.
pub(super) struct OpenDirections {
    /// In falling order.
    singular_values: Vec<f64>,
    /// Relative changes (of offsets: rad) of all unknowns, a column for each that is held, by
    /// which that one changes by one.
    pub(super) changes: DMatrix<f64>,
    pub(super) held: Vec<usize>,
}

impl FitTask<'_> {
    /// Decomposes the triangle of the normal equations of these globals, in standard
    /// deviations of the data, whose own is `deviation` in those that were given; `first` to be
    /// held are those that were held already.
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
        let inverse = basis.select_rows(&held).try_inverse();
        OpenDirections {
            singular_values: sorted,
            changes: inverse.map_or_else(|| basis.clone(), |inverse| &basis * inverse),
            held,
        }
    }

    /// A relative change of one: of a parameter its size, of an offset 1 rad.
    pub(super) fn unit(&self, globals: &[f64], index: usize) -> f64 {
        match self.unknown.get(index) {
            Some(_) if globals[index] != 0.0 => globals[index].abs(),
            Some(_) => self.scales[index],
            None => 1.0,
        }
    }
}

impl OpenDirections {
    /// What it says in words of these names.
    pub(super) fn tell(self, names: &[String]) -> Identifiability {
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

/// One unknown for each column, each with a large share in what the ones before leave of the
/// columns: one of `first`, or the first of all, as they were given. (The one of largest share
/// may be an inertia, which leaves no finite masses where the real one is nought.)
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
    /// Number of combinations that the data determine.
    #[must_use]
    pub fn determined(&self) -> usize {
        self.unknown - self.open.len()
    }

    /// Unknowns that can change together with this one, of which the data then show nothing:
    /// none where it is determined by itself.
    #[must_use]
    pub fn together_with(&self, name: &str) -> Vec<String> {
        let mut all = vec![name.to_owned()];
        let mut changes: Vec<&OpenChange> = self.open.iter().collect();
        // One change after the other is a change, too.
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
