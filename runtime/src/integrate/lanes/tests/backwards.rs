//! Backwards in lanes is forwards with velocities and friction turned round, bit for bit.

use super::{Cases, END, Each, Integrator, LaneMethod, LopsidedOde};
use super::{lopsided, outcomes, starts, times, with_mirrored};
use crate::integrate::{Options, StopReason};
use crate::scalar::InstructionSet;
use crate::system::State;

/// The state of two links at the opposite time.
fn mirrored(state: &State<f64>) -> State<f64> {
    let mut values = state.values.clone();
    values[2..]
        .iter_mut()
        .for_each(|velocity| *velocity = -*velocity);
    State::new(-state.time, values)
}

struct Mirrored;

impl Each<f64> for Mirrored {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let (model, mut turned, starts) = (lopsided(), lopsided::<f64>(), starts::<f64>());
        turned.0.friction = -turned.0.friction;
        let backwards: Vec<State<f64>> = starts.iter().map(mirrored).collect();
        let times = times::<f64>();
        let before: Vec<f64> = times.iter().map(|time| -time).collect();
        let run = |model, starts, times: &[f64], end| {
            let cases = Cases::Starts(model, starts);
            outcomes(InstructionSet::widest(), method, cases, times, end)
        };
        let there = run(&model, &starts[..], &times, END);
        let back = run(&turned, &backwards[..], &before, -END);
        for (index, (there, back)) in there.iter().zip(&back).enumerate() {
            let (end, other) = (there.end.as_ref().unwrap(), back.end.as_ref().unwrap());
            assert_eq!(end.report.stop, StopReason::EndReached);
            assert_eq!(
                (&end.state, end.report),
                (&mirrored(&other.state), other.report)
            );
            assert_eq!(there.samples.len(), 4 * times.len());
            for (sample, other) in there.samples.chunks(4).zip(back.samples.chunks(4)) {
                let other = mirrored(&State::new(0.0, other.to_vec()));
                assert_eq!(sample, other.values, "{index}");
            }
        }
    }
}

#[test]
fn backwards_is_forwards_mirrored() {
    let basic = Options::with_tolerance(1e-8);
    let limited = Options {
        compensated: true,
        initial_step: Some(0.1),
        max_step: Some(0.3),
        ..basic.clone()
    };
    for options in [basic, limited] {
        with_mirrored(&options, &mut Mirrored);
    }
}
