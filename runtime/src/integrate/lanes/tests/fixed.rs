//! Fixed steps in lanes have the bits of single states: ends, samples, accounts, failures.

use super::models::bad_releases;
use super::{Cases, END, Each, Integrator, LaneMethod, LopsidedOde};
use super::{lopsided, outcomes, starts, times, with_fixed_steps};
use crate::integrate::{IntegrationError, Rk4, StopReason};
use crate::scalar::{InstructionSet, Lane};
use crate::system::State;

/// Compares, and counts what has become of the trajectories.
struct BitsOfSingleStates {
    stops: Vec<StopReason>,
    /// Steps that were not solved, and made in halves.
    rejected: u64,
}

impl BitsOfSingleStates {
    /// The trajectories of `cases` through `times`, and those of the plain method.
    fn compare<T: Lane, M>(
        &mut self,
        method: &M,
        releases: &[(LopsidedOde<T>, State<T>)],
        times: &[T],
    ) where
        M: LaneMethod<LopsidedOde<T>, T>,
        M: Integrator<T, LopsidedOde<T>>,
    {
        let end = *times.last().unwrap();
        let widest = InstructionSet::widest();
        let lanes = outcomes(widest, method, Cases::Pairs(releases), times, end);
        for (index, ((model, start), lane)) in releases.iter().zip(lanes).enumerate() {
            let mut samples = Vec::new();
            let plain = method.sample(model, start, times, |_, values| {
                samples.extend_from_slice(values);
            });
            let report = match &plain {
                Ok(solution) => Some(&solution.report),
                Err(error) => error.report(),
            };
            self.stops.extend(report.map(|report| report.stop));
            self.rejected += report.map_or(0, |report| report.rejected);
            // Texts of numbers are as many digits as it takes, and NaN is NaN.
            let ends = [format!("{:?}", lane.end), format!("{plain:?}")];
            let [of_lane, of_plain] = match report.is_some_and(|report| report.rejected > 0) {
                // Solves that fail may take other numbers of iterations in lanes.
                true => ends.map(|end| without_evaluations(&end)),
                false => ends,
            };
            assert_eq!(of_lane, of_plain, "{index}");
            assert_eq!(
                format!("{:?}", lane.samples),
                format!("{samples:?}"),
                "{index}"
            );
        }
    }
}

/// Returns the text of an end without its number of evaluations.
fn without_evaluations(end: &str) -> String {
    let (before, after) = end.split_once("evaluations: ").unwrap_or((end, ""));
    format!("{before}{}", after.trim_start_matches(char::is_numeric))
}

impl<T: Lane> Each<T> for BitsOfSingleStates {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<T>, T>,
        M: Integrator<T, LopsidedOde<T>>,
    {
        let good = starts::<T>().into_iter().map(|start| (lopsided(), start));
        let good: Vec<_> = good.collect();
        let mut bad = bad_releases::<T>();
        bad[2].1.values[1] = T::from_f64(9.0); // No answer at the start.
        bad[5].1.values[3] = T::from_f64(60.0); // Runs beyond the wall.
        bad[6].1.values[0] = T::NAN;
        bad[9].1.values.pop();
        bad[20].1.time = T::from_f64(END);
        let forwards = times::<T>();
        let backwards: Vec<T> = forwards.iter().map(|&time| -time).collect();
        for releases in [good, bad] {
            self.compare(method, &releases, &forwards);
            self.compare(method, &releases, &backwards);
        }
    }
}

#[test]
fn lanes_have_the_bits_of_single_states() {
    let mut work = BitsOfSingleStates {
        stops: Vec::new(),
        rejected: 0,
    };
    with_fixed_steps::<f64>(u64::MAX, &mut work);
    with_fixed_steps::<f32>(u64::MAX, &mut work);
    // Some trajectories run into the limit, each after as many steps.
    with_fixed_steps::<f64>(150, &mut work);
    for stop in [
        StopReason::EndReached,
        StopReason::NonFinite,
        StopReason::NotSolved,
        StopReason::StepLimit,
    ] {
        assert!(work.stops.contains(&stop), "{stop}");
    }
    assert!(work.rejected > 0);
}

/// A step that is no step is refused, one below the rounding of the time fails in its lane.
#[test]
fn steps_that_lead_nowhere_are_refused_alike() {
    let mut starts = starts::<f64>();
    starts[4].time = -1e12;
    let model = lopsided();
    for step in [0.0, -0.1, f64::NAN, 1e-4] {
        let method = Rk4::new(step);
        let cases = Cases::Starts(&model, &starts);
        let lanes = outcomes(InstructionSet::widest(), &method, cases, &[], 0.5);
        for (index, (start, lane)) in starts.iter().zip(lanes).enumerate() {
            let plain = method.sample(&model, start, &[0.5], |_, _| {});
            assert_eq!(format!("{:?}", lane.end), format!("{plain:?}"));
            let refused = matches!(lane.end, Err(IntegrationError::Input(_)));
            let stuck = matches!(lane.end, Err(IntegrationError::StepTooSmall { .. }));
            assert_eq!((refused, stuck), (step != 1e-4, step == 1e-4 && index == 4));
        }
    }
}

/// Steps reach the times of their grid, and the end is no sliver: the account says so.
#[test]
fn steps_are_those_of_the_grid() {
    let (model, starts) = (lopsided(), starts());
    let method = Rk4::new(0.0625);
    let cases = Cases::Starts(&model, &starts[..8]);
    let lanes = outcomes(InstructionSet::widest(), &method, cases, &[], 1.0);
    for (start, lane) in starts.iter().zip(lanes) {
        let end = lane.end.unwrap();
        let report = end.report;
        assert_eq!(end.state.time, 1.0);
        assert_eq!(report.accepted, ((1.0 - start.time) / 0.0625) as u64);
        assert_eq!(
            (report.shortest_step, report.longest_step),
            (0.0625, 0.0625)
        );
        assert_eq!(report.evaluations, 4 * report.accepted + 1);
    }
}
