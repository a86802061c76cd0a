//! One run of the experiment, from the release to the last sample.

use std::ops::ControlFlow;

use branched_pendulum::integrate::{DenseError, RunError, Tolerance};
use branched_pendulum::prelude::{
    DenseStep, Dop853, Integrator, Ode, Options, Real, State, SymmetricCoordinates,
};

use super::apparatus::{Apparatus, Flow, Sample};
use super::arguments::{Arguments, Precision};
use super::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::quadrature::GAUSS;

/// Cost of the integration, independent of the type of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Number of evaluations of the equations of motion.
    pub evaluations: u64,
}

/// A run: samples at equal intervals, and the energies transferred between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Initial angle of the parent link, in degrees.
    pub angle_deg: f64,
    /// The samples; the first is taken at the release.
    pub samples: Vec<Sample>,
    /// Energies (J) transferred between sample i and sample i + 1: the integrals of W and of the
    /// power of friction over the interval.
    pub intervals: Vec<Flow>,
    /// The integrator's work.
    pub work: Work,
}

impl Run {
    /// Runs the experiment from the initial angle `angle_deg`. `progress` is called after every
    /// step with the completed fraction of the duration.
    ///
    /// The trajectory is integrated in symmetric coordinates: in these, θ_d is a separate variable
    /// and keeps its relative accuracy however small it is; computed as the difference of two
    /// nearly equal angles, it would lose it. All quantities derived from the trajectory are
    /// computed in double precision.
    ///
    /// # Errors
    /// [`Failure::Parameter`], or [`Failure::Integration`] if the integrator
    /// does not reach the end.
    pub fn new(
        angle_deg: f64,
        arguments: &Arguments,
        progress: impl FnMut(f64),
    ) -> Result<Self, Failure> {
        let apparatus = Apparatus::new(arguments.friction)?;
        match arguments.precision {
            Precision::Double => run::<f64>(angle_deg, arguments, &apparatus, progress),
            Precision::Single => run::<f32>(angle_deg, arguments, &apparatus, progress),
        }
    }

    /// Returns the angle of release as text, for the names of panels and lines.
    pub fn release(&self) -> String {
        format!("θ_1(0) = {:?}°", self.angle_deg)
    }
}

fn run<T: Real>(
    angle_deg: f64,
    arguments: &Arguments,
    apparatus: &Apparatus,
    progress: impl FnMut(f64),
) -> Result<Run, Failure> {
    let result = if arguments.friction.is_zero() {
        let model = BranchedDouble::<T>::default();
        let ode = SymmetricCoordinates(&model);
        integrate(&ode, angle_deg, arguments, apparatus, progress)
    } else {
        let friction = arguments.friction.parameters();
        let model =
            DampedBranchedDouble::<T>::from_parameters_unchecked(DampedBranchedDoubleParameters {
                friction_root: T::from_f64(friction.friction_root),
                friction_children: T::from_f64(friction.friction_children),
            });
        let ode = SymmetricCoordinates(&model);
        integrate(&ode, angle_deg, arguments, apparatus, progress)
    };
    result.map_err(|error| Failure::Integration {
        angle_deg,
        source: error.to_string().into(),
    })
}

/// Integrates from the release to the last sample.
fn integrate<T: Real>(
    ode: &impl Ode<T>,
    angle_deg: f64,
    arguments: &Arguments,
    apparatus: &Apparatus,
    mut progress: impl FnMut(f64),
) -> Result<Run, RunError<T, DenseError<T>>> {
    let start = State::at_rest(
        T::ZERO,
        &[
            T::from_f64(angle_deg.to_radians()),
            T::ZERO,
            T::from_f64(arguments.disturbance),
        ],
    );
    let mut recorder = Recorder::new(apparatus, arguments);
    recorder.sample(&start.values);
    let end = arguments.sample_time(arguments.intervals());
    let options = Options {
        absolute: Tolerance::Uniform(T::from_f64(arguments.absolute_tolerance())),
        // The length of a run is the user's choice, not the method's.
        step_limit: u64::MAX,
        ..Options::with_tolerance(T::from_f64(arguments.tolerance))
    };
    let solution = Dop853::new(options).try_integrate(ode, &start, T::from_f64(end), |step| {
        progress(step.end_time().to_f64() / end);
        recorder.step(step)?;
        Ok(ControlFlow::Continue(()))
    })?;
    let report = solution.report;
    Ok(Run {
        angle_deg,
        samples: recorder.samples,
        intervals: recorder.intervals,
        work: Work {
            steps: report.accepted,
            rejected: report.rejected,
            evaluations: report.evaluations,
        },
    })
}

/// Takes samples and integrates the energy transfer between them, step by step.
struct Recorder<'a> {
    apparatus: &'a Apparatus,
    arguments: &'a Arguments,
    samples: Vec<Sample>,
    intervals: Vec<Flow>,
    /// Energies transferred since the last sample.
    since: Flow,
}

impl<'a> Recorder<'a> {
    fn new(apparatus: &'a Apparatus, arguments: &'a Arguments) -> Self {
        Self {
            apparatus,
            arguments,
            samples: Vec::new(),
            intervals: Vec::new(),
            since: Flow::default(),
        }
    }

    fn step<T: Real>(&mut self, step: &mut DenseStep<'_, T>) -> Result<(), DenseError<T>> {
        let mut values = [T::ZERO; 6];
        let mut from = step.start_time();
        while self.samples.len() <= self.arguments.intervals() {
            let time = T::from_f64(self.arguments.sample_time(self.samples.len()));
            if time > step.end_time() {
                break;
            }
            self.accumulate(step, from, time)?;
            step.eval(time, &mut values)?;
            self.intervals.push(std::mem::take(&mut self.since));
            self.sample(&values);
            from = time;
        }
        self.accumulate(step, from, step.end_time())
    }

    /// Adds the energy transferred from time `from` to time `to`, both within the step.
    fn accumulate<T: Real>(
        &mut self,
        step: &mut DenseStep<'_, T>,
        from: T,
        to: T,
    ) -> Result<(), DenseError<T>> {
        let length = to - from;
        if length == T::ZERO {
            return Ok(());
        }
        let mut values = [T::ZERO; 6];
        for (node, weight) in GAUSS {
            step.eval(from + length * T::from_f64(node), &mut values)?;
            let (coordinates, rates) = halves(&values);
            let flow = self.apparatus.flow(&coordinates, &rates);
            self.since.add(weight * length.to_f64(), &flow);
        }
        Ok(())
    }

    fn sample<T: Real>(&mut self, values: &[T]) {
        let time = self.arguments.sample_time(self.samples.len());
        let (coordinates, rates) = halves(values);
        self.samples
            .push(self.apparatus.measure(time, coordinates, rates));
    }
}

/// Splits a state of six components into three coordinates and their three rates.
fn halves<T: Real>(values: &[T]) -> ([f64; 3], [f64; 3]) {
    let at = |index: usize| values.get(index).map_or(f64::NAN, |value| value.to_f64());
    (
        std::array::from_fn(at),
        std::array::from_fn(|index| at(index + 3)),
    )
}

#[cfg(test)]
mod tests {
    use super::Run;
    use crate::branched_double::Arguments;
    use branched_pendulum_frame::Failure;

    #[test]
    fn samples_stand_at_even_times_and_intervals_between_them() {
        let arguments = Arguments {
            duration: 1.0,
            rate: 30.0,
            ..Arguments::default()
        };
        let mut parts = Vec::new();
        let run = Run::new(30.0, &arguments, |part| parts.push(part)).unwrap();
        assert_eq!(run.samples.len(), 31);
        assert_eq!(run.intervals.len(), 30);
        assert_eq!(run.samples[7].time, 7.0 / 30.0);
        assert_eq!(parts.last(), Some(&1.0));
        assert!(parts.is_sorted());
        assert_eq!(parts.len() as u64, run.work.steps);
        assert_eq!(run.samples[0].theta[0], 30.0_f64.to_radians());
        assert_eq!(run.samples[0].antiphase_energy, {
            let g_2 = 0.10531 * 9.80665 * 0.043;
            g_2 * arguments.disturbance.sin().powi(2)
        });
    }

    #[test]
    fn without_a_disturbance_the_antiphase_mode_stays_empty() {
        let arguments = Arguments {
            disturbance: 0.0,
            duration: 5.0,
            ..Arguments::default()
        };
        let run = Run::new(60.0, &arguments, |_| ()).unwrap();
        assert!(run.samples.iter().all(|s| s.antiphase_energy == 0.0));
        assert!(run.samples.iter().all(|s| s.theta[1] == s.theta[2]));
    }

    #[test]
    fn a_run_that_cannot_start_says_why() {
        let arguments = Arguments {
            tolerance: f64::NAN,
            ..Arguments::default()
        };
        let error = Run::new(60.0, &arguments, |_| ()).unwrap_err();
        assert!(matches!(error, Failure::Integration { angle_deg, .. } if angle_deg == 60.0));
    }
}
