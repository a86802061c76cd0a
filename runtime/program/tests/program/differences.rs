//! Where differences between copies grow, by which resonance, and how far orders of W reach.

use super::{Folder, Y};

/// Two jointed arms on a body.
const ARMS: &str = "gravity = 9.80665, body: rod(mass = 0.4, length = 0.3) [
    upper: rod(mass = 0.1, length = 0.2) [lower: rod(mass = 0.05, length = 0.15)] * 2
]";

/// The paper's pendulum, whose children have `ratio` times their mass.
const HEAVY: &str = "gravity = 9.80665,
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = 0.10531 * ratio, com = 0.043, inertia = 0.516e-3 * ratio) * 2
]";

fn has_charts(folder: &Folder, name: &str) {
    for ending in ["svg", "png", "pdf"] {
        let file = folder.0.join("results").join(format!("{name}.{ending}"));
        assert!(file.exists(), "{file:?}");
    }
}

/// The amplitude of a difference decays at half the rate c/M_2 of its velocity, so that
/// Q = ω M_2/c.
#[test]
fn windows_without_friction_and_with_quality_factors() {
    let folder = Folder::new("growth-quality");
    let words = ["growth", "--tree", "apparatus", "--set", "viscous_1=0"];
    let scan = ["--angles", "43:45:0.25", "--horizons", "4,10"];
    let more = ["--quality", "viscous_2=50,150", "--mark", "47.6,47.8"];
    let text = folder.answer(&[&words[..], &scan, &more].concat());
    let (without, with) = text.split_once("Q = 50").unwrap();
    assert!(
        without.contains("G(10 s) ≥ 10         43.5° to 44.75°"),
        "{text}"
    );
    assert!(with.contains("G(10 s) ≥ 10         nowhere"), "{text}");
    let moment: f64 = 0.516e-3 + 0.10531 * 0.043 * 0.043;
    let frequency = (0.10531 * 0.043 * 9.80665 / moment).sqrt();
    for quality in [50.0, 150.0] {
        let constant = frequency * moment / quality;
        let label = format!("Q = {quality}, viscous_2 = {constant:.3e}");
        assert!(text.contains(&label), "{label}: {text}");
    }
    // The ideal pendulum grows more than tenfold at both, with friction at neither.
    assert!(
        text.contains("G = 10 lies between 47.6° and 47.8° within none of these times"),
        "{text}"
    );
    has_charts(&folder, "growth");
}

/// A column of ratios is the map of the tree with that ratio.
#[test]
fn growth_over_a_parameter_by_ratios() {
    let folder = Folder::new("map-ratio");
    let tree = folder.file("heavy.txt", HEAVY);
    let words = ["map", "--tree", &tree, "--duration", "2"];
    let plane = ["--x", "ratio=0.05:20:x4", "--y", "parent=10:90:40"];
    let text = folder.answer(&[&words[..], &plane, &["--set", "ratio=1"]].concat());
    assert!(text.contains("15 points"), "{text}");
    has_charts(&folder, "map");
    let (_, all) = folder.table("map.csv");
    let expected = [0.05, 0.2, 0.8, 3.2, 12.8];
    for (row, ratio) in all.iter().zip(expected) {
        assert!((row[0] / ratio - 1.0).abs() < 1e-12);
    }
    let column = ["--x", "ratio=0.8:0.8:1", "--y", "parent=10:90:40"];
    folder.answer(&[&words[..], &column, &["--set", "ratio=1"]].concat());
    let (_, alone) = folder.table("map.csv");
    for (own, row) in alone.iter().zip(all.iter().skip(2).step_by(5)) {
        assert!((own[2] - row[2]).abs() < 1e-6, "{own:?} {row:?}");
    }
}

#[test]
fn a_difference_of_two_links_is_mapped_with_all_that_hangs() {
    let folder = Folder::new("map-arms");
    let tree = folder.file("arms.txt", ARMS);
    let words = ["map", "--tree", &tree, "--duration", "2"];
    let plane = ["--x", "upper+lower=-90:90:45", "--y", "body=0:90:45"];
    let text = folder.answer(&[&words[..], &plane].concat());
    assert!(text.contains("15 points"), "{text}");
    let (names, rows) = folder.table("map.csv");
    assert_eq!(names[0], "upper+lower [degrees]");
    // The other half mirrors this one: a body at zero has equal rates on both sides.
    for (left, right) in rows[..5].iter().zip(rows[..5].iter().rev()) {
        assert!((left[2] - right[2]).abs() < 1e-6, "{left:?} {right:?}");
    }
}

#[test]
fn normal_modes_go_through_the_plane() {
    let folder = Folder::new("map-modes");
    let plane = ["--x", "child=-60:60:30", "--y", "parent=0:30:15"];
    let more = ["--duration", "4", "--modes", "--mark", "0:20,-10:5"];
    let text = folder.answer(&[&["map"][..], &plane, &more].concat());
    assert!(text.contains("Mode f_1: 0.8732 Hz when small"), "{text}");
    assert!(text.contains("Mode f_2: 1.5826 Hz when small"), "{text}");
    let chart = folder.read("results/map.svg");
    for reported in ["nonlinear normal mode", "marked"] {
        assert!(chart.contains(reported), "{reported}");
    }
    has_charts(&folder, "map");
}

/// Twice the frequency of the difference is the sum of those of the two modes, on the
/// ridges of the two blades beside the first mode.
#[test]
fn the_blades_are_one_resonance() {
    let folder = Folder::new("map-tongues");
    for (parent, children) in [(30, "child=14:24:2"), (40, "child=82:94:3")] {
        let (y, line) = (
            format!("parent={parent}:{parent}:1"),
            format!("parent={parent}"),
        );
        let words = ["map", "--x", children, "--y", &y, "--tongues", &line];
        let more = ["--duration", "7.5", "--tolerance", "1e-9"];
        let text = folder.answer(&[&words[..], &more].concat());
        let row = text.lines().find(|line| line.contains("f_eff − ("));
        let row = row.unwrap_or_else(|| panic!("{text}"));
        let (_, mismatch) = row.split_once("f_eff − (f_1 + f_2)/2 = ").unwrap();
        let mismatch: f64 = mismatch.split(' ').next().unwrap().parse().unwrap();
        assert!(mismatch.abs() < 1e-3, "{text}");
        assert!(
            text.contains("At 1 places |f_eff − (f_1 + f_2)/2|"),
            "{text}"
        );
    }
}

/// The exact form of W against its orders, of a tree with a sector of two links.
#[test]
fn orders_of_the_transfer_fail_at_growing_amplitudes() {
    let folder = Folder::new("transfer-amplitude");
    let tree = folder.file("arms.txt", ARMS);
    let words = ["transfer", "--tree", &tree, "--against", "amplitude"];
    let more = ["--start", "body=45", "--duration", "2", "--rate", "50"];
    let text = folder.answer(&[&words[..], &more, &["--states", "16"]].concat());
    assert!(text.contains("into `upper_d`"), "{text}");
    assert!(text.contains("amplitude order 8"), "{text}");
    has_charts(&folder, "transfer");
    let (names, rows) = folder.table("transfer.csv");
    let phase = folder.read("results/transfer.csv");
    let phase = phase
        .lines()
        .filter(|line| line.contains(",phase,"))
        .count();
    assert_eq!(phase, 45);
    let column = |order: u32| {
        let name = format!("relative error amplitude order {order}");
        names.iter().position(|own| *own == name).unwrap()
    };
    // At a tenth of a radian.
    let row = rows[..45].iter().find(|row| row[2] > 0.1).unwrap();
    for orders in [[2, 4], [4, 6], [6, 8]] {
        let [low, high] = orders.map(|order| row[column(order)]);
        assert!(high < 0.5 * low, "{orders:?}: {row:?}");
    }
}

#[test]
fn trees_with_springs_have_no_bound_of_energy() {
    let folder = Folder::new("flips-springs");
    let y = folder.file("y.txt", Y);
    let words = ["map", "--of", "flip", "--tree", &y, "--set", "stiffness=4"];
    let plane = [
        "--x",
        "arm=0:90:45",
        "--y",
        "stem=0:45:45",
        "--duration",
        "1",
    ];
    let text = folder.answer(&[&words[..], &plane].concat());
    assert!(!text.contains("less energy"), "{text}");
    let chart = folder.read("results/map.svg");
    assert!(!chart.contains("inverted"));
}

/// The blade at 30° of the parent, by theory alone and next to simulation.
#[test]
fn tongues_are_predicted() {
    let folder = Folder::new("theory");
    let words = ["theory", "--x", "child=0:40:0.5", "--at", "parent=30"];
    let text = folder.answer(&words);
    assert!(text.contains("f_1 + f_2 = 2 d_1"), "{text}");
    let line = text.lines().find(|line| line.contains("1/s at")).unwrap();
    let numbers: Vec<f64> = line
        .split([' ', '°', ',', ':'])
        .filter_map(|part| part.parse().ok())
        .collect();
    let [from, _, to, _, rate, ..] = numbers[..] else {
        panic!("{line}")
    };
    assert!(
        (from - 13.5).abs() < 0.6 && (to - 23.5).abs() < 0.6,
        "{line}"
    );
    assert!((rate - 0.0713).abs() < 0.03 * 0.0713, "{line}");
}

/// A parameter on the axis: the mass of the children for which the release grows.
#[test]
fn a_tongue_over_a_parameter() {
    let folder = Folder::new("theory-parameter");
    let tree = folder.file("heavy.txt", HEAVY);
    let words = [
        "theory", "--tree", &tree, "--set", "ratio=1", "--start", "child=19",
    ];
    let text = folder.answer(
        &[
            &words[..],
            &["--x", "ratio=0.8:1.2:0.1", "--at", "parent=30"],
        ]
        .concat(),
    );
    assert!(text.contains("parent = 30°"), "{text}");
    assert!(text.contains("by f_1 + f_2 = 2 d_1"), "{text}");
}

/// The tongues on one line for each mass of the children: with the mass of the tree, those of it.
#[test]
fn tongues_for_each_value_of_a_parameter() {
    let folder = Folder::new("theory-varied");
    let tree = folder.file("heavy.txt", HEAVY);
    let words = ["theory", "--tree", &tree, "--set", "ratio=1"];
    let plane = ["--x", "child=0:40:1", "--at", "parent=30"];
    let own = folder.answer(&[&words[..], &plane].concat());
    let own = own.lines().find(|line| line.contains("1/s at")).unwrap();
    let varied = ["--vary", "ratio=0.5:1.5:0.5"];
    let all = Folder::new("theory-of-each");
    let text = all.answer(&[&words[..], &plane, &varied].concat());
    let lines: Vec<&str> = text.lines().collect();
    let of = |value: &str| {
        let place = lines
            .iter()
            .position(|line| line.trim() == format!("ratio = {value}"));
        lines[place.unwrap() + 1]
    };
    assert_eq!(of("1"), own, "{text}");
    assert!(of("0.5") != own && of("1.5") != own, "{text}");
}
