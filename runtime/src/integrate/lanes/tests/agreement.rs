//! Steps, ends and samples are those of the plain methods but for rounding.

use super::{AbsoluteAngles, Cases, END, Each, Integrator, LaneMethod, Lopsided, LopsidedOde};
use super::{lopsided, outcomes, plain, starts, times, with_each};
use crate::integrate::{
    Dop853, Dopri5, InputError, IntegrationError, Options, StopReason, Taylor, Tolerance, Verner98,
};
use crate::scalar::InstructionSet;
use crate::system::State;

struct ThePlainMethodIsMet;

impl Each<f64> for ThePlainMethodIsMet {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let starts = starts::<f64>();
        let (forwards, model) = (times::<f64>(), lopsided());
        let backwards: Vec<f64> = forwards.iter().map(|time| -time).collect();
        for times in [forwards, backwards] {
            let end = *times.last().unwrap();
            let cases = Cases::Starts(&model, &starts);
            let lanes = outcomes(InstructionSet::widest(), method, cases, &times, end);
            for (start, lane) in starts.iter().zip(lanes) {
                let mut samples = Vec::new();
                let plain = method
                    .sample(&model, start, &times, |_, y| {
                        samples.extend_from_slice(y);
                    })
                    .unwrap();
                let lane_end = lane.end.unwrap();
                assert_eq!(lane_end.state.time, end);
                assert_eq!(lane_end.report.stop, StopReason::EndReached);
                assert_eq!(lane_end.state.values, lane.samples[samples.len() - 4..]);
                assert_eq!(lane.samples.len(), samples.len());
                for (a, b) in lane.samples.iter().zip(&samples) {
                    assert!((a - b).abs() < 1e-7, "{start:?}: {a} {b}");
                }
                let (lane, plain) = (lane_end.report, plain.report);
                assert!(
                    lane.accepted.abs_diff(plain.accepted) <= 2,
                    "{lane} {plain}"
                );
                assert!((lane.longest_step - plain.longest_step).abs() < 0.1 * plain.longest_step);
                assert!((lane.shortest_step - plain.shortest_step).abs() <= plain.longest_step);
            }
        }
    }
}

#[test]
fn the_plain_methods_are_met_to_the_tolerance() {
    let basic = Options::with_tolerance(1e-9);
    for options in [
        basic.clone(),
        Options {
            compensated: true,
            initial_step: Some(0.01),
            max_step: Some(0.2),
            ..basic.clone()
        },
        Options {
            absolute: Tolerance::PerComponent(vec![1e-12, 1e-9, 1e-8, 1e-10]),
            ..basic
        },
    ] {
        with_each(&options, &mut ThePlainMethodIsMet);
        for order in [3, 4, 5, 6, 7] {
            let options = Options {
                // For steps that do not depend on the last digits.
                relative: Tolerance::Uniform(1e-2),
                absolute: Tolerance::Uniform(1e-2),
                max_step: Some(0.02),
                ..options.clone()
            };
            ThePlainMethodIsMet.each(&Taylor::new(options).with_order(order));
        }
    }
}

/// Evaluations of an accepted step and of a rejected one, in lanes and not.
fn evaluations_are_counted<M>(
    options: &Options<f64>,
    method: impl FnOnce(Options<f64>) -> M,
    [accepted, rejected]: [u64; 2],
) where
    M: LaneMethod<LopsidedOde<f64>, f64>,
    M: Integrator<f64, LopsidedOde<f64>>,
{
    let (model, starts, method) = (lopsided(), starts(), method(options.clone()));
    let cases = Cases::Starts(&model, &starts);
    let lanes = outcomes(InstructionSet::widest(), &method, cases, &[], END);
    let mut rejections = 0;
    for (start, lane) in starts.iter().zip(lanes) {
        let ends = [lane.end, plain(&method, &model, start, END)];
        let of_first_step = ends.map(|end| {
            let report = end.unwrap().report;
            rejections += report.rejected;
            report.evaluations - accepted * report.accepted - rejected * report.rejected
        });
        let given = options.initial_step.is_some();
        assert_eq!(of_first_step, if given { [1; 2] } else { [2; 2] });
    }
    assert!(rejections > 0);
}

#[test]
fn pairs_count_the_evaluations_of_their_steps() {
    let basic = Options::with_tolerance(1e-7);
    for options in [
        Options {
            beta: 0.04,
            ..basic.clone()
        },
        Options {
            initial_step: Some(0.3),
            ..basic
        },
    ] {
        evaluations_are_counted(&options, Dopri5::new, [6, 6]);
        evaluations_are_counted(&options, Dop853::new, [12, 11]);
        evaluations_are_counted(&options, Verner98::new, [16, 15]);
    }
}

struct ZeroNeedsNoAbsoluteTolerance;

impl Each<f64> for ZeroNeedsNoAbsoluteTolerance {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let still = AbsoluteAngles(Lopsided {
            drive: 0.0,
            lateral: 0.0,
            ..lopsided().0
        });
        let starts = [State::at_rest(0.0, &[0.0, 0.0])];
        let cases = Cases::Starts(&still, &starts);
        let rest = outcomes(InstructionSet::widest(), method, cases, &[], 1.0).remove(0);
        assert_eq!(rest.end, plain(method, &still, &starts[0], 1.0));
        assert_eq!(rest.end.unwrap().state.values, [0.0; 4]);
    }
}

#[test]
fn a_component_that_stays_zero_needs_no_absolute_tolerance() {
    let options = Options {
        absolute: Tolerance::Uniform(0.0),
        ..Options::with_tolerance(1e-9)
    };
    with_each(&options, &mut ZeroNeedsNoAbsoluteTolerance);
    let no_tolerance = Dop853::new(Options {
        relative: Tolerance::Uniform(0.0),
        ..options
    });
    let (model, starts) = (lopsided(), &starts()[..1]);
    let cases = Cases::Starts(&model, starts);
    let refused = outcomes(InstructionSet::widest(), &no_tolerance, cases, &[], 1.0);
    let error = IntegrationError::Input(InputError::NoTolerance { component: 0 });
    assert_eq!(refused[0].end, Err(error));
}
