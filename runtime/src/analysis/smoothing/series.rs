//! A motion estimated from data, with its errors.

use nalgebra::SVector;

use super::gaussian::{Back, Innovations, Step, smooth};

/// A motion of `D` components at every time, their errors, and draws from all motions that
/// the data allow: for a [`KinematicSmoother`](super::KinematicSmoother) a coordinate with
/// its first and second time derivative, for a [`ModelSmoother`](super::ModelSmoother) angles
/// and angular velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothedMotion<const D: usize> {
    times: Vec<f64>,
    noise: f64,
    density: f64,
    means: Vec<[f64; D]>,
    deviations: Vec<[f64; D]>,
    back: Vec<Back<D>>,
    innovations: Vec<f64>,
    free: usize,
    /// Factors that take the smoother's state to the user's units.
    scales: SVector<f64, D>,
}

/// What a smoother knows of its state beside the steps.
pub(super) struct Scale<const D: usize> {
    /// Standard deviation of the data.
    pub(super) noise: f64,
    /// Spectral density of what disturbs the motion.
    pub(super) density: f64,
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
            density,
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
            density,
            means: means.collect(),
            deviations: deviations.collect(),
            back,
            innovations: innovations
                .standard
                .iter()
                .map(|value| value / noise)
                .collect(),
            free: innovations.free,
            scales: factors,
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

    /// Spectral density of what disturbs the motion: the jerk of a
    /// [`KinematicSmoother`](super::KinematicSmoother) in the data's unit squared over s⁵,
    /// the angular acceleration of a [`ModelSmoother`](super::ModelSmoother) in rad²/s³.
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Returns the components at a time, NaN beyond the last.
    pub fn mean(&self, index: usize) -> [f64; D] {
        self.means.get(index).copied().unwrap_or([f64::NAN; D])
    }

    /// Returns their standard deviations, NaN beyond the last time.
    pub fn deviation(&self, index: usize) -> [f64; D] {
        self.deviations.get(index).copied().unwrap_or([f64::NAN; D])
    }

    /// What each datum differed from what those before it led to expect, in standard
    /// deviations of that: white and normal if noise and motion are as assumed. The first
    /// `D` say nothing.
    pub fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// Returns the correlation of successive innovations in its standard deviations for
    /// white ones: beyond some 3 the motion is not what the smoother takes it for, and its
    /// errors are larger than it says.
    pub fn whiteness(&self) -> f64 {
        let used = self.innovations.get(self.free..).unwrap_or_default();
        let square: f64 = used.iter().map(|x| x * x).sum();
        let product: f64 = used.windows(2).map(|pair| pair[0] * pair[1]).sum();
        (used.len() as f64).sqrt() * product / square
    }

    /// Draws a motion, each as likely as the data make it: the components at every time.
    /// `normal` gives independent numbers of a standard normal distribution.
    pub fn draw(&self, mut normal: impl FnMut() -> f64) -> Vec<[f64; D]> {
        let mut motion = vec![[0.0; D]; self.back.len()];
        let mut next = SVector::zeros();
        for (slot, back) in motion.iter_mut().zip(&self.back).rev() {
            let kick = SVector::from_fn(|_, _| self.noise * normal());
            next = back.offset + back.gain * next + back.root * kick;
            *slot = next.component_mul(&self.scales).into();
        }
        motion
    }
}
