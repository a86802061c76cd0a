//! Motions that measured angles allow.

use std::rc::Rc;

use branched_pendulum::analysis::variational::Linearised;
use branched_pendulum::prelude::Rk4;
use branched_pendulum_measure::{
    ModelSmoother, SmoothedCoordinates, SmoothedMotion, SmoothingError,
};

use crate::Failure;

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
    smooth: impl Fn(&[f64], &[Option<f64>]) -> Result<SmoothedMotion<3>, SmoothingError>,
) -> Result<Smoothed, SmoothingError> {
    let links = record.angles.first().map_or(0, Vec::len);
    let data = (0..links).map(|of| record.angles.iter().map(|all| all[of]).collect());
    let series = SmoothedCoordinates::new(data, |data| smooth(record.times, data))?;
    let parted = move |state: Vec<f64>| -> Motion {
        [0, links].map(|first| state[first..first + links].to_vec())
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

/// Most links of a tree whose equations smooth a record.
pub const MOST_LINKS: usize = 6;

impl<L: Linearised<f64>> SmoothingEquations<'_, L> {
    /// Smooths a record, beginning from a motion near the true one.
    ///
    /// # Errors
    /// [`Failure::Smoothing`], and [`Failure::Lacking`] for more links than the equations of six.
    pub fn smooth(&self, record: AngleRows<'_>, guess: &[Motion]) -> Result<Smoothed, Failure> {
        let smoothed = match record.angles.first().map_or(0, Vec::len) {
            1 => self.of_links::<1, 2>(record, guess),
            2 => self.of_links::<2, 4>(record, guess),
            3 => self.of_links::<3, 6>(record, guess),
            4 => self.of_links::<4, 8>(record, guess),
            5 => self.of_links::<5, 10>(record, guess),
            MOST_LINKS => self.of_links::<MOST_LINKS, 12>(record, guess),
            links => {
                return Err(Failure::Lacking {
                    what: format!(
                        "the equations of motion smooth records of up to {MOST_LINKS} links, not \
                         of {links}: describe the part that was measured, or smooth without them"
                    ),
                });
            }
        };
        Ok(smoothed?)
    }

    /// Of N links, D = 2N.
    fn of_links<const N: usize, const D: usize>(
        &self,
        record: AngleRows<'_>,
        guess: &[Motion],
    ) -> Result<Smoothed, SmoothingError> {
        let row = |values: &[f64]| -> [f64; N] { std::array::from_fn(|of| values[of]) };
        let rows = |rows: &[Vec<f64>]| rows.iter().map(|own| row(own)).collect::<Vec<_>>();
        let smoother = ModelSmoother {
            disturbances: rows(self.disturbances),
            frictions: self.frictions.iter().map(|own| rows(own)).collect(),
            ..ModelSmoother::default()
        };
        let mass = |theta: &[f64; N]| -> [[f64; N]; N] {
            let matrix = (self.mass_matrix)(theta);
            std::array::from_fn(|link| row(&matrix[link]))
        };
        let angles = record.angles.iter();
        let angles: Vec<[Option<f64>; N]> = angles
            .map(|all| std::array::from_fn(|of| all[of]))
            .collect();
        let flat = |[angles, rates]: &Motion| -> [f64; D] {
            std::array::from_fn(|of| if of < N { angles[of] } else { rates[of - N] })
        };
        let guess: Vec<[f64; D]> = guess.iter().map(flat).collect();
        let method = Rk4::new(ModelSmoother::<N>::LONGEST_STEP);
        let motion = smoother.smooth(&method, self.system, mass, record.times, &angles, &guess)?;
        let times = 0..record.times.len();
        let (noise, whiteness) = (motion.noise(), motion.whiteness());
        let mean = times.map(|time| parted::<D>(&motion.mean(time))).collect();
        let likeliest = motion.disturbances().iter().map(parted).collect();
        let frictions = motion.frictions().to_vec();
        let motion = Rc::new(motion);
        let measured = Rc::clone(&motion);
        let spurious = move |normal: &mut dyn FnMut() -> f64| {
            let drawn = measured.spurious_disturbances(normal);
            drawn.iter().map(parted).collect()
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
            draw: Box::new(move |normal| motion.draw(normal).iter().map(parted).collect()),
        })
    }
}

fn parted<const D: usize>(state: &[f64; D]) -> Motion {
    let (angles, rates) = state.split_at(D / 2);
    [angles.to_vec(), rates.to_vec()]
}
