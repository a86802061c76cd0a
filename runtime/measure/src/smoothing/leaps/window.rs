//! Fit of a motion that satisfies the equations to a few rows of a record.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use branched_pendulum::analysis::variational::{Linearised, Variational, flow_jacobian};
use branched_pendulum::integrate::Integrator;
use branched_pendulum::system::State;

/// Number of Gauss–Newton steps for one window.
const STEPS: usize = 4;
/// Smallest number of rows of a window before and behind a change.
const FEWEST: usize = 3;

/// A few consecutive rows of a record.
pub(super) struct MotionWindow<'a> {
    pub(super) times: &'a [f64],
    pub(super) data: &'a [Vec<Option<f64>>],
    pub(super) links: usize,
}

/// Motion that fits the data of a window best.
pub(super) struct WindowFit {
    /// State at the first time.
    pub(super) state: DVector<f64>,
    /// Mean square residual, rad².
    pub(super) square: f64,
    /// Degrees of freedom of the mean square.
    pub(super) freedom: f64,
    /// Best change to another motion; `None` if the window is too short for two.
    pub(super) change: Option<Change>,
}

/// Change to another motion within a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    /// First row of the other motion.
    pub(super) row: usize,
    /// Decrease of the sum of squared residuals by the second motion, rad².
    pub(super) gain: f64,
}

/// Residuals of a motion, and their derivatives by its state at the first time.
struct Linearisation {
    matrix: DMatrix<f64>,
    residuals: DVector<f64>,
    /// Data of each row of the window.
    rows: Vec<Range<usize>>,
}

impl MotionWindow<'_> {
    /// Fits a motion that satisfies the equations, starting from an approximate state at the first
    /// time, or from cubic polynomials through the data. `None` if the window has too few data or
    /// the fit fails.
    pub(super) fn fit<L, M>(
        &self,
        method: &M,
        system: &L,
        guess: Option<&DVector<f64>>,
    ) -> Option<WindowFit>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let size = 2 * self.links;
        let count = self.data.iter().flatten().flatten().count();
        if count <= size {
            return None;
        }
        let mut state = match guess {
            Some(guess) => guess.clone(),
            None => self.start()?,
        };
        let mut least = f64::INFINITY;
        let mut last = None;
        for _ in 0..STEPS {
            // A window with a leap may lead far away: what the steps before left counts.
            let Some(linear) = self.linearise(method, system, &state) else {
                break;
            };
            let Some(normal) = linear.matrix.tr_mul(&linear.matrix).cholesky() else {
                break;
            };
            let step = normal.solve(&linear.matrix.tr_mul(&linear.residuals));
            let left = (&linear.residuals - &linear.matrix * &step).norm_squared();
            let now = linear.residuals.norm_squared();
            if !(left.is_finite() && now.is_finite()) {
                break;
            }
            // What the linear problem leaves is that of the motion where the steps converge.
            let has_converged = now - left <= 1e-2 * left;
            least = least.min(if has_converged { left } else { now });
            state += step;
            last = Some((linear, left));
            if has_converged {
                break;
            }
        }
        if !least.is_finite() {
            return None;
        }
        let freedom = (count - size) as f64;
        Some(WindowFit {
            state,
            square: least / freedom,
            freedom,
            // Across a leap the steps may not converge: the last linear problem shows it, too.
            change: last.and_then(|(linear, left)| linear.change(left)),
        })
    }

    /// Returns an approximate state at the first time, from cubic polynomials fitted to the data of
    /// each link.
    fn start(&self) -> Option<DVector<f64>> {
        const POWERS: usize = 4;
        let start = self.times[0];
        let span = self.times.last()? - start;
        let mut state = DVector::zeros(2 * self.links);
        for link in 0..self.links {
            let points = self.times.iter().zip(self.data);
            let points = points.filter_map(|(time, row)| Some(((time - start) / span, row[link]?)));
            let points: Vec<(f64, f64)> = points.collect();
            if points.len() < POWERS {
                return None;
            }
            let matrix = DMatrix::from_fn(points.len(), POWERS, |row, power| {
                points[row].0.powi(power as i32)
            });
            let angles = DVector::from_fn(points.len(), |row, _| points[row].1);
            let normal = matrix.tr_mul(&matrix).cholesky()?;
            let cubic = normal.solve(&matrix.tr_mul(&angles));
            state[link] = cubic[0];
            state[self.links + link] = cubic[1] / span;
        }
        Some(state)
    }

    /// Returns the derivative of the angles by the state at the first time, and the data minus the
    /// angles of the motion from that state, with one row per datum.
    fn linearise<L, M>(&self, method: &M, system: &L, state: &DVector<f64>) -> Option<Linearisation>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let size = state.len();
        let mut now = State::new(self.times[0], state.as_slice().to_vec());
        let mut derivative = DMatrix::identity(size, size);
        let (mut entries, mut residuals) = (Vec::new(), Vec::new());
        let mut rows = Vec::with_capacity(self.times.len());
        for (index, (time, data)) in self.times.iter().zip(self.data).enumerate() {
            if index > 0 {
                let (next, columns) = flow_jacobian(method, system, &now, *time).ok()?;
                derivative = DMatrix::from_vec(size, size, columns) * derivative;
                now = next;
            }
            let first = residuals.len();
            for (link, datum) in data.iter().enumerate() {
                let Some(datum) = datum else { continue };
                entries.extend(derivative.row(link).iter());
                residuals.push(datum - now.values[link]);
            }
            rows.push(first..residuals.len());
        }
        Some(Linearisation {
            matrix: DMatrix::from_row_slice(residuals.len(), size, &entries),
            residuals: DVector::from_vec(residuals),
            rows,
        })
    }
}

impl Linearisation {
    /// Returns the change to another motion that leaves the smallest sum of squares; one motion alone
    /// leaves `left`.
    fn change(&self, left: f64) -> Option<Change> {
        // With the rows before a row: AᵀA, Aᵀr and rᵀr, summed up.
        let size = self.matrix.ncols();
        let mut before = NormalEquations::zeros(size);
        let mut sums = Vec::with_capacity(self.rows.len() + 1);
        for rows in &self.rows {
            sums.push(before.clone());
            before.add(&self.matrix, &self.residuals, rows);
        }
        let whole = before;
        let last = self.rows.len().checked_sub(FEWEST)?;
        let changes = (FEWEST..=last).filter_map(|row| {
            let before = &sums[row];
            let both = before.left()? + whole.less(before).left()?;
            let gain = left - both;
            Some(Change { row, gain })
        });
        changes.max_by(|one, other| one.gain.total_cmp(&other.gain))
    }
}

/// Normal equations of some rows of a linear problem.
#[derive(Clone)]
struct NormalEquations {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    square: f64,
    count: usize,
}

impl NormalEquations {
    fn zeros(size: usize) -> Self {
        Self {
            matrix: DMatrix::zeros(size, size),
            right: DVector::zeros(size),
            square: 0.0,
            count: 0,
        }
    }

    fn add(&mut self, matrix: &DMatrix<f64>, residuals: &DVector<f64>, rows: &Range<usize>) {
        for row in rows.clone() {
            let (entries, residual) = (matrix.row(row).transpose(), residuals[row]);
            self.matrix.ger(1.0, &entries, &entries, 1.0);
            self.right.axpy(residual, &entries, 1.0);
            self.square += residual * residual;
        }
        self.count += rows.len();
    }

    fn less(&self, other: &Self) -> Self {
        Self {
            matrix: &self.matrix - &other.matrix,
            right: &self.right - &other.right,
            square: self.square - other.square,
            count: self.count - other.count,
        }
    }

    /// Returns the sum of squared residuals of the solution; `None` if the rows do not determine it.
    fn left(&self) -> Option<f64> {
        if self.count <= self.right.len() {
            return None;
        }
        let solution = self.matrix.clone().cholesky()?.solve(&self.right);
        let left = self.square - solution.dot(&self.right);
        left.is_finite().then_some(left)
    }
}
