//! Fits with several laws of friction, and what they leave over.

use std::marker::PhantomData;

use branched_pendulum::analysis::identification::{
    AngleErrors, FamilyOf, Fit, Identification, IdentificationError, Shooting,
};
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::analysis::{KinematicSmoother, ModelSmoother, bands};
use branched_pendulum::prelude::AbsoluteAngles;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::arguments::{Arguments, Law};
use super::scene::{COULOMB, Described, GRAVITY, QUADRATIC};
use super::source::Measurement;
use crate::analyse::motion::{Motion, Record, Smoothed, by_equations, one_by_one};
use crate::failure::Failure;

/// Length of windows, s.
pub const WINDOW: f64 = 1.0;

/// Fits of one measurement.
#[derive(Debug)]
pub struct Study<'a, M> {
    arguments: &'a Arguments,
    measurement: &'a Measurement,
    tree: PhantomData<fn() -> M>,
}

/// Fits with one law of friction, and their errors.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The law.
    pub law: Law,
    /// The fit of windows.
    pub in_windows: Fit,
    /// The fit of one motion over the whole part that is fitted.
    pub fit: Fit,
    /// Errors of that motion, followed to the end of the record.
    pub one_motion: AngleErrors,
    /// Errors in windows of a fit to windows: of the part that was fitted, and of the rest.
    pub windows: [AngleErrors; 2],
}

/// Energy against time.
#[derive(Clone, Debug, Default)]
pub struct Energies {
    /// Times, s.
    pub times: Vec<f64>,
    /// Of measured angles and velocities by smoothness.
    pub by_smoothness: MeasuredEnergy,
    /// Of measured angles and velocities by the fitted equations of motion, which follow the
    /// data where they are wrong: process noise of the likeliest size disturbs them.
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

/// Differences of two energies, each of that at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// Root mean square.
    pub rms: f64,
    /// Largest, and its time, s.
    pub largest: [f64; 2],
    /// Standard deviation of the measured one at that time.
    pub deviation: f64,
}

impl Energies {
    /// Compares the fitted motion's energy with one of the measured ones.
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

/// Draws from which deviations of the measured energy follow.
const DRAWS: usize = 100;

impl<'a, M: Described> Study<'a, M> {
    /// Checks that options name parameters of the tree.
    ///
    /// # Errors
    /// [`Failure::Identification`].
    pub fn new(arguments: &'a Arguments, measurement: &'a Measurement) -> Result<Self, Failure> {
        let parameters = || M::PARAMETERS.iter().map(|name| (*name).to_owned());
        for (name, _) in arguments.known.iter().chain(&arguments.start) {
            if !parameters().any(|parameter| parameter == *name) {
                return Err(Failure::Identification(
                    IdentificationError::UnknownParameter {
                        name: name.clone(),
                        parameters: parameters().collect(),
                    },
                ));
            }
        }
        Ok(Self {
            arguments,
            measurement,
            tree: PhantomData,
        })
    }

    fn identification(&self, law: Law) -> Identification<FamilyOf<M>> {
        let given = |list: &[(String, f64)], name: &str| {
            list.iter()
                .rev()
                .find(|(own, _)| own == name)
                .map(|(_, value)| *value)
        };
        let rough = |name: &str| {
            M::ROUGH
                .iter()
                .find(|(own, _)| *own == name)
                .map(|(_, v)| *v)
        };
        let sizes = || COULOMB.iter().map(|size| (Law::Coulomb, size));
        let sizes = || sizes().chain(QUADRATIC.iter().map(|size| (Law::All, size)));
        let task = Identification::new(FamilyOf::<M>::new()).with_offsets();
        M::PARAMETERS.iter().fold(task, |task, name| {
            let from = sizes().find(|(_, (own, _))| own == name);
            if let Some(value) = given(&self.arguments.known, name) {
                return task.known(name, value);
            }
            match (
                given(&self.arguments.start, name).or_else(|| rough(name)),
                from,
            ) {
                (Some(value), _) => task.unknown(name, value),
                (None, Some((needed, (_, size)))) if law as u8 >= needed as u8 => {
                    task.unknown_from_zero(name, *size)
                }
                (None, Some(_)) => task.known(name, 0.0),
                (None, None) => task.known(name, GRAVITY),
            }
        })
    }

    /// Fits with one law, beginning where the fit with a poorer one has ended.
    ///
    /// # Errors
    /// [`Failure::Identification`].
    pub fn outcome(&self, law: Law, poorer: Option<&Outcome>) -> Result<Outcome, Failure> {
        let (fitted, later) = (self.measurement.fitted(), self.measurement.later());
        let task = self.identification(law);
        let short = task.clone().with_shooting(Shooting {
            first: WINDOW,
            longest: WINDOW,
            ..Shooting::default()
        });
        let in_windows = match poorer {
            Some(poorer) => short.fit_from(&poorer.in_windows, &fitted)?,
            None => short.fit(&fitted)?,
        };
        // One motion goes on from windows.
        let fit = task.fit_from(&in_windows, &fitted)?;
        Ok(Outcome {
            law,
            windows: [
                short.window_errors(&in_windows, &fitted, WINDOW)?,
                short.window_errors(&in_windows, &later, WINDOW)?,
            ],
            one_motion: task.errors(&fit, &self.measurement.record)?,
            in_windows,
            fit,
        })
    }

    /// Energies of the measured and of the fitted motion, with the fitted parameters, of a
    /// tree of N links and D = 2N.
    ///
    /// # Errors
    /// [`Failure::Identification`] or [`Failure::Smoothing`].
    pub fn energies<const N: usize, const D: usize>(
        &self,
        outcome: &Outcome,
    ) -> Result<Energies, Failure> {
        let values = outcome.fit.parameters();
        let tree = M::with_parameters(|index| values[index]);
        let energy = |[theta, omega]: [&[f64]; 2]| {
            tree.kinetic_energy_of(theta, omega) + tree.potential_energy_of(theta)
        };
        let times = self.measurement.record.times();
        let links: [_; N] = std::array::from_fn(|link| &self.measurement.links[link]);
        let offsets = links.map(|link| outcome.fit.offset(link));
        let measured = &self.measurement.angles;
        let at = |time: usize| {
            std::array::from_fn(|link| measured[link][time].map(|angle| angle - offsets[link]))
        };
        let angles: Vec<[Option<f64>; N]> = (0..times.len()).map(at).collect();
        let angles = &angles;
        let record = Record { times, angles };
        let energies = |found: &Smoothed<N>| {
            let energies = |motion: &[Motion<N>]| -> Vec<[f64; 1]> {
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
        let mut unit = [[0.0; N]; N];
        (0..N).for_each(|link| unit[link][link] = 1.0);
        let system = linearised(AbsoluteAngles(&tree));
        let smoother = ModelSmoother {
            disturbances: unit.to_vec(),
            ..ModelSmoother::default()
        };
        let exact = by_equations::<N, D, _>(&smoother, &system, |_| unit, record, &smooth.mean)?;
        let fitted = self
            .identification(outcome.law)
            .predict(&outcome.fit, times)?;
        Ok(Energies {
            times: times.to_vec(),
            by_smoothness: energies(&smooth),
            by_equations: energies(&exact),
            fitted: fitted
                .iter()
                .map(|state| energy(state.values.split_at(N).into()))
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use clap::Parser;

    use super::super::arguments::{Arguments, Law};
    use super::super::scene::Chain;
    use super::super::source::Measurement;
    use super::{Outcome, Study};
    use crate::failure::Failure;

    #[test]
    fn a_simulated_chain_is_found_within_its_bars() {
        let arguments = Arguments {
            duration: 6.0,
            noise: 1e-4,
            known: [("mass_1", 0.088), ("mass_2", 0.102), ("com_1", 0.09)]
                .map(|(name, value)| (name.to_owned(), value))
                .to_vec(),
            ..Arguments::default()
        };
        let measurement = Measurement::new::<Chain>(&arguments).unwrap();
        let study = Study::<Chain>::new(&arguments, &measurement).unwrap();
        let outcome = study.outcome(Law::All, None).unwrap();
        for (name, truth) in measurement.truth.iter().flatten() {
            let Ok(estimate) = outcome.fit.determined(name) else {
                continue;
            };
            let off = (estimate.value - truth).abs();
            assert!(
                off < 4.5 * estimate.naive.unwrap(),
                "{name} {estimate:?} {truth}"
            );
        }
        let rms = outcome.one_motion.rms();
        assert!((0.9e-4..1.1e-4).contains(&rms), "{rms}");
        let energies = study.energies::<2, 4>(&outcome).unwrap();
        let mismatch = energies.mismatch(&energies.by_smoothness);
        assert!(mismatch.largest[0] < 0.015, "{mismatch:?}");
        let mismatch = energies.mismatch(&energies.by_equations);
        assert!(mismatch.largest[0] < 0.002, "{mismatch:?}");
    }

    /// All that `identify` computes of the measured chain, with the time of each part:
    /// `cargo test --release -p branched-pendulum-examples --lib three_laws -- --ignored --nocapture`
    #[test]
    #[ignore = "half a minute"]
    fn three_laws_of_friction_follow_one_another() {
        let file = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../runtime/tests/identification/double-pendulum.csv"
        );
        let line = [
            "identify",
            file,
            "--fit",
            "60",
            "--known",
            "gravity=9.80858",
        ];
        let arguments = Arguments::parse_from(line);
        let measurement = Measurement::new::<Chain>(&arguments).unwrap();
        let study = Study::<Chain>::new(&arguments, &measurement).unwrap();
        let mut outcomes: Vec<Outcome> = Vec::new();
        for &law in &arguments.laws {
            let start = Instant::now();
            let outcome = study.outcome(law, outcomes.last()).unwrap();
            let [first, then] = outcome.windows.each_ref().map(|errors| errors.rms());
            let one = &outcome.one_motion;
            let [fitted, later] =
                [(0.0, 60.0), (60.0, 81.0)].map(|(from, until)| one.rms_between(from, until));
            let bounds = match law {
                Law::Viscous => [1.35e-3, 1.05e-3, 0.1, 0.1],
                Law::Coulomb => [1.2e-3, 0.7e-3, 0.03, 0.02],
                Law::All => [0.45e-3, 0.32e-3, 3.5e-3, 6e-3],
            };
            let found = [first, then, fitted, later];
            println!("{law:?} {found:.6?} in {:.1?}", start.elapsed());
            for fit in [&outcome.in_windows, &outcome.fit] {
                let stages = fit.stages.iter();
                let steps: Vec<_> = stages.map(|stage| (stage.length, stage.steps)).collect();
                println!("  {steps:?}");
            }
            let is_near = |(found, bound): (&f64, f64)| *found < bound;
            assert!(found.iter().zip(bounds).all(is_near), "{law:?} {found:?}");
            outcomes.push(outcome);
        }
        let start = Instant::now();
        let energies = study.energies::<2, 4>(&outcomes[2]).unwrap();
        let mismatch = energies.mismatch(&energies.by_equations);
        println!("{mismatch:?} in {:.1?}", start.elapsed());
        assert!(mismatch.largest[0] < 0.015, "{mismatch:?}");
    }

    #[test]
    fn names_that_no_tree_has_are_refused() {
        let arguments = Arguments {
            known: vec![("mass_3".to_owned(), 1.0)],
            ..Arguments::default()
        };
        let measurement = Measurement::new::<Chain>(&arguments).unwrap();
        let refused = Study::<Chain>::new(&arguments, &measurement);
        assert!(matches!(refused, Err(Failure::Identification(_))));
    }
}
