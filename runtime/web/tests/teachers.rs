//! Numbers in the sentences of `teachers.html`, computed here.

use std::path::Path;

use branched_pendulum_web::Pendulum;

/// Tolerance of motions whose differences grow to full turns: results change by less than they are
/// rounded to where it is ten times as large.
const TOLERANCE: f64 = 1e-12;

/// Returns the text of a file of the page, with single spaces and without tags.
fn words_of(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("page")
        .join(file);
    let html = std::fs::read_to_string(path).expect("it is a file of the page");
    let mut text = String::new();
    let mut is_tag = false;
    for letter in html.chars() {
        match letter {
            '<' => is_tag = true,
            '>' => is_tag = false,
            letter if !is_tag => text.push(letter),
            _ => {}
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns a tree of `examples.js` as its file describes it, with other values of parameters.
fn example(id: &str, changed: &[(&str, f64)]) -> Pendulum {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("page/examples.js");
    let all = std::fs::read_to_string(file).expect("it is a file of the page");
    let (_, own) = all
        .split_once(&format!("id: \"{id}\""))
        .expect("there is such an example");
    let between = |start: &str, end: &str| {
        let (_, rest) = own.split_once(start).expect("an example has it");
        rest.split_once(end).expect("it ends").0.to_owned()
    };
    let values = between("values: { ", " }");
    let values = values.split(", ").map(|entry| {
        let (name, value) = entry.split_once(": ").expect("a name and its value");
        let value: f64 = value.parse().expect("a number");
        let other = changed.iter().find(|(changed, _)| *changed == name);
        (name.to_owned(), other.map_or(value, |(_, other)| *other))
    });
    let (names, values) = values.unzip();
    let mut pendulum = Pendulum::new(&between("text: `", "`"), names, values).expect("a tree");
    pendulum
        .set_method("verner98", TOLERANCE)
        .expect("a method");
    pendulum
}

/// Releases a tree at angles in degrees.
fn release(pendulum: &mut Pendulum, root: f64, others: f64, apart: f64) {
    let [root, others, apart] = [root, others, apart].map(f64::to_radians);
    pendulum.release(root, others, apart).expect("a release");
}

/// Moves the tree until a condition on its angles (degrees) holds; returns the time, or none if
/// it does not within `end` seconds.
fn until(pendulum: &mut Pendulum, end: f64, is_so: impl Fn(&[f64]) -> bool) -> Option<f64> {
    const STEP: f64 = 0.01;
    while pendulum.time() < end {
        pendulum.advance(STEP).expect("it moves");
        let degrees: Vec<f64> = pendulum
            .angles()
            .iter()
            .map(|own| own.to_degrees())
            .collect();
        if is_so(&degrees) {
            return Some(pendulum.time());
        }
    }
    None
}

/// Angles of the root from which the first task releases the arms, degrees.
fn half_degrees(from: f64, to: f64) -> Vec<f64> {
    let steps = (2.0 * (to - from)).round() as u32;
    (0..=steps)
        .map(|step| from + 0.5 * f64::from(step))
        .collect()
}

/// A release of the first task.
#[derive(Debug)]
struct Parting {
    root: f64,
    /// Largest difference between the arms within 12 s, degrees.
    largest: f64,
    /// Time at which an arm turns over, s.
    over: Option<f64>,
}

impl Parting {
    fn of(root: f64, apart: f64) -> Self {
        let mut pendulum = example("paper", &[]);
        release(&mut pendulum, root, 0.0, apart);
        let largest = std::cell::Cell::new(0.0_f64);
        let over = until(&mut pendulum, 12.0, |angles| {
            largest.set(largest.get().max((angles[1] - angles[2]).abs()));
            angles[1..].iter().any(|angle| angle.abs() > 180.0)
        });
        let largest = largest.get();
        Self {
            root,
            largest,
            over,
        }
    }
}

#[test]
fn the_first_task_says_where_the_arms_part() {
    let words = words_of("teachers.html");
    let says = |sentence: String| assert!(words.contains(&sentence), "not on the page: {sentence}");
    let released = |from, to| -> Vec<Parting> {
        let angles = half_degrees(from, to).into_iter();
        angles.map(|root| Parting::of(root, 0.6)).collect()
    };
    let largest = |all: &[Parting]| all.iter().map(|own| own.largest).fold(0.0, f64::max);
    let least = |all: &[Parting]| {
        all.iter()
            .map(|own| own.largest)
            .fold(f64::INFINITY, f64::min)
    };
    let over = |own: &Parting| own.over.expect("an arm turns over");

    let calm = released(39.5, 42.5);
    says(format!(
        "Up to 42.5° the arms stay within {:.0}° of each other",
        largest(&calm).ceil()
    ));
    let band = released(43.0, 44.5);
    says(format!(
        "from 43° to 44.5° they come {:.0}° to {:.0}° apart",
        least(&band),
        largest(&band)
    ));
    let gap = released(45.0, 45.5);
    assert!(largest(&gap) < 10.0 && largest(&calm) < 10.0 && least(&band) > 10.0);
    says("at 45° and 45.5° less than 10°".to_owned());
    let again = Parting::of(46.0, 0.6);
    says(format!("at 46° again {:.0}°", again.largest));
    for own in calm.iter().chain(&band).chain(&gap).chain([&again]) {
        assert_eq!(own.over, None, "{own:?}");
    }
    let first = Parting::of(46.5, 0.6);
    says(format!(
        "At 46.5° one turns over after {:.1} s",
        over(&first)
    ));
    let mut later = released(47.0, 60.0);
    later.push(Parting::of(47.8, 0.6));
    assert!(later.iter().all(|own| over(own) < 5.0), "{later:?}");
    assert!(later.iter().any(|own| over(own) > 4.0), "{later:?}");
    says("and from 47° to 60° within five seconds".to_owned());

    // The starting difference is twice what each arm is turned by.
    let half = Parting::of(43.0, 0.3);
    assert!((half.largest / band[0].largest - 0.5).abs() < 0.05);
    says(format!("half as far apart, {:.1}° at 43°", half.largest));
    for (one, other) in band.iter().map(|own| (own, Parting::of(own.root, 0.3))) {
        assert!(one.largest / 1.2 > 10.0 && other.largest / 0.6 > 10.0);
    }
    for own in &calm {
        assert!(own.largest / 1.2 < 10.0 && Parting::of(own.root, 0.3).largest / 0.6 < 10.0);
    }
}

#[test]
fn the_second_task_says_what_the_area_below_w_is() {
    let words = words_of("teachers.html");
    for sentence in [
        "W changes its sign several times a swing",
        "The area below W is the gain of Hd: without friction nothing else changes it",
    ] {
        assert!(words.contains(sentence), "not on the page: {sentence}");
    }
    const STEP: f64 = 1e-3;
    let mut pendulum = example("paper", &[]);
    release(&mut pendulum, 47.8, 0.0, 0.6);
    let mut now = |duration: f64| {
        pendulum.advance(duration).expect("it moves");
        let budget = pendulum.budget(false).expect("a tree with copies");
        (budget.energies[1], budget.received[1], pendulum.angles()[0])
    };
    let rows: Vec<(f64, f64, f64)> = (0..6000).map(|_| now(STEP)).collect();
    let changes = |of: fn(&(f64, f64, f64)) -> f64| {
        let pairs = rows
            .windows(2)
            .filter(|pair| of(&pair[0]) * of(&pair[1]) < 0.0);
        pairs.count()
    };
    // The root passes the vertical twice a swing.
    let swings = changes(|row| row.2) / 2;
    assert!(swings >= 4 && changes(|row| row.1) >= 3 * swings);
    for two_seconds in rows.chunks_exact(2000) {
        let area: f64 = two_seconds
            .windows(2)
            .map(|pair| 0.5 * STEP * (pair[0].1 + pair[1].1))
            .sum();
        let gain = two_seconds[1999].0 - two_seconds[0].0;
        let largest = two_seconds.iter().map(|row| row.0).fold(0.0, f64::max);
        assert!((area - gain).abs() < 1e-4 * largest, "{area} {gain}");
    }
}

#[test]
fn the_third_task_says_which_branches_part_first() {
    let words = words_of("teachers.html");
    let parted = |ratio: f64, pairs: &[[usize; 2]]| {
        let mut tree = example("three-generations", &[("c", 1e-4), ("r", ratio)]);
        release(&mut tree, 90.0, 30.0, 0.5);
        let is_apart = |angles: &[f64]| {
            let mut pairs = pairs.iter();
            pairs.any(|[one, other]| (angles[*one] - angles[*other]).abs() > 15.0)
        };
        until(&mut tree, 12.0, is_apart).expect("they part")
    };
    // Trunk, limb, its twigs, limb, its twigs.
    let (limbs, twigs) = ([[1, 4]], [[2, 3], [5, 6]]);
    let [early, late] = [0.7, 1.0].map(|ratio| [parted(ratio, &limbs), parted(ratio, &twigs)]);
    let sentence = format!(
        "At r = 0.7 the twigs part after {:.1} s and the limbs after {:.1} s; at r = 1 the limbs after {:.1} s and the \
         twigs after {:.1} s",
        early[1], early[0], late[0], late[1]
    );
    assert!(words.contains(&sentence), "not on the page: {sentence}");
}
