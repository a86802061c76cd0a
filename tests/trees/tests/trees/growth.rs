//! Growth of small differences beside motions in phase: windows, three ways to one number, and
//! periodic motions.

use branched_pendulum::analysis::SectorModes;
use branched_pendulum::analysis::growth::{
    Continuation, Floquet, Grown, Growth, GrowthError, frequency_at_rest,
};
use branched_pendulum::analysis::variational::{Copies, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::SymmetricCoordinates;
use branched_pendulum_trees::{DifferenceGrowth, InPhaseTree, PendulumTree, TreeDescription};

/// The pendulum of the paper with friction in the children's pivots.
fn paper(friction: f64) -> PendulumTree {
    let text = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
        ]";
    let description = TreeDescription::parse(text).unwrap();
    description.tree(&[("friction", friction)]).unwrap()
}

/// Moment of inertia of a child about its pivot, kg m².
const M_2: f64 = 0.516e-3 + 0.10531 * 0.043 * 0.043;

fn antiphase(tree: &PendulumTree) -> InPhaseTree {
    let copies = tree.all_copies();
    let in_phase = tree.in_phase(&copies).unwrap();
    in_phase.with_differences(&copies).unwrap()
}

fn release(degrees: f64) -> State<f64> {
    State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0])
}

fn grown(tree: &PendulumTree, degrees: &[f64], horizons: &[f64]) -> Vec<Grown> {
    let system = antiphase(tree);
    let growth = Growth {
        frequency_hz: frequency_at_rest(&system),
        horizons: horizons.to_vec(),
        tolerance: 1e-10,
    };
    let starts = degrees
        .iter()
        .map(|degrees| system.start(&release(*degrees)));
    let releases: Vec<_> = starts.map(|start| (&system, start.unwrap())).collect();
    let grown = growth.in_lanes(&Ensemble::new(), &releases);
    grown.into_iter().collect::<Result<_, _>>().unwrap()
}

/// The edges of the windows of growth, to a twentieth of a degree.
#[test]
fn windows_of_growth() {
    let tree = paper(0.0);
    let edges = [
        (43.35, [1, 1]),
        (43.40, [1, 10]),
        (44.80, [1, 10]),
        (44.85, [1, 1]),
        (45.95, [1, 1]),
        (46.00, [1, 10]),
        (46.05, [1, 10]),
        (46.10, [1, 1]),
        (46.15, [1, 10]),
        (46.25, [1, 10]),
        (46.30, [10, 10]),
    ];
    let degrees = edges.map(|(degrees, _)| degrees);
    for ((degrees, levels), grown) in edges.iter().zip(grown(&tree, &degrees, &[4.0, 10.0])) {
        for (level, factor) in levels.iter().zip(&grown.factors) {
            assert_eq!(factor.value >= 10.0, *level == 10, "{degrees}: {factor:?}");
            assert!(factor.is_determined());
        }
    }
    let edges = [(42.65, false), (42.7, true), (44.55, true), (44.6, false)];
    let degrees = edges.map(|(degrees, _)| degrees);
    for ((degrees, grows), grown) in edges.iter().zip(grown(&tree, &degrees, &[30.0])) {
        assert_eq!(grown.factors[0].value >= 100.0, *grows, "{degrees}");
    }
}

/// Differences beside the motion in phase, the variational equations of the whole tree,
/// and a small difference of its own.
#[test]
fn three_ways_to_growth() {
    let tree = paper(2e-5);
    let system = linearised(SymmetricCoordinates(&tree));
    for degrees in [39.5, 43.5, 46.3] {
        let beside = &grown(&tree, &[degrees], &[4.0, 10.0])[0];
        let growth = Growth {
            frequency_hz: 1.258,
            horizons: vec![4.0, 10.0],
            tolerance: 1e-10,
        };
        let start = State::at_rest(0.0, &[f64::to_radians(degrees), 0.0, 0.0]);
        let deviation = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let along = growth
            .along(&system, &start, &deviation, [2..3, 5..6])
            .unwrap();
        for (one, other) in beside.factors.iter().zip(&along.factors) {
            assert!(
                (one.value / other.value - 1.0).abs() < 1e-4,
                "{one:?} {other:?}"
            );
        }
        assert!((beside.rate.value - along.rate.value).abs() < 1e-3);
        assert!((beside.frequency_hz.value - along.frequency_hz.value).abs() < 1e-3);

        // Small beside its own square, large beside rounding.
        const SIZE: f64 = 1e-6;
        let start = State::at_rest(0.0, &[f64::to_radians(degrees), 0.0, SIZE]);
        let method = Dop853::new(Options {
            max_step: Some(0.02),
            ..Options::with_tolerance(1e-13)
        });
        let mut largest = 0.0_f64;
        let run = method.integrate(&SymmetricCoordinates(&tree), &start, 10.0, |step| {
            largest = largest.max(step.end()[2].abs());
            ControlFlow::Continue(())
        });
        run.unwrap();
        let factor = beside.factors[1].value;
        assert!(
            (largest / SIZE / factor - 1.0).abs() < 0.01,
            "{largest} {factor}"
        );
    }
}

/// det Φ(t) = exp(−c t/M_2) beside any motion.
#[test]
fn friction_shrinks_the_plane_of_differences() {
    for constant in [2.8e-5, 1.1e-4] {
        let tree = paper(constant);
        let system = antiphase(&tree);
        let method = Dop853::new(Options::with_tolerance(1e-12));
        let time = 3.3;
        let column = |angle: f64, rate: f64| {
            let start = State::new(0.0, vec![0.7, 0.1, angle, 0.0, 0.0, rate]);
            let end = method.run(&system, &start, time).unwrap();
            [end.state.values[2], end.state.values[5]]
        };
        let ([a, c], [b, d]) = (column(1.0, 0.0), column(0.0, 1.0));
        let expected = (-constant * time / M_2).exp();
        assert!(((a * d - b * c) / expected - 1.0).abs() < 1e-9);
    }
}

/// Periodic motions from the linear modes on: shapes and periods at small size, growth
/// along them by multipliers.
#[test]
fn nonlinear_normal_modes() {
    let tree = paper(0.0);
    let rest = [0.0; 3];
    let (mass, stiffness) = (tree.mass_matrix(&rest), tree.stiffness_matrix(&rest));
    let blocks = SectorModes::new(tree.sectors(), &mass, &stiffness)
        .unwrap()
        .blocks;
    let modes = &blocks[0].modes;
    let in_phase = tree.in_phase(&tree.all_copies()).unwrap();
    let system = linearised(in_phase.clone());
    let differences = antiphase(&tree);
    let continuation = Continuation {
        tolerance: 1e-10,
        step: 0.1,
        largest: 1.2,
    };
    for (shape, &frequency) in modes.shapes.iter().zip(&modes.frequencies_hz) {
        // The coordinate of both children is √2 times their angle where squares sum.
        let shape = [shape[0], shape[1] / 2.0_f64.sqrt()];
        let orbits = continuation
            .orbits(&system, &rest[..2], &shape, frequency)
            .unwrap();
        assert!(orbits.len() > 5);
        let first = &orbits[0];
        assert!((first.period * frequency - 1.0).abs() < 0.01);
        let ratio = first.release[1] / first.release[0];
        assert!((ratio / (shape[1] / shape[0]) - 1.0).abs() < 0.05);
        // Larger ones are slower, and all mirror themselves.
        assert!(
            orbits
                .windows(2)
                .all(|pair| pair[0].period < pair[1].period)
        );
        for orbit in &orbits {
            assert!(orbit.is_symmetric());
            // A period leads back to the release, in the whole tree too.
            let start = State::at_rest(0.0, &in_phase.whole(&orbit.release));
            let method = Dop853::new(Options::with_tolerance(1e-12));
            let end = method.run(&AbsoluteAngles(&tree), &start, orbit.period);
            for (end, start) in end.unwrap().state.values.iter().zip(&start.values) {
                assert!((end - start).abs() < 1e-6, "{orbit:?}");
            }
            let floquet = Floquet::of_differences(&differences, orbit, 1e-10).unwrap();
            assert_eq!(floquet.period, orbit.period / 2.0);
            let [[a, b], [c, d]] =
                [0, 1].map(|row: usize| [0, 1].map(|i: usize| floquet.matrix[row][i]));
            assert!((a * d - b * c - 1.0).abs() < 1e-8);
            assert_eq!((a + d).abs() > 2.0 + 1e-6, floquet.rate.value > 1e-3);
            let within = Floquet::of_motion(&system, orbit, 1e-10).unwrap();
            let unit = within.multipliers.iter();
            let unit = unit.filter(|[re, im]| (re - 1.0).hypot(*im) < 1e-3).count();
            assert!(unit >= 2, "{:?}", within.multipliers);
        }
    }
}

#[test]
fn requests_without_an_answer() {
    let tree = paper(0.0);
    let system = antiphase(&tree);
    let growth = Growth {
        frequency_hz: 1.26,
        horizons: vec![1.0],
        tolerance: 1e-8,
    };
    let ask = |growth: &Growth, start: State<f64>| {
        let start = system.start(&start).unwrap();
        growth
            .in_lanes(&Ensemble::new(), &[(&system, start)])
            .remove(0)
    };
    assert!(ask(&growth, release(20.0)).is_ok());
    for lost in [f64::NAN, f64::INFINITY] {
        let lost = State::at_rest(0.0, &[lost, 0.0, 0.0]);
        assert!(matches!(
            ask(&growth, lost),
            Err(GrowthError::Integration(_))
        ));
    }
    for horizons in [vec![], vec![2.0, 1.0], vec![0.0], vec![f64::NAN]] {
        let growth = Growth {
            horizons,
            ..growth.clone()
        };
        assert_eq!(ask(&growth, release(20.0)), Err(GrowthError::Horizons));
    }
    let growth = Growth {
        frequency_hz: 0.0,
        ..growth
    };
    assert_eq!(
        ask(&growth, release(20.0)),
        Err(GrowthError::Frequency(0.0))
    );
}

/// Trees in lanes have times of their own, by their own periods, and lanes only of their shape and
/// of what is asked.
#[test]
fn trees_in_lanes_grow_as_each_alone() {
    let trees = [
        (0.10531, 0.0, 12.0, 1e-8),
        (0.2, 0.0, 12.0, 1e-8),
        (0.15, 1e-4, 12.0, 1e-8),
        (0.05, 0.0, 8.0, 1e-8),
        (0.3, 2e-4, 12.0, 1e-9),
        (0.12, 0.0, 12.0, 1e-9),
    ];
    let differences = trees.map(|(mass, friction, horizon, tolerance)| {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.80665,
             parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                 child(mass = {mass}, com = 0.043, inertia = 0.516e-3, friction = {friction}) * 2
             ]"
        ))
        .unwrap();
        // Longer than the time after which differences are scaled back.
        DifferenceGrowth::new(&tree, &tree.all_copies(), vec![4.0, horizon], tolerance).unwrap()
    });
    let start = |degrees: f64| State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0]);
    let cases: Vec<_> = [30.0, 44.0, 60.0]
        .into_iter()
        .flat_map(|degrees| differences.iter().map(move |own| (own, start(degrees))))
        .collect();
    let ensemble = Ensemble::new();
    let together = DifferenceGrowth::of_trees_in_lanes(&ensemble, &cases).unwrap();
    assert_eq!(together.len(), cases.len());
    for (together, (own, start)) in together.iter().zip(&cases) {
        let alone = own
            .in_lanes(&ensemble, std::slice::from_ref(start))
            .unwrap();
        let [together, alone] = [together, &alone[0]].map(|grown| grown.as_ref().unwrap());
        assert_eq!(together, alone);
    }
    let factors = together
        .iter()
        .map(|grown| grown.as_ref().unwrap().factors[1].value);
    assert!(factors.fold(0.0, f64::max) > 10.0);
}

/// The decay is that of a difference in which all links of one subtree turn as one and those of
/// the other against them, by the equations of the whole tree.
/// Light hands on arms fall faster than the arms return, so that the mean acceleration of equal
/// displacements is not restoring. The differences oscillate nevertheless: their typical frequency
/// is the root mean square of the three frequencies with opposite arms, by the modes of the tree.
#[test]
fn light_links_have_a_frequency_at_rest() {
    for [mass_ratio, length_ratio] in [[0.25, 0.7], [0.3, 0.7], [0.1, 0.5]] {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.80665,
             tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                 mass_ratio = {mass_ratio}, length_ratio = {length_ratio})"
        ));
        let tree = tree.expect("it is a tree");
        let parents = [None, Some(0), Some(1), Some(1), Some(0), Some(4), Some(4)];
        let arms = Copies::of_links(&parents, &[&[1, 4]]).expect("they are copies");
        let grown =
            DifferenceGrowth::new(&tree, &arms, vec![1.0], 1e-9).expect("they are in phase");
        let modes = tree.modes(&[0.0; 7]).expect("it hangs");
        let pairs = || modes.frequencies_hz.iter().zip(&modes.shapes);
        let square = |(frequency, _): (&f64, &Vec<f64>)| frequency * frequency;
        let arms = pairs().filter(|(_, shape)| shape[1] * shape[4] < -1e-6);
        let arms: Vec<f64> = arms.map(square).collect();
        assert_eq!(arms.len(), 2);
        // Hands against each other, while their arms rest; one of two equal frequencies.
        let hands = pairs().find(|(_, shape)| shape[0].abs() + shape[1].abs() < 1e-9);
        let hands = hands.map(square).expect("hands swing against each other");
        let expected = ((arms.iter().sum::<f64>() + hands) / 3.0).sqrt();
        let own = grown.growth().frequency_hz;
        assert!((own / expected - 1.0).abs() < 1e-9, "{own} {expected}");
    }
}

#[test]
fn decay_is_the_mean_over_the_links_that_differ() {
    let twig = "twig: rod(mass = 0.2, length = 0.3, friction = 1e-3, drag = 2e-4)";
    let two = format!("{twig} [leaf: rod(mass = 0.1, length = 0.2, friction = 3e-3)]");
    let three = format!(
        "{twig} [leaf: rod(mass = 0.1, length = 0.2, friction = 3e-3) [
            tip: rod(mass = 0.05, length = 0.1, friction = 5e-4)
        ]]"
    );
    let fork = format!(
        "{twig} [left: rod(mass = 0.1, length = 0.2, friction = 3e-3),
            right: rod(mass = 0.3, length = 0.1, drag = 2e-3)]"
    );
    for (subtree, links) in [(twig.to_owned(), 1), (two, 2), (three, 3), (fork, 3)] {
        let text = format!(
            "gravity = 9.81, stem: rod(mass = 1, length = 0.4, friction = 1e-2) [{subtree} * 2]"
        );
        let tree = PendulumTree::parse(&text).unwrap();
        let copies = tree.all_copies();
        let growth = DifferenceGrowth::new(&tree, &copies, vec![1.0], 1e-9).unwrap();
        let n = tree.links();
        assert_eq!(n, 1 + 2 * links);
        // Links follow their parents.
        let mut sign = vec![0.0; n];
        for (link, name) in tree.names().iter().enumerate() {
            sign[link] = match (name.as_str(), tree.properties_of(link).unwrap().parent) {
                ("twig_1", _) => 1.0,
                ("twig_2", _) => -1.0,
                (_, Some(parent)) => sign[parent],
                (_, None) => 0.0,
            };
        }
        let alpha = tree.accelerations(0.0, &vec![0.0; n], &sign);
        let lost: f64 = alpha
            .iter()
            .zip(&sign)
            .map(|(alpha, sign)| -sign * alpha)
            .sum();
        let decay = lost / (2 * links) as f64;
        // A twig that is braked speeds its leaf up: the mean may be negative.
        assert!(decay.abs() > 1e-3, "{decay}");
        let found = growth.decay();
        assert!(
            (found - decay).abs() < 1e-12 * decay.abs(),
            "{text}: {found} {decay}"
        );
    }
}
