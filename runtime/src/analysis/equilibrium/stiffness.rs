//! Symmetric stiffness matrices and their factorisation.

/// Stiffness matrix: the second derivatives of a potential energy by angles, N m/rad. It is
/// symmetric; below the diagonal, only nonzero entries are stored.
///
/// Rows are eliminated from the last one to the first. If all springs of a tree act between a link
/// and its parent, each row has one such entry, there is no fill-in, and the factorisation takes
/// O(links) operations. A dense matrix takes O(links³).
#[derive(Clone, Debug, PartialEq)]
pub struct Stiffness {
    diagonal: Vec<f64>,
    /// For each row, the columns before the diagonal and their entries, by ascending column.
    rows: Vec<Vec<(usize, f64)>>,
}

impl Stiffness {
    /// Returns the matrix of `n` angles without any entry.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        Self {
            diagonal: vec![0.0; n],
            rows: vec![Vec::new(); n],
        }
    }

    /// Number of angles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// Returns true if the number of angles is zero.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.diagonal.is_empty()
    }

    /// Adds `value` to the entry of two angles and to its mirror image. If an angle does not exist,
    /// the first diagonal entry becomes NaN.
    pub fn add(&mut self, [one, other]: [usize; 2], value: f64) {
        let (row, column) = (one.max(other), one.min(other));
        if row >= self.len() {
            if let Some(first) = self.diagonal.first_mut() {
                *first = f64::NAN;
            }
        } else if row == column {
            self.diagonal[row] += value;
        } else {
            let entries = &mut self.rows[row];
            match entries.binary_search_by_key(&column, |(own, _)| *own) {
                Ok(place) => entries[place].1 += value,
                Err(place) => entries.insert(place, (column, value)),
            }
        }
    }

    /// Returns the full matrix, row by row.
    #[must_use]
    pub fn to_rows(&self) -> Vec<Vec<f64>> {
        let n = self.len();
        let mut all = vec![vec![0.0; n]; n];
        for (row, entries) in self.rows.iter().enumerate() {
            all[row][row] = self.diagonal[row];
            for &(column, value) in entries {
                all[row][column] = value;
                all[column][row] = value;
            }
        }
        all
    }

    /// Returns true if no entry is infinite or NaN.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let entries = self.rows.iter().flatten();
        let is_finite = entries
            .map(|(_, value)| value)
            .all(|value| value.is_finite());
        is_finite && self.diagonal.iter().all(|value| value.is_finite())
    }

    /// Returns the sum of the magnitudes in each row, which bounds the eigenvalues (Gershgorin).
    pub(super) fn row_sums(&self) -> Vec<f64> {
        let mut sums: Vec<f64> = self.diagonal.iter().map(|value| value.abs()).collect();
        for (row, entries) in self.rows.iter().enumerate() {
            for &(column, value) in entries {
                sums[row] += value.abs();
                sums[column] += value.abs();
            }
        }
        sums
    }

    /// Adds to each diagonal entry `share` times the sum of the magnitudes in its row. If `share`
    /// is 2, the matrix then has no negative eigenvalue.
    pub(super) fn shift(&mut self, share: f64) {
        let sums = self.row_sums();
        let least = 1e-6 * sums.iter().copied().fold(0.0, f64::max);
        for (own, sum) in self.diagonal.iter_mut().zip(sums) {
            *own += share * sum.max(least);
        }
    }

    /// Factorises the matrix as Lᵀ D L, from the last row to the first, and stops at the first
    /// negative pivot.
    pub(super) fn factor(self) -> Factored {
        const ROUNDING: f64 = 64.0 * f64::EPSILON;
        let Self {
            mut diagonal,
            mut rows,
        } = self;
        let mut sizes: Vec<f64> = diagonal.iter().map(|value| value.abs()).collect();
        let mut is_neutral = vec![false; diagonal.len()];
        for row in (0..diagonal.len()).rev() {
            let (pivot, rounding) = (diagonal[row], ROUNDING * sizes[row]);
            let entries = core::mem::take(&mut rows[row]);
            let largest = entries
                .iter()
                .fold(0.0_f64, |most, (_, x)| most.max(x.abs()));
            if pivot.abs() <= rounding && largest <= rounding {
                is_neutral[row] = true;
                continue;
            }
            if pivot <= rounding {
                return Factored::Indefinite(descent(row, &rows));
            }
            let factors: Vec<(usize, f64)> = entries.iter().map(|&(j, x)| (j, x / pivot)).collect();
            for (place, &(column, value)) in entries.iter().enumerate() {
                let change = value * factors[place].1;
                diagonal[column] -= change;
                sizes[column] += change.abs();
                subtract(&mut rows[column], value, &factors[..place]);
            }
            rows[row] = factors;
        }
        Factored::Definite(Factors {
            pivots: diagonal,
            rows,
            is_neutral,
        })
    }
}

/// Subtracts `factor` times one sparse row from another; both are sorted by column.
fn subtract(row: &mut Vec<(usize, f64)>, factor: f64, other: &[(usize, f64)]) {
    let mut place = 0;
    for &(column, value) in other {
        while row.get(place).is_some_and(|(own, _)| *own < column) {
            place += 1;
        }
        match row.get_mut(place) {
            Some((own, entry)) if *own == column => *entry -= factor * value,
            Some(_) | None => row.insert(place, (column, -factor * value)),
        }
        place += 1;
    }
}

/// Returns a direction x for which xᵀ K x equals the pivot of row `row`: x is 1 there, 0 in the
/// rows before it, and in the rows after it such that they have no torque. The rows after it must
/// hold their factors.
fn descent(row: usize, rows: &[Vec<(usize, f64)>]) -> Vec<f64> {
    let mut direction = vec![0.0; rows.len()];
    direction[row] = 1.0;
    for behind in row + 1..rows.len() {
        let terms = rows[behind]
            .iter()
            .map(|&(column, factor)| factor * direction[column]);
        direction[behind] = -terms.sum::<f64>();
    }
    direction
}

/// Outcome of a factorisation.
pub(super) enum Factored {
    /// The matrix has no negative eigenvalues: all pivots of the factorisation are positive, or are
    /// zero (up to rounding) and belong to a zero row.
    Definite(Factors),
    /// A pivot is negative: the energy decreases along this direction.
    Indefinite(Vec<f64>),
}

/// Factors of a matrix that has no negative eigenvalues.
pub(super) struct Factors {
    pivots: Vec<f64>,
    rows: Vec<Vec<(usize, f64)>>,
    is_neutral: Vec<bool>,
}

impl Factors {
    /// Returns true if there is a direction with zero stiffness.
    pub(super) fn is_neutral(&self) -> bool {
        self.is_neutral.contains(&true)
    }

    /// Solves K x = `torques` in place. x has no component in directions of zero stiffness; returns
    /// false if a torque acts along such a direction.
    pub(super) fn solve(&self, torques: &mut [f64]) -> bool {
        let mut is_solved = true;
        let largest = torques.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for row in (0..torques.len()).rev() {
            let own = torques[row];
            for &(column, factor) in &self.rows[row] {
                torques[column] -= factor * own;
            }
        }
        for row in 0..torques.len() {
            if self.is_neutral[row] {
                is_solved &= torques[row].abs() <= 1e-12 * largest;
                torques[row] = 0.0;
                continue;
            }
            let terms = self.rows[row].iter();
            let above: f64 = terms
                .map(|&(column, factor)| factor * torques[column])
                .sum();
            torques[row] = torques[row] / self.pivots[row] - above;
        }
        is_solved
    }
}
