//! Everything that can go wrong, among trajectories that go well.

use std::mem::discriminant;

use super::{Cases, END, Each, End, Integrator, LaneMethod, LopsidedOde};
use super::{lopsided, outcomes, plain, starts, strict_options, with_each, with_pairs};
use crate::integrate::{InputError, IntegrationError, Options, StopReason, Taylor, Tolerance};
use crate::scalar::InstructionSet;
use crate::system::{Pendulum, State};

/// Both ends are of one kind, failures of the same and about the same time: why, if
/// they ran.
pub(super) fn stop_of_both(index: usize, lane: &End<f64>, plain: &End<f64>) -> Option<StopReason> {
    match (lane, plain) {
        (Ok(lane), Ok(plain)) => {
            assert_eq!(lane.state.time, plain.state.time);
            None
        }
        (Err(IntegrationError::Input(lane)), Err(IntegrationError::Input(plain))) => {
            // NaN is not itself.
            assert_eq!(format!("{lane:?}"), format!("{plain:?}"));
            None
        }
        (Err(lane), Err(plain)) => {
            assert_eq!(discriminant(lane), discriminant(plain), "{index}");
            let times = [lane, plain].map(|e| e.last_state().unwrap().time);
            let reports = [lane, plain].map(|e| *e.report().unwrap());
            let mut step = reports[1].longest_step;
            if reports[1].stop == StopReason::StepLimit {
                // One may accept what, by its last bits, the other one rejects: it is a
                // step ahead then.
                let ahead = reports[0].accepted.abs_diff(reports[1].accepted);
                assert!(ahead <= 1, "{index}: {reports:?}");
                step *= 1.0 + ahead as f64;
            }
            assert!((times[0] - times[1]).abs() <= step, "{index}: {times:?}");
            assert_eq!(reports[0].stop, reports[1].stop);
            Some(reports[0].stop)
        }
        (lane, plain) => panic!("{index}: {lane:?} but {plain:?}"),
    }
}

/// Stops of trajectories that have failed.
struct StopsOfBoth(Vec<State<f64>>, Vec<StopReason>);

impl Each<f64> for StopsOfBoth {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let (Self(starts, seen), model) = (self, lopsided());
        for end in [END, f64::INFINITY] {
            let cases = Cases::Starts(&model, starts);
            let lanes = outcomes(InstructionSet::widest(), method, cases, &[], end);
            for (index, (start, lane)) in starts.iter().zip(&lanes).enumerate() {
                let plain = plain(method, &model, start, end);
                seen.extend(stop_of_both(index, &lane.end, &plain));
            }
        }
    }
}

#[test]
fn errors_are_those_of_the_plain_methods() {
    let mut starts = starts::<f64>();
    starts[2].values[1] = 9.0; // No answer at the start.
    starts[5].values[3] = 60.0; // Runs beyond the wall.
    starts[6].values[0] = f64::NEG_INFINITY;
    starts[9].values.pop();
    starts[10].time = f64::NAN;
    starts[20].time = END;
    let mut stops = StopsOfBoth(starts, Vec::new());
    for options in strict_options() {
        with_each(&options, &mut stops);
    }
    for stop in [
        StopReason::NonFinite,
        StopReason::StepLimit,
        StopReason::StepTooSmall,
    ] {
        assert!(stops.1.contains(&stop), "{stop}");
    }
    let no_order = Taylor::new(Options::with_tolerance(1e-9)).with_order(2);
    let (model, starts) = (lopsided(), &stops.0[..1]);
    let cases = Cases::Starts(&model, starts);
    let refused = outcomes(InstructionSet::widest(), &no_order, cases, &[], END);
    assert!(matches!(
        refused[0].end,
        Err(IntegrationError::Input(InputError::Order { order: 2, .. }))
    ));
}

/// Refused alike, and no other trajectory with them.
struct BelowRounding(InputError<f64>);

impl Each<f64> for BelowRounding {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let (mut starts, model) = (starts::<f64>(), lopsided());
        starts[7].values = vec![1e5, 0.0, 0.0, 0.0];
        let cases = Cases::Starts(&model, &starts);
        let lanes = outcomes(InstructionSet::widest(), method, cases, &[], END);
        for (index, lane) in lanes.iter().enumerate() {
            assert_eq!(lane.end.is_err(), index == 7);
        }
        let expected = Err(IntegrationError::Input(self.0.clone()));
        assert_eq!(plain(method, &model, &starts[7], END), expected);
        assert_eq!(lanes[7].end, expected);
    }
}

#[test]
fn a_tolerance_below_rounding_is_refused() {
    let options = Options {
        relative: Tolerance::Uniform(0.0),
        absolute: Tolerance::Uniform(1e-12),
        ..Options::with_tolerance(1e-9)
    };
    with_pairs(
        &options,
        &mut BelowRounding(InputError::ToleranceBelowRounding {
            component: 0,
            relative: 0.0,
            absolute: 1e-12,
            smallest: 0.25 * f64::EPSILON,
        }),
    );
}

struct FailureSaysWhere;

impl Each<f64> for FailureSaysWhere {
    fn each<M: LaneMethod<LopsidedOde<f64>, f64>>(&mut self, method: &M) {
        let (mut starts, model) = (starts::<f64>(), lopsided());
        starts[5].values[3] = 60.0;
        starts[30].values[1] = 9.0;
        let cases = Cases::Starts(&model, &starts);
        let outcomes = outcomes(InstructionSet::widest(), method, cases, &[], END);
        for (index, outcome) in outcomes.iter().enumerate() {
            match &outcome.end {
                Ok(_) => assert!(index != 5 && index != 30),
                Err(IntegrationError::NonFinite {
                    time, values, last, ..
                }) => {
                    let mut alpha = [0.0; 2];
                    let (theta, omega) = values.split_at(2);
                    model.0.accelerations_into(*time, theta, omega, &mut alpha);
                    assert!(alpha.iter().any(|alpha| !alpha.is_finite()), "{values:?}");
                    assert!(*time >= last.time && *time < last.time + 1.0);
                    assert!((index == 5) == (last.time > starts[index].time), "{last:?}");
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
}

/// The place of a failure is one where the rates have no answer.
#[test]
fn a_failure_says_where() {
    with_each(&Options::with_tolerance(1e-9), &mut FailureSaysWhere);
}

struct FailureKeepsItsSamples;

impl Each<f64> for FailureKeepsItsSamples {
    fn each<M: LaneMethod<LopsidedOde<f64>, f64>>(&mut self, method: &M) {
        let (mut starts, model) = (starts::<f64>(), lopsided());
        starts[5].values[3] = 30.0;
        let times: Vec<f64> = (0..=400).map(|i| 0.1875 + 0.01 * f64::from(i)).collect();
        let end = *times.last().unwrap();
        let cases = Cases::Starts(&model, &starts);
        let outcomes = outcomes(InstructionSet::widest(), method, cases, &times, end);
        for (index, outcome) in outcomes.iter().enumerate() {
            let samples = outcome.samples.len() / 4;
            match &outcome.end {
                Ok(_) => assert_eq!((index == 5, samples), (false, times.len())),
                Err(error) => {
                    let last = error.last_state().unwrap();
                    let until = times.iter().filter(|time| **time <= last.time).count();
                    assert_eq!((index, samples), (5, until));
                    assert!(samples > 10 && samples < times.len(), "{samples}");
                }
            }
        }
    }
}

/// A trajectory that fails has samples up to its last good state.
#[test]
fn a_failure_keeps_its_samples() {
    with_each(&Options::with_tolerance(1e-9), &mut FailureKeepsItsSamples);
}
