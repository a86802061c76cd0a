//! Texts: messages with their places, and any text at all.

use std::time::{Duration, Instant};

use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

fn message(text: &str) -> String {
    PendulumTree::parse(text).unwrap_err().to_string()
}

#[test]
fn mistakes_are_marked_in_the_text() {
    let text = "gravity = 9.81,
upper: rod(mass = 0.2, length = 0.3) [
    lower: rod(mas = 0.1, length = 0.2),
]";
    let expected = "error: a `rod` has no property `mas`
 --> 3:16
  |
3 |     lower: rod(mas = 0.1, length = 0.2),
  |                ^^^ unknown property
help: did you mean `mass`?";
    let found = message(text);
    assert_eq!(found, expected);
    let TreeError::Description(error) = PendulumTree::parse(text).unwrap_err() else {
        panic!("{found}");
    };
    let places = error.mistakes().iter().map(|at| (at.line, at.column));
    assert_eq!(places.collect::<Vec<_>>()[0], (3, 16));
}

#[test]
fn what_is_derived_for_one_tree_is_refused_where_it_stands() {
    let tree = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2], ";
    let text = format!("{tree}emit(transverse)");
    let found = message(&text);
    assert!(found.contains("at run time"), "{found}");
    let column = text.find("transverse").unwrap() + 1;
    assert!(found.contains(&format!("--> 1:{column}\n")), "{found}");
    let always = format!("{tree}emit(energies, momenta, modes, positions, forces, taylor)");
    assert!(PendulumTree::parse(&always).is_ok());
    let of_copies = format!("{tree}emit(symmetric, transfer(exact), budget(parseval))");
    assert!(PendulumTree::parse(&of_copies).is_ok());
    let alone = "gravity = 9.81, a: rod(mass = 1, length = 1), emit(transfer(exact))";
    assert!(message(alone).contains("identical"), "{}", message(alone));
    assert!(message(&format!("{tree}emit(energy)")).contains("did you mean `energies`?"));
}

#[test]
fn texts_that_are_no_tokens_or_too_much_are_refused() {
    for text in [
        "gravity = \"",
        "a [",
        "gravity = 9.81 )",
        "'",
        "\u{7f}",
        "/*",
    ] {
        assert!(message(text).starts_with("error: "), "{text}");
    }
    assert!(message("").contains("gravity"));
    assert!(message(&"[".repeat(100_000)).starts_with("error: "));
    let deep = format!("{}{}", "(".repeat(100_000), ")".repeat(100_000));
    let found = message(&deep);
    assert!(found.starts_with("error: brackets are nested more than 64 levels deep"));
    assert!(found.len() < 1000, "{}", found.len());
    let wrong = message(&"a = 1, ".repeat(100_000));
    assert!(wrong.ends_with("more errors") && wrong.len() < 100_000);
    assert!(message(&" ".repeat(2 << 20)).contains("bytes"));
    let many = "gravity = 1, tree: generations(count = 17, branching = 2, shape = rod, mass = 1, length = 1)";
    assert!(message(many).contains("more than 65536 links"));
    let many = "gravity = 1, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 4096]";
    assert!(message(many).contains("more than 4096 links"));
    let page = include_str!("../../../../docs/limits.md");
    for limit in [
        "| 65,536 links | trees by rule that are",
        "| 4,096 links | all other trees",
    ] {
        assert!(page.contains(limit), "{limit}");
    }
}

/// Cost of a large tree, and that it is right at all.
#[test]
fn a_tree_of_many_links_is_computed() {
    let tree = PendulumTree::parse(
        "gravity = 9.81, tree: generations(count = 14, branching = 2, shape = rod, mass = 1,
            length = 1, mass_ratio = 0.5, length_ratio = 0.8)",
    )
    .unwrap();
    assert_eq!(tree.links(), (1 << 14) - 1);
    let alpha = tree.accelerations(0.0, &vec![0.0; tree.links()], &vec![1.0; tree.links()]);
    // All hang straight and turn alike.
    assert!(alpha.iter().all(|alpha| alpha.abs() < 1e-9));
}

const SEEDS: [&str; 5] = [
    "gravity = 9.80665, parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 2e-5) * 2
    ], emit(energies, momenta, modes)",
    "gravity = g, arm: rod(mass = m, length = l / 2 + 0.1) [
        hand: disc(mass = 2 * m^2, length = l, radius = -(-0.1)^1, at = (l, 0.02)) [
            finger: point(mass = 0.1, length = 0.2),
        ] * 3,
        weight: plate(mass = 1, length = 0.3, width = 0.1, margin = 0.01, at = 0.1),
    ]",
    "gravity = 1, tree: generations(count = 3, branching = 2, shape = rod_with_bob, mass = 0.12,
        bob_mass = 0.1, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7)",
    "gravity = 9.8, rod: rod(mass = 1, length = 1, spring = 0.1, rest = 0.2),
        drive(torque = a * cos(w * t + p) + 0.1, x = b * t^2 / 2, y = -sin(2 * w * t) / w)",
    "gravity = 9.8, code = loops, a: rod(mass = 1, length = 1) [
        b(mass = each(left, 0.2), com = each(0.1, (0.1, 0.02)), inertia = each(1e-3, 2e-3)) * 2
    ], in_phase(b), locked(a, 0.1), parameters(left)",
];

const PIECES: [&str; 36] = [
    "0",
    "1e300",
    "1e-300",
    "99999999999999999999",
    "1e99999",
    "-",
    "^",
    "^99",
    "^-99",
    "(",
    ")",
    "[",
    "]",
    "*",
    "* 1000",
    "/",
    "/ 0",
    ",",
    ":",
    "=",
    "\"",
    "'",
    "é",
    "\u{0}",
    "r#type",
    "t",
    "gravity",
    "mass",
    "at = (1, 2)",
    "generations(count = 9, branching = 3)",
    "each(1, 2)",
    "emit(transfer)",
    "sin(t)",
    "\\",
    "//",
    "/*",
];

pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, end: usize) -> usize {
        // xorshift64*
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % end.max(1)
    }
}

fn mutated(random: &mut Random) -> String {
    let mut letters: Vec<char> = SEEDS[random.below(SEEDS.len())].chars().collect();
    for _ in 0..=random.below(4) {
        let start = random.below(letters.len());
        let end = (start + random.below(12)).min(letters.len());
        match random.below(4) {
            0 => drop(letters.drain(start..end)),
            1 => {
                let piece = PIECES[random.below(PIECES.len())].chars();
                drop(letters.splice(start..start, piece));
            }
            2 => {
                let copy = letters[start..end].to_vec();
                let place = random.below(letters.len());
                drop(letters.splice(place..place, copy));
            }
            _ => letters[start] = char::from(b' ' + random.below(95) as u8),
        }
        if letters.is_empty() {
            break;
        }
    }
    letters.into_iter().collect()
}

/// Reads mutated texts: each gives a tree that can be computed or a message with a place.
fn read(count: usize, seed: u64) {
    let mut random = Random(seed);
    let (mut right, mut longest) = (0, Duration::ZERO);
    for number in 0..count {
        let text = mutated(&mut random);
        let start = Instant::now();
        match TreeDescription::parse(&text) {
            Ok(description) => {
                right += 1;
                let names: Vec<String> = description.parameters().map(str::to_owned).collect();
                let values: Vec<(&str, f64)> = names.iter().map(|name| (&**name, 0.3)).collect();
                match description.tree::<f64>(&values) {
                    Ok(tree) => {
                        let angles = vec![0.1; tree.links()];
                        let alpha = tree.accelerations(0.2, &angles, &angles);
                        assert_eq!(alpha.len(), tree.links());
                    }
                    Err(error) => assert!(!error.to_string().is_empty()),
                }
            }
            Err(error) => {
                let lines = text.lines().count().max(1);
                assert!(!error.mistakes().is_empty(), "{number}: {text}");
                for mistake in error.mistakes() {
                    assert!((1..=lines + 1).contains(&mistake.line), "{number}: {text}");
                    assert!(!mistake.help.is_empty(), "{number}: {text}");
                }
            }
        }
        longest = longest.max(start.elapsed());
    }
    println!("{right} of {count} right, longest {longest:?}");
    assert!(right > count / 50 && right < count / 2);
    // Beside other processes; alone some milliseconds.
    assert!(longest < Duration::from_secs(20));
}

#[test]
fn mutated_texts_give_trees_or_messages() {
    read(2_000, 1);
}

#[test]
#[ignore = "takes a minute"]
fn many_mutated_texts_give_trees_or_messages() {
    read(100_000, 2);
}

/// No code is written for trees at run time: their names are free.
#[test]
fn names_are_those_of_physicists() {
    let text = "gravity = g,
        Upper(mass = M, com = .084, inertia = I_2, joint = L) [
            theBob: point(mass = m_Bob, length = .5e-1, spring = κ) * 2
        ]";
    let description = TreeDescription::parse(text).unwrap();
    let names: Vec<&str> = description.parameters().collect();
    for name in ["g", "L", "M", "I_2", "κ", "m_Bob"] {
        assert!(names.contains(&name), "{name} {names:?}");
    }
    let values = [
        ("g", 9.81),
        ("L", 0.3),
        ("M", 0.2),
        ("I_2", 1e-3),
        ("κ", 0.1),
        ("m_Bob", 0.05),
    ];
    let tree = description.tree::<f64>(&values).unwrap();
    assert_eq!(tree.names(), ["Upper", "theBob_1", "theBob_2"]);
    let small = text.to_lowercase().replace('κ', "k");
    let values = values.map(|(name, value)| (name.to_lowercase().replace('κ', "k"), value));
    let values: Vec<(&str, f64)> = values.iter().map(|(name, x)| (name.as_str(), *x)).collect();
    let other = TreeDescription::parse(&small)
        .unwrap()
        .tree::<f64>(&values)
        .unwrap();
    let state = [[0.3, -0.2, 1.0], [2.0, 0.1, -0.4]];
    assert_eq!(
        tree.accelerations(0.0, &state[0], &state[1]),
        other.accelerations(0.0, &state[0], &state[1])
    );
    // Words of the grammar and of Rust, and names without a letter, are none.
    for name in ["drive", "emit", "type", "_", "__"] {
        let text = format!("gravity = 9.81, rod: rod(mass = {name}, length = 1)");
        let error = TreeDescription::parse(&text).unwrap_err();
        assert!(error.to_string().contains(name), "{error}");
    }
}

#[test]
fn numbers_may_begin_with_their_point() {
    let mass = |number: &str| {
        let text = format!("gravity = 9.81, a: rod(mass = {number}, length = (.25 + 3 * .25))");
        let tree = PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{error}"));
        tree.properties_of(0).unwrap().mass
    };
    for (number, value) in [
        (".1", 0.1),
        (".25", 0.25),
        ("1.5e-1", 0.15),
        (".5e-1", 0.05),
        ("2 * .1", 0.2),
        ("-(-.3)", 0.3),
        ("1. / .5", 2.0),
        (".5^2", 0.25),
    ] {
        assert_eq!(mass(number), value, "{number}");
    }
    for number in ["..1", ".", ".1.2", ". x", ".1x"] {
        let text = format!("gravity = 9.81, a: rod(mass = {number}, length = 1)");
        assert!(PendulumTree::parse(&text).is_err(), "{number}");
    }
}

#[test]
fn the_name_of_a_file_is_recognised() {
    for name in [
        "swing.txt",
        "trees/my swing",
        r"C:\trees\swing.txt",
        "./a.tree",
        " y.dat ",
    ] {
        let error = PendulumTree::parse(name).unwrap_err().to_string();
        assert!(error.contains("looks like the name of a file"), "{error}");
        assert!(error.contains("help: pass the text in the file"), "{error}");
    }
    for text in [
        "rod",
        "gravity = 9.81",
        "rod(mass = 1.5)",
        "0.5",
        "",
        "a / b = 1",
    ] {
        let error = PendulumTree::parse(text).unwrap_err().to_string();
        assert!(!error.contains("file"), "{error}");
    }
}
