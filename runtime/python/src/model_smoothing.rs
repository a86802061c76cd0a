//! Smoothing by equations of motion.

use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::integrate::Rk4;
use branched_pendulum::system::AbsoluteAngles;
use branched_pendulum_measure::{ModelSmoother, SmoothingError};

use crate::estimates::Estimate;
use crate::measured_model::MeasuredModel;

/// A smoothing by equations of motion that is asked for.
pub(crate) struct ModelSmoothing<'a, M> {
    pub(crate) model: &'a M,
    pub(crate) noise: Option<f64>,
    pub(crate) friction: bool,
    pub(crate) times: &'a [f64],
    pub(crate) angles: &'a [Vec<Option<f64>>],
    pub(crate) guess: &'a [f64],
}

/// Most links of a pendulum whose equations smooth angles.
pub(crate) const MOST_SMOOTHED: usize = 4;

impl<M: MeasuredModel> ModelSmoothing<'_, M> {
    pub(crate) fn estimate<const N: usize, const D: usize>(
        &self,
    ) -> Result<Estimate, SmoothingError> {
        let array = |row: &Vec<Option<f64>>| std::array::from_fn(|link| row[link]);
        let angles: Vec<[Option<f64>; N]> = self.angles.iter().map(array).collect();
        let (guess, _) = self.guess.as_chunks::<D>();
        // Forces on a single coordinate, and in the pivot of a single link.
        let coordinates = self.model.smoothed_coordinates().of_links;
        let pattern = |row: &Vec<f64>| std::array::from_fn(|link| row[link]);
        let parents = self.model.link_parents();
        let joint = |(own, parent): (usize, &Option<usize>)| {
            let weight = |link: usize| match link {
                link if link == own => 1.0,
                link if Some(link) == *parent => -1.0,
                _ => 0.0,
            };
            vec![std::array::from_fn(weight)]
        };
        let smoother = ModelSmoother {
            noise: self.noise,
            disturbances: coordinates.iter().map(pattern).collect(),
            frictions: match self.friction {
                true => parents.iter().enumerate().map(joint).collect(),
                false => Vec::new(),
            },
            ..ModelSmoother::<N>::default()
        };
        let method = Rk4::new(ModelSmoother::<N>::LONGEST_STEP);
        let system = linearised(AbsoluteAngles(self.model.clone()));
        let mass = |theta: &[f64; N]| {
            let rows = self.model.mass_rows(theta);
            let entry = |row: usize, column: usize| rows.get(row)?.get(column).copied();
            std::array::from_fn(|row| {
                std::array::from_fn(|column| entry(row, column).unwrap_or(f64::NAN))
            })
        };
        let motion = smoother.smooth(&method, &system, mass, self.times, &angles, guess)?;
        let rows = |of: &dyn Fn(usize) -> [f64; D]| (0..self.times.len()).flat_map(of).collect();
        Ok(Estimate {
            states: [
                rows(&|time| motion.mean(time)),
                rows(&|time| motion.deviation(time)),
            ],
            accelerations: None,
            noise: vec![motion.noise(); N],
            whiteness: motion.whiteness(),
            frictions: motion.frictions().to_vec(),
            draw: Box::new(move |normal| motion.draw(normal).into_flattened()),
        })
    }
}
