//! Scans over parameters of an emitted model, in the lanes of vector registers.

use branched_pendulum::integrate::{IntegrationError, LaneMethod, StopReason};
use branched_pendulum::prelude::*;
use branched_pendulum_tests::scenes::driven_series::{DrivenSeries, DrivenSeriesParameters};

use crate::taylor::PARAMETERS;

type Release = (AbsoluteAngles<DrivenSeries>, State<f64>);

/// As many that no register divides them: masses, stiffness and drive differ, and
/// so do the starts.
const COUNT: u32 = 19;

/// A link without mass and inertia, whose mass matrix is singular, and a parameter
/// that is not a number.
const BAD: [usize; 2] = [4, 13];

const END: f64 = 2.0;

fn releases() -> Vec<Release> {
    (0..COUNT)
        .map(|i| {
            let part = f64::from(i) / f64::from(COUNT);
            let mut parameters = DrivenSeriesParameters {
                twig_mass: 0.05 + 0.1 * part,
                stiffness: 0.5 * part,
                push: 0.4 - 0.4 * part,
                pace: 3.0 + part,
                ..PARAMETERS
            };
            if i as usize == BAD[0] {
                parameters.bob_mass = 0.0;
            }
            if i as usize == BAD[1] {
                parameters.stiffness = f64::NAN;
            }
            let start = State::at_rest(0.1 * part, &[0.3, part - 0.5, 0.2]);
            // Unchecked: `new` refuses both.
            let model = DrivenSeries::from_parameters_unchecked(parameters);
            (AbsoluteAngles(model), start)
        })
        .collect()
}

/// Lanes meet the method one by one, in its order; what is bad fails alone, at once
/// and with its state.
fn lanes_meet_one_by_one<M>(method: &M)
where
    M: LaneMethod<AbsoluteAngles<DrivenSeries>, f64>,
    M: Integrator<f64, AbsoluteAngles<DrivenSeries>>,
{
    let (releases, times) = (releases(), [0.1, 0.7, 1.4, END]);
    let ensemble = Ensemble::new();
    let ends = ensemble.integrate_models_in_lanes(method, &releases, END);
    let samples = ensemble.sample_models_in_lanes(method, &releases, &times);
    assert_eq!(
        (ends.len(), samples.len()),
        (releases.len(), releases.len())
    );
    for (index, (model, start)) in releases.iter().enumerate() {
        let (end, samples) = (&ends[index], &samples[index]);
        if BAD.contains(&index) {
            for end in [end, &samples.end] {
                let Err(error @ IntegrationError::NonFinite { last, .. }) = end else {
                    panic!("{index}: {end:?}");
                };
                assert_eq!(last, start);
                assert_eq!(error.report().map(|r| r.stop), Some(StopReason::NonFinite));
            }
            continue;
        }
        let plain = method.run(model, start, END);
        let (end, plain) = (end.as_ref().unwrap(), plain.unwrap());
        assert_eq!(end.state, samples.end.as_ref().unwrap().state);
        assert_eq!(samples.states().len(), times.len());
        assert_eq!(samples.states().last(), Some(end.state.values.as_slice()));
        for (lane, plain) in end.state.values.iter().zip(&plain.state.values) {
            assert!((lane - plain).abs() < 1e-8, "{index}: {lane} {plain}");
        }
    }
}

#[test]
fn scans_in_lanes_meet_the_methods_one_by_one() {
    let options = Options::with_tolerance(1e-11);
    lanes_meet_one_by_one(&Taylor::new(options.clone()));
    lanes_meet_one_by_one(&Dop853::new(options.clone()));
    lanes_meet_one_by_one(&Verner98::new(options));
    lanes_meet_one_by_one(&Dopri5::new(Options::with_tolerance(1e-10)));
    lanes_meet_one_by_one(&Rk4::new(0.01));
}

/// A trajectory has the bits that it has among starts of its own model.
#[test]
fn a_model_has_the_same_bits_among_others() {
    let (releases, ensemble) = (releases(), Ensemble::new());
    let method = Taylor::new(Options::with_tolerance(1e-9));
    let among = ensemble.integrate_models_in_lanes(&method, &releases, END);
    for (index, (model, start)) in releases.iter().enumerate() {
        let starts = std::slice::from_ref(start);
        let own = ensemble.integrate_in_lanes(&method, model, starts, END);
        // NaN is not itself.
        assert_eq!(format!("{:?}", own[0]), format!("{:?}", among[index]));
    }
}
