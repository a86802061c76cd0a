//! Smoothing by polynomials that are fitted to the data near each time.

use nalgebra::{DMatrix, SVector};

use super::error::{SmoothingError, check_data, check_option};
use super::series::{DataWeights, SmoothedMotion};

/// A smoother without any model of the motion as a whole: near each time it fits a polynomial to
/// the data, with weights that decrease towards the ends of its window. It is a cross-check of
/// [`KinematicSmoother`](super::KinematicSmoother), since it assumes neither a white jerk nor white
/// innovations.
///
/// A. Savitzky, M. J. E. Golay, *Smoothing and differentiation of data by simplified least squares
/// procedures*, Anal. Chem. 36 (1964), here extended to uneven times, to missing data and to the
/// ends of the record. Errors include only the noise, not the deviation of the motion from a
/// polynomial.
///
/// # Examples
///
/// ```
/// use branched_pendulum_measure::LocalPolynomials;
///
/// let times: Vec<f64> = (0..240).map(|i| f64::from(i) / 120.0).collect();
/// // Rounded to milliradians: noise of some 0.3 mrad.
/// let data: Vec<_> = times.iter().map(|t| Some((1e3 * (6.0 * t).sin()).round() * 1e-3)).collect();
///
/// let smoothed = LocalPolynomials::default().smooth(&times, &data)?;
/// assert!((smoothed.noise() / 0.29e-3 - 1.0).abs() < 0.2);
/// let [_, velocity, _] = smoothed.mean(120);
/// assert!((velocity - 6.0 * 6.0_f64.cos()).abs() < 0.02);
/// # Ok::<(), branched_pendulum_measure::SmoothingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalPolynomials {
    /// Degree of the polynomials, 2 to 8. For odd degrees, rates are as accurate as values.
    pub degree: u8,
    /// Number of data in a window; `None` for the number that gives the best prediction of each
    /// datum from the others.
    pub window: Option<usize>,
    /// Standard deviation of the data; `None` to use that of the residuals of the polynomials.
    pub noise: Option<f64>,
}

impl Default for LocalPolynomials {
    fn default() -> Self {
        Self {
            degree: 5,
            window: None,
            noise: None,
        }
    }
}

/// Largest number of data in a window that is tried when the best window is searched.
const WIDEST: usize = 2001;
/// Ratio of the lengths of two successive windows in that search.
const GROWTH: f64 = 1.15;
/// Squared error, relative to that of the best window, above which wider windows are not tried.
const HOPELESS: f64 = 4.0;

impl LocalPolynomials {
    /// Estimates the motion at all times, also where data are missing. The effort is linear in the
    /// number of times, for each of up to 40 windows that are tried.
    ///
    /// # Errors
    ///
    /// [`SmoothingError`].
    pub fn smooth(
        &self,
        times: &[f64],
        data: &[Option<f64>],
    ) -> Result<SmoothedMotion, SmoothingError> {
        check_data(times, data)?;
        check_option("noise", self.noise)?;
        let degree = usize::from(self.degree);
        if !(2..=8).contains(&degree) {
            let (name, value) = ("degree", f64::from(self.degree));
            return Err(SmoothingError::Option { name, value });
        }
        let found = times.iter().zip(data);
        let found = found.filter_map(|(time, datum)| Some([*time, (*datum)?]));
        let record = Record {
            points: found.collect(),
            degree,
        };
        let narrowest = degree + 2;
        let found = record.points.len();
        if found < narrowest {
            let needed = narrowest;
            return Err(SmoothingError::TooFew { found, needed });
        }
        let window = match self.window {
            Some(window) if !(narrowest..=found).contains(&window) => {
                let (name, value) = ("window", window as f64);
                return Err(SmoothingError::Option { name, value });
            }
            Some(window) => window,
            None => record.best_window(),
        };
        let noise = self.noise.unwrap_or_else(|| record.errors(window).noise);
        let weights = times.iter().map(|&time| record.weights(time, window));
        let values: Vec<f64> = record.points.iter().map(|[_, value]| *value).collect();
        Ok(SmoothedMotion::by_weights(
            times,
            weights.collect(),
            &values,
            noise,
        ))
    }
}

/// The data without missing values.
struct Record {
    /// Times and values of the data.
    points: Vec<[f64; 2]>,
    degree: usize,
}

/// Errors of the data relative to the fitted polynomials.
struct Errors {
    /// Mean squared difference between a datum and its prediction from the others.
    foretold: f64,
    /// Standard deviation of the data.
    noise: f64,
}

impl Record {
    fn best_window(&self) -> usize {
        let mut best = (f64::INFINITY, self.degree + 2);
        let mut window = self.degree + 2;
        while window <= self.points.len().min(WIDEST) {
            let error = self.errors(window).foretold;
            if error < best.0 {
                best = (error, window);
            }
            if error > HOPELESS * best.0 {
                break;
            }
            window = (window + 1).max((GROWTH * window as f64) as usize);
        }
        best.1
    }

    fn errors(&self, window: usize) -> Errors {
        let (mut foretold, mut squares) = (0.0, 0.0);
        let mut freedom = 0.0;
        for (index, [time, value]) in self.points.iter().enumerate() {
            let weights = self.weights::<1>(*time, window);
            let near = self.points[weights.first..].iter().zip(&weights.weights);
            let (mean, square) = near.fold((0.0, 0.0), |(mean, square), ([_, value], weight)| {
                (mean + weight[0] * value, square + weight[0] * weight[0])
            });
            let own = index.checked_sub(weights.first);
            let own = own.and_then(|own| weights.weights.get(own));
            let own = own.map_or(0.0, |weight| weight[0]);
            let left = value - mean;
            // The weight of the datum itself may be 1; then the others predict nothing.
            foretold += (left / (1.0 - own).max(f64::EPSILON)).powi(2);
            squares += left * left;
            freedom += 1.0 - 2.0 * own + square;
        }
        Errors {
            foretold: foretold / self.points.len() as f64,
            noise: (squares / freedom).sqrt(),
        }
    }

    /// Returns the weights of the data in the window about a time, with which the first `D` of
    /// value, first and second derivative of the polynomial at that time are computed.
    fn weights<const D: usize>(&self, time: f64, window: usize) -> DataWeights<[f64; D]> {
        let after = self.points.partition_point(|[other, _]| *other < time);
        let mut first = after.saturating_sub(window);
        while first + window < self.points.len()
            && self.points[first + window][0] - time < time - self.points[first][0]
        {
            first += 1;
        }
        let near = &self.points[first..first + window];
        let reach = near.iter().map(|[other, _]| (other - time).abs());
        // Extends a little beyond the farthest datum, so that it has a weight.
        let reach = reach.fold(0.0, f64::max) * (1.0 + 1.0 / window as f64);
        let places = near.iter().map(|[other, _]| (other - time) / reach);
        let places: Vec<f64> = places.collect();
        // The normal equations contain moments only.
        let mut moments = vec![0.0; 2 * self.degree + 1];
        for place in &places {
            let mut power = 1.0 - place * place;
            for moment in &mut moments {
                *moment += power;
                power *= place;
            }
        }
        let columns = self.degree + 1;
        let normal = DMatrix::from_fn(columns, columns, |row, column| moments[row + column]);
        // The first rows of their inverse.
        let asked = DMatrix::identity(columns, D);
        let solved = normal.cholesky().map(|f| f.solve(&asked));
        let solved = solved.unwrap_or_else(|| DMatrix::zeros(columns, D));
        let scales = [1.0, 1.0 / reach, 2.0 / (reach * reach)];
        let coefficients =
            |power: usize| SVector::<f64, D>::from_fn(|row, _| scales[row] * solved[(power, row)]);
        let coefficients: Vec<_> = (0..columns).map(coefficients).collect();
        let weight = |place: &f64| {
            let horner = |sum: SVector<f64, D>, power: &SVector<f64, D>| sum * *place + power;
            let polynomial = coefficients.iter().rev().fold(SVector::zeros(), horner);
            (polynomial * (1.0 - place * place)).into()
        };
        DataWeights {
            first,
            weights: places.iter().map(weight).collect(),
        }
    }
}
