//! A motion estimated from data, with its errors.

use nalgebra::SVector;

use super::disturbances::Disturbances;
use super::gaussian::{Back, Innovations, Step, smooth};

/// A motion of `D` components at every time, their errors, and draws from all motions that
/// the data allow: for a [`KinematicSmoother`](super::KinematicSmoother) and
/// [`LocalPolynomials`](super::LocalPolynomials) a coordinate with its first and second time
/// derivative, for a [`ModelSmoother`](super::ModelSmoother) angles and angular velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothedMotion<const D: usize> {
    times: Vec<f64>,
    noise: f64,
    densities: Vec<f64>,
    frictions: Vec<f64>,
    means: Vec<[f64; D]>,
    deviations: Vec<[f64; D]>,
    spread: Spread<D>,
    innovations: Vec<f64>,
    disturbances: Disturbances<D>,
    free: usize,
}

/// How the errors of a motion hang together.
#[derive(Clone, Debug, PartialEq)]
enum Spread<const D: usize> {
    /// Each state given the next.
    Steps {
        back: Vec<Back<D>>,
        /// Factors that take the smoother's state to the user's units.
        factors: SVector<f64, D>,
        /// Changes at each time by independent errors of one deviation, which all states share.
        shared: Vec<Vec<SVector<f64, D>>>,
    },
    /// Each state a sum over data of independent errors.
    Sums {
        rows: Vec<DataWeights<D>>,
        /// Number of data.
        data: usize,
    },
}

/// Weights of some data, from the one with index `first` on, in a state.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DataWeights<const D: usize> {
    pub(super) first: usize,
    pub(super) weights: Vec<SVector<f64, D>>,
}

impl<const D: usize> DataWeights<D> {
    fn sum(&self, data: &[f64]) -> SVector<f64, D> {
        let terms = self.weights.iter().zip(data.iter().skip(self.first));
        terms.map(|(weight, datum)| weight * *datum).sum()
    }
}

/// Knowledge of a smoother's state beside the steps.
pub(super) struct Scale<const D: usize> {
    /// Standard deviation of the data.
    pub(super) noise: f64,
    /// Spectral densities of what disturbs the motion.
    pub(super) densities: Vec<f64>,
    /// Factors that take the state to the user's units.
    pub(super) factors: SVector<f64, D>,
}

impl<const D: usize> SmoothedMotion<D> {
    /// Smooths what a filter has gone over.
    pub(super) fn new(
        times: &[f64],
        steps: &[Step<D>],
        innovations: Innovations,
        scale: Scale<D>,
    ) -> Self {
        let Scale {
            noise,
            densities,
            factors,
        } = scale;
        let (smoothed, back) = smooth(steps);
        let means = smoothed
            .iter()
            .map(|state| state.mean.component_mul(&factors).into());
        let deviations = smoothed.iter().map(|state| {
            let deviations = noise * state.deviations();
            deviations.component_mul(&factors).into()
        });
        Self {
            times: times.to_vec(),
            noise,
            densities,
            frictions: Vec::new(),
            means: means.collect(),
            deviations: deviations.collect(),
            spread: Spread::Steps {
                back,
                factors,
                shared: Vec::new(),
            },
            innovations: innovations
                .standard
                .iter()
                .map(|value| value / noise)
                .collect(),
            disturbances: Disturbances::default(),
            free: innovations.free,
        }
    }

    /// The motion with what tells its disturbances.
    pub(super) fn with_disturbances(mut self, disturbances: Disturbances<D>) -> Self {
        self.disturbances = disturbances;
        self
    }

    /// The motion with frictions that were found with it. Their errors come to those of the
    /// states: each is independent, and a series tells what one deviation of it does at each
    /// time, for data of a standard deviation of 1.
    pub(super) fn with_frictions(
        mut self,
        frictions: Vec<f64>,
        errors: impl FnOnce(&[Back<D>]) -> Vec<Vec<SVector<f64, D>>>,
    ) -> Self {
        self.frictions = frictions;
        let Spread::Steps {
            back,
            factors,
            shared,
        } = &mut self.spread
        else {
            return self;
        };
        *shared = errors(back);
        for error in shared.iter() {
            for (deviations, error) in self.deviations.iter_mut().zip(error) {
                let error = self.noise * error.component_mul(factors);
                for (deviation, error) in deviations.iter_mut().zip(&error) {
                    *deviation = deviation.hypot(*error);
                }
            }
        }
        self
    }

    /// A motion whose states are sums of data with independent errors.
    pub(super) fn by_weights(
        times: &[f64],
        rows: Vec<DataWeights<D>>,
        data: &[f64],
        noise: f64,
    ) -> Self {
        let deviation = |row: &DataWeights<D>| {
            let squares = row
                .weights
                .iter()
                .map(|weight| weight.component_mul(weight));
            squares.sum::<SVector<f64, D>>().map(|x| noise * x.sqrt())
        };
        Self {
            times: times.to_vec(),
            noise,
            densities: Vec::new(),
            frictions: Vec::new(),
            means: rows.iter().map(|row| row.sum(data).into()).collect(),
            deviations: rows.iter().map(|row| deviation(row).into()).collect(),
            spread: Spread::Sums {
                rows,
                data: data.len(),
            },
            innovations: Vec::new(),
            disturbances: Disturbances::default(),
            free: 0,
        }
    }

    /// Times, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Standard deviation of the data.
    pub fn noise(&self) -> f64 {
        self.noise
    }

    /// Spectral densities of what disturbs the motion: the jerk of a
    /// [`KinematicSmoother`](super::KinematicSmoother) in the data's unit squared over s⁵,
    /// the generalized forces of a [`ModelSmoother`](super::ModelSmoother) in (N m)² s, one
    /// for each of its patterns; none for [`LocalPolynomials`](super::LocalPolynomials).
    pub fn densities(&self) -> &[f64] {
        &self.densities
    }

    /// Coefficients (N m s) of the friction that the equations of motion lack, one for each
    /// kind that a [`ModelSmoother`](super::ModelSmoother) looks for: zero where the data do
    /// not ask for one.
    pub fn frictions(&self) -> &[f64] {
        &self.frictions
    }

    /// Returns the components at a time, NaN beyond the last.
    pub fn mean(&self, index: usize) -> [f64; D] {
        self.means.get(index).copied().unwrap_or([f64::NAN; D])
    }

    /// Returns their standard deviations, NaN beyond the last time.
    pub fn deviation(&self, index: usize) -> [f64; D] {
        self.deviations.get(index).copied().unwrap_or([f64::NAN; D])
    }

    /// Difference of each datum from the one that those before it led to expect, in standard
    /// deviations of that: white and normal if noise and motion are as assumed. The first
    /// `D` say nothing. [`LocalPolynomials`](super::LocalPolynomials) expect nothing: none.
    pub fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// Returns the correlation of successive innovations in its standard deviations for
    /// white ones: beyond some 3 the motion is not what the smoother takes it for, and its
    /// errors are larger than it says. NaN without innovations.
    pub fn whiteness(&self) -> f64 {
        let used = self.innovations.get(self.free..).unwrap_or_default();
        let square: f64 = used.iter().map(|x| x * x).sum();
        let product: f64 = used.windows(2).map(|pair| pair[0] * pair[1]).sum();
        (used.len() as f64).sqrt() * product / square
    }

    /// Changes of the state from the time before to each that the equations of motion of a
    /// [`ModelSmoother`](super::ModelSmoother) do not make, nor the frictions that it found: those
    /// of the likeliest disturbances. Other smoothers know of none.
    pub fn disturbances(&self) -> Vec<[f64; D]> {
        let innovations = self.innovations.iter();
        let innovations: Vec<f64> = innovations.map(|value| self.noise * value).collect();
        self.disturbances.likeliest(&innovations)
    }

    /// Draws the [`disturbances`](Self::disturbances) that another measurement would feign of a
    /// motion that has none, with its densities as they were found. What the found ones do, and
    /// these do not, is no noise: a test of the equations. `normal` gives independent numbers of
    /// a standard normal distribution.
    pub fn spurious_disturbances(&self, mut normal: impl FnMut() -> f64) -> Vec<[f64; D]> {
        self.disturbances.spurious(|| self.noise * normal())
    }

    /// Draws a motion, each as likely as the data make it: the components at every time.
    /// `normal` gives independent numbers of a standard normal distribution.
    pub fn draw(&self, mut normal: impl FnMut() -> f64) -> Vec<[f64; D]> {
        match &self.spread {
            Spread::Steps {
                back,
                factors,
                shared,
            } => {
                let mut motion = vec![SVector::zeros(); back.len()];
                for error in shared {
                    let size = self.noise * normal();
                    for (slot, error) in motion.iter_mut().zip(error) {
                        *slot += size * error;
                    }
                }
                let mut next = SVector::zeros();
                for (slot, back) in motion.iter_mut().zip(back).rev() {
                    let kick = SVector::from_fn(|_, _| self.noise * normal());
                    next = back.offset + back.gain * next + back.root * kick;
                    *slot += next;
                }
                let told = motion.iter().map(|state| state.component_mul(factors));
                told.map(Into::into).collect()
            }
            Spread::Sums { rows, data } => {
                let errors: Vec<f64> = (0..*data).map(|_| self.noise * normal()).collect();
                let states = rows.iter().zip(&self.means);
                let drawn = |(row, mean): (&DataWeights<D>, &[f64; D])| {
                    (SVector::from(*mean) + row.sum(&errors)).into()
                };
                states.map(drawn).collect()
            }
        }
    }
}
