//! `cascade`: motions in lanes, checkpoints, shards, refusals.

mod sweeps;

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use branched_pendulum::analysis::SectorModes;
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::UnderTorques;
use branched_pendulum_frame::command_line::parse_line;
use branched_pendulum_program::commands::cascade::Arguments;
use branched_pendulum_program::commands::cascade::motor::{Motor, Random};

use super::{Folder, TRIPLE, UNEQUAL, Y, text};

fn arguments(line: &str) -> Arguments {
    parse_line(line).unwrap()
}

/// A pair of outermost rods moves against each other on a pivot at rest.
#[test]
fn the_outermost_sectors_have_the_frequency_of_a_rod() {
    let tree = arguments("--generations 4").read().unwrap().tree;
    let hanging = [0.0; 15];
    let (mass, stiffness) = (tree.mass_matrix(&hanging), tree.stiffness_matrix(&hanging));
    let modes = SectorModes::new(tree.sectors(), &mass, &stiffness).unwrap();
    assert!(modes.mass_off_block < 1e-15 && modes.stiffness_off_block < 1e-15);
    let length = 0.3 * 0.7_f64.powi(3);
    let rod = (1.5 * 9.80665 / length).sqrt() / TAU;
    let outermost = modes
        .blocks
        .iter()
        .filter(|block| block.name.starts_with("arm_4"));
    let mut seen = 0;
    for block in outermost {
        let [frequency] = block.modes.frequencies_hz[..] else {
            panic!("{} modes", block.modes.frequencies_hz.len());
        };
        assert!((frequency / rod - 1.0).abs() < 1e-13, "{frequency}, {rod}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn the_onset_leaves_table_and_charts() {
    let folder = folder("onset");
    let output = command(&folder, &["--onset", "0.2", "--generations", "4"])
        .output()
        .unwrap();
    finished(&output);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("| `in_phase` | 4 | 0."), "{text}");
    let csv = fs::read_to_string(folder.join("onset.csv")).unwrap();
    // The header and one sample each fiftieth of a second from 0 to 0.2 s.
    assert_eq!(csv.lines().count(), 12);
    for chart in ["onset.svg", "onset.png"] {
        assert!(folder.join(chart).metadata().unwrap().len() > 1000);
    }
}

/// A tree with dampers between its youngest rods beside its equilibrium, and two such runs beside
/// each other.
#[test]
fn cascades_stand_beside_their_equilibrium_and_each_other() {
    let runs = ["damped", "free"].map(|name| folder(&format!("beside-{name}")));
    for (run, gravity) in runs.iter().zip(["9.8", "0"]) {
        let set = format!("gravity={gravity},friction=0,sibling_friction=1e-4");
        let more = [
            "--torque",
            "0.5",
            "--steps",
            "256",
            "--set",
            &set,
            "--equilibrium",
        ];
        let output = command(run, &more).output().unwrap();
        finished(&output);
        let table = fs::read_to_string(run.join("scales.csv")).unwrap();
        let head = table.lines().next().unwrap();
        assert!(head.ends_with("energy in equilibrium [J],error of energy in equilibrium [J]"));
        let report = fs::read_to_string(run.join("report.md")).unwrap();
        assert!(
            report.contains("In thermal equilibrium at the same energy"),
            "{report}"
        );
    }
    let all = folder("beside-all");
    let both = runs.each_ref().map(|run| run.to_str().unwrap()).join(",");
    let output = super::command(&["cascade", "--compare", &both, "--output"])
        .arg(&all)
        .output()
        .unwrap();
    finished(&output);
    let text = fs::read_to_string(all.join("spectrum.md")).unwrap();
    assert!(
        text.contains("beside-damped |") && text.contains("beside-free |"),
        "{text}"
    );
    assert!(all.join("cascade-spectrum.png").metadata().unwrap().len() > 1000);
    // Without averages there is nothing to compare.
    let still = folder("beside-still");
    let more = ["--torque", "0", "--spread", "0", "--duration", "10"];
    finished(&command(&still, &more).output().unwrap());
    let refused = super::command(&["cascade", "--compare", still.to_str().unwrap(), "--output"])
        .arg(&all)
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&refused.stderr);
    assert!(
        !refused.status.success() && stderr.contains("no scale of differences in"),
        "{stderr}"
    );
    let missing = super::command(&["cascade", "--compare", "nowhere", "--output"])
        .arg(&all)
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&missing.stderr);
    assert!(
        !missing.status.success() && stderr.contains("scales.csv"),
        "{stderr}"
    );
}

/// A lineage under white noise: its input is known beforehand, and friction takes it.
#[test]
fn a_lineage_under_noise_is_balanced() {
    let folder = folder("lineage");
    let line = "--generations 6 --open 1 --noise 0.003 --steps 1024 --samples 32 --starts 16 \
                --duration 60 \
                --set gravity=0,length_ratio=0.85,friction=0,sibling_friction=2e-4";
    let more: Vec<&str> = line.split_whitespace().collect();
    let output = command(&folder, &more).output().unwrap();
    finished(&output);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("21 links in 6 generations"), "{text}");
    assert!(text.contains("white noise of 0.003 N² m² s"), "{text}");
    assert!(text.contains(": balanced."), "{text}");
    assert!(text.contains("Flatness of the amplitude"), "{text}");
    let refused = command(&folder, &["--generations", "17"]).output().unwrap();
    let stderr = String::from_utf8_lossy(&refused.stderr);
    assert!(stderr.contains("at most 16 without `--open`"), "{stderr}");
}

/// Starts in lanes move as another method moves them one by one, under the torque written down
/// once more, and the error falls as that of a method of order four.
#[test]
fn starts_in_lanes_have_the_motion_of_another_method() {
    let arguments = |steps: u32| arguments(&format!("--generations 3 --steps {steps}"));
    let own = arguments(2048);
    let subject = own.read().unwrap();
    let (tree, torque) = (&subject.tree, own.torque(&subject));
    let mut random = Random::of_start(1, 0);
    let starts: Vec<State<f64>> = (0..11)
        .map(|_| State::at_rest(0.0, &[(); 7].map(|()| random.within(0.5))))
        .collect();
    let pace = TAU * own.frequency;
    let pushed = UnderTorques::new(
        tree,
        |time: f64, _: &[f64], _: &[f64], torques: &mut [f64]| {
            torques.fill(0.0);
            torques[0] = torque * (pace * time).cos();
        },
    );
    let ensemble = Ensemble::new();
    let reference = Verner98::new(Options::with_tolerance(1e-13));
    let reference = ensemble.integrate(&reference, &pushed, &starts, 1.0);
    let error = |steps: u32| {
        let arguments = arguments(steps);
        let motor = Motor::new(&arguments, torque, &mut Random::of_start(1, 0));
        let system = UnderTorques::of(tree, motor);
        let method = Rk4::new(arguments.step());
        let ends = ensemble.integrate_in_lanes(&method, &system, &starts, 1.0);
        let mut largest = 0.0_f64;
        for (end, reference) in ends.into_iter().zip(&reference) {
            let (end, reference) = (end.unwrap().state, &reference.as_ref().unwrap().state);
            for (value, reference) in end.values.iter().zip(&reference.values) {
                largest = largest.max((value - reference).abs());
            }
        }
        largest
    };
    let [coarse, fine] = [2048, 4096].map(error);
    assert!(coarse < 2e-6, "{coarse:e}");
    let order = (coarse / fine).log2();
    assert!((3.5..4.5).contains(&order), "{coarse:e} {fine:e}");
}

/// A short run.
const SHORT: &[&str] = &[
    "--generations",
    "3",
    "--starts",
    "8",
    "--duration",
    "100",
    "--samples",
    "8",
    "--set",
    "friction=1e-4",
    "--steps",
    "128",
    "--threads",
    "1",
    "--checkpoint",
    "0",
];

fn folder(name: &str) -> PathBuf {
    super::folder(&format!("cascade-{name}"))
}

/// The options of the short run, but for those that `more` has.
fn options<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let others = SHORT.chunks(2).filter(|option| !more.contains(&option[0]));
    others.flatten().chain(more).copied().collect()
}

fn command(folder: &Path, more: &[&str]) -> Command {
    let mut command = super::command(&["cascade"]);
    command.args(options(more)).arg("--output").arg(folder);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn finished(output: &Output) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
}

/// All files of a folder but those of shards.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let files = entries.filter(|entry| entry.file_type().unwrap().is_file());
    files
        .map(|entry| {
            let name = entry.file_name().into_string().unwrap();
            (name, fs::read(entry.path()).unwrap())
        })
        .collect()
}

#[test]
fn what_is_asleep_is_called_so() {
    // Too much friction, and a tree that hangs still.
    for (number, more) in [
        [
            "--starts",
            "4",
            "--torque",
            "0.05",
            "--set",
            "friction=1e-2",
        ],
        ["--starts", "4", "--torque", "0", "--spread", "0"],
    ]
    .iter()
    .enumerate()
    {
        let folder = folder(&format!("asleep-{number}"));
        let output = command(&folder, more).output().unwrap();
        finished(&output);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains("| 2 | 2 | asleep ("), "{text}");
    }
}

/// Trees of files: scales where there are copies, else a refusal that says what to write.
#[test]
fn other_trees_are_followed_or_refused() {
    let folder = Folder::new("cascade");
    let y = folder.file("y.txt", Y);
    let line = "--set stiffness=4 --duration 20 --starts 4 --steps 256 --samples 16";
    let mut words = vec!["cascade", "--tree", &y];
    words.extend(line.split_whitespace());
    let reported = folder.answer(&words);
    let title = "y.txt: 3 links in 2 generations, 4 starts of 20.0 s each; torque 0.2 N m";
    assert!(reported.contains(title), "{reported}");
    let (names, rows) = folder.table("windows.csv");
    assert_eq!(names[6], "energy 1 [J]");
    assert_eq!((names.len(), rows.len()), (10, 4 * 12));
    assert!(folder.read("results/tree.svg").contains("</svg>"));

    let own = format!("{TRIPLE}, drive(torque = 0.1 * cos(4 * t))");
    let fork = "gravity = 9.81, drive(torque = 0.1 * cos(4 * t)),
        stem: rod(mass = 0.2, length = 0.3, friction = 1e-4) [
            arm: rod(mass = 0.1, length = 0.2, friction = 1e-5) * 3]";
    for (text, more, message) in [
        (
            TRIPLE,
            "",
            "`tree.txt` has no scales, since there are no copies: write equal",
        ),
        (
            UNEQUAL,
            "",
            "`tree.txt` has no scales, because links of one generation differ",
        ),
        (
            "gravity = 9.81, stem: rod(mass = 0.2, length = 0.3) [arm: rod(mass = 0.1, length = 0.2) * 2],
            guy(stem, at = 0.2, to = (0.4, 0), spring = 3)",
            "",
            "`tree.txt` has no scales, because the spring `guy(stem)` couples them",
        ),
        (own.as_str(), "--onset 1", "the tree has no copies"),
        (
            fork,
            "--torque 0.1",
            "`tree.txt` already has a drive: leave out `--torque`",
        ),
        (
            fork,
            "--bandwidth 0.1",
            "`tree.txt` already has a drive: leave out `--torque`",
        ),
    ] {
        let tree = folder.file("tree.txt", text);
        let mut words = vec!["cascade", "--tree", &tree];
        words.extend(more.split_whitespace());
        let output = folder.run(&words);
        let reported = super::text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{reported}");
        assert!(reported.contains(message), "{reported}");
    }
    let tree = folder.file("tree.txt", fork);
    let reported = folder.answer(&["cascade", "--tree", &tree, "--onset", "1"]);
    assert!(
        reported.contains("no torque but that of the description"),
        "{reported}"
    );
    assert!(reported.contains("| `in_phase` | 2 |"), "{reported}");
}

#[test]
fn mistakes_are_named() {
    for (line, message) in [
        ("--generations 17", "must be at most 16 without `--open`"),
        ("--generations 33", "33 is not in 2..=32"),
        (
            "--generations 3 --tree paper",
            "leave out either them or `--tree`",
        ),
        ("--torque NaN", "must be from 0 to 100 N m"),
        ("--bandwidth 1", "at most 0.9 of the frequency"),
        (
            "--samples 100",
            "`--steps` must be a multiple of `--samples`",
        ),
        ("--shard 3/3", "must be I/N"),
        ("--shard 0/3 --merge 3", "cannot be used with"),
    ] {
        let reported = parse_line::<Arguments>(line).unwrap_err();
        assert!(reported.contains(message), "{line}: {reported}");
    }
}
