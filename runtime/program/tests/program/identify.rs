//! `branched-pendulum identify`: trees in texts, and what it refuses.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeDescription};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::{folder, run, text};

/// A chain of three rods that nobody compiled, with friction of two laws.
const TRIPLE: &str = "gravity = 9.81,
upper: rod(mass = 0.3, length = upper_length, friction = viscous) [
    middle: rod(mass = 0.2, length = 0.25,
        friction(viscous = viscous, coulomb = coulomb, width = 0.05)) [
        lower: rod(mass = lower_mass, length = 0.2, friction = viscous)
    ]
]";

/// Values of its parameters.
const TRUTH: [(&str, f64); 4] = [
    ("upper_length", 0.3),
    ("viscous", 4e-4),
    ("coulomb", 3e-4),
    ("lower_mass", 0.1),
];

/// The tree with them.
pub(super) fn tree() -> PendulumTree {
    let tree = TreeDescription::parse(TRIPLE).unwrap();
    tree.tree(&TRUTH).unwrap()
}

/// Writes a tree, and angles of its links with noise of 1 mrad, 100 a second.
pub(super) fn measured(name: &str) -> (PathBuf, PathBuf) {
    let tree = tree();
    let times: Vec<f64> = (0..500).map(|row| f64::from(row) / 100.0).collect();
    let start = State::at_rest(0.0, &[0.5, -0.2, 0.3]);
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let motion = method.sample_to_vec(&AbsoluteAngles(&tree), &start, &times);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let mut table = "t [s],upper [rad],middle [rad],lower [rad]\n".to_owned();
    for (time, state) in times.iter().zip(motion.unwrap()) {
        write!(table, "{time}").unwrap();
        for angle in &state.values[..3] {
            let normal: f64 = StandardNormal.sample(&mut random);
            write!(table, ",{:.6}", angle + 1e-3 * normal).unwrap();
        }
        table.push('\n');
    }
    let folder = folder(&format!("identify-{name}"));
    fs::create_dir_all(&folder).unwrap();
    let (tree, file) = (folder.join("triple.txt"), folder.join("swing.csv"));
    fs::write(&tree, TRIPLE).unwrap();
    fs::write(&file, table).unwrap();
    (tree, file)
}

/// Runs `identify`; its exit code and what it prints.
fn identify(file: &Path, words: &str) -> (Option<i32>, String) {
    let output = file.with_file_name("output");
    let mut all = vec!["identify", file.to_str().unwrap()];
    all.extend(["--output", output.to_str().unwrap()]);
    all.extend(words.split_whitespace());
    let done = run(&all);
    let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
    (done.status.code(), printed)
}

#[test]
fn parameters_of_a_tree_in_a_text_are_found() {
    let (tree, file) = measured("triple");
    let tree = tree.to_str().unwrap();
    let words =
        format!("--tree {tree} --unknown upper_length=0.33,lower_mass=0.085,viscous=3e-4,coulomb");
    let (code, printed) = identify(&file, &words);
    assert_eq!(code, Some(0), "{printed}");
    assert!(
        printed.contains("Parameters by one motion, friction and Coulomb"),
        "{printed}"
    );
    // No quadratic drag is named: the third law would be the second.
    assert!(!printed.contains("and quadratic"), "{printed}");
    assert!(
        printed.contains("Energy of the fitted motion and of the measured one differ"),
        "{printed}"
    );
    let output = file.with_file_name("output");
    let read = |name: &str| fs::read_to_string(output.join(name)).unwrap();
    let found: serde_json::Value = serde_json::from_str(&read("parameters.json")).unwrap();
    for (name, truth) in TRUTH {
        let found = found[name].as_f64().unwrap();
        let near = match name {
            "viscous" | "coulomb" => 0.1,
            _ => 0.01,
        };
        assert!((found / truth - 1.0).abs() < near, "{name} {found}");
    }
    let errors = read("errors.csv");
    assert!(
        errors.starts_with("time [s],window_upper [rad],window_middle [rad],window_lower [rad]"),
        "{errors:.99}"
    );
    // The run is repeated from its record.
    let again = output.with_file_name("again");
    let record = output.join("run.json");
    let words = ["identify", "--repeat", record.to_str().unwrap()];
    let done = run(&[&words[..], &["--output", again.to_str().unwrap()]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    assert_eq!(
        fs::read_to_string(again.join("parameters.json")).unwrap(),
        read("parameters.json")
    );
}

/// Angles are not counted from a place that follows from what is looked for.
#[test]
fn a_place_of_rest_that_is_looked_for_is_refused() {
    let folder = folder("identify-rest");
    fs::create_dir_all(&folder).unwrap();
    let (tree, file) = (folder.join("bent.txt"), folder.join("swing.csv"));
    let bent = "gravity = 9.81, arm(mass = 0.2, com = (0.1, aside), inertia = 1e-3, friction = f)";
    fs::write(&tree, bent).unwrap();
    fs::write(&file, "t [s],arm [rad]\n0,0\n0.1,0\n").unwrap();
    let rest = format!("--tree {} --rest 0:0.1 --unknown", tree.display());
    let (code, printed) = identify(&file, &format!("{rest} aside=0.02,f"));
    assert_eq!(code, Some(1), "{printed}");
    let reported = "the rest position of the tree depends on the unknown parameter `aside`: set it by \
                `--set aside=";
    assert!(printed.contains(reported), "{printed}");
    // Friction moves no place of rest.
    let (_, printed) = identify(&file, &format!("{rest} f --set aside=0.02"));
    assert!(!printed.contains("depends on"), "{printed}");
}

#[test]
fn what_is_not_known_or_not_there_is_refused() {
    let (tree, file) = measured("refusals");
    let tree = tree.to_str().unwrap();
    for (words, code, message) in [
        (
            format!("--tree {tree}"),
            1,
            "has no value: give its value by `--set upper_length=VALUE`, or a starting value for the \
             search by `--unknown upper_length=GUESS`",
        ),
        (
            format!("--tree {tree} --unknown lower_mass=0.1"),
            1,
            "`--set upper_length=VALUE`",
        ),
        (
            format!("--tree {tree} --set length=0.3"),
            1,
            "no parameter `length`: there are `upper_length`, `viscous`, `coulomb`, `lower_mass`",
        ),
        (
            "--unknown com1".to_owned(),
            1,
            "no parameter `com1`: there are `gravity`",
        ),
        (
            "--set com_1=0.1 --unknown com_1".to_owned(),
            1,
            "`com_1` is given both as known (`--set`) and as unknown (`--unknown`)",
        ),
        (
            "--tree y".to_owned(),
            1,
            "the tree `y` has no unknown parameter",
        ),
        ("--tree no-such-tree".to_owned(), 1, "there is no tree"),
        (
            "--set gravity=9.81".to_owned(),
            1,
            "angles of 3 links, but the pendulum has 2",
        ),
        (
            "--columns upper --dots a:b".to_owned(),
            2,
            "angles come from one of them",
        ),
        (
            "--laws dry".to_owned(),
            2,
            "laws are viscous, coulomb and all",
        ),
    ] {
        let (ended, printed) = identify(&file, &words);
        assert_eq!(ended, Some(code), "{words}: {printed}");
        assert!(printed.contains(message), "{words}: {printed}");
    }
}

/// A folder in place of a file: the rename fails, after the part was written.
#[test]
fn a_file_that_cannot_be_written_is_told() {
    let folder = folder("identify-taken");
    let taken = folder.join("parameters.json");
    fs::create_dir_all(&taken).unwrap();
    let mut words: Vec<&str> = "identify --duration 5 --laws viscous".split(' ').collect();
    words.extend(["--output", folder.to_str().unwrap()]);
    let done = run(&words);
    assert_eq!(done.status.code(), Some(1));
    let expected = format!("cannot write {}", taken.display());
    assert!(
        text(&done.stderr).contains(&expected),
        "{}",
        text(&done.stderr)
    );
}
