//! Springs and friction between links that are not parent and child.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{CanonicalVariables, Workspace};
use branched_pendulum::transfer::Given;
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_trees::{PendulumTree, TreeError};

use super::mechanics::near;

/// Uniform numbers from a seed (Numerical Recipes' `ranqd1` in 64 bits).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }
}

/// Solves a system of equations by elimination with pivots.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for column in 0..n {
        let size = |row: &usize| matrix[*row][column].abs();
        let pivot = (column..n).max_by(|a, b| size(a).total_cmp(&size(b)));
        matrix.swap(column, pivot.unwrap());
        right.swap(column, pivot.unwrap());
        let (above, below) = matrix.split_at_mut(column + 1);
        let pivot = &above[column];
        for (row, own) in (column + 1..).zip(below) {
            let factor = own[column] / pivot[column];
            for (own, pivot) in own.iter_mut().zip(pivot) {
                *own -= factor * pivot;
            }
            right[row] -= factor * right[column];
        }
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n)
            .map(|place| matrix[row][place] * right[place])
            .sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}

/// A tree of links without lateral offsets and without joint torques, in plain numbers, and what
/// acts between its links: the accelerations by the closed form of the mass matrix.
struct PlainTree {
    parents: Vec<Option<usize>>,
    /// Mass, centre of mass, inertia and pivot on the parent.
    bodies: Vec<[f64; 4]>,
    /// The two links, κ, ρ, c, C, q and ε.
    couplings: Vec<([usize; 2], [f64; 6])>,
}

impl PlainTree {
    fn random(numbers: &mut Numbers) -> Self {
        let links = 2 + numbers.below(11);
        let parents = (0..links)
            .map(|link| (link > 0).then(|| numbers.below(link)))
            .collect();
        let body = |numbers: &mut Numbers| {
            let ranges = [(0.05, 0.4), (0.05, 0.3), (1e-4, 3e-3), (0.05, 0.4)];
            ranges.map(|(low, high)| numbers.between(low, high))
        };
        let bodies = (0..links).map(|_| body(numbers)).collect();
        let coupling = |numbers: &mut Numbers| {
            let first = numbers.below(links);
            let second = (first + 1 + numbers.below(links - 1)) % links;
            let ranges = [
                (0.0, 0.5),
                (-1.0, 1.0),
                (0.0, 1e-2),
                (0.0, 0.05),
                (0.0, 1e-2),
                (0.01, 0.3),
            ];
            let own = ranges.map(|(low, high)| numbers.between(low, high));
            ([first, second], own)
        };
        let couplings = (0..1 + numbers.below(4))
            .map(|_| coupling(numbers))
            .collect();
        Self {
            parents,
            bodies,
            couplings,
        }
    }

    fn text(&self) -> String {
        let link = |link: usize| {
            let [mass, com, inertia, at] = self.bodies[link];
            let at = match self.parents[link] {
                Some(_) => format!(", at = {at}"),
                None => String::new(),
            };
            format!("l{link}(mass = {mass}, com = {com}, inertia = {inertia}{at})")
        };
        fn written(tree: &PlainTree, own: usize, link: &dyn Fn(usize) -> String) -> String {
            let children =
                (0..tree.parents.len()).filter(|other| tree.parents[*other] == Some(own));
            let children: Vec<String> = children.map(|child| written(tree, child, link)).collect();
            match children.is_empty() {
                true => link(own),
                false => format!("{} [{}]", link(own), children.join(", ")),
            }
        }
        let couplings = self.couplings.iter().map(|([a, b], own)| {
            let [spring, rest, friction, coulomb, quadratic, width] = own;
            format!(
                ", between(l{a}, l{b}, spring = {spring}, rest = {rest}, friction(viscous = \
                 {friction}, coulomb = {coulomb}, quadratic = {quadratic}, width = {width}))"
            )
        });
        let couplings: String = couplings.collect();
        format!("gravity = 9.81, {}{couplings}", written(self, 0, &link))
    }

    fn accelerations(&self, theta: &[f64], omega: &[f64]) -> Vec<f64> {
        let n = theta.len();
        let below = |link: usize, above: usize| {
            let mut at = Some(link);
            while let Some(own) = at {
                if own == above {
                    return true;
                }
                at = self.parents[own];
            }
            false
        };
        let children = |link: usize| (0..n).filter(move |other| self.parents[*other] == Some(link));
        let carried = |link: usize| -> f64 {
            (0..n)
                .filter(|other| below(*other, link))
                .map(|other| self.bodies[other][0])
                .sum()
        };
        let moment = |link: usize| -> f64 {
            let [mass, com, ..] = self.bodies[link];
            let hung: f64 = children(link)
                .map(|child| self.bodies[child][3] * carried(child))
                .sum();
            mass * com + hung
        };
        let mut matrix = vec![vec![0.0; n]; n];
        let mut right = vec![0.0; n];
        for i in 0..n {
            let [mass, com, inertia, _] = self.bodies[i];
            let hung: f64 = children(i)
                .map(|child| self.bodies[child][3].powi(2) * carried(child))
                .sum();
            matrix[i][i] = inertia + mass * com * com + hung;
            right[i] -= 9.81 * moment(i) * theta[i].sin();
            for j in (0..n).filter(|j| *j != i && below(*j, i)) {
                let child = children(i).find(|child| below(j, *child)).unwrap();
                let entry = self.bodies[child][3] * moment(j);
                let apart = theta[i] - theta[j];
                matrix[i][j] = entry * apart.cos();
                matrix[j][i] = matrix[i][j];
                right[i] -= entry * apart.sin() * omega[j] * omega[j];
                right[j] += entry * apart.sin() * omega[i] * omega[i];
            }
        }
        for ([a, b], [spring, rest, friction, coulomb, quadratic, width]) in &self.couplings {
            let (apart, rate) = (theta[*a] - theta[*b], omega[*a] - omega[*b]);
            let speed = rate.hypot(*width);
            let braking = (friction + coulomb / speed + quadratic * speed) * rate;
            let torque = -spring * (apart - rest) - braking;
            right[*a] += torque;
            right[*b] -= torque;
        }
        solve(matrix, right)
    }
}

/// The order of links of a plain tree in the described one.
fn order(tree: &PendulumTree) -> Vec<usize> {
    let names = tree.names().iter();
    names.map(|name| name[1..].parse().unwrap()).collect()
}

#[test]
fn accelerations_are_those_of_a_dense_solve() {
    let mut numbers = Numbers(7);
    for _ in 0..100 {
        let plain = PlainTree::random(&mut numbers);
        let tree = PendulumTree::parse(&plain.text()).unwrap();
        let order = order(&tree);
        let links = order.len();
        let state = |numbers: &mut Numbers, range: f64| -> Vec<f64> {
            (0..links).map(|_| numbers.between(-range, range)).collect()
        };
        let (theta, omega) = (state(&mut numbers, 3.0), state(&mut numbers, 6.0));
        let expected = plain.accelerations(&theta, &omega);
        let own = |values: &[f64]| -> Vec<f64> { order.iter().map(|link| values[*link]).collect() };
        let found = tree.accelerations(0.0, &own(&theta), &own(&omega));
        let size = expected
            .iter()
            .fold(1.0, |size: f64, alpha| size.max(alpha.abs()));
        for (found, expected) in found.iter().zip(own(&expected)) {
            let apart = (found - expected).abs();
            assert!(apart < 1e-9 * size, "{found} {expected}: {}", plain.text());
        }
    }
}

/// The paper's tree with a spring between its children: θ_d has the stiffness 2 G_2 + 4 κ and the
/// mass 2 M_2, and in phase nothing is changed.
#[test]
fn a_spring_between_siblings_stiffens_their_difference_alone() {
    let paper = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ]";
    let stiffness: f64 = 0.02;
    let free = PendulumTree::parse(paper).unwrap();
    let coupled = format!("{paper}, siblings(child, spring = {stiffness})");
    let coupled = PendulumTree::parse(&coupled).unwrap();
    let own = PendulumTree::parse(&format!(
        "{paper}, between(child_1, child_2, spring = {stiffness})"
    ));
    assert_eq!(
        own.unwrap().modes(&[0.0; 3]).unwrap(),
        coupled.modes(&[0.0; 3]).unwrap()
    );
    let [gravity, inertia] = [
        0.10531 * 9.80665 * 0.043,
        0.516e-3 + 0.10531 * 0.043 * 0.043,
    ];
    let antiphase = ((gravity + 2.0 * stiffness) / inertia).sqrt() / std::f64::consts::TAU;
    let modes = coupled.modes(&[0.0; 3]).unwrap();
    let nearest = |modes: &[f64], wanted: f64| {
        modes.iter().fold(f64::INFINITY, |least: f64, own| {
            least.min((own - wanted).abs())
        })
    };
    assert!(nearest(&modes.frequencies_hz, antiphase) < 1e-12);
    for frequency in &free.modes(&[0.0; 3]).unwrap().frequencies_hz[..] {
        let is_antiphase =
            (frequency - (gravity / inertia).sqrt() / std::f64::consts::TAU).abs() < 1e-9;
        assert!(is_antiphase || nearest(&modes.frequencies_hz, *frequency) < 1e-12);
    }
    // The bits of a motion in phase.
    let ([theta, omega], time) = ([[0.8, 0.3, 0.3], [-1.0, 2.0, 2.0]], 0.0);
    let braked = format!("{paper}, siblings(child, spring = 0.3, friction(coulomb = 0.1))");
    let braked = PendulumTree::parse(&braked).unwrap();
    assert_eq!(
        braked.accelerations(time, &theta, &omega),
        free.accelerations(time, &theta, &omega)
    );
}

/// Springs alone keep the energy in every form of the equations, and friction takes what its
/// power says: the loss is integrated beside the motion.
#[test]
fn energy_is_balanced_in_every_form() {
    let text = "gravity = 9.81,
        a: rod(mass = 0.4, length = 0.5) [
            b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 2] * 2
        ],
        siblings(b, spring = 0.4), siblings(c, spring = 0.2), between(a, c_2_1, spring = 0.3, rest = 0.4)";
    let tree = PendulumTree::parse(text).unwrap();
    let links = tree.links();
    let mut numbers = Numbers(3);
    let values: Vec<f64> = (0..2 * links)
        .map(|place| numbers.between(-1.0, 1.0) * if place < links { 2.0 } else { 4.0 })
        .collect();
    let start = State::new(0.0, values.clone());
    let first = tree.energy_of(start.positions(), start.velocities());
    let drift =
        |state: &State<f64>| (tree.energy_of(state.positions(), state.velocities()) - first).abs();
    let method = Dop853::new(Options::with_tolerance(1e-14));
    let go_on = |_: &mut DenseStep<'_, f64>| ControlFlow::Continue(());
    let end = method
        .integrate(&AbsoluteAngles(&tree), &start, 10.0, go_on)
        .unwrap()
        .state;
    assert!(drift(&end) < 1e-10, "{:e}", drift(&end));
    let taylor = Taylor::new(Options::with_tolerance(1e-14));
    let by_series = taylor
        .integrate(&AbsoluteAngles(&tree), &start, 10.0, go_on)
        .unwrap()
        .state;
    assert!(drift(&by_series) < 1e-10, "{:e}", drift(&by_series));
    let momenta = tree.momenta(start.positions(), start.velocities());
    let canonical = [start.positions(), &momenta].concat();
    let system = CanonicalVariables(&tree);
    let canonical = method
        .integrate(&system, &State::new(0.0, canonical), 3.0, go_on)
        .unwrap()
        .state;
    let angles = method
        .integrate(&AbsoluteAngles(&tree), &start, 3.0, go_on)
        .unwrap()
        .state;
    for (own, other) in canonical.positions().iter().zip(angles.positions()) {
        near(*own, *other, 1e-7);
    }
    let lanes = vec![(AbsoluteAngles(&tree), start.clone()); 5];
    for moved in Ensemble::new().integrate_models_in_lanes(&method, &lanes, 10.0) {
        let state = moved.unwrap().state;
        assert!(drift(&state) < 1e-10, "{:e}", drift(&state));
    }
    // What friction takes.
    let braked = text.replace(
        "rest = 0.4)",
        "rest = 0.4, friction(viscous = 1e-3, coulomb = 0.02, width = 0.3))",
    );
    let tree = PendulumTree::parse(&braked).unwrap();
    let system = WithLoss(&tree);
    let start = State::new(0.0, [values, vec![0.0; 2]].concat());
    let end = method
        .integrate(&system, &start, 10.0, go_on)
        .unwrap()
        .state
        .values;
    let energy = tree.energy_of(&end[..links], &end[links..2 * links]);
    let balance = energy - first - end[2 * links];
    assert!(
        end[2 * links] < -0.01 && balance.abs() < 1e-10,
        "{balance:e}"
    );
}

/// The motion, and the work of friction.
struct WithLoss<'a>(&'a PendulumTree);

impl Ode<f64> for WithLoss<'_> {
    fn dimension(&self) -> usize {
        2 * self.0.links() + 2
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        let links = self.0.links();
        let (theta, omega) = (&state[..links], &state[links..2 * links]);
        rates[..links].copy_from_slice(omega);
        rates[links..2 * links].copy_from_slice(&self.0.accelerations(time, theta, omega));
        rates[2 * links..].copy_from_slice(&[self.0.friction_power(omega), 0.0]);
    }
}

/// In the binary tree of three generations every order of W closes on the exact one, and a
/// spring that couples sectors is refused.
#[test]
fn transfers_know_springs_between_siblings() {
    let text = "gravity = 9.81,
        a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35) * 2],
        siblings(b, spring = 0.4)";
    let tree = PendulumTree::parse(text).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let mut workspace = Workspace::new();
    let mut errors = Vec::new();
    for size in [0.02, 0.01] {
        let (coordinates, momenta) = ([0.9, 0.4, size], [0.03, 0.01, 0.01 * size]);
        let given = Given::Momenta {
            coordinates: &coordinates,
            momenta: &momenta,
        };
        let mut w = [Transfer::default(); 2];
        let mut into = |form| {
            symmetric.transfers(&mut workspace, form, given, &mut w);
            w[1].total()
        };
        let exact = into(TransferForm::Exact);
        errors.push(((into(TransferForm::Amplitude(2)) - exact) / exact).abs());
        assert!(exact.abs() > 1e-9);
    }
    // The next order is the fourth: four times less at half the size.
    assert!((errors[0] / errors[1] - 4.0).abs() < 0.05, "{errors:?}");

    let crossed = text.replace("siblings(b,", "between(a, b_1,");
    let crossed = PendulumTree::parse(&crossed).unwrap();
    assert_eq!(crossed.symmetric().unwrap_err(), TreeError::CoupledSectors);
    assert!(crossed.copies().is_none());
    let damped = text.replace(
        "siblings(b, spring = 0.4)",
        "between(a, b_1, friction = 1e-3)",
    );
    assert!(PendulumTree::parse(&damped).unwrap().symmetric().is_ok());
}

/// A damper on one of two copies, which does nothing at rest, takes them out of phase.
#[test]
fn copies_that_one_damper_brakes_do_not_move_alike() {
    let tree = "gravity = 9.81, a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35, F) * 2]";
    let start = State::at_rest(0.0, &[0.9, 0.4, 0.4]);
    let copies = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
    for (friction, clause, are_alike) in [
        ("friction = 1e-3", "", true),
        (
            "friction = 1e-3",
            ", siblings(b, spring = 0.1, friction = 1e-3)",
            true,
        ),
        (
            "friction = 1e-3",
            ", between(a, b_1, friction = 1e-3)",
            false,
        ),
        ("friction = each(1e-3, 2e-3)", "", false),
    ] {
        let text = format!("{}{clause}", tree.replace('F', friction));
        let tree = PendulumTree::parse(&text).unwrap();
        let found = copies.are_in_phase(&AbsoluteAngles(&tree), &start);
        assert_eq!(found, are_alike, "{text}");
    }
}

#[test]
fn clauses_that_say_nothing_are_refused() {
    let tree = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2]";
    for (clause, message) in [
        ("between(a, b_1)", "neither spring nor friction"),
        ("between(a, a, spring = 1)", "does not name two links"),
        ("between(a, c, spring = 1)", "no link is called `c`"),
        (
            "between(a, b_1, spring = -1)",
            "spring of `between(a, b_1)`",
        ),
        ("between(a, b_1, rest = 1)", "rest angle, but no spring"),
        (
            "between(a, b_1, mass = 1)",
            "`between` has no property `mass`",
        ),
        ("siblings(a, spring = 1)", "`a` has no copies"),
        (
            "siblings(b, spring = 1, rest = 1)",
            "`siblings` has no property `rest`",
        ),
        ("siblings(b, b, spring = 1)", "does not name one node"),
        (
            "between(a, b_1, spring = each(1, 2))",
            "there are no copies",
        ),
        (
            "siblings(b, spring = 1), in_phase(b)",
            "a link in phase stands for several",
        ),
    ] {
        let found = PendulumTree::parse(&format!("{tree}, {clause}"))
            .unwrap_err()
            .to_string();
        assert!(found.contains(message), "{clause}: {found}");
    }
}
