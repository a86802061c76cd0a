//! What the page asks for, on this machine.

use branched_pendulum_web::{Pendulum, methods, parameters, with_branch, without_branch};

const PAPER: &str = "gravity = g,
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = m, com = 0.043, inertia = 0.516e-3) * 2
]";

fn paper() -> Pendulum {
    let names = ["g", "m"].map(str::to_owned).to_vec();
    Pendulum::new(PAPER, names, vec![9.80665, 0.10531]).expect("it is a tree")
}

#[test]
fn every_method_keeps_the_energy_as_its_setting_lets_it() {
    for method in methods() {
        let setting = if method.adaptive { 1e-9 } else { 1e-3 };
        let mut pendulum = paper();
        pendulum
            .set_method(&method.name, setting)
            .expect("it is a method");
        pendulum.release(1.0, 0.0, 0.01).expect("it is a release");
        for _ in 0..300 {
            pendulum.advance(1.0 / 60.0).expect("it moves");
        }
        let error = pendulum.energy_error().abs();
        assert!(error > 0.0 && error < 1e-4, "{}: {error}", method.name);
        assert!((pendulum.time() - 5.0).abs() < 1e-12);
    }
    let mut pendulum = paper();
    assert!(
        pendulum
            .set_method("euler", 0.1)
            .unwrap_err()
            .contains("rk4")
    );
    assert!(pendulum.set_method("rk4", 0.0).is_err());
    pendulum
        .release(1.0, 0.0, 0.01)
        .expect("the method is the one before");
    pendulum.advance(0.1).expect("it moves");
}

#[test]
fn the_account_knows_the_work_of_friction_and_of_the_hand() {
    let text = "gravity = 9.81, arm: rod(mass = 0.2, length = 0.4, friction = c) [
        hand: rod(mass = 0.1, length = 0.3, friction = c) * 2
    ]";
    let mut pendulum = Pendulum::new(text, vec!["c".to_owned()], vec![1e-3]).expect("a tree");
    pendulum.set_method("dop853", 1e-10).expect("a method");
    pendulum.release(0.8, 0.2, 0.1).expect("a release");
    let start = pendulum.energy();
    pendulum.advance(1.0).expect("it moves");
    assert!(pendulum.energy() < 0.999 * start);
    assert!(pendulum.energy_error().abs() < 1e-8);
    pendulum.grab(1, 0.3, -0.2);
    for step in 0..60 {
        pendulum.pull(0.3, -0.2 + 0.005 * f64::from(step));
        pendulum.advance(1.0 / 60.0).expect("it moves");
    }
    assert_eq!(pendulum.hand().len(), 4);
    // The powers on the scales are all that changes the energy.
    let budget = pendulum.budget(true).expect("a tree with copies");
    let (received, power): (f64, f64) = (budget.received.iter().sum(), budget.powers.iter().sum());
    assert!(received.abs() < 1e-12);
    let before = pendulum.energy();
    pendulum.advance(1e-6).expect("it moves");
    let rate = (pendulum.energy() - before) / 1e-6;
    assert!((rate - power).abs() < 1e-3 * power.abs(), "{rate} {power}");
    pendulum.let_go();
    assert!(pendulum.hand().is_empty());
    assert!(pendulum.energy_error().abs() < 1e-7);
}

#[test]
fn a_hand_draws_the_point_that_it_holds() {
    let mut pendulum = paper();
    // A point of the parent, between its ends.
    pendulum.grab(0, 0.0, -0.2);
    pendulum.set_parameter("g", 0.0).expect("a value");
    pendulum.pull(0.2, 0.0);
    for _ in 0..6000 {
        pendulum.advance(1.0 / 60.0).expect("it moves");
    }
    let hand = pendulum.hand();
    assert!(
        (hand[0] - 0.2).abs() < 1e-3 && hand[1].abs() < 1e-3,
        "{hand:?}"
    );
}

#[test]
fn a_change_keeps_the_motion() {
    let mut pendulum = paper();
    pendulum.release(0.9, 0.1, 0.05).expect("a release");
    pendulum.advance(0.7).expect("it moves");
    let angles = pendulum.angles();
    pendulum.set_parameter("m", 0.3).expect("a mass");
    assert_eq!(pendulum.angles(), angles);
    let error = pendulum.set_parameter("m", -1.0).unwrap_err();
    assert!(error.contains("not negative"), "{error}");

    let more = with_branch(PAPER, "parent").expect("a branch more");
    let names = ["g", "m"].map(str::to_owned).to_vec();
    let mut larger = Pendulum::new(&more, names, vec![9.8, 0.1]).expect("a tree");
    larger.take_up(&pendulum).expect("a state");
    assert_eq!(larger.angles()[..3], angles[..]);
    assert_eq!(larger.time(), 0.7);
}

#[test]
fn branches_come_and_go() {
    let three = with_branch(PAPER, "parent").expect("a branch more");
    assert_eq!(three, PAPER.replace("* 2", "* 3"));
    assert_eq!(
        without_branch(&three, "child_3").expect("a branch less"),
        PAPER
    );
    let one = without_branch(PAPER, "child_2").expect("a branch less");
    assert_eq!(one, PAPER.replace(" * 2", ""));
    assert_eq!(with_branch(&one, "parent").expect("a branch more"), PAPER);
    assert!(
        !without_branch(&one, "child")
            .expect("a branch less")
            .contains("child")
    );
    assert!(without_branch(PAPER, "parent").is_err());

    let text = "gravity = 9.81, arm: rod(mass = 1, length = 1) [a: rod(mass = 1, length = 2), b: \
        rod(mass = 1, length = 3) * 2]";
    let more = with_branch(text, "b_2").expect("a branch more");
    assert!(more.contains("b: rod(mass = 1, length = 3) [b_twig: rod(mass = 1, length = 3)] * 2"));
    let names = Pendulum::new(&more, vec![], vec![])
        .expect("a tree")
        .names();
    assert_eq!(names, ["arm", "a", "b_1", "b_twig_1", "b_2", "b_twig_2"]);
    // From the name in the tree back to that in the text.
    let back = without_branch(&more, "b_twig_2").expect("a branch less");
    assert_eq!(back, text);
    let less = without_branch(text, "a").expect("a branch less");
    assert_eq!(
        Pendulum::new(&less, vec![], vec![])
            .expect("a tree")
            .names()
            .len(),
        3
    );
    assert!(with_branch("gravity = 1, t: generations(count = 2)", "t_1").is_err());
}

#[test]
fn mistakes_are_marked_and_parameters_explained() {
    let error = parameters("gravity = g, arm: rod(mas = 0.1, length = l)").unwrap_err();
    assert!(
        error.contains("^^^") && error.contains("did you mean `mass`?"),
        "{error}"
    );
    let known = parameters(PAPER).expect("a description");
    assert_eq!(known[0].meaning, "gravity, m/s²");
    assert_eq!(known[1].name, "m");
    assert!(
        Pendulum::new(PAPER, vec![], vec![])
            .unwrap_err()
            .contains("no value for `g`, `m`")
    );
}

#[test]
fn the_map_knows_the_threshold() {
    let pendulum = paper();
    assert!(pendulum.has_copies());
    let map = pendulum
        .release_map(10.0, 1e-7)
        .expect("a tree with two equal branches");
    let rate = |degrees: f64| map.rate(degrees.to_radians(), 0.0);
    assert!(rate(30.0)[0] < 0.1, "{:?}", rate(30.0));
    assert!(
        rate(44.0)[0] > 0.3 && rate(44.0)[1] < 0.01,
        "{:?}",
        rate(44.0)
    );
    let chain = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1)]";
    let chain = Pendulum::new(chain, vec![], vec![]).expect("a tree");
    assert!(!chain.has_copies() && chain.release_map(10.0, 1e-7).is_err());
    assert_eq!(chain.parents(), [-1, 0]);
    assert!((chain.reach() - 2.0).abs() < 1e-15);
}

/// Three generations, three twigs on each limb.
fn nested() -> Pendulum {
    let text = "gravity = 9.81, trunk: rod(mass = 0.1, length = 0.3, friction = 1e-4) [
        limb: rod(mass = 0.07, length = 0.2, friction = 1e-4) [
            twig: rod(mass = 0.05, length = 0.15) * 3
        ] * 2
    ]";
    Pendulum::new(text, vec![], vec![]).expect("a tree")
}

#[test]
fn a_release_sets_every_branching_apart() {
    let mut pendulum = paper();
    pendulum.release(0.8, 0.1, 0.02).expect("a release");
    let angles = pendulum.angles();
    for (angle, expected) in angles.iter().zip([0.8, 0.12, 0.08]) {
        assert!((angle - expected).abs() < 1e-15, "{angles:?}");
    }
    let mut pendulum = nested();
    pendulum.release(0.8, 0.1, 0.02).expect("a release");
    let budget = pendulum.budget(true).expect("a tree with copies");
    assert_eq!(budget.energies.len(), 3);
    assert!(
        budget.energies.iter().all(|&energy| energy > 0.0),
        "{budget:?}"
    );
    // Two that are equal without being written as copies.
    let text = "gravity = 9.81, a: rod(mass = 1, length = 1) [
        b: rod(mass = 1, length = 1), c: rod(mass = 1, length = 1)
    ]";
    let mut pair = Pendulum::new(text, vec![], vec![]).expect("a tree");
    pair.release(0.8, 0.1, 0.02).expect("a release");
    let angles = pair.angles();
    assert!((angles[1] - angles[2] - 0.04).abs() < 1e-15, "{angles:?}");
    assert!(pair.budget(true).is_none() && pair.ghost().is_empty());
}

#[test]
fn the_budgets_close() {
    let mut pendulum = nested();
    pendulum.set_method("dop853", 1e-12).expect("a method");
    pendulum.release(0.9, 0.3, 0.1).expect("a release");
    pendulum.advance(0.8).expect("it moves");
    for by_parseval in [true, false] {
        let mut at = |duration: f64| {
            pendulum.advance(duration).expect("it moves");
            pendulum.budget(by_parseval).expect("a tree with copies")
        };
        let step = 1e-4;
        let [before, now, after] = [at(step), at(step), at(step)];
        for scale in 0..3 {
            let rate = (after.energies[scale] - before.energies[scale]) / (2.0 * step);
            let reported = now.received[scale] + now.powers[scale];
            let error = (rate - reported).abs();
            assert!(error < 1e-4 * reported.abs(), "scale {scale}: {rate} {reported}");
        }
    }
    // By Parseval the scales have all of the energy.
    let budget = pendulum.budget(true).expect("a tree with copies");
    let (sum, energy) = (budget.energies.iter().sum::<f64>(), pendulum.energy());
    assert!((sum / energy - 1.0).abs() < 1e-12, "{sum} {energy}");
}

#[test]
fn copies_that_differ_have_a_budget() {
    let text = PAPER.replace("0.516e-3) * 2", "each(0.516e-3, 0.5e-3)) * 2");
    let names = ["g", "m"].map(str::to_owned).to_vec();
    let mut pendulum = Pendulum::new(&text, names, vec![9.8, 0.1]).expect("a tree");
    assert!(pendulum.has_unequal_copies() && !paper().has_unequal_copies());
    pendulum.release(0.8, 0.1, 0.0).expect("a release");
    pendulum.advance(0.5).expect("it moves");
    let budget = pendulum.budget(false).expect("a tree with copies");
    assert!(
        budget.energies[1] > 0.0 && budget.received[1] != 0.0,
        "{budget:?}"
    );
}

#[test]
fn springs_that_couple_sectors_are_the_reason_of_no_budget() {
    let text = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2]";
    let tree = |text: &str| Pendulum::new(text, vec![], vec![]).expect("a tree");
    let mut coupled = tree(&format!("{text}, between(a, b_1, spring = 0.2)"));
    assert!(coupled.budget(false).is_none());
    let reason = coupled.refused_energies().expect("a reason");
    assert!(
        reason.contains("`siblings(NODE, spring = ...)`"),
        "{reason}"
    );
    let equal = tree(&format!("{text}, siblings(b, spring = 0.2)"));
    assert_eq!(equal.refused_energies(), None);
    // The page has words of its own for a tree without copies.
    let rod = tree("gravity = 9.81, a: rod(mass = 1, length = 1)");
    assert_eq!(rod.refused_energies(), None);
}

#[test]
fn the_ghost_is_the_motion_in_phase() {
    let mut pendulum = paper();
    pendulum.release(0.0, 0.3, 0.2).expect("a release");
    let ghost = pendulum.ghost();
    let ends: Vec<&[f64]> = ghost.chunks(4).map(|link| &link[2..]).collect();
    // Children are drawn to their centre: they have no joint.
    let expected = [0.043 * 0.3_f64.sin(), -0.27 - 0.043 * 0.3_f64.cos()];
    assert_eq!(ends.len(), 3);
    for (end, expected) in ends[1].iter().zip(expected) {
        assert!((end - expected).abs() < 1e-12, "{end}");
    }
    assert_eq!(ends[1], ends[2]);
    // A turn of one child against the other is no difference.
    let turn = std::f64::consts::PI;
    pendulum
        .release(0.0, 0.3 + turn, turn + 0.2)
        .expect("a release");
    for (again, before) in pendulum.ghost().iter().zip(ghost) {
        assert!((again - before).abs() < 1e-12, "{again} {before}");
    }
}

#[test]
fn bodies_are_cut_from_one_sheet() {
    let text = "gravity = 9.81, a: rod(mass = 0.2, length = 0.4) [
        b: rod(mass = 0.1, length = 0.1), c: point(mass = 0.05, length = 0.2)
    ]";
    let pendulum = Pendulum::new(text, vec![], vec![]).expect("a tree");
    let [a, b, c]: [[f64; 2]; 3] = pendulum
        .widths_and_radii()
        .as_chunks()
        .0
        .try_into()
        .expect("three links");
    let area = [0.4 * a[0], 0.1 * b[0], std::f64::consts::PI * c[1] * c[1]];
    for (area, mass) in area.iter().zip([0.2, 0.1, 0.05]) {
        assert!(
            (area / mass / (area_of(&a) / 0.2) - 1.0).abs() < 1e-12,
            "{area}"
        );
    }
    assert_eq!([a[1], b[1], c[0]], [0.0; 3]);
    assert!((b[0] - 0.4 * 0.1).abs() < 1e-12);
    let long = "gravity = 9.81, a: rod(mass = 0.2, length = 0.4)";
    let long = Pendulum::new(long, vec![], vec![]).expect("a tree");
    assert!((long.widths_and_radii()[0] - 0.11 * 0.4).abs() < 1e-12);
}

fn area_of(rod: &[f64; 2]) -> f64 {
    0.4 * rod[0]
}
