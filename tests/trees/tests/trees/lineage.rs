//! Trees with one open branching of each generation, against the full trees of which they are
//! motions.

use branched_pendulum::ScaleBudget;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Dual, Lanes};
use branched_pendulum_trees::PendulumTree;

/// Six generations with all that links can have; `open` is `open = 1,` or nothing.
fn tree(gravity: f64, open: &str) -> PendulumTree {
    tree_with(gravity, open, "friction(viscous = 1e-4, coulomb = 1e-3)")
}

fn tree_with(gravity: f64, open: &str, friction: &str) -> PendulumTree {
    let text = format!(
        "gravity = {gravity},
        arm: generations(count = 6, branching = 2, {open} shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7, com = (0.14, 0.02), joint = (0.3, 0.01),
            {friction}, friction_ratio = 0.3, drag = 1e-5,
            spring = 0.01, rest = 0.1, spring_ratio = 0.4),
        siblings(arm_3, spring = 0.02), siblings(arm_6, friction = 1e-5),
        drive(torque = 0.3 * cos(3 * t), x = 0.01 * sin(2 * t), y = 0.02 * cos(t))"
    );
    PendulumTree::parse(&text).unwrap()
}

/// Returns for each link of the full tree its representative: the link of the lineage whose name
/// ends with the numbers of the copies up to the first that is not on the open path.
fn representatives(full: &PendulumTree, lineage: &PendulumTree) -> Vec<usize> {
    let names = full.names().iter().map(|name| {
        // Behind the generation, as in `arm_3_1_2`.
        let stem = "arm_3".len();
        let closed = name[stem..]
            .find("_2")
            .map(|first| &name[..stem + first + 2]);
        let own = closed.unwrap_or(name);
        let known = lineage.names().iter();
        known.clone().position(|known| known == own).unwrap()
    });
    names.collect()
}

/// A state of the lineage, the same in the full tree, and the representatives.
fn states(full: &PendulumTree, lineage: &PendulumTree) -> [Vec<f64>; 2] {
    let number = |link: usize, factor: f64| 0.4 * (factor * (1 + link) as f64).sin();
    let own: Vec<f64> = (0..42).map(|link| number(link, 4.1)).collect();
    let copies = representatives(full, lineage);
    let (theta, omega) = own.split_at(21);
    let whole = |values: &[f64]| {
        copies
            .iter()
            .map(|&link| values[link])
            .collect::<Vec<f64>>()
    };
    [own.clone(), [whole(theta), whole(omega)].concat()]
}

fn near(own: f64, other: f64, size: f64, what: &str) {
    assert!((own - other).abs() <= 1e-10 * size, "{what}: {own} {other}");
}

#[test]
fn a_lineage_is_a_motion_of_the_full_tree() {
    // Without gravity, and upright, rounding errors of the two trees grow faster.
    for (gravity, time) in [(9.81, 5.0), (0.0, 1.5), (-2.0, 1.0)] {
        let [full, lineage] =
            ["", "open = 1,"].map(|open| tree_with(gravity, open, "friction = 1e-4"));
        assert_eq!((full.links(), lineage.links()), (63, 21));
        let starts = states(&full, &lineage);
        let method = Dop853::new(Options::with_tolerance(1e-13));
        let [own, whole] = [(&lineage, &starts[0]), (&full, &starts[1])].map(|(tree, start)| {
            let start = State::new(0.0, start.clone());
            method
                .run(&AbsoluteAngles(tree), &start, time)
                .unwrap()
                .state
                .values
        });
        let copies = representatives(&full, &lineage);
        for (link, &copy) in copies.iter().enumerate() {
            for (a, b) in [(own[copy], whole[link]), (own[21 + copy], whole[63 + link])] {
                assert!((a - b).abs() < 1e-9, "{gravity}, link {link}: {a} {b}");
            }
        }
    }
}

#[test]
fn a_lineage_has_the_budget_of_the_full_tree() {
    for gravity in [9.81, 0.0, -2.0] {
        let (full, lineage) = (tree(gravity, ""), tree(gravity, "open = 1,"));
        let [own, whole] = states(&full, &lineage);
        let ((theta, omega), (angles, rates)) = (own.split_at(21), whole.split_at(63));
        // The same torque on all copies of a link: the sum of them on the link of the lineage.
        let copies = representatives(&full, &lineage);
        let mut torques = [0.0; 21];
        let on_links: Vec<f64> = copies
            .iter()
            .map(|&link| 1e-4 * (link as f64).cos())
            .collect();
        for (&link, torque) in copies.iter().zip(&on_links) {
            torques[link] += torque;
        }
        let budget = lineage
            .budget_by_scale(0.4, [theta, omega, &torques])
            .unwrap();
        let wanted = full
            .budget_by_scale(0.4, [angles, rates, &on_links])
            .unwrap();
        assert_eq!((budget.scales(), wanted.scales()), (6, 6));
        assert_eq!(
            lineage.degrees_of_freedom_by_scale().unwrap(),
            [6, 5, 4, 3, 2, 1]
        );
        let energy = full.energy_of(angles, rates).abs();
        let mut power = 0.0_f64;
        for scale in 0..6 {
            for other in 0..6 {
                power = power.max(wanted.transfer(scale, other).abs());
            }
        }
        for scale in 0..6 {
            near(budget.energy(scale), wanted.energy(scale), energy, "energy");
            for other in 0..6 {
                let (a, b) = (
                    budget.energy_of(scale, other),
                    wanted.energy_of(scale, other),
                );
                near(a, b, energy, "energy of a generation");
                let (a, b) = (budget.transfer(scale, other), wanted.transfer(scale, other));
                near(a, b, power, "transfer");
            }
            for (name, of) in [
                (
                    "friction",
                    ScaleBudget::friction_power as fn(&ScaleBudget<f64>, usize) -> f64,
                ),
                ("drag", ScaleBudget::drag_power),
                ("drive", ScaleBudget::drive_power),
                ("outside", ScaleBudget::outside_power),
            ] {
                let size = (0..6).map(|scale| of(&wanted, scale).abs()).sum();
                assert!(size > 0.0, "{name}");
                near(of(&budget, scale), of(&wanted, scale), size, name);
            }
        }
    }
}

/// By dual numbers along the motion, in two lanes.
#[test]
fn energies_of_a_lineage_change_as_its_budget_says() {
    let lineage = tree(9.81, "open = 1,");
    let [own, _] = states(&tree(9.81, ""), &lineage);
    let (theta, omega) = own.split_at(21);
    let alpha = lineage.accelerations(0.4, theta, omega);
    let dual = lineage.cast(Dual::<f64, 1>::constant);
    let along = |values: &[f64], rates: &[f64]| -> Vec<Dual<f64, 1>> {
        let pairs = values.iter().zip(rates);
        pairs
            .map(|(&value, &rate)| Dual {
                value,
                tangents: [rate],
            })
            .collect()
    };
    let moving = [along(theta, omega), along(omega, &alpha)];
    let rates = dual.budget_by_scale(Dual::constant(0.4), [&moving[0], &moving[1], &[]]);
    let (rates, budget) = (
        rates.unwrap(),
        lineage.budget_by_scale(0.4, [theta, omega, &[]]).unwrap(),
    );
    let lanes = lineage.cast(Lanes::<f64, 2>::splat);
    let both = |values: &[f64]| {
        values
            .iter()
            .map(|&own| Lanes([own, 0.5 * own]))
            .collect::<Vec<_>>()
    };
    let both = lanes
        .budget_by_scale(Lanes::splat(0.4), [&both(theta), &both(omega), &[]])
        .unwrap();
    let mut energy = 0.0;
    for scale in 0..6 {
        let [rate] = rates.energy(scale).tangents;
        let change = budget.received(scale) + budget.power(scale);
        let size = budget.received(scale).abs() + budget.power(scale).abs();
        near(rate, change, size, "rate");
        assert_eq!(both.energy(scale).0[0], budget.energy(scale));
        energy += budget.energy(scale);
    }
    let whole = lineage.energy_of(theta, omega);
    near(energy, whole, whole.abs(), "energy");
    // A lineage in equilibrium has ½ kT for each of its links.
    let shares = lineage.kinetic_shares(theta).unwrap();
    near(shares.iter().sum(), 21.0, 21.0, "shares");
    let short = lineage
        .budget_by_scale(0.0, [&[0.0; 21], &[0.0; 20], &[]])
        .unwrap();
    assert!(short.energy(0).is_nan());
}

#[test]
fn an_open_link_and_its_sibling_are_named_like_those_of_the_full_tree() {
    let lineage = tree(0.0, "open = 1,");
    assert_eq!(lineage.names()[..3], ["arm_1", "arm_2_1", "arm_3_1_1"]);
    assert_eq!(lineage.names()[18..], ["arm_4_2", "arm_5_2", "arm_6_2"]);
    let order = lineage.lineage().unwrap();
    let name = |link: usize| lineage.names()[link].as_str();
    assert_eq!(name(order.closed(1, 2)), "arm_3_2");
    assert_eq!(name(order.closed(2, 2)), "arm_3_1_2");
    // Eight copies of the youngest rods below the closed child of the root's open child.
    let mass = |link: usize| lineage.properties_of(link).unwrap().mass;
    assert_eq!(mass(order.closed(2, 5)), 8.0 * mass(order.open(5)));
    assert!(tree(0.0, "").lineage().is_none());
}
