//! Motions that measured angles allow.

use std::rc::Rc;

use branched_pendulum::analysis::variational::Linearised;
use branched_pendulum::prelude::Rk4;
use branched_pendulum_measure::{
    ModelSmoother, SmoothedCoordinates, SmoothedMotion, SmoothingError,
};

/// Coordinates and their rates.
pub type Motion = [Vec<f64>; 2];

/// Measured angles of links, or symmetric coordinates computed from them.
#[derive(Clone, Copy, Debug)]
pub struct AngleRows<'a> {
    /// Times, s.
    pub times: &'a [f64],
    /// Angles at every time, in rad, one per link; `None` if missing.
    pub angles: &'a [Vec<Option<f64>>],
}

/// Function that draws a random motion, given a source of normal random numbers.
pub type Draw = dyn Fn(&mut dyn FnMut() -> f64) -> Vec<Motion>;

/// The most likely motion, and random draws of motions that agree with the data.
pub struct Smoothed {
    /// The likeliest motion.
    pub mean: Vec<Motion>,
    /// Draws another motion that agrees with the data.
    pub draw: Box<Draw>,
    /// Standard deviation of the angles' errors, in rad; of the first coordinate if each has its
    /// own.
    pub noise: f64,
    /// Largest correlation of successive innovations (prediction errors), in standard deviations;
    /// NaN if the method makes no predictions.
    pub whiteness: f64,
    /// Friction coefficients (N m s) that are missing in the equations, pivot by pivot; empty if
    /// none are searched for.
    pub frictions: Vec<f64>,
    /// Residual torques of the motion; `None` if it was estimated without equations of motion.
    pub disturbances: Option<Disturbances>,
}

/// Changes of a motion, from one time to the next, that its equations do not explain.
pub struct Disturbances {
    /// The likeliest ones.
    pub likeliest: Vec<Motion>,
    /// Draws changes that noise alone would produce for a motion without any.
    pub spurious: Box<Draw>,
}

/// Smooths each coordinate separately.
///
/// # Errors
/// [`SmoothingError`].
pub fn one_by_one(
    record: AngleRows<'_>,
    smooth: impl Fn(&[f64], &[Option<f64>]) -> Result<SmoothedMotion, SmoothingError>,
) -> Result<Smoothed, SmoothingError> {
    let links = record.angles.first().map_or(0, Vec::len);
    let data = (0..links).map(|of| record.angles.iter().map(|all| all[of]).collect());
    let series = SmoothedCoordinates::new(data, |data| smooth(record.times, data))?;
    let times = 0..record.times.len();
    let noise = series.coordinates().first().map(SmoothedMotion::noise);
    Ok(Smoothed {
        mean: times.map(|time| parted(series.mean(time))).collect(),
        noise: noise.unwrap_or(f64::NAN),
        whiteness: series.whiteness(),
        frictions: Vec::new(),
        disturbances: None,
        draw: Box::new(move |normal| series.draw(normal).into_iter().map(parted).collect()),
    })
}

/// Equations of motion for smoothing a record.
pub struct SmoothingEquations<'a, L> {
    /// Equations of motion, with the derivatives of the accelerations.
    pub system: &'a L,
    /// Function that returns the mass matrix at given angles, row by row.
    pub mass_matrix: &'a dyn Fn(&[f64]) -> Vec<Vec<f64>>,
    /// Combinations of links on which forces may act that are missing in the equations.
    pub disturbances: &'a [Vec<f64>],
    /// Pivots whose friction may be missing in the equations: the relative angular velocity in
    /// each, as a linear combination of the links' angular velocities.
    pub frictions: &'a [Vec<Vec<f64>>],
}

impl<L: Linearised<f64>> SmoothingEquations<'_, L> {
    /// Smooths a record, starting from a motion near the true one.
    ///
    /// # Errors
    /// [`SmoothingError`].
    pub fn smooth(
        &self,
        record: AngleRows<'_>,
        guess: &[Motion],
    ) -> Result<Smoothed, SmoothingError> {
        let AngleRows { times, angles } = record;
        let smoother = ModelSmoother {
            disturbances: self.disturbances.to_vec(),
            frictions: self.frictions.to_vec(),
            ..ModelSmoother::default()
        };
        let guess: Vec<Vec<f64>> = guess.iter().map(|parts| parts.concat()).collect();
        let method = Rk4::new(ModelSmoother::LONGEST_STEP);
        let (system, mass) = (self.system, self.mass_matrix);
        let motion = smoother.smooth(&method, system, mass, times, angles, &guess)?;
        let (noise, whiteness) = (motion.noise(), motion.whiteness());
        let mean = (0..times.len()).map(|time| parted(motion.mean(time)));
        let mean = mean.collect();
        let likeliest = motion.disturbances().into_iter().map(parted).collect();
        let frictions = motion.frictions().to_vec();
        let motion = Rc::new(motion);
        let measured = Rc::clone(&motion);
        let spurious = move |normal: &mut dyn FnMut() -> f64| {
            let drawn = measured.spurious_disturbances(normal);
            drawn.into_iter().map(parted).collect()
        };
        Ok(Smoothed {
            mean,
            noise,
            whiteness,
            frictions,
            disturbances: Some(Disturbances {
                likeliest,
                spurious: Box::new(spurious),
            }),
            draw: Box::new(move |normal| motion.draw(normal).into_iter().map(parted).collect()),
        })
    }
}

/// The halves of a state.
fn parted(mut angles: Vec<f64>) -> Motion {
    let rates = angles.split_off(angles.len() / 2);
    [angles, rates]
}
