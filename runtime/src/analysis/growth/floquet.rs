//! Floquet multipliers: the growth of small deviations from periodic motions.

use nalgebra::DMatrix;

use super::{BrakeOrbit, Checked, FINER, GrowthError, TransverseSystem, difference_ranges};
use crate::analysis::eigenvalues::eigenvalues;
use crate::analysis::variational::{Linearised, flow_jacobian};
use crate::integrate::{Dop853, Integrator, Options};
use crate::system::State;

/// The monodromy matrix of small deviations from a periodic motion, which maps deviations at the
/// start of a period to those at its end, and its eigenvalues.
#[derive(Clone, Debug, PartialEq)]
pub struct Floquet {
    /// Period of the equations of the deviations, in s. For differences along a symmetric motion,
    /// whose two halves mirror each other, it is half the period of the motion.
    pub period: f64,
    /// The monodromy matrix, row by row: deviations of angles first, then of velocities.
    pub matrix: Vec<Vec<f64>>,
    /// Eigenvalues of the matrix as [real, imaginary] parts, the largest absolute value first.
    pub multipliers: Vec<[f64; 2]>,
    /// Growth rate, 1/s: the logarithm of the largest absolute multiplier over the period; zero to
    /// rounding if the motion is stable.
    pub rate: Checked,
}

impl Floquet {
    /// Returns the Floquet multipliers of small differences between copies along a periodic
    /// in-phase motion. The angles of `orbit` are those of the system.
    ///
    /// # Errors
    ///
    /// As [`Dop853::integrate`].
    pub fn of_differences<O: TransverseSystem>(
        ode: &O,
        orbit: &BrakeOrbit,
        tolerance: f64,
    ) -> Result<Self, GrowthError> {
        let parts = if orbit.is_symmetric() { 2.0 } else { 1.0 };
        let (place, links) = (difference_ranges(ode), ode.differences());
        Self::checked(orbit.period / parts, tolerance, |method, period| {
            let mut matrix = DMatrix::zeros(2 * links, 2 * links);
            for column in 0..2 * links {
                let mut angles = orbit.release.clone();
                angles.resize(angles.len() + links, 0.0);
                let mut start = State::at_rest(0.0, &angles);
                let own = [place.angles.clone(), place.rates.clone()];
                let places: Vec<usize> = own.into_iter().flatten().collect();
                start.values[places[column]] = 1.0;
                let end = method.run(ode, &start, period)?.state;
                for (row, place) in places.iter().enumerate() {
                    matrix[(row, column)] = end.values[*place];
                }
            }
            Ok(matrix)
        })
    }

    /// Returns the multipliers of deviations from a motion of the system itself, as
    /// [`linearised`](crate::analysis::variational::linearised) returns it. For a conservative
    /// system, two multipliers are 1.
    ///
    /// # Errors
    ///
    /// As [`Dop853::integrate`].
    pub fn of_motion<L: Linearised<f64>>(
        system: &L,
        orbit: &BrakeOrbit,
        tolerance: f64,
    ) -> Result<Self, GrowthError> {
        let start = State::at_rest(0.0, &orbit.release);
        Self::checked(orbit.period, tolerance, |method, period| {
            let (_, columns) = flow_jacobian(method, system, &start, period)?;
            let n = start.values.len();
            Ok(DMatrix::from_column_slice(n, n, &columns))
        })
    }

    fn checked(
        period: f64,
        tolerance: f64,
        monodromy: impl Fn(&Dop853<f64>, f64) -> Result<DMatrix<f64>, GrowthError>,
    ) -> Result<Self, GrowthError> {
        let [coarse, fine] = [tolerance, FINER * tolerance].map(|tolerance| {
            let matrix = monodromy(&Dop853::new(Options::with_tolerance(tolerance)), period)?;
            let values = eigenvalues(&matrix).ok_or(GrowthError::Multipliers)?;
            let mut values: Vec<[f64; 2]> = values.iter().map(|v| [v.re, v.im]).collect();
            values.sort_by(|a, b| size(b).total_cmp(&size(a)));
            Ok::<_, GrowthError>((matrix, values))
        });
        let ((_, coarse), (matrix, multipliers)) = (coarse?, fine?);
        let rate = |values: &[[f64; 2]]| values.first().map_or(f64::NAN, size).ln() / period;
        Ok(Self {
            period,
            rate: Checked::of_rates(rate(&coarse), rate(&multipliers), period),
            matrix: matrix
                .row_iter()
                .map(|row| row.iter().copied().collect())
                .collect(),
            multipliers,
        })
    }
}

fn size([re, im]: &[f64; 2]) -> f64 {
    re.hypot(*im)
}
