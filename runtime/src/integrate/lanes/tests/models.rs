//! A model in each lane.

use core::num::NonZeroUsize;
use core::slice::from_ref;

use super::failures::stop_of_both;
use super::{
    AbsoluteAngles, Cases, END, Each, Integrator, LaneMethod, Lopsided, LopsidedOde, assert_same,
};
use super::{outcomes, plain, starts, times, with_each, with_each_kind};
use crate::ensemble::Ensemble;
use crate::integrate::{Dop853, InputError, IntegrationError, Options, StopReason};
use crate::scalar::{InstructionSet, Lane, Scalar};
use crate::system::{LinkName, Model, Pendulum, State};

/// Models no two of which are the same, from the starts of the other tests.
fn releases<T: Lane>() -> Vec<(LopsidedOde<T>, State<T>)> {
    let model = |i: usize| {
        let part = i as f64 / 43.0;
        let model = Lopsided {
            wall: 7.0 - part,
            inertia: 0.4 + part,
            drive: 0.6 * part,
            friction: 0.1 - 0.1 * part,
            lateral: 2.0 * part - 1.0,
        };
        AbsoluteAngles(model.cast(T::from_f64))
    };
    let starts = starts().into_iter().enumerate();
    starts.map(|(i, start)| (model(i), start)).collect()
}

/// Without an answer: at the start, because of a constant; on the way, because of
/// the wall; on the way, because the mass matrix gets singular where the links
/// are in line.
const BAD: [usize; 3] = [3, 13, 29];

pub(super) fn bad_releases<T: Lane>() -> Vec<(LopsidedOde<T>, State<T>)> {
    let mut releases = releases::<T>();
    releases[3].0.0.friction = T::NAN;
    releases[13].0.0.wall = T::from_f64(0.1);
    releases[29].0.0.inertia = T::from_f64(0.05);
    releases
}

struct BitsAreThoseOfTheModelAlone;

impl<T: Lane> Each<T> for BitsAreThoseOfTheModelAlone {
    fn each<M: LaneMethod<LopsidedOde<T>, T>>(&mut self, method: &M) {
        let (releases, times, end) = (bad_releases::<T>(), times(), T::from_f64(END));
        for set in InstructionSet::ALL {
            let together = outcomes(set, method, Cases::Pairs(&releases), &times, end);
            let alone: Vec<_> = releases
                .iter()
                .flat_map(|(model, start)| {
                    let cases = Cases::Starts(model, from_ref(start));
                    outcomes(set, method, cases, &times, end)
                })
                .collect();
            assert_same(&together, &alone);
            let reversed: Vec<_> = releases.iter().rev().cloned().collect();
            let mut reversed = outcomes(set, method, Cases::Pairs(&reversed), &times, end);
            reversed.reverse();
            assert_same(&together, &reversed);
        }
    }
}

#[test]
fn bits_are_those_of_the_model_alone() {
    let double = Options::with_tolerance(1e-8);
    with_each(&double, &mut BitsAreThoseOfTheModelAlone);
    let single = Options::with_tolerance(1e-4_f32);
    with_each_kind(&single, &mut BitsAreThoseOfTheModelAlone);
}

struct TimesAreThoseOfTheModelAlone;

impl<T: Lane> Each<T> for TimesAreThoseOfTheModelAlone {
    fn each<M: LaneMethod<LopsidedOde<T>, T>>(&mut self, method: &M) {
        let (releases, times) = (bad_releases::<T>(), times::<T>());
        // None for some, and ends that differ by much.
        let own = |index: usize| &times[..7 * index % (times.len() + 1)];
        let own: Vec<&[T]> = (0..releases.len()).map(own).collect();
        let end = T::from_f64(END);
        for set in InstructionSet::ALL {
            let cases = Cases::Timed(&releases, &own);
            let together = outcomes(set, method, cases, &[], end);
            let each = releases.iter().zip(&own);
            let alone: Vec<_> = each
                .flat_map(|((model, start), own)| {
                    let end = own.last().copied().unwrap_or(start.time);
                    let cases = Cases::Starts(model, from_ref(start));
                    outcomes(set, method, cases, own, end)
                })
                .collect();
            assert_same(&together, &alone);
        }
    }
}

#[test]
fn times_are_those_of_the_model_alone() {
    let double = Options::with_tolerance(1e-8);
    with_each(&double, &mut TimesAreThoseOfTheModelAlone);
    let single = Options::with_tolerance(1e-4_f32);
    with_each_kind(&single, &mut TimesAreThoseOfTheModelAlone);
}

struct ThePlainMethodStopsAlike(Vec<StopReason>);

impl Each<f64> for ThePlainMethodStopsAlike {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<f64>, f64>,
        M: Integrator<f64, LopsidedOde<f64>>,
    {
        let releases = bad_releases();
        let cases = Cases::Pairs(&releases);
        let lanes = outcomes(InstructionSet::widest(), method, cases, &[], END);
        for (index, ((model, start), lane)) in releases.iter().zip(lanes).enumerate() {
            let plain = plain(method, model, start, END);
            let stop = stop_of_both(index, &lane.end, &plain);
            assert_eq!(stop.is_some(), BAD.contains(&index), "{index}");
            self.0.extend(stop);
            let (Ok(lane), Ok(plain)) = (lane.end, plain) else {
                continue;
            };
            for (a, b) in lane.state.values.iter().zip(&plain.state.values) {
                assert!((a - b).abs() < 1e-7, "{index}: {a} {b}");
            }
        }
    }
}

/// A trajectory without an answer fails alone, and as the plain method fails.
#[test]
fn the_plain_methods_are_met_one_by_one() {
    let mut stops = ThePlainMethodStopsAlike(Vec::new());
    with_each(&Options::with_tolerance(1e-9), &mut stops);
    for stop in [StopReason::NonFinite, StopReason::StepTooSmall] {
        assert!(stops.0.contains(&stop), "{stop}");
    }
}

#[test]
fn ends_and_samples_stand_in_the_order_of_the_releases() {
    let (releases, times) = (bad_releases::<f64>(), times());
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let widest = InstructionSet::widest();
    let one = outcomes(widest, &method, Cases::Pairs(&releases), &times, END);
    for threads in [1, 3] {
        let ensemble = Ensemble::new().threads(NonZeroUsize::new(threads).unwrap());
        let samples = ensemble.sample_models_in_lanes(&method, &releases, &times);
        assert_eq!(samples.len(), releases.len());
        let ends = ensemble.integrate_models_in_lanes(&method, &releases, END);
        for (index, (samples, end)) in samples.iter().zip(&ends).enumerate() {
            assert_eq!(
                samples.states().flatten().copied().collect::<Vec<_>>(),
                one[index].samples
            );
            let both = [samples.end.as_ref(), end.as_ref()];
            match both.map(|end| end.map(|end| end.state.clone())) {
                [Ok(sampled), Ok(end)] => assert_eq!(sampled, end),
                [Err(sampled), Err(end)] => assert_eq!(
                    format!("{:?}", sampled.last_state()),
                    format!("{:?}", end.last_state())
                ),
                ends => panic!("{index}: {ends:?}"),
            }
        }
    }
    let none: &[(LopsidedOde<f64>, State<f64>)] = &[];
    let ends = Ensemble::new().integrate_models_in_lanes(&method, none, END);
    assert!(ends.is_empty());
}

/// A rod that says it has so many constants.
struct Uneven<T>(Vec<T>);

impl<T: Scalar> Model<T> for Uneven<T> {
    type Of<S: Scalar> = Uneven<S>;
    const KNOWN_LINKS: Option<usize> = Some(1);

    fn links(&self) -> usize {
        1
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        LinkName::in_list(&["rod"], index)
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Uneven<S> {
        Uneven(self.0.iter().copied().map(convert).collect())
    }
}

impl<T: Scalar> Pendulum<T> for Uneven<T> {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        _omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        alpha(0, -(self.0[0] * theta(0).sin_cos().0));
    }
}

#[test]
fn models_with_other_numbers_of_constants_are_refused() {
    let model = |count: usize| AbsoluteAngles(Uneven(vec![9.0; count]));
    let releases = [3, 2, 3, 4].map(|count| (model(count), State::at_rest(0.0, &[0.5])));
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 1.0);
    assert!(ends[0].is_ok());
    assert_eq!(ends[0], ends[2]);
    for (end, found) in [(&ends[1], 2), (&ends[3], 4)] {
        let error = InputError::Constants { expected: 3, found };
        assert_eq!(*end, Err(IntegrationError::Input(error)));
    }
}
