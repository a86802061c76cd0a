//! Motions that measured angles allow.

use std::rc::Rc;

use branched_pendulum::analysis::variational::Linearised;
use branched_pendulum::prelude::Rk4;
use branched_pendulum_measure::{
    ModelSmoother, SmoothedCoordinates, SmoothedMotion, SmoothingError,
};

/// Coordinates and their rates.
pub type Motion = [Vec<f64>; 2];

/// Measured angles, or symmetric coordinates of them.
#[derive(Clone, Copy, Debug)]
pub struct AngleRows<'a> {
    /// Times, s.
    pub times: &'a [f64],
    /// Angles at every time, rad: as many as there are links.
    pub angles: &'a [Vec<Option<f64>>],
}

/// Draws a motion by normal numbers.
pub type Draw = dyn Fn(&mut dyn FnMut() -> f64) -> Vec<Motion>;

/// The likeliest motion, and all others that the data allow.
pub struct Smoothed {
    /// The likeliest motion.
    pub mean: Vec<Motion>,
    /// Another motion that the data allow.
    pub draw: Box<Draw>,
    /// Standard deviation of the angles, rad; of the first one, where each has its own.
    pub noise: f64,
    /// Correlation of successive innovations, in standard deviations, the largest; NaN where
    /// nothing is foretold.
    pub whiteness: f64,
    /// Friction that the equations lack, N m s, pivot by pivot; none where none is sought.
    pub frictions: Vec<f64>,
    /// What the motion does beside its equations; none where it was found without any.
    pub disturbances: Option<Disturbances>,
}

/// Changes of a motion from the time before to each that its equations do not make.
pub struct Disturbances {
    /// The likeliest ones.
    pub likeliest: Vec<Motion>,
    /// Others, which noise alone would feign of a motion that has none.
    pub spurious: Box<Draw>,
}

/// Smooths each coordinate by itself.
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

/// Equations of motion by which a record is smoothed.
pub struct SmoothingEquations<'a, L> {
    /// Accelerations of the links with their derivatives.
    pub system: &'a L,
    /// The mass matrix at the angles, by rows.
    pub mass_matrix: &'a dyn Fn(&[f64]) -> Vec<Vec<f64>>,
    /// Combinations of links on which forces act that the equations lack.
    pub disturbances: &'a [Vec<f64>],
    /// Rates in pivots whose friction may be lacking, as combinations of those of links.
    pub frictions: &'a [Vec<Vec<f64>>],
}

impl<L: Linearised<f64>> SmoothingEquations<'_, L> {
    /// Smooths a record, beginning from a motion near the true one.
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
