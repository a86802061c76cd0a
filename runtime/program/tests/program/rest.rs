//! Where trees rest, and how far a motion is determined.

use super::Folder;

/// A Y whose tips a spring pushes apart: at rest its arms stand 18° and −13° aside.
const VEE: &str = "gravity = 9.80665,
stem: rod(mass = 0.25, length = 0.28) [
    left: rod(mass = 0.09, length = 0.22),
    right: rod(mass = 0.11, length = 0.25)
], between(left, right, at = each(0.22, 0.25), spring = k, rest = 0.2)";

/// A standing rod: κ θ = m g l/2 sin θ at ±0.71286 rad.
const BUCKLED: &str = "gravity = -9.81, r: rod(mass = 0.4, length = 0.5, spring = 0.9)";

/// The last number with a degree sign in a line that holds a word.
fn degrees(text: &str, word: &str) -> f64 {
    let line = text.lines().find(|line| line.contains(word));
    let line = line.unwrap_or_else(|| panic!("{word}: {text}"));
    let number = line.rsplit_once('°').unwrap().0.rsplit(' ').next().unwrap();
    number.parse().unwrap()
}

#[test]
fn rest_is_below_the_saddle() {
    let folder = Folder::new("rest");
    for (text, set, rest, others) in [
        (VEE, "k=2", "left -18.3331°, right 13.0893°", 2),
        (BUCKLED, "", "rests at r 40.84", 2),
        (
            &BUCKLED.replace("0.9", "1.2")[..],
            "",
            "rests with all angles zero",
            1,
        ),
    ] {
        let tree = folder.file("tree.txt", text);
        let mut words = vec!["describe", "--tree", &tree];
        if !set.is_empty() {
            words.extend(["--set", set]);
        }
        let printed = folder.answer(&words);
        assert!(printed.contains(rest), "{rest}: {printed}");
        let lines = printed.lines().filter(|line| line.contains("rests "));
        assert!(lines.count() >= others, "{printed}");
        assert_eq!(
            printed.contains("unstable equilibrium: "),
            others > 1,
            "{printed}"
        );
        // The same place is that of modes, and of links that are not named.
        words[0] = "modes";
        let modes = folder.answer(&words);
        assert!(!modes.contains("unstable"), "{modes}");
    }
}

/// Frequencies of the first newcomer's Y by an independent Lagrangian, and both sides of the rod.
#[test]
fn modes_are_those_about_a_stable_rest() {
    let folder = Folder::new("rest-modes");
    let tree = folder.file("vee.txt", VEE);
    let printed = folder.answer(&["modes", "--tree", &tree, "--set", "k=2"]);
    for frequency in ["0.84256", "2.00362", "2.14440"] {
        assert!(printed.contains(frequency), "{frequency}: {printed}");
    }
    let rod = folder.file("rod.txt", BUCKLED);
    let of = |start: &str| folder.answer(&["modes", "--tree", &rod, "--start", start]);
    assert!((degrees(&of("10"), "(r ") - 40.844).abs() < 1e-3);
    assert!((degrees(&of("-10"), "(r ") + 40.844).abs() < 1e-3);
    assert!(of("r=-0.5").contains("another stable rest: --start 40.84"));
    let start = folder.answer(&[
        "simulate",
        "--tree",
        &rod,
        "--start",
        "r=40.8442",
        "--duration",
        "1",
    ]);
    assert!(
        (degrees(&start, "r ends at") - 40.844).abs() < 2e-3,
        "{start}"
    );
}

/// Chaos from 10 s on, a rod upside down, and motions that are regular.
#[test]
fn digits_that_are_lost_are_not_printed() {
    let folder = Folder::new("horizon");
    let flip = folder.file(
        "flip.txt",
        "gravity = 9.80665, upper: rod(mass = 0.24, length = 0.31) [
            lower: rod(mass = 0.17, length = 0.26)
        ]",
    );
    let rod = folder.file(
        "rod.txt",
        "gravity = 9.81, rod: rod(mass = 0.2, length = 0.3)",
    );
    let horizon = |text: &str| -> f64 {
        let after = text
            .split_once("NOT DETERMINED from ")
            .unwrap_or_else(|| panic!("{text}"))
            .1;
        after.split(' ').next().unwrap().parse().unwrap()
    };
    for method in ["dop853", "taylor", "verner98", "dopri5"] {
        let words = [
            "--start",
            "120,-120",
            "--duration",
            "60",
            "--method",
            method,
        ];
        let text = folder.answer(&[&["simulate", "--tree", &flip][..], &words].concat());
        let time = horizon(&text);
        assert!((1.5..20.0).contains(&time), "{method} {text}");
        assert!(
            text.contains("lower ends at an angle that is not determined"),
            "{text}"
        );
        assert!(!text.contains("unstable equilibrium"), "{text}");
    }
    let upside_down = |start: &str| {
        folder.answer(&[
            "simulate",
            "--tree",
            &rod,
            "--start",
            start,
            "--duration",
            "20",
        ])
    };
    for start in ["180", "-180", "540"] {
        let text = upside_down(start);
        assert!(
            text.contains("released at rest in an unstable equilibrium"),
            "{text}"
        );
        assert!(text.contains("a factor of e in 0.1"), "{text}");
        assert!((1.0..10.0).contains(&horizon(&text)), "{text}");
    }
    for start in ["10", "20", "30"] {
        let text = upside_down(start);
        assert!(text.contains("agrees to 0.000001° at all times"), "{text}");
    }
    // Nearly upside down an error of one step grows, but the motion is determined.
    for start in ["30", "170", "179"] {
        let text = upside_down(start);
        assert!(!text.contains("unstable equilibrium"), "{text}");
        assert!(!text.contains("NOT DETERMINED"), "{text}");
    }
    // A coarse method is told from chaos by its smaller error.
    let words = [
        "--start",
        "30",
        "--duration",
        "10",
        "--method",
        "rk4",
        "--tolerance",
        "0.01",
    ];
    let text = folder.answer(&[&["simulate", "--tree", &rod][..], &words].concat());
    assert!(
        text.contains("differs by more than 0.000001° from"),
        "{text}"
    );
    let text = folder.answer(&[&["simulate", "--once", "--tree", &flip][..], &words].concat());
    assert!(!text.contains("second run"), "{text}");
}

/// Copies that differ by `each(…)`: why they have no growth of their own, and W in two parts.
#[test]
fn copies_that_differ_have_growth_and_forcing() {
    let folder = Folder::new("unequal");
    let wye = |mass: &str, length: &str| {
        format!(
            "gravity = 9.80665, stem: rod(mass = 0.25, length = 0.28) [
                arm: rod(mass = {mass}, length = {length}, friction = 1e-4) * 2
            ], siblings(arm, at = 0.2, spring = 1)"
        )
    };
    for (mass, length, quantity) in [
        (
            "each(0.09, 0.11)",
            "each(0.22, 0.25)",
            "length 0.22 and 0.25 m",
        ),
        ("0.1", "each(0.22, 0.25)", "length 0.22 and 0.25 m"),
        ("0.1", "each(0.25, 0.22)", "length 0.25 and 0.22 m"),
    ] {
        let tree = folder.file("wye.txt", &wye(mass, length));
        let output = folder.run(&["growth", "--tree", &tree, "--angles", "10,20"]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(
            text.contains("`arm_1` and `arm_2` differ by `each(…)`"),
            "{text}"
        );
        assert!(text.contains(quantity), "{quantity}: {text}");
        let words = ["--tree", &tree, "--start", "40,45,30", "--duration", "2"];
        let text = folder.answer(&[&["simulate"][..], &words].concat());
        assert!(text.contains("its copies differ: W is growth"), "{text}");
        let (names, rows) = folder.table("sectors.csv");
        let column = |name: &str| {
            let place = names
                .iter()
                .position(|own| own.trim_matches('"').starts_with(name));
            place.unwrap_or_else(|| panic!("{name}: {names:?}"))
        };
        let columns = ["W d", "growth d", "forcing d"].map(column);
        let most = rows
            .iter()
            .fold(0.0_f64, |most, row| most.max(row[columns[0]].abs()));
        for row in &rows {
            let [w, growth, forcing] = columns.map(|place| row[place]);
            assert!(
                (w - growth - forcing).abs() < 1e-9 * most,
                "{w} {growth} {forcing}"
            );
        }
        assert!(rows.iter().any(|row| row[columns[2]].abs() > 1e-3 * most));
        let text = folder.answer(&[&["transfer"][..], &words].concat());
        for line in [
            "angle order 1",
            "amplitude order 8",
            "growth: at most",
            "forcing: at most",
        ] {
            assert!(text.contains(line), "{line}: {text}");
        }
    }
    let equal = folder.file("equal.txt", &wye("0.1", "0.25"));
    let text = folder.answer(&["growth", "--tree", &equal, "--angles", "10,20"]);
    assert!(text.contains("G(4 s)"), "{text}");
    let output = folder.run(&["growth", "--tree", &equal, "--start", "0,1,2"]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("the copies do not start in phase"), "{text}");
    let words = [
        "simulate",
        "--tree",
        &equal,
        "--start",
        "40,45,30",
        "--duration",
        "1",
    ];
    assert!(!folder.answer(&words).contains("growth"));
}

#[test]
fn advice_on_a_text_is_a_command_that_runs() {
    let folder = Folder::new("advice-command");
    let rod = folder.file(
        "my rod.txt",
        "gravity = 9.81, R: rod(mass = M, length = .3)",
    );
    for (start, right) in [
        ("30", "angles:1e-6"),
        ("R=100", "energy:1e-6"),
        ("10", "angles:1e-3"),
    ] {
        let tree = ["--tree", &rod, "--set", "M=0.2"];
        let words = ["--start", start, "--duration", "2", "--right", right];
        let text = folder.answer(&[&["advise"][..], &tree, &words].concat());
        assert!(!text.contains("let method"), "{text}");
        let line = text
            .lines()
            .find(|line| line.contains("branched-pendulum simulate"));
        let line = line.unwrap_or_else(|| panic!("{text}")).trim();
        let quoted = format!("--tree '{rod}'");
        assert!(line.contains(&quoted), "{line}");
        let rest = line.replacen(&quoted, "", 1);
        let words: Vec<&str> = rest.split_whitespace().skip(1).collect();
        let words = [&words[..1], &["--tree", &rod], &words[1..]].concat();
        assert!(folder.answer(&words).contains("ends at"), "{words:?}");
    }
}
