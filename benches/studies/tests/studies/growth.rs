//! Growth of small differences, the programs `critical-angle` and `release-map`, and
//! the physics behind them.

use std::f64::consts::TAU;

use branched_pendulum::analysis::Modes;
use branched_pendulum::analysis::growth::{
    Continuation, Floquet, Grown, Growth, GrowthError, frequency_at_rest,
};
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::*;
use branched_pendulum::system::TransverseOde;
use branched_pendulum_frame::Job;
use branched_pendulum_frame::command_line::parse_line;
use branched_pendulum_studies::critical_angle::scene::{InPhase, InPhaseParameters};
use branched_pendulum_studies::critical_angle::trees::{Rule, Three, ThreeParameters, threshold};
use branched_pendulum_studies::critical_angle::{self, Friction};
use branched_pendulum_studies::release_map::tongues::Ridge;
use branched_pendulum_studies::release_map::{self, normal_modes};

use super::folder;

/// The whole pendulum of the paper.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    emit(symmetric),
)]
struct Whole;

/// Three rods on each.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 3, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.7),
    in_phase(tree),
    emit(transverse),
)]
struct Triples;

/// Moment of inertia of a child about its pivot, kg m².
const M_2: f64 = 0.516e-3 + 0.10531 * 0.043 * 0.043;

fn in_phase(friction: f64) -> InPhase {
    InPhase::new(InPhaseParameters { friction }).unwrap()
}

fn release(degrees: f64) -> State<f64> {
    State::at_rest(0.0, &[degrees.to_radians(), 0.0, 1.0])
}

fn grown(model: &InPhase, degrees: &[f64], horizons: &[f64]) -> Vec<Grown> {
    let ode = TransverseOde::new(model, 0).unwrap();
    let releases: Vec<_> = degrees.iter().map(|d| (ode, release(*d))).collect();
    let growth = Growth {
        frequency_hz: frequency_at_rest(&ode),
        horizons: horizons.to_vec(),
        tolerance: 1e-10,
    };
    let grown = growth.in_lanes(&Ensemble::new(), &releases).into_iter();
    grown.collect::<Result<_, _>>().unwrap()
}

/// The edges of the windows of growth, to a twentieth of a degree.
#[test]
fn windows_of_growth() {
    let model = in_phase(0.0);
    let edges = [
        (43.35, [1, 1]),
        (43.40, [1, 10]),
        (44.80, [1, 10]),
        (44.85, [1, 1]),
        (45.95, [1, 1]),
        (46.00, [1, 10]),
        (46.05, [1, 10]),
        (46.10, [1, 1]),
        (46.15, [1, 10]),
        (46.25, [1, 10]),
        (46.30, [10, 10]),
    ];
    let degrees = edges.map(|(degrees, _)| degrees);
    for ((degrees, levels), grown) in edges.iter().zip(grown(&model, &degrees, &[4.0, 10.0])) {
        for (level, factor) in levels.iter().zip(&grown.factors) {
            assert_eq!(factor.value >= 10.0, *level == 10, "{degrees}: {factor:?}");
            assert!(factor.is_determined());
        }
    }
    let edges = [(42.65, false), (42.7, true), (44.55, true), (44.6, false)];
    for ((degrees, grows), grown) in edges
        .iter()
        .zip(grown(&model, &edges.map(|e| e.0), &[30.0]))
    {
        assert_eq!(grown.factors[0].value >= 100.0, *grows, "{degrees}");
    }
}

/// The transverse equations against the linear equations of the whole pendulum, and
/// against a small difference of its own.
#[test]
fn three_ways_to_growth() {
    let friction = 2e-5;
    let whole = Whole::new(WholeParameters { friction }).unwrap();
    let system = linearised(SymmetricCoordinates(&whole));
    for degrees in [39.5, 43.5, 46.3] {
        let reduced = &grown(&in_phase(friction), &[degrees], &[4.0, 10.0])[0];
        let growth = Growth {
            frequency_hz: 1.258,
            horizons: vec![4.0, 10.0],
            tolerance: 1e-10,
        };
        let start = State::at_rest(0.0, &[f64::to_radians(degrees), 0.0, 0.0]);
        let deviation = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let along = growth
            .along(&system, &start, &deviation, [2..3, 5..6])
            .unwrap();
        let both = reduced.factors.iter().zip(&along.factors);
        for (one, other) in both {
            assert!(
                (one.value / other.value - 1.0).abs() < 1e-4,
                "{one:?} {other:?}"
            );
        }
        assert!((reduced.rate.value - along.rate.value).abs() < 1e-3);
        assert!((reduced.frequency_hz.value - along.frequency_hz.value).abs() < 1e-3);

        // Small beside its own square, large beside rounding.
        const SIZE: f64 = 1e-6;
        let start = State::at_rest(0.0, &[f64::to_radians(degrees), 0.0, SIZE]);
        let method = Dop853::new(Options {
            max_step: Some(0.02),
            ..Options::with_tolerance(1e-13)
        });
        let mut largest = 0.0_f64;
        let run = method.integrate(&SymmetricCoordinates(&whole), &start, 10.0, |step| {
            largest = largest.max(step.end()[2].abs());
            ControlFlow::Continue(())
        });
        run.unwrap();
        let factor = reduced.factors[1].value;
        assert!(
            (largest / SIZE / factor - 1.0).abs() < 0.01,
            "{largest} {factor}"
        );
    }
}

/// det Φ(t) = exp(−c t/M_2) beside any motion.
#[test]
fn friction_shrinks_the_plane_of_differences() {
    for quality in [50.0, 200.0] {
        let constant = Friction::Quality(quality).constant().unwrap();
        let model = in_phase(constant);
        let ode = TransverseOde::new(&model, 0).unwrap();
        // The decay of the amplitude is half that of the area.
        let decay = TAU * frequency_at_rest(&ode) / quality;
        assert!((constant / M_2 / decay - 1.0).abs() < 1e-9);
        let method = Dop853::new(Options::with_tolerance(1e-12));
        let time = 3.3;
        let column = |angle: f64, rate: f64| {
            let start = State::new(0.0, vec![0.7, 0.1, angle, 0.0, 0.0, rate]);
            let go_on = |_: &mut DenseStep<'_, f64>| ControlFlow::Continue(());
            let end = method.integrate(&ode, &start, time, go_on).unwrap();
            [end.state.values[2], end.state.values[5]]
        };
        let ([a, c], [b, d]) = (column(1.0, 0.0), column(0.0, 1.0));
        let expected = (-constant * time / M_2).exp();
        assert!(((a * d - b * c) / expected - 1.0).abs() < 1e-9);
    }
}

/// Periodic motions from the linear modes on: shapes and periods at small size, growth
/// along them by multipliers and by following differences.
#[test]
fn nonlinear_normal_modes() {
    let model = in_phase(0.0);
    let rest = [0.0; 2];
    let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest)).unwrap();
    let system = linearised(AbsoluteAngles(&model));
    let ode = TransverseOde::new(&model, 0).unwrap();
    let continuation = Continuation {
        tolerance: 1e-10,
        step: 0.1,
        largest: 1.2,
    };
    for (shape, &frequency) in modes.shapes.iter().zip(&modes.frequencies_hz) {
        let orbits = continuation
            .orbits(&system, &rest, shape, frequency)
            .unwrap();
        assert!(orbits.len() > 5);
        let first = &orbits[0];
        assert!((first.period * frequency - 1.0).abs() < 0.01);
        let ratio = first.release[1] / first.release[0];
        assert!((ratio / (shape[1] / shape[0]) - 1.0).abs() < 0.05);
        // Larger ones are slower, and all mirror themselves.
        assert!(
            orbits
                .windows(2)
                .all(|pair| pair[0].period < pair[1].period)
        );
        for orbit in &orbits {
            assert!(orbit.is_symmetric());
            // A period leads back to the release.
            let start = State::at_rest(0.0, &orbit.release);
            let method = Dop853::new(Options::with_tolerance(1e-12));
            let end = method.integrate(&AbsoluteAngles(&model), &start, orbit.period, |_| {
                ControlFlow::Continue(())
            });
            for (end, start) in end.unwrap().state.values.iter().zip(&start.values) {
                assert!((end - start).abs() < 1e-6, "{orbit:?}");
            }
            let floquet = Floquet::of_differences(&ode, orbit, 1e-10).unwrap();
            assert_eq!(floquet.period, orbit.period / 2.0);
            let [[a, b], [c, d]] =
                [0, 1].map(|row: usize| [0, 1].map(|i: usize| floquet.matrix[row][i]));
            assert!((a * d - b * c - 1.0).abs() < 1e-8);
            assert_eq!((a + d).abs() > 2.0 + 1e-6, floquet.rate.value > 1e-3);
            let within = Floquet::of_motion(&system, orbit, 1e-10).unwrap();
            let unit = within.multipliers.iter();
            let unit = unit.filter(|[re, im]| (re - 1.0).hypot(*im) < 1e-3).count();
            assert!(unit >= 2, "{:?}", within.multipliers);
        }
    }
}

#[test]
fn requests_without_an_answer() {
    let model = in_phase(0.0);
    let ode = TransverseOde::new(&model, 0).unwrap();
    let growth = Growth {
        frequency_hz: 1.26,
        horizons: vec![1.0],
        tolerance: 1e-8,
    };
    let ask = |growth: &Growth, start: State<f64>| {
        let releases = [(ode, release(10.0)), (ode, start)];
        growth.in_lanes(&Ensemble::new(), &releases).remove(1)
    };
    assert!(ask(&growth, release(20.0)).is_ok());
    let still = State::at_rest(0.0, &[0.1, 0.0, 0.0]);
    assert_eq!(ask(&growth, still), Err(GrowthError::Difference));
    let later = State::at_rest(1.0, &[0.1, 0.0, 1.0]);
    assert_eq!(ask(&growth, later), Err(GrowthError::StartTime(1.0)));
    let lost = State::at_rest(0.0, &[f64::NAN, 0.0, 1.0]);
    assert!(matches!(
        ask(&growth, lost),
        Err(GrowthError::Integration(_))
    ));
    for horizons in [vec![], vec![2.0, 1.0], vec![0.0], vec![f64::NAN]] {
        let growth = Growth {
            horizons,
            ..growth.clone()
        };
        assert_eq!(ask(&growth, release(20.0)), Err(GrowthError::Horizons));
    }
    let growth = Growth {
        frequency_hz: 0.0,
        ..growth
    };
    assert_eq!(
        ask(&growth, release(20.0)),
        Err(GrowthError::Frequency(0.0))
    );
}

/// Thresholds know the number of copies by the product with the ratio of masses alone.
#[test]
fn copies_count_by_their_mass() {
    let rule = Rule {
        generations: 3,
        copies: 3,
        mass_ratio: 0.4,
        length_ratio: 0.7,
    };
    let pairs = Three::new(ThreeParameters {
        mass_ratio: rule.pair_ratio(),
        length_ratio: rule.length_ratio,
    });
    let (pairs, triples) = (pairs.unwrap(), Triples::new());
    let start = State::at_rest(0.0, &[0.9, 0.2, 0.0, 1.0, 0.5]);
    let growth = Growth {
        frequency_hz: frequency_at_rest(&TransverseOde::new(&pairs, 0).unwrap()),
        horizons: vec![5.0],
        tolerance: 1e-10,
    };
    let one = [(TransverseOde::new(&pairs, 0).unwrap(), start.clone())];
    let other = [(TransverseOde::new(&triples, 0).unwrap(), start)];
    let one = growth.in_lanes(&Ensemble::new(), &one).remove(0).unwrap();
    let other = growth.in_lanes(&Ensemble::new(), &other).remove(0).unwrap();
    let line = "--trees --angles 20:100:40 --tolerance 1e-7";
    let arguments = parse_line::<critical_angle::Arguments>(line).unwrap();
    let found = threshold(rule, &arguments).unwrap();
    let of_pairs = Rule {
        copies: 2,
        mass_ratio: rule.pair_ratio(),
        ..rule
    };
    assert_eq!(
        found.angle_deg,
        threshold(of_pairs, &arguments).unwrap().angle_deg
    );
    assert!(found.angle_deg.is_some_and(|angle| angle > 20.0));
    let ratio = one.factors[0].value / other.factors[0].value;
    assert!((ratio - 1.0).abs() < 1e-6, "{one:?} {other:?}");
}

#[test]
fn critical_angle_tells_windows() {
    let line = "--angles 43:45:0.25 --horizons 4,10 --quality 150 --tolerance 1e-9";
    let arguments = parse_line::<critical_angle::Arguments>(line).unwrap();
    let job = Job::quiet(&folder("critical-angle")).unwrap();
    critical_angle::run(&arguments, &job).unwrap();
    let text = job.printed();
    assert!(
        text.contains("G(10 s) ≥ 10         43.5° to 44.75°"),
        "{text}"
    );
    assert!(
        text.contains("The ideal model does not separate 47.6° from 47.8°"),
        "{text}"
    );
    let files = job.files();
    for file in ["growth-factor.csv", "growth-factor.svg"] {
        assert!(files.iter().any(|name| name == file), "{files:?}");
    }
}

/// Twice the frequency of the difference is the sum of those of the two modes, on the
/// ridges of the two blades.
#[test]
fn the_blades_are_one_resonance() {
    let model = in_phase(0.0);
    let modes = normal_modes::of(&model, 20.0).unwrap();
    let places = [[30.0, 18.0], [30.0, 77.0], [40.0, 34.5], [40.0, 88.0]];
    for release in places {
        let ridge = Ridge::at(&model, &modes, release, (60.0, 1e-9)).unwrap();
        let ridge = ridge.expect("a regular motion");
        let resonance = ridge.resonance.expect("a resonance");
        assert_eq!(resonance.numbers, [1, 1]);
        assert!(resonance.mismatch.abs() < 1e-3, "{ridge:?}");
        assert!(ridge.rate > 0.05, "{ridge:?}");
    }
}

#[test]
fn release_map_draws_what_there_is() {
    for (line, name) in [
        (
            "--step 15 --parent 30 --children 90 --span 4",
            "release-map",
        ),
        ("--step 45 --scene arms --span 2", "release-map"),
        ("--step 45 --plane ratio-energy --span 2", "ratio-energy"),
    ] {
        let arguments = parse_line::<release_map::Arguments>(line).unwrap();
        let job = Job::quiet(&folder("release-map")).unwrap();
        release_map::run(&arguments, &job).unwrap();
        let text = job.printed();
        assert!(text.contains(" releases, "), "{text}");
        assert_eq!(
            text.contains("Mode f_+: 0.8732 Hz when small"),
            line.contains("30")
        );
        for ending in ["csv", "svg", "png", "pdf"] {
            let file = format!("{name}.{ending}");
            assert!(job.files().contains(&file), "{file}");
        }
    }
    let both = parse_line::<release_map::Arguments>("--scene arms --plane ratio-energy");
    assert!(both.unwrap_err().contains("of the paper's pendulum alone"));
}
