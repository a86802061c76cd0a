//! Descriptions of driven trees with leaves that are copies.

use std::fmt::Write;

use branched_pendulum_compiler_tests::random::Random;

/// A number in these bounds.
fn random_value(random: &mut Random, low: f64, high: f64) -> String {
    format!("{:.4}", random.between(low, high))
}

/// Leaves that are copies, with what a link may have but offsets across, alike or each its own.
fn leaves(random: &mut Random, copies: usize, differ: bool) -> String {
    let mut own = |name: &str, low: f64, high: f64| -> String {
        let mut one = || random_value(random, low, high);
        match differ {
            false => format!("{name} = {}, ", one()),
            true => {
                let values: Vec<String> = (0..copies).map(|_| one()).collect();
                format!("{name} = each({}), ", values.join(", "))
            }
        }
    };
    let mut text = String::from("(");
    for (name, low, high) in [
        ("mass", 0.1, 0.3),
        ("com", 0.05, 0.2),
        ("inertia", 1e-3, 2e-3),
        ("spring", 0.01, 0.2),
        ("drag", 1e-3, 1e-2),
        ("rest", -0.2, 0.2),
    ] {
        text.push_str(&own(name, low, high));
    }
    if differ {
        text.push_str(&own("at", 0.2, 0.4));
    }
    let law = |random: &mut Random| {
        let [viscous, coulomb, quadratic] =
            [0.01, 0.05, 0.01].map(|high| random_value(random, 1e-3, high));
        format!("viscous = {viscous}, coulomb = {coulomb}, quadratic = {quadratic}, width = 0.3")
    };
    let _ = write!(text, "friction({})) * {copies}", law(random));
    text
}

/// A driven tree with one or two groups of leaves.
pub(super) fn driven_tree(seed: u64, differ: bool, requests: &str) -> String {
    let mut random = Random::new(seed);
    let (first, second) = (2 + seed as usize % 2, 2 + seed as usize / 2 % 2);
    let twigs = leaves(&mut random, first, differ);
    let inner = match seed % 3 {
        0 => String::new(),
        _ => {
            let leaves = leaves(&mut random, second, false);
            format!(
                ", arm: rod(mass = {}, length = 0.25, friction = 2e-3) [bud{leaves}]",
                random_value(&mut random, 0.1, 0.2)
            )
        }
    };
    format!(
        "gravity = 9.80665,
        trunk: rod_with_bob(mass = 0.4, length = 0.35, bob_mass = {}, drag(quadratic = 1e-3)) [
            twig{twigs}{inner}
        ],
        drive(x = 0.05 * cos(7 * t), y = 0.03 * sin(5 * t), torque = 0.2 * cos(3 * t)),
        emit({requests})",
        random_value(&mut random, 0.1, 0.5)
    )
}
