//! Energy transfers between the sectors of trees with copies: what can be told without the
//! compiler.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, SectorBudget, StateInput, SymmetricTree,
};
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

/// Nested copies with all that links can have, beside copies that differ.
const TREES: [&str; 6] = [
    "gravity = 9.81,
     trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, friction = 1e-3, drag = 2e-4) [
         bough(mass = 0.1, com = (0.12, -0.01), inertia = 1e-3, at = (0.3, 0.05),
             joint = (0.2, 0.01), spring = 0.2, rest = 0.1,
             friction(viscous = 1e-3, coulomb = 0.02, static = 0.03, stribeck = 0.9, quadratic = 1e-3)) [
             twig: rod(mass = 0.04, length = 0.2, drag(viscous = 1e-4, quadratic = 1e-4)) * 3
         ] * 2
     ],
     drive(torque = 0.1 * cos(3 * t), x = 0.02 * sin(2 * t)^2, y = 0.01 * sin(5 * t))",
    "gravity = -9.81,
     trunk: rod(mass = 0.3, length = 0.4, spring = 40) [
         bough: rod(mass = each(0.1, 0.12), length = 0.3, spring = each(3, 2.5), rest = each(0.1, 0)) [
             twig: rod(mass = 0.04, length = 0.2, friction = 1e-3, spring = 1) * 2
         ] * 2
     ],
     drive(torque = 0.1 * cos(3 * t), y = 0.01 * sin(5 * t))",
    "gravity = 9.81,
     trunk: rod(mass = 0.3, length = 0.4) [
         bough: rod(mass = 0.1, length = 0.3, spring = 0.2, rest = 0.1) [
             twig: rod(mass = 0.04, length = 0.2) * 3
         ] * 2
     ],
     siblings(bough, spring = 0.4), siblings(twig, spring = 0.1, friction(coulomb = 0.01)),
     between(trunk, twig_2_3, friction = 2e-3)",
    "gravity = 9.81,
     trunk: rod(mass = 0.3, length = 0.4) [
         bough: rod(mass = each(0.1, 0.12), length = 0.3) [twig: rod(mass = 0.04, length = 0.2) * 2] * 2
     ],
     siblings(bough, spring = 0.4, friction = 1e-3)",
    "gravity = 9.81,
     trunk: rod(mass = 0.3, length = 0.4, friction = 1e-3) [
         bough: rod(mass = 0.1, length = 0.3, spring = 0.2, rest = 0.1) [
             twig: rod(mass = 0.04, length = 0.2) * 3
         ] * 2
     ],
     siblings(bough, at = (0.2, 0.03), spring = 5), siblings(twig, at = 0.1, spring = 8),
     siblings(twig, spring = 0.02)",
    "gravity = -9.81,
     trunk: rod(mass = 0.3, length = 0.4, spring = 40) [
         bough: rod(mass = each(0.1, 0.12), length = 0.3) [twig: rod(mass = 0.04, length = 0.2) * 2] * 2
     ],
     siblings(bough, at = 0.25, spring = 7), siblings(twig, at = (0.2, -0.01), spring = 2)",
];

const DEFINITIONS: [EnergyDefinition; 4] = [
    EnergyDefinition::Rest,
    EnergyDefinition::Canonical,
    EnergyDefinition::Velocity,
    EnergyDefinition::Parseval,
];

fn state(links: usize) -> [Vec<f64>; 3] {
    let number = |link: usize, factor: f64| (factor * (1 + link) as f64).sin();
    [1.3, 4.1, 0.7].map(|factor| (0..links).map(|link| number(link, factor)).collect())
}

fn budget<T: Scalar>(
    tree: &SymmetricTree<T>,
    definition: EnergyDefinition,
    acting: &[NonConservative<'_, T>],
    [theta, omega]: [&[T]; 2],
) -> SectorBudget<T> {
    let mut budget = SectorBudget::new();
    let given = StateInput::Absolute { theta, omega };
    tree.budget(
        &mut Workspace::new(),
        definition,
        acting,
        given,
        &mut budget,
    );
    budget
}

/// By derivatives along the motion of the driven tree in dual numbers, whose accelerations come
/// from other equations.
#[test]
fn energies_change_as_the_budget_tells() {
    for text in TREES {
        let tree = PendulumTree::parse(text).unwrap();
        let symmetric = tree.symmetric().unwrap();
        let (links, time) = (tree.links(), 0.4);
        let [theta, omega, mut torques] = state(links);
        torques.iter_mut().for_each(|torque| *torque *= 0.1);
        let mut alpha = vec![0.0; links];
        tree.accelerations_under_into(time, &theta, &omega, &torques, &mut alpha);
        let along = |values: &[f64], rates: &[f64]| -> Vec<Dual<f64, 1>> {
            let pairs = values.iter().zip(rates);
            let number = |(value, rate): (&f64, &f64)| Dual {
                value: *value,
                tangents: [*rate],
            };
            pairs.map(number).collect()
        };
        let moving = [along(&theta, &omega), along(&omega, &alpha)];
        let dual = symmetric.cast(Dual::<f64, 1>::constant);
        let acting = [
            NonConservative::Friction,
            NonConservative::Drive(tree.drive(time).unwrap_or_default()),
            NonConservative::Torques(&torques),
        ];
        for definition in DEFINITIONS {
            let reported = budget(&symmetric, definition, &acting, [&theta, &omega]);
            let rates = budget(&dual, definition, &[], [&moving[0], &moving[1]]);
            let is_known = !symmetric.has_unequal_copies() || definition != DEFINITIONS[3];
            let known = reported.energies.iter().all(|energy| !energy.is_nan());
            assert_eq!(known, is_known);
            let size = |list: &[f64]| list.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let size = size(&reported.transfers) + size(&reported.powers);
            for (sector, rate) in rates.energies.iter().enumerate().filter(|_| is_known) {
                let [rate] = rate.tangents;
                let reported = reported.transfers[sector] + reported.powers[sector];
                let error = (rate - reported).abs();
                assert!(
                    error < 1e-12 * size,
                    "{definition:?} {sector}: {rate} {reported}"
                );
            }
        }
    }
}

#[test]
fn energies_by_parseval_sum_up() {
    let tree = PendulumTree::parse(TREES[0]).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let [theta, omega, _] = state(tree.links());
    let parseval = budget(
        &symmetric,
        EnergyDefinition::Parseval,
        &[NonConservative::Friction],
        [&theta, &omega],
    );
    let near = |own: f64, other: f64| {
        assert!(
            (own - other).abs() < 1e-13 * other.abs().max(1.0),
            "{own} {other}"
        );
    };
    near(
        parseval.energies.iter().sum(),
        tree.energy_of(&theta, &omega),
    );
    near(parseval.transfers.iter().sum(), 0.0);
    near(
        parseval.powers.iter().sum(),
        tree.friction_power(&theta, &omega),
    );
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    let hamiltonian = symmetric.hamiltonian(&mut Workspace::new(), given);
    near(hamiltonian, tree.energy_of(&theta, &omega));
    // By scale: the sectors of each level together.
    let by_scale = tree.budget_by_scale(0.0, [&theta, &omega, &[]]).unwrap();
    let levels = [0..1, 1..2, 2..6];
    for (scale, sectors) in levels.into_iter().enumerate() {
        near(
            parseval.energies[sectors.clone()].iter().sum(),
            by_scale.energy(scale),
        );
        near(
            parseval.transfers[sectors].iter().sum(),
            by_scale.received(scale),
        );
    }
}

/// W of what the differing copies do and of the mean tree are W; and small forcing keeps digits.
#[test]
fn growth_and_forcing_are_the_transfer() {
    let symmetric = PendulumTree::parse(TREES[1]).unwrap().symmetric().unwrap();
    let precise = symmetric.cast(Double::from);
    let [theta, omega, _] = state(symmetric.links());
    let lift = |values: &[f64]| -> Vec<Double> { values.iter().map(|&v| v.into()).collect() };
    let (exact_theta, exact_omega) = (lift(&theta), lift(&omega));
    let mut parts = [(); 3].map(|()| vec![Transfer::default(); symmetric.sectors().len()]);
    let zero = Transfer {
        kinetic: Double::from(0.0),
        potential: Double::from(0.0),
    };
    let mut exact = parts.clone().map(|part| vec![zero; part.len()]);
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    let [whole, growth, forcing] = &mut parts;
    let workspace = &mut Workspace::new();
    symmetric.exact_transfers(workspace, given, whole);
    symmetric.growth(workspace, given, growth);
    symmetric.forcing(workspace, given, forcing);
    let given = StateInput::Absolute {
        theta: &exact_theta,
        omega: &exact_omega,
    };
    let [_, exact_growth, exact_forcing] = &mut exact;
    let workspace = &mut Workspace::new();
    precise.growth(workspace, given, exact_growth);
    precise.forcing(workspace, given, exact_forcing);
    for sector in 0..whole.len() {
        let parts = [growth[sector], forcing[sector]];
        let parts = parts.map(|part| part.kinetic.abs() + part.potential.abs());
        let size: f64 = parts.iter().sum();
        let sum = growth[sector].total() + forcing[sector].total();
        let error = sum - whole[sector].total();
        assert!(error.abs() < 1e-13 * size, "{sector}: {error:e}");
        assert!(forcing[sector].total().abs() > 1e-6 * size, "{sector}");
        for (own, exact) in [
            (growth[sector], exact_growth[sector]),
            (forcing[sector], exact_forcing[sector]),
        ] {
            let error = (own.total() - exact.total().high()).abs();
            assert!(error < 1e-13 * size, "{sector}: {error:e}");
        }
    }
}

/// A rule gives one tree, link by link and generation by generation, in another order of links.
#[test]
fn trees_in_loops_have_the_sectors_of_those_written_out() {
    let text = |code: &str| {
        format!(
            "gravity = 9.81, tree: generations(count = 4, branching = 2, code = {code},
                shape = rod, mass = 0.2, length = 0.3, mass_ratio = 0.5, length_ratio = 0.8)"
        )
    };
    let [loops, unrolled] =
        ["loops", "unrolled"].map(|code| PendulumTree::parse(&text(code)).unwrap());
    let [one, other] = [&loops, &unrolled].map(|tree| tree.symmetric().unwrap());
    let [theta, omega, _] = state(15);
    let place = |name: &String| loops.names().iter().position(|own| own == name).unwrap();
    let places: Vec<usize> = unrolled.names().iter().map(place).collect();
    let ordered =
        |values: &[f64]| -> Vec<f64> { places.iter().map(|&place| values[place]).collect() };
    let by = EnergyDefinition::Canonical;
    let one_budget = budget(&one, by, &[], [&theta, &omega]);
    let other_budget = budget(&other, by, &[], [&ordered(&theta), &ordered(&omega)]);
    for (number, sector) in other.sectors().iter().enumerate() {
        let same = one.sector(sector.name()).unwrap();
        let names = |sector: usize, tree: &SymmetricTree<f64>| -> Vec<String> {
            let own = tree.sectors()[sector].coordinates().iter();
            own.map(|coordinate| coordinate.name().to_owned()).collect()
        };
        assert_eq!(names(same, &one), names(number, &other));
        let error = one_budget.transfers[same] - other_budget.transfers[number];
        assert!(error.abs() < 1e-13, "{}: {error:e}", sector.name());
    }
}

/// Copies in phase have no differences, exactly, and get nothing.
#[test]
fn nothing_flows_into_differences_that_are_zero() {
    let symmetric = PendulumTree::parse(TREES[0]).unwrap().symmetric().unwrap();
    let links = symmetric.links();
    let mut theta = vec![0.3; links];
    let mut omega = vec![-0.7; links];
    // The trunk, and of each bough the twigs.
    (theta[0], omega[0]) = (0.1, 2.0);
    for bough in [1, 5] {
        (theta[bough], omega[bough]) = (1.1, 0.4);
    }
    let mut transfers = vec![Transfer::default(); symmetric.sectors().len()];
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    for form in [
        TransferForm::Exact,
        TransferForm::Amplitude(4),
        TransferForm::Angle(1),
    ] {
        symmetric.transfers(&mut Workspace::new(), form, given, &mut transfers);
        for transfer in &transfers[1..] {
            assert!(transfer.total().abs() < 1e-15, "{form}: {transfer:?}");
        }
    }
}

/// Coordinates and momenta in both normalisations, and equations of motion in them.
#[test]
fn symmetric_coordinates_move_as_the_links_do() {
    let tree = PendulumTree::parse(TREES[0]).unwrap();
    let links = tree.links();
    let [theta, omega, _] = state(links);
    let plain = Normalisation::Plain;
    let mut start = vec![0.0; 2 * links];
    let (coordinates, rates) = start.split_at_mut(links);
    tree.symmetric_from_absolute(plain, &theta, coordinates);
    tree.symmetric_from_absolute(plain, &omega, rates);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let start = State::new(0.0, start);
    let own = method.run(&SymmetricCoordinates(&tree), &start, 1.0);
    let own = own.unwrap().state;
    let start = State::new(0.0, [&theta[..], &omega].concat());
    let other = method.run(&AbsoluteAngles(&tree), &start, 1.0);
    let other = other.unwrap().state;
    let mut absolute = vec![0.0; links];
    tree.absolute_from_symmetric(plain, own.positions(), &mut absolute);
    for (own, other) in absolute.iter().zip(other.positions()) {
        assert!((own - other).abs() < 1e-8, "{own} {other}");
    }
}

#[test]
fn a_tree_without_copies_says_what_to_do() {
    let chain = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = m)]";
    let description = TreeDescription::parse(chain).unwrap();
    let refused = description.symmetric::<f64>(&[("m", 1.0)]).unwrap_err();
    assert_eq!(refused, TreeError::NoCopies);
    assert!(
        refused.to_string().contains("`child(...) * 2`"),
        "{refused}"
    );
    let tree = description.tree::<f64>(&[("m", 1.0)]).unwrap();
    assert_eq!(tree.symmetric().unwrap_err(), TreeError::NoCopies);
    let names: Vec<&str> = tree.sectors().iter().map(|sector| sector.name()).collect();
    assert_eq!(names, ["in_phase"]);
}

#[test]
fn slices_of_other_lengths_are_answered_with_nan() {
    let symmetric = PendulumTree::parse(TREES[0]).unwrap().symmetric().unwrap();
    let [theta, omega, _] = state(symmetric.links());
    let count = symmetric.sectors().len();
    let (mut workspace, mut transfers) = (Workspace::new(), vec![Transfer::default(); count]);
    let short = StateInput::Absolute {
        theta: &theta[1..],
        omega: &omega,
    };
    symmetric.exact_transfers(&mut workspace, short, &mut transfers);
    assert!(transfers.iter().all(|w| w.total().is_nan()));
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    symmetric.exact_transfers(&mut workspace, given, &mut transfers[1..]);
    assert!(transfers[1..].iter().all(|w| w.total().is_nan()));
    symmetric.transfers(
        &mut workspace,
        TransferForm::Amplitude(16),
        given,
        &mut transfers,
    );
    assert!(transfers.iter().all(|w| w.total().is_nan()));
    let mut powers = vec![0.0; count];
    symmetric.powers(
        &mut workspace,
        NonConservative::Torques(&theta[1..]),
        given,
        &mut powers,
    );
    assert!(powers.iter().all(|power| power.is_nan()));
}
