//! `design` against formulas that it does not use, and against integration.

use std::f64::consts::TAU;

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::system::State;
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

use super::Folder;

/// Two links, with two parameters.
const CHAIN: &str = "// Two links.
gravity = 9.81,
upper(mass = 0.3, com = com, inertia = 2e-3, joint = joint) [
    lower(mass = 0.2, com = 0.1, inertia = 1e-3)
]";

const GRAVITY: f64 = 9.80665;

/// Frequencies (Hz) of the chain, from the quadratic equation det(K − ω² M) = 0.
fn frequencies(com: f64, joint: f64) -> [f64; 2] {
    let first = 2e-3 + 0.3 * com * com + 0.2 * joint * joint;
    let (second, between) = (1e-3 + 0.2 * 0.1 * 0.1, 0.2 * joint * 0.1);
    let [k1, k2] = [9.81 * (0.3 * com + 0.2 * joint), 9.81 * 0.2 * 0.1];
    let a = first * second - between * between;
    let b = k1 * second + k2 * first;
    let root = (b * b - 4.0 * a * k1 * k2).sqrt();
    [-1.0, 1.0].map(|sign| ((b + sign * root) / (2.0 * a)).sqrt() / TAU)
}

/// Values in a column of a table whose first column has names.
fn column(folder: &Folder, table: &str, name: &str) -> Vec<f64> {
    let (names, rows) = folder.table(table);
    let place = names.iter().position(|own| own == name).unwrap();
    rows.iter().map(|row| row[place]).collect()
}

/// Runs a design, which must fail, and returns what it writes to the standard error.
fn failure(folder: &Folder, words: &[&str], code: i32) -> String {
    let output = folder.run(&[&["design"], words].concat());
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{words:?}: {text}");
    text
}

#[test]
fn frequencies_of_a_chain_are_those_of_a_formula() {
    let folder = Folder::new("design-chain");
    let chain = folder.file("chain.txt", CHAIN);
    let [slow, fast] = frequencies(0.11, 0.25);
    let target = format!("mode_1={slow},mode_2={fast}");
    let vary = [
        "--vary",
        "com=0.05:0.2,joint=0.1:0.4",
        "--set",
        "com=0.19,joint=0.12",
    ];
    let words = [
        &["design", "--tree", &chain, "--target", &target],
        &vary[..],
    ]
    .concat();
    let text = folder.answer(&words);
    let found = column(&folder, "parameters.csv", "value");
    let [first, second] = frequencies(found[0], found[1]);
    assert!(
        (first / slow - 1.0).abs() < 2e-6 && (second / fast - 1.0).abs() < 2e-6,
        "{text}"
    );
    // Derivatives against differences of the formula.
    let step = 1e-5;
    let by_joint = column(&folder, "targets.csv", "derivative by joint");
    for mode in [0, 1] {
        let of = |joint| frequencies(found[0], joint)[mode];
        let slope = (of(found[1] + step) - of(found[1] - step)) / (2.0 * step);
        assert!(
            (by_joint[mode] / slope - 1.0).abs() < 1e-4,
            "{slope} {by_joint:?}"
        );
    }
    // The parameters with which the targets were computed are the solution, or listed as another.
    let is_truth = |com: f64, joint: f64| (com - 0.11).abs() < 1e-4 && (joint - 0.25).abs() < 1e-4;
    assert!(is_truth(found[0], found[1]) || text.contains("com +1.1000e-1, joint +2.5000e-1"));
    // The written tree needs no parameters.
    let tree = PendulumTree::parse(&folder.read("results/tree.txt")).unwrap();
    let modes = tree.modes(&[0.0; 2]).unwrap().frequencies_hz;
    assert!((modes[0] / first - 1.0).abs() < 1e-9 && (modes[1] / second - 1.0).abs() < 1e-9);
    // The record has them for other commands.
    let record = folder.0.join("results/run.json");
    let again = [
        "describe",
        "--tree",
        &chain,
        "--parameters",
        record.to_str().unwrap(),
    ];
    let output = super::run(&again);
    assert!(output.status.success(), "{}", super::text(&output.stderr));
}

#[test]
fn a_threshold_is_where_integrated_differences_begin_to_grow() {
    let folder = Folder::new("design-threshold");
    let words = "design --tree apparatus --set viscous_1=0,viscous_2=0 --vary joint_1=0.25:0.33 \
                 --target threshold=25";
    let text = folder.answer(&words.split_whitespace().collect::<Vec<_>>());
    let error = column(&folder, "targets.csv", "error bar")[0];
    assert!(error > 0.0 && error < 1.0, "{text}");
    let tree = PendulumTree::parse(&folder.read("results/tree.txt")).unwrap();
    let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
    let growth = DifferenceGrowth::new(&tree, &children, vec![240.0], 1e-9).unwrap();
    let rate = |degrees: f64| {
        let start = State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0]);
        growth.of_release(&start).unwrap().unwrap().rate.value
    };
    // Growth of 0.02 1/s counts.
    let [below, above] = [24.7, 25.3].map(rate);
    assert!(below < 0.02 && above > 0.02, "{below} {above}");
}

/// ω² = g m d/(I + m d²) of a child has one solution m for each d.
#[test]
fn the_nearest_of_many_solutions_is_reported() {
    let folder = Folder::new("design-nearest");
    let words = "design --tree apparatus --vary mass_2=0.05:0.15,com_2=0.03:0.06 --target f_d=1.2";
    let text = folder.answer(&words.split_whitespace().collect::<Vec<_>>());
    assert!(text.contains("change together"), "{text}");
    let square = (TAU * 1.2).powi(2);
    let mass = |com: f64| square * 0.516e-3 / (GRAVITY * com - square * com * com);
    let away = |mass: f64, com: f64| ((mass - 0.10531) / 0.1).hypot((com - 0.043) / 0.03);
    let all = (0..=30_000).map(|step| 0.03 + 1e-6 * f64::from(step));
    let nearest = all
        .map(|com| away(mass(com), com))
        .fold(f64::INFINITY, f64::min);
    let found = column(&folder, "parameters.csv", "value");
    assert!((found[0] / mass(found[1]) - 1.0).abs() < 1e-5, "{found:?}");
    assert!(
        (away(found[0], found[1]) - nearest).abs() < 1e-4,
        "{found:?} {nearest}"
    );
}

#[test]
fn a_limit_is_kept_and_a_growth_rate_reached() {
    let folder = Folder::new("design-limit");
    let words = "design --tree apparatus --set viscous_1=0,viscous_2=0 --vary joint_1=0.25:0.29 \
                 --start parent=30,child=19 --target growth=0.05,f_+<=0.88";
    let text = folder.answer(&words.split_whitespace().collect::<Vec<_>>());
    let values = column(&folder, "targets.csv", "value");
    assert!(
        (values[0] - 0.05).abs() < 1e-6 && values[1] <= 0.88,
        "{text}"
    );
}

#[test]
fn what_the_bounds_exclude_is_said_with_the_bound() {
    let folder = Folder::new("design-bound");
    let words = [
        "--tree",
        "apparatus",
        "--vary",
        "joint_1=0.1:0.2",
        "--target",
        "f_+=0.5",
    ];
    let text = failure(&folder, &words, 1);
    assert!(
        text.contains("`joint_1` is held at 0.2; help: widen this range"),
        "{text}"
    );
    assert!((column(&folder, "parameters.csv", "value")[0] - 0.2).abs() < 1e-12);
    assert!(!folder.0.join("results/tree.txt").exists());
    assert!(
        folder
            .read("results/run.json")
            .contains("\"reached\": false")
    );
}

#[test]
fn mistakes_of_a_design_are_named() {
    let folder = Folder::new("design-mistakes");
    for (vary, target, code, reported) in [
        ("joint=0.1:0.2", "f_d=1", 1, "no parameter `joint`"),
        (
            "joint_1=0.2:0.1",
            "f_d=1",
            1,
            "the bounds must be finite and ascending",
        ),
        ("joint_1=0.1", "f_d=1", 2, "write `NAME=FROM:TO`"),
        (
            "joint_1=0.1:0.2",
            "f_3=1",
            1,
            "there are: mode_1, mode_2, mode_3, f_1, f_2, f_+",
        ),
        ("joint_1=0.1:0.2", "f_d", 2, "write `NAME=VALUE`"),
        ("joint_1=0.1:0.2", "f_d=inf", 1, "must be a finite number"),
        ("joint_1=-2:-1", "threshold=30", 1, "choose other bounds"),
    ] {
        let words = ["--tree", "apparatus", "--vary", vary, "--target", target];
        let text = failure(&folder, &words, code);
        assert!(text.contains(reported), "{vary} {target}: {text}");
    }
    let words = [
        "--tree",
        "chain",
        "--vary",
        "upper_length=0.1:0.3",
        "--target",
        "threshold=9",
    ];
    assert!(failure(&folder, &words, 1).contains("of trees with copies"));
}
