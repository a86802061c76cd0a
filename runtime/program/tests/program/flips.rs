//! Times of first flips, against other routes to the same times.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;

use branched_pendulum::integrate::{Crossing, Event};
use branched_pendulum::prelude::*;
use branched_pendulum_trees::TreeDescription;

use super::{Folder, text};

/// The shipped tree `chain`, whose numbers the tests below know.
const CHAIN: &str = "gravity = 9.80665,
upper: rod(mass = 0.2, length = 0.3) [lower: rod(mass = 0.1, length = 0.2)]";

/// The rows of a map of flips: the point, the time, and the link.
fn rows(folder: &Folder) -> Vec<([f64; 2], f64, String)> {
    let table = folder.read("results/map.csv");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        // The time of a link that does not flip is missing.
        let number = |cell: usize| match cells[cell] {
            "" => f64::NAN,
            number => number.parse().unwrap(),
        };
        ([number(0), number(1)], number(2), cells[4].to_owned())
    };
    table.lines().skip(1).map(row).collect()
}

/// The first of the events by which a link of the chain comes to π or to −π, one motion alone.
fn by_events(start: [f64; 2], duration: f64) -> Option<(f64, usize)> {
    let tree = TreeDescription::parse(CHAIN).unwrap().tree(&[]).unwrap();
    let sides = [(0, PI), (0, -PI), (1, PI), (1, -PI)];
    let functions = sides.map(|(link, at)| move |_: f64, state: &[f64]| state[link] - at);
    let events: Vec<Event<'_, f64>> = functions
        .iter()
        .map(|function| Event::new(Crossing::Either, function).with_terminal(1))
        .collect();
    let start = State::at_rest(0.0, &start.map(f64::to_radians));
    let mut first = None;
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let system = AbsoluteAngles(&tree);
    let ended = method.integrate_with_events(&system, &start, duration, &events, |occurrence| {
        first = first.or(Some((occurrence.time, sides[occurrence.event].0)));
        ControlFlow::Continue(())
    });
    ended.unwrap();
    first
}

#[test]
fn flips_in_lanes_are_those_of_one_motion_alone() {
    let folder = Folder::new("flips");
    let tree = folder.file("chain.txt", CHAIN);
    let words = ["map", "--of", "flip", "--tree", &tree, "--duration", "3"];
    let axes = ["--x", "lower=-150:150:30", "--y", "upper=28:178:30"];
    let printed = folder.answer(&[&words[..], &axes, &["--tolerance", "1e-10"]].concat());
    assert!(printed.contains("66 points"), "{printed}");
    let (mut flips, mut others) = ([0, 0], 0);
    for ([lower, upper], time, link) in rows(&folder) {
        match by_events([upper, lower], 3.0) {
            None => {
                assert!(time.is_nan() && link.is_empty(), "{lower} {upper}: {time}");
                others += 1;
            }
            Some((alone, number)) => {
                assert!(
                    (time - alone).abs() < 1e-7,
                    "{lower} {upper}: {time} {alone}"
                );
                assert_eq!(link, ["upper", "lower"][number]);
                flips[number] += 1;
            }
        }
    }
    assert!(flips.iter().all(|&count| count > 3) && others > 3);
    let chart = folder.read("results/map.svg");
    assert!(chart.contains("no flip within 3 s"));
    let record = folder.read("results/run.json");
    let flipped = format!("\"flipped\": {}", flips[0] + flips[1]);
    assert!(record.contains(&flipped), "{record}");

    // Of one link alone: later, or the same.
    let before = rows(&folder);
    let alone = ["--link", "upper", "--tolerance", "1e-10"];
    folder.answer(&[&words[..], &axes, &alone].concat());
    let after = rows(&folder);
    let mut later = 0;
    for ((_, first, link), (_, own, named)) in before.iter().zip(&after) {
        assert!(named != "lower");
        match link.as_str() {
            "upper" => assert_eq!(first.to_bits(), own.to_bits()),
            "lower" => later += u32::from(own.is_nan() || own > first),
            _ => assert!(own.is_nan()),
        }
    }
    assert!(later > 3);
}

/// A motion has the energy of its release, and each flip needs at least that of the lowest
/// configuration with a link upside down; what is left and right does not matter.
#[test]
fn nothing_flips_below_its_energy_and_mirror_images_flip_together() {
    let folder = Folder::new("flips-bound");
    let tree = folder.file("chain.txt", CHAIN);
    let words = ["map", "--of", "flip", "--tree", &tree, "--duration", "5"];
    let axes = ["--x", "lower=-170:170:20", "--y", "upper=-70:70:20"];
    let printed = folder.answer(&[&words[..], &axes].concat());
    let rows = rows(&folder);
    let (upper_moment, lower_moment) = ((0.2 / 2.0 + 0.1) * 0.3, 0.1 / 2.0 * 0.2);
    let above_rest = |moment: f64, degrees: f64| moment * (1.0 - degrees.to_radians().cos());
    let least = 2.0 * f64::min(upper_moment, lower_moment);
    let (mut below, mut flipped) = (0, 0);
    for (&([lower, upper], time, _), (mirrored, other, _)) in rows.iter().zip(rows.iter().rev()) {
        let energy = above_rest(upper_moment, upper) + above_rest(lower_moment, lower);
        if energy < least {
            below += 1;
            assert!(time.is_nan(), "{lower} {upper}: {time}");
        }
        flipped += u32::from(!time.is_nan());
        assert_eq!(*mirrored, [-lower, -upper]);
        let is_same = (time - other).abs() < 1e-12 || time.is_nan() && other.is_nan();
        assert!(is_same, "{lower} {upper}: {time} {other}");
    }
    assert!(below > 20 && flipped > 20, "{below} {flipped}");
    let reported = format!("Of all points {below} have less energy");
    assert!(printed.contains(&reported), "{below}: {printed}");
    let chart = folder.read("results/map.svg");
    assert!(chart.contains("energy of the lowest inverted configuration"));
}

/// A rod that turns over and over comes from the bottom to the top within (2/ω) K(m), where
/// m = 4 Ω²/ω², Ω² = 3 g/(2 l), and K = π/(2 agm(1, √(1 − m))).
#[test]
fn a_rod_flips_when_an_elliptic_integral_says() {
    let folder = Folder::new("flips-rod");
    let rod = "gravity = 9.80665, arm: rod(mass = 0.1, length = long)";
    let tree = folder.file("rod.txt", rod);
    let words = ["map", "--of", "flip", "--tree", &tree, "--set", "long=1"];
    let axes = ["--x", "long=0.2:0.5:0.1", "--y", "arm=0:0:1"];
    let more = ["--rates", "arm=1200", "--tolerance", "1e-11"];
    folder.answer(&[&words[..], &axes, &more].concat());
    let rows = rows(&folder);
    assert_eq!(rows.len(), 4);
    let speed = 1200.0_f64.to_radians();
    for ([long, _], time, link) in rows {
        let modulus = 4.0 * 1.5 * 9.80665 / long / (speed * speed);
        let (mut mean, mut geometric) = (1.0, (1.0 - modulus).sqrt());
        for _ in 0..8 {
            (mean, geometric) = (0.5 * (mean + geometric), (mean * geometric).sqrt());
        }
        let expected = 2.0 / speed * FRAC_PI_2 / mean;
        assert!((time - expected).abs() < 1e-10, "{time} {expected}");
        assert_eq!(link, "arm");
    }
}

/// A column of a plane with a parameter is the map of the tree with that value.
#[test]
fn parameters_have_the_flips_of_their_own_tree() {
    let folder = Folder::new("flips-parameter");
    let words = ["map", "--of", "flip", "--tree", "chain", "--duration", "2"];
    let upper = ["--y", "upper=90:170:2"];
    let plane = ["--x", "lower_length=0.15:0.25:0.05", "--start", "lower=40"];
    folder.answer(&[&words[..], &upper, &plane].concat());
    let all = rows(&folder);
    assert_eq!(all.len(), 3 * 41);
    for (place, long) in ["0.15", "0.2", "0.25"].iter().enumerate() {
        let set = format!("lower_length={long}");
        let line = ["--x", "lower=40:40:1", "--set", &set];
        folder.answer(&[&words[..], &upper, &line].concat());
        let own = rows(&folder);
        let column = all.iter().skip(place).step_by(3);
        for ((_, in_plane, _), (_, alone, _)) in column.zip(&own) {
            let is_same = (in_plane - alone).abs() < 1e-9 || in_plane.is_nan() && alone.is_nan();
            assert!(is_same, "{long}: {in_plane} {alone}");
        }
        assert!(own.iter().any(|(_, time, _)| time.is_finite()));
    }
}

#[test]
fn help_tells_units_of_both_quantities() {
    let help = super::run(&["map", "--help"]);
    let help = text(&help.stdout);
    for reported in ["growth", "flip", "1/s", "first flips (turns over), s"] {
        assert!(help.contains(reported), "{reported}: {help}");
    }
}

/// π and −π are one place, and no flip: a link that starts there flips when it comes back.
#[test]
fn a_link_that_starts_upside_down_flips_when_it_comes_back() {
    let folder = Folder::new("flips-upside-down");
    let words = ["map", "--of", "flip", "--tree", "chain", "--duration", "3"];
    let axes = ["--x", "lower=-180:180:360", "--y", "upper=60:100:20"];
    folder.answer(&[&words[..], &axes].concat());
    let rows = rows(&folder);
    assert_eq!(rows.len(), 6);
    for pair in rows.chunks(2) {
        assert!((pair[0].1 - pair[1].1).abs() < 1e-6, "{pair:?}");
    }
    // One degree further the first of these passes the top within 0.03 s.
    assert!(rows[0].1 > 1.2, "{:?}", rows[0]);
}

/// A friction of zero is none: a tree without it is one of another shape.
#[test]
fn a_plane_may_hold_trees_of_several_shapes() {
    let folder = Folder::new("flips-shapes");
    let brushed = CHAIN.replace("length = 0.2", "length = 0.2, friction = f");
    let tree = folder.file("brushed.txt", &brushed);
    let words = ["map", "--tree", &tree, "--set", "f=1", "--start", "90"];
    let axes = [
        "--of",
        "flip",
        "--x",
        "f=0:2e-3:1e-3",
        "--y",
        "upper=100:160:30",
    ];
    let printed = folder.answer(&[&words[..], &axes].concat());
    assert!(printed.contains("9 points"), "{printed}");
    assert!(!printed.contains("could not be followed"), "{printed}");
}
