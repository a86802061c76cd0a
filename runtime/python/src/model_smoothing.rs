//! Smoothing by equations of motion.

use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::integrate::Rk4;
use branched_pendulum::system::AbsoluteAngles;
use branched_pendulum_measure::{ModelSmoother, SmoothingError};

use crate::estimates::Estimate;
use crate::measured_model::MeasuredModel;

/// Smooths measured angles by the equations of motion of a model. On request it also estimates
/// friction in each pivot that the equations lack. `guess` contains states near the true ones, one
/// after the other.
pub(crate) fn smoothed_by_equations<M: MeasuredModel>(
    model: &M,
    noise: Option<f64>,
    friction: bool,
    times: &[f64],
    angles: &[Vec<Option<f64>>],
    guess: &[f64],
) -> Result<Estimate, SmoothingError> {
    let parents = model.link_parents();
    let links = parents.len();
    let guess = guess.chunks(2 * links).map(<[f64]>::to_vec);
    let guess: Vec<Vec<f64>> = guess.collect();
    // Friction in the pivot of a single link.
    let joint = |(own, parent): (usize, &Option<usize>)| {
        let weight = |link: usize| match link {
            link if link == own => 1.0,
            link if Some(link) == *parent => -1.0,
            _ => 0.0,
        };
        vec![(0..links).map(weight).collect()]
    };
    let smoother = ModelSmoother {
        noise,
        // Forces on a single coordinate.
        disturbances: model.smoothed_coordinates().of_links,
        frictions: match friction {
            true => parents.iter().enumerate().map(joint).collect(),
            false => Vec::new(),
        },
        ..ModelSmoother::default()
    };
    let method = Rk4::new(ModelSmoother::LONGEST_STEP);
    let system = linearised(AbsoluteAngles(model.clone()));
    let mass = |theta: &[f64]| model.mass_rows(theta);
    let motion = smoother.smooth(&method, &system, mass, times, angles, &guess)?;
    let rows = |of: &dyn Fn(usize) -> Vec<f64>| (0..times.len()).flat_map(of).collect();
    Ok(Estimate {
        states: [
            rows(&|time| motion.mean(time)),
            rows(&|time| motion.deviation(time)),
        ],
        accelerations: None,
        noise: vec![motion.noise(); links],
        whiteness: motion.whiteness(),
        frictions: motion.frictions().to_vec(),
        draw: Box::new(move |normal| motion.draw(normal).concat()),
    })
}
