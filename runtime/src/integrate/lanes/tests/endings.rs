//! Trajectories end where a condition is met, lane by lane.

use core::f64::consts::PI;
use core::ops::ControlFlow;
use core::slice::from_ref;

use super::{Cases, END, Each, Ending, LaneMethod, LopsidedOde, assert_same, lopsided};
use super::{outcomes_until, starts};
use crate::ensemble::Ensemble;
use crate::integrate::{
    Crossing, Dop853, Event, IntegrationError, Integrator, Options, StopReason,
};
use crate::scalar::{InstructionSet, Lane};
use crate::system::State;

/// Releases of which some turn a link over and some do not.
fn releases<T: Lane>() -> Vec<State<T>> {
    // More of them than registers have lanes.
    let mut all: Vec<_> = starts::<T>().into_iter().take(19).collect();
    for (index, start) in all.iter_mut().enumerate() {
        let part = index as f64 / 18.0;
        start.values[0] = T::from_f64(0.5 + 2.5 * part);
        start.values[1] = T::from_f64(3.0 * part - 0.2);
    }
    all
}

/// The square of an angle less that of half a turn.
fn beyond_the_top<T: Lane>(link: usize) -> impl Fn(T, &[T]) -> T + Sync {
    let top = T::from_f64(PI * PI);
    move |_, state| state[link] * state[link] - top
}

struct AsAlone;

impl Each<f64> for AsAlone {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let (model, starts) = (lopsided(), releases::<f64>());
        let functions = [0, 1].map(beyond_the_top);
        let endings = functions
            .each_ref()
            .map(|function| Ending::new(Crossing::Rising, function));
        let until = |set, starts: &[_]| {
            let cases = Cases::Starts(&model, starts);
            outcomes_until(set, method, cases, &[], END, &endings)
        };
        let (mut turned, mut stayed) = (0, 0);
        let together = until(InstructionSet::widest(), &starts);
        for (start, outcome) in starts.iter().zip(&together) {
            let events = functions.each_ref().map(|function| {
                let function: &dyn Fn(f64, &[f64]) -> f64 = function;
                Event::new(Crossing::Rising, function).with_terminal(1)
            });
            let alone = method
                .integrate_with_events(&model, start, END, &events, |_| ControlFlow::Continue(()))
                .unwrap();
            let lane = outcome.end.as_ref().unwrap();
            assert_eq!(lane.report.stop, alone.report.stop, "{start:?}");
            match alone.report.stop {
                StopReason::StoppedByEvent => turned += 1,
                _ => stayed += 1,
            }
            let off = (lane.state.time - alone.state.time).abs();
            assert!(off < 1e-5, "{start:?}: {off:e}");
        }
        assert!(turned > 3 && stayed > 3, "{turned} {stayed}");
        // Neither the neighbours nor the width of the registers change a bit.
        for set in InstructionSet::ALL {
            let alone: Vec<_> = starts
                .iter()
                .flat_map(|start| until(set, from_ref(start)))
                .collect();
            assert_same(&until(set, &starts), &alone);
        }
        let [_, avx2, avx512] = InstructionSet::ALL.map(|set| until(set, &starts));
        assert_same(&avx2, &avx512);
    }
}

#[test]
fn links_turn_over_in_lanes_when_they_do_alone() {
    super::with_each(&Options::with_tolerance(1e-10), &mut AsAlone);
}

#[test]
fn a_function_that_is_not_a_number_ends_its_lane_alone() {
    let (model, starts) = (lopsided(), releases::<f64>());
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let undefined = |time: f64, state: &[f64]| match state[0] > 1.0 && time > 2.0 {
        true => f64::NAN,
        false => 1.0,
    };
    let ends = Ensemble::new().integrate_in_lanes_until(
        &method,
        &model,
        &starts,
        END,
        &[Ending::new(Crossing::Either, &undefined)],
    );
    let failed = ends.iter().filter(|end| match end {
        Err(IntegrationError::Event { event, time, .. }) => *event == 0 && *time > 2.0,
        Err(_) => panic!("{end:?}"),
        Ok(solution) => {
            assert_eq!(solution.state.time, END);
            false
        }
    });
    let failed = failed.count();
    assert!(failed > 3 && failed < starts.len(), "{failed}");
}

#[test]
fn systems_of_their_own_end_as_the_starts_of_one() {
    let starts = releases::<f64>();
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let functions = [0, 1].map(beyond_the_top);
    let endings = functions
        .each_ref()
        .map(|function| Ending::new(Crossing::Rising, function));
    let all = Ensemble::new();
    let one = all.integrate_in_lanes_until(&method, &lopsided(), &starts, END, &endings);
    let own: Vec<_> = starts
        .iter()
        .map(|start| (lopsided(), start.clone()))
        .collect();
    let own = all.integrate_models_in_lanes_until(&method, &own, END, &endings);
    let mut stopped = 0;
    for (one, own) in one.iter().zip(&own) {
        let [one, own] = [one, own].map(|end| end.as_ref().unwrap());
        assert_eq!((&one.state, one.report.stop), (&own.state, own.report.stop));
        stopped += u32::from(own.report.stop == StopReason::StoppedByEvent);
    }
    assert!(stopped > 3, "{stopped}");
}
