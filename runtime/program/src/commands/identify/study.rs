//! Fits with several friction laws, and their residuals.

use branched_pendulum::Energy;
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::AbsoluteAngles;
use branched_pendulum_measure::identification::{
    AngleErrors, Fit, Identification, SearchObserver, Unfound, WindowedFit, best,
};
use branched_pendulum_measure::{KinematicSmoother, bands};
use branched_pendulum_trees::TreeDescription;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::arguments::{Arguments, Law, Sign};
use super::source::Measurement;
use super::unknowns::{Knowledge, Unknowns};
use crate::Failure;
use crate::smoothed::{AngleRows, Motion, Smoothed, SmoothingEquations, one_by_one};

/// Length of windows, s.
pub const WINDOW: f64 = 1.0;

/// Fits of one measurement.
#[derive(Debug)]
pub struct Study<'a> {
    arguments: &'a Arguments,
    unknowns: &'a Unknowns,
    measurement: &'a Measurement,
}

/// Fits with one friction law, and their errors.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The law.
    pub law: Law,
    /// Fit of short windows, and fit of one motion over the whole fitted part.
    pub found: WindowedFit,
    /// Errors of that motion, continued to the end of the record; `None` if the fit failed.
    pub errors: Option<AngleErrors>,
    /// Errors in windows, for a fit to windows: in the fitted part, and in the rest.
    pub windows: [AngleErrors; 2],
}

impl Outcome {
    /// Returns the length of the windows in s: shorter than [`WINDOW`] if the motion is lost in
    /// windows of that length.
    pub fn window(&self) -> f64 {
        self.found.window().unwrap_or(WINDOW)
    }

    /// Returns the result: the fit of one motion or, if that failed, the fit of windows.
    pub fn result(&self) -> Result<&Fit, &Unfound> {
        self.found.result()
    }
}

/// Energy against time.
#[derive(Clone, Debug, Default)]
pub struct Energies {
    /// Times, s.
    pub times: Vec<f64>,
    /// Energy from angles and velocities that were smoothed without equations of motion.
    pub by_smoothness: MeasuredEnergy,
    /// Energy from angles and velocities that were smoothed with the fitted equations of motion.
    /// Process noise of the most likely size lets the result follow the data where the equations
    /// are wrong.
    pub by_equations: MeasuredEnergy,
    /// Of the fitted motion, J.
    pub fitted: Vec<f64>,
}

/// Energy of the measured motion.
#[derive(Clone, Debug, Default)]
pub struct MeasuredEnergy {
    /// At every time, J.
    pub values: Vec<f64>,
    /// Standard deviations, J.
    pub deviations: Vec<f64>,
}

/// Difference between two energies, each relative to its initial value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// Root mean square.
    pub rms: f64,
    /// Largest, and its time, s.
    pub largest: [f64; 2],
    /// Standard deviation of the measured energy at that time.
    pub deviation: f64,
}

impl Energies {
    /// Compares the energy of the fitted motion with one of the measured energies.
    pub fn mismatch(&self, measured: &MeasuredEnergy) -> Mismatch {
        let start = self.fitted.first().copied().unwrap_or(f64::NAN);
        let mut squares = 0.0;
        let mut found = Mismatch {
            rms: f64::NAN,
            largest: [0.0, f64::NAN],
            deviation: f64::NAN,
        };
        for (index, &time) in self.times.iter().enumerate() {
            let difference = (measured.values[index] - self.fitted[index]).abs() / start;
            squares += difference * difference;
            if difference > found.largest[0] {
                found.largest = [difference, time];
                found.deviation = measured.deviations[index] / start;
            }
        }
        found.rms = (squares / self.times.len() as f64).sqrt();
        found
    }
}

/// Number of random draws from which standard deviations of the measured energy are computed.
const DRAWS: usize = 100;

impl<'a> Study<'a> {
    /// Fits of this measurement.
    pub fn new(
        arguments: &'a Arguments,
        unknowns: &'a Unknowns,
        measurement: &'a Measurement,
    ) -> Self {
        Self {
            arguments,
            unknowns,
            measurement,
        }
    }

    /// Fits with one law, starting from the result of the fit with a simpler law. The observer can
    /// end the search early.
    ///
    /// # Errors
    /// [`Failure::Identification`].
    pub fn outcome(
        &self,
        law: Law,
        poorer: Option<&Outcome>,
        observer: SearchObserver<'_>,
    ) -> Result<Outcome, Failure> {
        let (fitted, later) = (self.measurement.fitted(), self.measurement.later());
        let task = identification(self.arguments, self.unknowns, law);
        let poorer = poorer.map(|poorer| &poorer.found);
        let found = task.fit_by_windows(&fitted, WINDOW, poorer, observer)?;
        let errors = task.motion_errors(&found, &self.measurement.record)?;
        let window = found.window().unwrap_or(WINDOW);
        let in_windows = |record| task.window_errors(best(&found.in_windows), record, window);
        let windows = match &found.in_windows {
            Ok(_) => [in_windows(&fitted)?, in_windows(&later)?],
            Err(_) => [&fitted, &later].map(|record| {
                let none = AngleErrors::missing(record);
                in_windows(record).unwrap_or(none)
            }),
        };
        Ok(Outcome {
            law,
            errors,
            windows,
            found,
        })
    }

    /// Returns the energies of the measured motion, and of the motion with the fitted parameters.
    ///
    /// # Errors
    /// [`Failure::Identification`] or [`Failure::Smoothing`].
    pub fn energies(&self, law: Law, fit: &Fit) -> Result<Energies, Failure> {
        let count = self.measurement.links.len();
        let tree = self.unknowns.subject_as_given(fit.parameters())?.tree;
        let energy = |[theta, omega]: [&[f64]; 2]| {
            tree.kinetic_energy_of(theta, omega) + tree.potential_energy_of(theta)
        };
        let times = self.measurement.record.times();
        let links = self.measurement.links.iter();
        let offsets: Vec<f64> = links.map(|link| fit.offset(link)).collect();
        let measured = self.measurement.angles.iter();
        let links: Vec<_> = measured.zip(&offsets).collect();
        let at = |time: usize| -> Vec<Option<f64>> {
            let links = links.iter();
            links
                .map(|(angles, offset)| angles[time].map(|angle| angle - *offset))
                .collect()
        };
        let angles: Vec<Vec<Option<f64>>> = (0..times.len()).map(at).collect();
        let angles = &angles;
        let record = AngleRows { times, angles };
        let energies = |found: &Smoothed| {
            let energies = |motion: &[Motion]| -> Vec<[f64; 1]> {
                let parts = motion.iter().map(|[theta, omega]| [&theta[..], omega]);
                parts.map(|parts| [energy(parts)]).collect()
            };
            let mut random = Xoshiro256PlusPlus::seed_from_u64(self.arguments.seed);
            let mut normal = || StandardNormal.sample(&mut random);
            let (bands, _) = bands(DRAWS, || energies(&(found.draw)(&mut normal)));
            MeasuredEnergy {
                values: energies(&found.mean).concat(),
                deviations: bands.deviations.concat(),
            }
        };
        let smooth = one_by_one(record, |times, angles| {
            KinematicSmoother::default().smooth(times, angles)
        })?;
        // What is lacking accelerates each link by itself, as if each had an inertia of one.
        let mut unit = vec![vec![0.0; count]; count];
        (0..count).for_each(|link| unit[link][link] = 1.0);
        let equations = SmoothingEquations {
            system: &linearised(AbsoluteAngles(&tree)),
            mass_matrix: &|_| unit.clone(),
            disturbances: &unit,
            frictions: &[],
        };
        let exact = equations.smooth(record, &smooth.mean)?;
        let fitted = identification(self.arguments, self.unknowns, law).predict(fit, times)?;
        Ok(Energies {
            times: times.to_vec(),
            by_smoothness: energies(&smooth),
            by_equations: energies(&exact),
            fitted: fitted
                .iter()
                .map(|state| energy(state.values.split_at(count).into()))
                .collect(),
        })
    }
}

/// Creates the identification with a friction law, from angles with offsets and from the
/// frequencies in the arguments.
pub fn identification(
    arguments: &Arguments,
    unknowns: &Unknowns,
    law: Law,
) -> Identification<TreeDescription> {
    let task = Identification::new(unknowns.family()).with_offsets();
    let frequencies = arguments.frequency.iter().flatten();
    let task = frequencies.fold(task, |task, own| task.with_frequency(*own));
    unknowns.parameters.iter().fold(task, |task, own| {
        let name = &own.name;
        let task = match own.knowledge {
            Knowledge::Known(value) => return task.known(name, value),
            _ if own.law() > law => return task.known(name, 0.0),
            Knowledge::Guess(value) => task.unknown(name, value),
            Knowledge::Size(size) => task.unknown_from_zero(name, size),
        };
        match (arguments.friction, own.is_friction()) {
            (Sign::Nonnegative, true) => task.at_least(name, 0.0),
            _ => task,
        }
    })
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::time::Instant;

    use super::super::arguments::{Arguments, Law};
    use super::super::source::Measurement;
    use super::super::unknowns::Unknowns;
    use branched_pendulum_measure::identification::{SearchProgress, best};

    use super::{Outcome, Study};
    use crate::frame::command_line::parse_line;

    fn on(_: &SearchProgress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    #[test]
    fn a_simulated_chain_is_found_within_its_bars() {
        let line = "--duration 6 --noise 1e-4 --set mass_1=0.088,mass_2=0.102,com_1=0.09";
        let arguments: Arguments = parse_line(line).unwrap();
        let unknowns = Unknowns::new(&arguments).unwrap();
        let measurement = Measurement::new(&arguments, &unknowns).unwrap();
        let study = Study::new(&arguments, &unknowns, &measurement);
        let outcome = study.outcome(Law::All, None, &on).unwrap();
        for (name, truth) in measurement.truth.iter().flatten() {
            let Ok(estimate) = outcome.result().unwrap().determined(name) else {
                continue;
            };
            let off = (estimate.value - truth).abs();
            assert!(
                off < 4.5 * estimate.naive.unwrap(),
                "{name} {estimate:?} {truth}"
            );
        }
        let rms = outcome.errors.as_ref().unwrap().rms();
        assert!((0.9e-4..1.1e-4).contains(&rms), "{rms}");
        let energies = study.energies(Law::All, outcome.result().unwrap());
        let energies = energies.unwrap();
        let mismatch = energies.mismatch(&energies.by_smoothness);
        assert!(mismatch.largest[0] < 0.015, "{mismatch:?}");
        let mismatch = energies.mismatch(&energies.by_equations);
        assert!(mismatch.largest[0] < 0.002, "{mismatch:?}");
    }

    /// Runs everything that `identify` computes for the measured chain, and prints the time of each
    /// part: `cargo test --release -p branched-pendulum-program --lib three_laws -- --ignored
    /// --nocapture`
    #[test]
    #[ignore = "half a minute"]
    fn three_laws_of_friction_follow_one_another() {
        let file = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../measure/tests/measure/identification/double-pendulum.csv"
        );
        let line = format!("{file} --fit 60 --set gravity=9.80858");
        let arguments: Arguments = parse_line(&line).unwrap();
        let unknowns = Unknowns::new(&arguments).unwrap();
        let measurement = Measurement::new(&arguments, &unknowns).unwrap();
        let study = Study::new(&arguments, &unknowns, &measurement);
        let mut outcomes: Vec<Outcome> = Vec::new();
        for &law in &arguments.laws {
            let start = Instant::now();
            let outcome = study.outcome(law, outcomes.last(), &on).unwrap();
            let [first, then] = outcome.windows.each_ref().map(|errors| errors.rms());
            let one = outcome.errors.as_ref().unwrap();
            let [fitted, later] =
                [(0.0, 60.0), (60.0, 81.0)].map(|(from, until)| one.rms_between(from, until));
            let bounds = match law {
                Law::Viscous => [1.35e-3, 1.05e-3, 0.1, 0.1],
                Law::Coulomb => [1.2e-3, 0.7e-3, 0.03, 0.02],
                Law::All => [0.45e-3, 0.32e-3, 3.5e-3, 6e-3],
            };
            let found = [first, then, fitted, later];
            println!("{law:?} {found:.6?} in {:.1?}", start.elapsed());
            for fit in [&outcome.found.in_windows, &outcome.found.one_motion].map(best) {
                println!("  {}", fit.convergence);
                let stages = fit.stages.iter();
                let steps: Vec<_> = stages.map(|stage| (stage.length, stage.steps)).collect();
                println!("  {steps:?}");
            }
            let is_near = |(found, bound): (&f64, f64)| *found < bound;
            assert!(found.iter().zip(bounds).all(is_near), "{law:?} {found:?}");
            outcomes.push(outcome);
        }
        let start = Instant::now();
        let energies = study.energies(Law::All, outcomes[2].result().unwrap());
        let energies = energies.unwrap();
        let mismatch = energies.mismatch(&energies.by_equations);
        println!("{mismatch:?} in {:.1?}", start.elapsed());
        assert!(mismatch.largest[0] < 0.015, "{mismatch:?}");
    }
}
