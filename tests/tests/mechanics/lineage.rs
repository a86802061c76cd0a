//! Compiled trees with one open branching of each generation, against the full tree at run time.

use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

/// A lineage of six generations, or the full tree.
macro_rules! text {
    ($($open:tt)*) => {
        concat!(
            "gravity = 9.81, ",
            "arm: generations(count = 6, branching = 2, ", $($open)*, " shape = rod, mass = 0.12, ",
            "length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4, ",
            "friction_ratio = 0.3, drag = 1e-5, spring = 0.01, spring_ratio = 0.4), ",
            "siblings(arm_3, spring = 0.02), siblings(arm_6, friction = 1e-5)"
        )
    };
}

macro_rules! lineage {
    ($name:ident, $code:ident) => {
        #[branched_pendulum(
                    gravity = 9.81,
                    code = $code,
                    arm: generations(count = 6, branching = 2, open = 1, shape = rod, mass = 0.12,
                        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4,
                        friction_ratio = 0.3, drag = 1e-5, spring = 0.01, spring_ratio = 0.4),
                    siblings(arm_3, spring = 0.02), siblings(arm_6, friction = 1e-5),
                    emit(energies),
                )]
        struct $name;
    };
}

lineage!(WrittenOut, unrolled);
lineage!(InLoops, loops);

#[test]
fn compiled_lineages_move_as_the_full_tree() {
    let full = PendulumTree::parse(text!("")).unwrap();
    let lineage = PendulumTree::parse(text!("open = 1,")).unwrap();
    let names = || lineage.names().iter();
    assert!(names().eq(WrittenOut::<f64>::LINK_NAMES.iter()));
    assert!(names().eq(InLoops::<f64>::LINK_NAMES.iter()));
    // The copies of each link of the lineage, by the first number that is not on the open path.
    let stem = "arm_3".len();
    let representative = |name: &String| {
        let closed = name[stem..]
            .find("_2")
            .map(|first| &name[..stem + first + 2]);
        let own = closed.unwrap_or(name);
        lineage
            .names()
            .iter()
            .position(|known| known == own)
            .unwrap()
    };
    let copies: Vec<usize> = full.names().iter().map(representative).collect();
    let start: Vec<f64> = (0..42)
        .map(|link| 0.4 * (4.1 * f64::from(link + 1)).sin())
        .collect();
    let (theta, omega) = start.split_at(21);
    let alpha = lineage.accelerations(0.0, theta, omega);
    let size = alpha.iter().fold(0.0_f64, |size, own| size.max(own.abs()));
    let (theta_of, omega_of) = (theta.try_into().unwrap(), omega.try_into().unwrap());
    let written = WrittenOut::new().accelerations(theta_of, omega_of);
    let looped = InLoops::new().accelerations(theta_of, omega_of);
    for ((own, a), b) in alpha.iter().zip(&written).zip(&looped) {
        assert!((own - a).abs() < 1e-12 * size && (own - b).abs() < 1e-12 * size);
    }
    let whole = [theta, omega].map(|own| copies.iter().map(|&link| own[link]).collect::<Vec<_>>());
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let own = State::new(0.0, start.clone());
    let written = method
        .run(&AbsoluteAngles(WrittenOut::new()), &own, 5.0)
        .unwrap()
        .state;
    let looped = method
        .run(&AbsoluteAngles(InLoops::new()), &own, 5.0)
        .unwrap()
        .state;
    let whole = method.run(
        &AbsoluteAngles(&full),
        &State::new(0.0, whole.concat()),
        5.0,
    );
    let whole = whole.unwrap().state;
    for (link, &copy) in copies.iter().enumerate() {
        for (compiled, at, wanted) in [
            (&written, copy, link),
            (&written, 21 + copy, 63 + link),
            (&looped, copy, link),
            (&looped, 21 + copy, 63 + link),
        ] {
            let (a, b) = (compiled.values[at], whole.values[wanted]);
            assert!((a - b).abs() < 1e-9, "link {link}: {a} {b}");
        }
    }
    let energy = WrittenOut::new().energy_of(theta, omega);
    let wanted = lineage.energy_of(theta, omega);
    assert!(
        (energy - wanted).abs() < 1e-13 * wanted.abs(),
        "{energy} {wanted}"
    );
}
