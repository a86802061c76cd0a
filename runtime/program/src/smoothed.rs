//! Motions that measured angles allow.

use std::rc::Rc;

use branched_pendulum::analysis::variational::Linearised;
use branched_pendulum::prelude::Rk4;
use branched_pendulum_measure::{
    ModelSmoother, SmoothedCoordinates, SmoothedMotion, SmoothingError,
};

/// Coordinates and their rates.
pub type Motion<const N: usize> = [[f64; N]; 2];

/// Measured angles, or symmetric coordinates of them.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a, const N: usize> {
    /// Times, s.
    pub times: &'a [f64],
    /// Angles at every time, rad.
    pub angles: &'a [[Option<f64>; N]],
}

/// Draws a motion by normal numbers.
pub type Draw<const N: usize> = dyn Fn(&mut dyn FnMut() -> f64) -> Vec<Motion<N>>;

/// The likeliest motion, and all others that the data allow.
pub struct Smoothed<const N: usize> {
    /// The likeliest motion.
    pub mean: Vec<Motion<N>>,
    /// Another motion that the data allow.
    pub draw: Box<Draw<N>>,
    /// Standard deviation of the angles, rad; of the first one, where each has its own.
    pub noise: f64,
    /// Correlation of successive innovations, in standard deviations, the largest; NaN where
    /// nothing is foretold.
    pub whiteness: f64,
    /// Friction that the equations lack, N m s, pivot by pivot; none where none is sought.
    pub frictions: Vec<f64>,
    /// What the motion does beside its equations; none where it was found without any.
    pub disturbances: Option<Disturbances<N>>,
}

/// Changes of a motion from the time before to each that its equations do not make.
pub struct Disturbances<const N: usize> {
    /// The likeliest ones.
    pub likeliest: Vec<Motion<N>>,
    /// Others, which noise alone would feign of a motion that has none.
    pub spurious: Box<Draw<N>>,
}

/// Smooths each coordinate by itself.
///
/// # Errors
/// [`SmoothingError`].
pub fn one_by_one<const N: usize>(
    record: Record<'_, N>,
    smooth: impl Fn(&[f64], &[Option<f64>]) -> Result<SmoothedMotion<3>, SmoothingError>,
) -> Result<Smoothed<N>, SmoothingError> {
    let data = (0..N).map(|of| record.angles.iter().map(|all| all[of]).collect());
    let series = SmoothedCoordinates::new(data, |data| smooth(record.times, data))?;
    let parted = |state: Vec<f64>| -> Motion<N> {
        [0, N].map(|first| std::array::from_fn(|of| state[first + of]))
    };
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

/// Smooths by equations of motion, beginning from a motion near the true one.
///
/// # Errors
/// [`SmoothingError`].
pub fn by_equations<const N: usize, const D: usize, L: Linearised<f64>>(
    smoother: &ModelSmoother<N>,
    system: &L,
    mass_matrix: impl Fn(&[f64; N]) -> [[f64; N]; N],
    record: Record<'_, N>,
    guess: &[Motion<N>],
) -> Result<Smoothed<N>, SmoothingError> {
    let flat = |[angles, rates]: &Motion<N>| -> [f64; D] {
        std::array::from_fn(|i| if i < N { angles[i] } else { rates[i - N] })
    };
    let parted = |state: &[f64; D]| -> Motion<N> {
        [0, N].map(|first| std::array::from_fn(|i| state[first + i]))
    };
    let guess: Vec<[f64; D]> = guess.iter().map(flat).collect();
    let method = Rk4::new(ModelSmoother::<N>::LONGEST_STEP);
    let motion: Rc<SmoothedMotion<D>> = Rc::new(smoother.smooth(
        &method,
        system,
        mass_matrix,
        record.times,
        record.angles,
        &guess,
    )?);
    let likeliest = motion.disturbances().iter().map(parted).collect();
    let measured = Rc::clone(&motion);
    let spurious = move |normal: &mut dyn FnMut() -> f64| {
        let drawn = measured.spurious_disturbances(normal);
        drawn.iter().map(parted).collect()
    };
    Ok(Smoothed {
        mean: (0..record.times.len())
            .map(|index| parted(&motion.mean(index)))
            .collect(),
        noise: motion.noise(),
        whiteness: motion.whiteness(),
        frictions: motion.frictions().to_vec(),
        disturbances: Some(Disturbances {
            likeliest,
            spurious: Box::new(spurious),
        }),
        draw: Box::new(move |normal| motion.draw(normal).iter().map(parted).collect()),
    })
}
