//! The physics of the paper's experiment, and what the program finds in a motion.

use std::f64::consts::PI;

use branched_pendulum_examples::branched_double::apparatus::{EXACT, PUBLISHED, Sample, parts};
use branched_pendulum_examples::branched_double::charts::{compared, folded_with_gaps};
use branched_pendulum_examples::branched_double::report::three_digits;
use branched_pendulum_examples::branched_double::scan::{Fate, ScanPoint, bands};
use branched_pendulum_examples::branched_double::{
    Arguments, BranchedDouble, Findings, Frequencies, Run, spectrum,
};
use branched_pendulum_frame::Failure;

fn frictionless() -> BranchedDouble {
    Arguments::default().model().unwrap()
}

fn run(angle_deg: f64, duration: f64, arguments: Arguments) -> Run {
    let arguments = Arguments {
        duration,
        ..arguments
    };
    Run::new(&arguments.model().unwrap(), angle_deg, &arguments).unwrap()
}

/// A state whose integrals are zero.
fn state(coordinates: [f64; 3], rates: [f64; 3]) -> Vec<f64> {
    let integrals = [0.0; 7];
    [&coordinates[..], &rates, &integrals].concat()
}

#[test]
fn eigenfrequencies_to_seven_digits() {
    let Frequencies {
        plus,
        minus,
        antiphase,
    } = Frequencies::of(&frictionless()).unwrap();
    assert_eq!(format!("{plus:.7}"), "0.8731696");
    assert_eq!(format!("{minus:.7}"), "1.5825567");
    assert_eq!(format!("{antiphase:.7}"), "1.2580584");
}

/// Growth comes in bands of angles, with a gap about 45°.
#[test]
fn the_antiphase_mode_grows_in_bands() {
    let growth = |angle_deg| {
        let run = run(angle_deg, 10.0, Arguments::default());
        Findings::new(&run).growth.unwrap()
    };
    for (angle, low, high) in [
        (39.5, 1.0, 1.5),
        (42.5, 1.0, 10.0),
        (44.0, 10.0, f64::INFINITY),
        (45.0, 1.0, 10.0),
        (45.5, 1.0, 10.0),
        (47.8, 50.0, f64::INFINITY),
    ] {
        let growth = growth(angle);
        assert!(growth > low && growth < high, "{angle}: {growth}");
    }
}

#[test]
fn while_small_the_growth_does_not_depend_on_the_disturbance() {
    let growth = |disturbance| {
        let arguments = Arguments {
            disturbance,
            ..Arguments::default()
        };
        Findings::new(&run(45.0, 6.0, arguments)).growth.unwrap()
    };
    let (small, tiny) = (growth(1e-4), growth(1e-12));
    assert!(small > 5.0);
    assert!((small / tiny - 1.0).abs() < 1e-5, "{small} {tiny}");
}

#[test]
fn the_exact_transfer_explains_every_change_of_the_antiphase_energy() {
    for [friction_root, friction_children] in [[0.0; 2], [1e-4, 3.5e-5]] {
        let arguments = Arguments {
            friction_root,
            friction_children,
            ..Arguments::default()
        };
        let run = run(48.6, 6.0, arguments);
        let energies = run.column(|sample| sample.antiphase_energy);
        let largest = energies.into_iter().fold(0.0, f64::max);
        assert!(largest > 1e-3);
        let initial = run.samples[0].antiphase_energy;
        for sample in &run.samples {
            let expected = initial + sample.supplied.total(EXACT);
            assert!((sample.antiphase_energy - expected).abs() < 1e-9 * largest);
        }
        let supplied = run.samples.last().unwrap().supplied;
        let transferred = supplied.transfer(EXACT).total();
        let is_damped = supplied.friction() < -0.1 * transferred.abs();
        assert_eq!(is_damped, friction_children > 0.0);
        let findings = Findings::new(&run);
        assert!(findings.deviations[EXACT].unwrap() < 1e-9);
    }
}

#[test]
fn the_complete_quadratic_form_holds_for_small_angles_and_the_published_does_not() {
    let [published, quadratic, exact] =
        Findings::new(&run(39.5, 5.0, Arguments::default())).deviations;
    assert!(published.unwrap() > 0.5);
    assert!(quadratic.unwrap() < 1e-3);
    assert!(exact.unwrap() < 1e-3 * quadratic.unwrap());
}

#[test]
fn friction_in_the_childrens_joints_brings_onset_and_peak_near_the_papers() {
    let arguments = Arguments {
        friction_children: 3.5e-5,
        ..Arguments::default()
    };
    let peak = |angle_deg| {
        let findings = Findings::new(&run(angle_deg, 6.5, arguments.clone()));
        findings.peak.unwrap()
    };
    let (below, above) = (peak(47.6), peak(47.8));
    let energies = [below, above].map(|peak| peak.sample.antiphase_energy);
    assert!(energies[1] > 4.0 * energies[0]);
    // The paper: at 3.8 s, θ_m beyond 2 rad, W_P dominant but not overwhelming.
    let time = above.sample.time;
    assert!((time - 3.8).abs() < 0.2, "{time}");
    assert!(above.largest_mean > 2.0);
    let (kinetic, potential) = above.shares(PUBLISHED).unwrap();
    assert!(potential > 0.75 && kinetic > 0.05);
}

const COORDINATES: [f64; 3] = [0.7, -0.4, 0.3];
const RATES: [f64; 3] = [1.2, -2.1, 0.9];

#[test]
fn exact_transfer_and_friction_are_the_rate_of_the_antiphase_energy() {
    for [friction_root, friction_children] in [[0.0; 2], [3e-3, 5e-3]] {
        let arguments = Arguments {
            friction_root,
            friction_children,
            ..Arguments::default()
        };
        let model = arguments.model().unwrap();
        let accelerations = model.symmetric_accelerations(&COORDINATES, &RATES);
        let at = |step: f64| {
            let coordinates = std::array::from_fn(|i| {
                COORDINATES[i] + step * (RATES[i] + 0.5 * step * accelerations[i])
            });
            let rates = std::array::from_fn(|i| RATES[i] + step * accelerations[i]);
            model.measure(0.0, &state(coordinates, rates))
        };
        let h = 1e-4;
        let (before, after) = (at(-h), at(h));
        let rate = |of: fn(&Sample) -> f64| (of(&after) - of(&before)) / (2.0 * h);
        let antiphase = rate(|sample| sample.antiphase_energy);
        let powers = model.powers(&COORDINATES, &RATES);
        assert!((powers.total(EXACT) - antiphase).abs() < 1e-6);
        assert_eq!(friction_root == 0.0, powers.friction() == 0.0);
        // Friction takes energy from the whole pendulum.
        let energy = rate(|sample| sample.energy);
        assert_eq!(friction_root == 0.0, energy.abs() < 1e-6, "{energy}");
    }
}

/// Compares the terms with the formulas of sections 5.3 and 5.4 of the physics page, written out.
#[test]
fn the_terms_are_those_of_the_quadratic_form() {
    let model = frictionless();
    let sample = model.measure(0.0, &state([0.7, -0.4, 0.02], [1.2, -2.1, 0.09]));
    let (m1, m2) = (model.inertia_parent(), model.inertia_child());
    let (mu, g2) = (model.coupling_child_parent(), model.gravity_child());
    let [p1, pm, pd] = sample.momenta;
    let (s, c) = (-0.4_f64 - 0.7).sin_cos();
    let d = 2.0 * m1 * m2 - 4.0 * mu * mu * c * c;
    let x = m2 * p1 - mu * c * pm;
    let (w1, wm) = (2.0 * x / d, (m1 * pm - 2.0 * mu * c * p1) / d);
    let expected = [
        -mu * s * x * pd * pd / (m2 * m2 * d),
        g2 / m2 * (1.0 - (-0.4_f64).cos()) * pd * 0.02,
        -(mu * mu * s * s * w1 * w1 / (m2 * m2) + mu * c * w1 * wm / m2) * pd * 0.02,
        4.0 * g2 * mu * s * x * 0.02 * 0.02 / (m2 * d),
    ];
    let sum: f64 = sample.terms.iter().sum();
    let whole = sample.powers.transfer(1).total();
    assert!((sum / whole - 1.0).abs() < 1e-12, "{sum}, {whole}");
    for (found, expected) in sample.terms.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() < 1e-12,
            "{found}, {expected}"
        );
    }
}

#[test]
fn sizes_of_terms_do_not_depend_on_a_small_amplitude() {
    let sizes = |disturbance: f64| {
        let arguments = Arguments {
            disturbance,
            ..Arguments::default()
        };
        Findings::new(&run(30.0, 4.0, arguments)).terms
    };
    let (small, smaller) = (sizes(1e-4).unwrap(), sizes(1e-5).unwrap());
    for ([a, largest], [b, _]) in small.into_iter().zip(smaller) {
        assert!((a / b - 1.0).abs() < 1e-4, "{a}, {b}");
        assert!(largest > a);
    }
    assert_eq!(sizes(0.0), None);
}

#[test]
fn samples_are_taken_at_even_times_from_the_release_on() {
    let arguments = Arguments::default();
    let disturbance = arguments.disturbance;
    let run = run(30.0, 1.0, arguments);
    assert_eq!(run.samples.len(), 101);
    assert_eq!(run.samples[7].time, 0.07);
    let start = run.samples[0];
    assert_eq!(start.theta[0], 30.0_f64.to_radians());
    assert_eq!(start.supplied, parts(&[0.0; 13]).2);
    let g_2 = 0.10531 * 9.80665 * 0.043;
    assert_eq!(start.antiphase_energy, g_2 * disturbance.sin().powi(2));
}

#[test]
fn without_a_disturbance_the_antiphase_mode_stays_empty() {
    let arguments = Arguments {
        disturbance: 0.0,
        ..Arguments::default()
    };
    let run = run(60.0, 5.0, arguments);
    assert!(run.samples.iter().all(|s| s.antiphase_energy == 0.0));
    assert!(run.samples.iter().all(|s| s.theta[1] == s.theta[2]));
}

#[test]
fn a_run_that_cannot_start_says_why() {
    let error = Run::new(&frictionless(), f64::NAN, &Arguments::default()).unwrap_err();
    assert!(matches!(error, Failure::Integration { angle_deg, .. } if angle_deg.is_nan()));
}

/// Creates a run, sampled every 0.01 s, with these values of H_d.
fn run_with(energies: &[f64]) -> Run {
    let rest = frictionless().measure(0.0, &[0.0; 13]);
    let sample = |(index, &antiphase_energy): (usize, &f64)| Sample {
        time: 0.01 * index as f64,
        antiphase_energy,
        ..rest
    };
    Run {
        angle_deg: 0.0,
        samples: energies.iter().enumerate().map(sample).collect(),
    }
}

#[test]
fn the_first_peak_is_the_first_that_nothing_near_exceeds() {
    for (pulses, expected) in [
        (&[(70, 1.0)][..], Some(70)),
        // Dwarfed within two seconds, twice.
        (&[(70, 1.0), (200, 2.0), (380, 3.0)], Some(380)),
        // The second comes too late.
        (&[(70, 1.0), (400, 2.0)], Some(70)),
        (&[(400, 1.0), (300, 2.0)], Some(300)),
        // Falls from the start, then rises.
        (&[(0, 5.0), (500, 1.0)], Some(500)),
        (&[(0, 5.0), (50, 1.0)], None),
        // Still rising at the end.
        (&[(998, 1.0), (999, 2.0)], None),
    ] {
        let mut energies = vec![0.0; 1000];
        for &(at, height) in pulses {
            energies[at] = height;
        }
        let peak = Findings::new(&run_with(&energies)).peak;
        let time = peak.map(|peak| peak.sample.time);
        assert_eq!(
            time,
            expected.map(|index| 0.01 * f64::from(index)),
            "{pulses:?}"
        );
    }
    assert_eq!(Findings::new(&run_with(&[])).peak, None);
}

#[test]
fn a_pendulum_at_rest_has_no_findings() {
    let findings = Findings::new(&run_with(&[0.0; 50]));
    assert_eq!(findings.growth, None);
    assert_eq!(findings.peak, None);
    assert_eq!(findings.deviations, [None; 3]);
    assert_eq!(findings.terms, None);
}

#[test]
fn lines_of_the_gentlest_release_have_names() {
    let arguments = Arguments {
        disturbance: 0.0,
        ..Arguments::default()
    };
    let text = spectrum::lines(&run(39.5, 32.0, arguments)).unwrap();
    let lines: Vec<&str> = text.trim_end().lines().skip(2).collect();
    assert_eq!(lines.len(), 12);
    // "0.8543167 ± 2.7e-5  1.063373  2f_+ − f_−": a number, its error, the amplitude, the name.
    let words = |line: &&str| line.split_whitespace().map(str::to_owned).collect();
    let lines: Vec<Vec<String>> = lines.iter().map(words).collect();
    let names = lines.iter().map(|words| words[4..].join(" "));
    let names: Vec<String> = names.collect();
    let named = names.iter().filter(|name| !name.is_empty());
    assert!(named.count() >= 10, "{names:?}");
    assert_eq!(names[..3], ["f_+", "f_−", "2f_+ − f_−"]);
    // The paper saw them at 1.38 and near 0.33 Hz.
    for (line, expected) in [(1, 1.38467395), (2, 0.32396674)] {
        let frequency: f64 = lines[line][0].parse().unwrap();
        assert!((frequency - expected).abs() < 1e-5, "{frequency}");
    }
}

#[test]
fn neighbours_with_one_fate_make_a_band() {
    let points = [
        (40.0, 1.5, Fate::Small),
        (40.1, 1.2, Fate::Small),
        (40.2, 157.0, Fate::TurnedOver),
        (40.3, 3.0, Fate::Small),
    ];
    let points = points.map(|(angle_deg, growth, fate)| ScanPoint {
        angle_deg,
        growth,
        fate,
    });
    let text = bands(&points);
    let lines: Vec<&str> = text.lines().skip(2).collect();
    let expected = [
        "  less than 10-fold   40° to 40.1°, 40.3°",
        "  10-fold or more     nowhere",
        "  children turn over  40.2°",
        "",
    ];
    assert_eq!(lines, expected);
    assert_eq!(bands(&[]), "");
}

#[test]
fn the_pair_is_that_of_the_paper_or_the_nearest() {
    for (given, pair) in [
        (&[39.5, 47.6, 47.8, 48.6][..], &[47.6, 47.8][..]),
        (&[47.6, 47.7, 47.8], &[47.6, 47.8]),
        (&[60.0, 70.0, 80.0], &[60.0, 70.0]),
        (&[10.0, 20.0, 47.7], &[20.0, 47.7]),
        (&[30.0], &[30.0]),
        (&[], &[]),
    ] {
        let run = |&angle_deg: &f64| Run {
            angle_deg,
            samples: Vec::new(),
        };
        let runs: Vec<Run> = given.iter().map(run).collect();
        let angles = compared(&runs).into_iter().map(|run| run.angle_deg);
        assert_eq!(angles.collect::<Vec<f64>>(), pair);
    }
}

#[test]
fn folding_leaves_a_gap_where_a_child_passes_the_top() {
    let folded = folded_with_gaps(&[0.1, 1.5, 1.7, 1.9]);
    assert_eq!(folded[..2], [0.1, 1.5]);
    assert!(folded[2].is_nan());
    assert!((folded[3] - (1.9 - PI)).abs() < 1e-15);
}

#[test]
fn numbers_keep_three_digits() {
    for (value, text) in [
        (1.2345, "1.23"),
        (12.345, "12.3"),
        (12345.6, "12346"),
        (0.0012345, "0.00123"),
        (1.2345e-5, "1.23e-5"),
        (0.0, "0.00e0"),
    ] {
        assert_eq!(three_digits(value), text);
    }
}
