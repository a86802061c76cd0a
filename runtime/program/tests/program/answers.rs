//! What the subcommands say of three trees, against other routes to the same numbers.

use std::f64::consts::TAU;

use branched_pendulum::integrate::Method;

use super::{Folder, TRIPLE, UNEQUAL, Y};

/// Energy is kept, and the motion is the same by another method.
#[test]
fn a_chain_of_three_moves() {
    let folder = Folder::new("simulate");
    let triple = folder.file("triple.txt", TRIPLE);
    let words = [
        "simulate",
        "--tree",
        &triple,
        "--start",
        "50,20,-10",
        "--duration",
        "3",
    ];
    folder.answer(&words);
    let (names, rows) = folder.table("motion.csv");
    assert_eq!(names[0], "time [s]");
    let energies = rows.iter().map(|row| row[7] + row[8]);
    let first = rows[0][7] + rows[0][8];
    assert!(first > 0.1);
    assert!(
        energies
            .into_iter()
            .all(|energy| (energy - first).abs() < 1e-8 * first)
    );
    folder.answer(&[&words[..], &["--method", "gauss8", "--tolerance", "2e-3"]].concat());
    let (_, others) = folder.table("motion.csv");
    let (last, other) = (rows.last().unwrap(), others.last().unwrap());
    assert_eq!(last[0], other[0]);
    for (one, other) in last[1..7].iter().zip(&other[1..7]) {
        assert!((one - other).abs() < 1e-6, "{one} {other}");
    }
    // No copies: no sectors.
    assert!(!folder.0.join("results/sectors.csv").exists());
}

/// H_d changes by W and friction, whose integral is taken from the table: of the paper's tree, and with a
/// rubber band between its children.
#[test]
fn differences_have_energies_and_transfers() {
    let folder = Folder::new("sectors");
    let band = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
        ],
        siblings(child, at = 0.06, spring = 5)";
    for tree in ["paper", &folder.file("band.txt", band)] {
        let words = [
            "simulate",
            "--tree",
            tree,
            "--set",
            "friction=2e-5",
            "--duration",
            "2",
        ];
        let start = [
            "--start",
            "parent=40,child_1=3,child_2=-3",
            "--rate",
            "1000",
        ];
        folder.answer(&[&words[..], &start].concat());
        let (names, rows) = folder.table("sectors.csv");
        let column = |name: &str| names.iter().position(|own| own.starts_with(name)).unwrap();
        let (energy, w, power) = (column("energy d"), column("W d"), column("power d"));
        let added: f64 = rows
            .windows(2)
            .map(|pair| {
                let rate = |row: &[f64]| row[w] + row[power];
                0.5 * (pair[1][0] - pair[0][0]) * (rate(&pair[0]) + rate(&pair[1]))
            })
            .sum();
        let gained = rows.last().unwrap()[energy] - rows[0][energy];
        assert!(gained.abs() > 1e-6 && (added - gained).abs() < 1e-3 * gained.abs());
        assert!(rows.iter().any(|row| row[power] < -1e-9));
    }
}

#[test]
fn modes_of_a_tree_that_stands() {
    let folder = Folder::new("modes");
    let y = folder.file("y.txt", Y);
    folder.answer(&["modes", "--tree", &y, "--set", "stiffness=4"]);
    let (names, rows) = folder.table("modes.csv");
    assert_eq!(names.len(), 4);
    // The difference of the arms leaves the stem at rest: J ω² = κ − m g l/2.
    let (mass, length, gravity): (f64, f64, f64) = (0.1, 0.35, 9.80665);
    let stiffness = 4.0 - mass * gravity * length / 2.0;
    let expected = (stiffness / (mass * length * length / 3.0)).sqrt() / TAU;
    let of_difference = |row: &&Vec<f64>| row[1].abs() < 1e-9;
    let found = rows.iter().find(of_difference).unwrap();
    assert!((found[0] - expected).abs() < 1e-4 * expected);
    assert!((found[2] + found[3]).abs() < 1e-9);
}

/// Against each other the pendulums leave the bar at rest: ω² = g/l + 2 κ/(m l²). Alike they are
/// one of twice the mass under it, a double pendulum, whatever the spring.
#[test]
fn modes_of_two_pendulums_that_a_spring_couples() {
    let folder = Folder::new("coupled");
    let (gravity, length, bar_length, mass): (f64, f64, f64, f64) = (9.80665, 0.25, 0.1, 0.1);
    for (bar_mass, coupling) in [(10.0, 0.01), (0.3, 0.08), (1e6, 0.02)] {
        let set = format!("bar_mass={bar_mass},coupling={coupling}");
        folder.answer(&["modes", "--tree", "coupled", "--set", &set]);
        let (_, rows) = folder.table("modes.csv");
        let frequency = |square: f64| square.sqrt() / TAU;
        let apart = gravity / length + 2.0 * coupling / (mass * length * length);
        // (A C − B²) ω⁴ − (K_A C + K_C A) ω² + K_A K_C = 0.
        let pair = 2.0 * mass;
        let a = (bar_mass / 3.0 + pair) * bar_length * bar_length;
        let (b, c) = (pair * bar_length * length, pair * length * length);
        let of_bar = (bar_mass / 2.0 + pair) * gravity * bar_length;
        let of_pair = pair * gravity * length;
        let (square, linear) = (a * c - b * b, of_bar * c + of_pair * a);
        let root = (linear * linear - 4.0 * square * of_bar * of_pair).sqrt();
        let alike = [linear - root, linear + root].map(|sum| frequency(sum / (2.0 * square)));
        let is_apart = |row: &&Vec<f64>| row[2] * row[3] < 0.0;
        let (own, others): (Vec<&Vec<f64>>, Vec<_>) = rows.iter().partition(is_apart);
        assert_eq!((own.len(), others.len()), (1, 2), "{set}: {rows:?}");
        assert!((own[0][0] / frequency(apart) - 1.0).abs() < 1e-9, "{set}");
        assert!(
            (own[0][2] / own[0][3] + 1.0).abs() < 1e-6 && own[0][1].abs() < 1e-9,
            "{set}"
        );
        for (row, expected) in others.iter().zip(alike) {
            assert!((row[0] / expected - 1.0).abs() < 1e-9, "{set}: {row:?}");
            assert!((row[2] / row[3] - 1.0).abs() < 1e-6, "{set}: {row:?}");
        }
    }
}

/// From a tenth of a degree on nothing grows; from the paper's 48° on a lot does.
#[test]
fn growth_begins_where_the_paper_sees_it() {
    let folder = Folder::new("growth");
    let words = ["growth", "--angles", "30,48", "--horizons", "10"];
    let text = folder.answer(&[&words[..], &["--vary", "friction=0,1e-4"]].concat());
    assert!(text.contains("G(10 s) ≥ 10         48°"), "{text}");
    let (names, rows) = folder.table("growth.csv");
    let factor = names
        .iter()
        .position(|name| name.starts_with("growth factor within 10 s"));
    let factors: Vec<f64> = rows.iter().map(|row| row[factor.unwrap()]).collect();
    assert!(factors[0] < 2.0 && factors[1] > 1e3, "{factors:?}");
    // Friction keeps it smaller.
    assert!(factors[3] < 0.5 * factors[1], "{factors:?}");
}

#[test]
fn a_map_has_a_row_for_each_point() {
    let folder = Folder::new("map");
    let y = folder.file("y.txt", Y);
    let words = [
        "map",
        "--tree",
        &y,
        "--set",
        "stiffness=4",
        "--duration",
        "2",
    ];
    let axes = [
        "--x",
        "stiffness=3:5:1",
        "--y",
        "stem=0:20:10",
        "--start",
        "arm=0",
    ];
    let text = folder.answer(&[&words[..], &axes].concat());
    assert!(text.contains("9 points"), "{text}");
    let (_, rows) = folder.table("map.csv");
    assert_eq!(rows.len(), 9);
    assert_eq!((rows[1][0], rows[8][1]), (4.0, 20.0));
    assert!(folder.read("results/map.svg").contains("stiffness"));
}

/// Each order of the amplitude is better than the one before.
#[test]
fn orders_come_nearer_to_the_exact_transfer() {
    let folder = Folder::new("transfer");
    let y = folder.file("y.txt", Y);
    let words = [
        "transfer",
        "--tree",
        &y,
        "--set",
        "stiffness=4",
        "--duration",
        "1",
    ];
    folder.answer(&[&words[..], &["--start", "stem=20,arm_1=12,arm_2=2"]].concat());
    let (names, rows) = folder.table("transfer.csv");
    let of = |form: &str| {
        let place = |part: &str| {
            names
                .iter()
                .position(|name| name.starts_with(&format!("{part} {form}")))
        };
        let (kinetic, potential) = (place("W_K").unwrap(), place("W_P").unwrap());
        rows.iter()
            .map(move |row| row[kinetic] + row[potential])
            .collect::<Vec<f64>>()
    };
    let exact = of("exact");
    let error = |form: &str| {
        let both = of(form).into_iter().zip(&exact);
        both.fold(0.0_f64, |most, (w, exact)| most.max((w - exact).abs()))
    };
    let errors = [
        "amplitude order 2",
        "amplitude order 4",
        "amplitude order 6",
    ]
    .map(error);
    assert!(exact.iter().any(|w| w.abs() > 1e-4));
    assert!(
        errors[1] < 0.2 * errors[0] && errors[2] < 0.2 * errors[1],
        "{errors:?}"
    );
}

#[test]
fn dry_friction_takes_energy_and_methods_are_compared() {
    let folder = Folder::new("friction");
    let unequal = folder.file("unequal.txt", UNEQUAL);
    let text = folder.answer(&[
        "simulate",
        "--tree",
        &unequal,
        "--start",
        "40",
        "--duration",
        "2",
    ]);
    assert!(text.contains("J at the start"), "{text}");
    let (_, rows) = folder.table("motion.csv");
    let energy = |row: &[f64]| row[9] + row[10];
    let (first, last) = (energy(&rows[0]), energy(rows.last().unwrap()));
    let lost: f64 = rows
        .windows(2)
        .map(|pair| 0.005 * (pair[0][11] + pair[1][11]))
        .sum();
    assert!(
        lost < -0.005 && (last - first - lost).abs() < 1e-3 * lost.abs(),
        "{lost}"
    );
    folder.answer(&[
        "methods",
        "--tree",
        &unequal,
        "--start",
        "20",
        "--duration",
        "0.2",
    ]);
    let table = folder.read("results/methods.csv");
    assert!(table.contains("Dormand–Prince 8(5,3)") && table.lines().count() > 40);
    assert!(table.contains(Method::Taylor.title()), "{table}");
}

#[test]
fn taylor_series_go_where_runge_kutta_methods_go() {
    let folder = Folder::new("taylor");
    let triple = folder.file("triple.txt", TRIPLE);
    let [one, other] = ["taylor", "verner98"].map(|method| {
        let words = [
            "simulate",
            "--tree",
            &triple,
            "--start",
            "20",
            "--duration",
            "2",
        ];
        folder.answer(&[&words[..], &["--method", method, "--tolerance", "1e-13"]].concat());
        folder.table("motion.csv").1
    });
    assert_eq!(one.len(), other.len());
    let values = one.iter().flatten().zip(other.iter().flatten());
    let worst = values.fold(0.0_f64, |worst, (one, other)| {
        worst.max((one - other).abs())
    });
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn advice_is_right() {
    let folder = Folder::new("advise");
    let triple = folder.file("triple.txt", TRIPLE);
    let words = [
        "advise",
        "--tree",
        &triple,
        "--start",
        "20",
        "--duration",
        "1",
    ];
    let text = folder.answer(&[&words[..], &["--right", "angles:1e-4,energy:1e-5"]].concat());
    assert!(text.contains("full"), "{text}");
    let record = folder.read("results/run.json");
    let (_, ratio) = record.split_once("\"error over tolerance\": ").unwrap();
    let ratio: f64 = ratio
        .split([',', '\n'])
        .next()
        .unwrap()
        .trim()
        .parse()
        .unwrap();
    assert!(ratio <= 1.0, "{ratio}");
}
