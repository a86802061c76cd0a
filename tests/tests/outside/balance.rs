//! Energy against the work of all that acts from outside, in every form of tree.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{Action, Computes, Workspace, functions};
use branched_pendulum_compiler_tests::random::Random;

use super::gusts::Gusts;

/// A pendulum under torques, beside its state the work of these and of other powers.
struct WithWork<'m, P, Q, W> {
    model: &'m P,
    torques: Q,
    /// Q·ω as the model gives it, and the powers of friction and drive.
    power: W,
}

impl<P, Q, W> Ode<f64> for WithWork<'_, P, Q, W>
where
    P: Pendulum<f64> + Computes<functions::AccelerationsUnderTorques, f64>,
    Q: Action<f64>,
    W: Fn(f64, &[f64], &[f64], &[f64]) -> f64,
{
    fn dimension(&self) -> usize {
        2 * self.model.links() + 1
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        rates: &mut [f64],
    ) {
        let (model, links) = (self.model, self.model.links());
        let (theta, rest) = state.split_at(links);
        let omega = &rest[..links];
        let mut torques = vec![0.0; links];
        self.torques.act(time, theta, omega, &mut torques);
        let (velocities, rest) = rates.split_at_mut(links);
        velocities.copy_from_slice(omega);
        let (alpha, work) = rest.split_at_mut(links);
        model.accelerations_under_with(workspace, time, theta, omega, &torques, alpha);
        work[0] = (self.power)(time, theta, omega, &torques);
    }
}

/// Checks that E(2 s) − E(0) is the work, to 1e-10 of the larger of the energies.
fn energy_closes<P>(model: &P, power: impl Fn(f64, &[f64], &[f64], &[f64]) -> f64)
where
    P: Positions<f64> + Energy<f64> + Computes<functions::AccelerationsUnderTorques, f64>,
{
    let links = model.links();
    let energy = |values: &[f64]| {
        let (theta, omega) = (&values[..links], &values[links..2 * links]);
        model.kinetic_energy_of(theta, omega) + model.potential_energy_of(theta)
    };
    for seed in 0..3 {
        let mut random = Random::new(80 + seed);
        let mut values = random.around_zero(2 * links, 0.5);
        values.push(0.0);
        let start = State::new(0.0, values);
        let system = WithWork {
            model,
            torques: Gusts::new(model, seed),
            power: &power,
        };
        let method = Dop853::new(Options::with_tolerance(1e-13));
        let end = method.run(&system, &start, 2.0).expect("it goes on").state;
        let energies = [energy(&start.values), energy(&end.values)];
        let work = end.values[2 * links];
        let size = energies[0].abs().max(energies[1].abs());
        let error = energies[1] - energies[0] - work;
        println!("{energies:?} {work} {error:e}");
        assert!(work.abs() > 0.01 * size, "work {work} of {size}");
        assert!(error.abs() < 1e-10 * size, "{error:e} of {size}");
    }
}

fn dot(torques: &[f64], omega: &[f64]) -> f64 {
    torques.iter().zip(omega).map(|(q, w)| q * w).sum()
}

/// The power functions of a model whose functions take arrays.
macro_rules! closes {
    ($model:expr, drive: $drive:expr) => {{
        let model = $model;
        energy_closes(&model, |time, theta, omega, torques| {
            let [theta, omega, torques] =
                [theta, omega, torques].map(|values| values.try_into().expect("all links"));
            let outside = model.outside_power(omega, torques);
            assert!((outside - dot(torques, omega)).abs() < 1e-14);
            outside + model.friction_power(omega) + $drive(&model, time, theta, omega)
        });
    }};
}

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
            joint = (0.25, 0.03), spring = 0.1, friction = 1e-2) [
            twig: rod(mass = 0.03, length = 0.2, drag = 1e-3) * 2
        ],
        shoot(mass = 0.05, com = 0.1, inertia = 1e-4),
    ],
    emit(energies, positions, forces),
)]
struct Written;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
            joint = (0.25, 0.03), spring = 0.1, friction = 1e-2) [
            twig: rod(mass = 0.03, length = 0.2, drag = 1e-3) * 2
        ],
        shoot(mass = 0.05, com = 0.1, inertia = 1e-4),
    ],
    emit(energies, positions, forces),
)]
pub(super) struct Irregular;

#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 4, branching = 2, shape = rod, mass = 0.4, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.7, friction = 1e-3, friction_ratio = 0.1, code = loops),
    emit(energies, positions, forces),
)]
pub(super) struct ByGeneration;

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        twig: rod(mass = 0.1, length = 0.3, friction = 1e-3) * 2
    ],
    drive(torque = 0.3 * cos(3 * t), x = 0.02 * sin(5 * t), y = 0.01 * cos(4 * t)),
    emit(energies, positions, forces),
)]
struct Driven;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        twig: rod(mass = 0.1, length = 0.3, friction = 1e-3) * 2
    ],
    drive(torque = 0.3 * cos(3 * t), x = 0.02 * sin(5 * t), y = 0.01 * cos(4 * t)),
    emit(energies, positions, forces),
)]
struct DrivenInLoops;

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        bough: rod(mass = 0.1, length = 0.3, friction = 1e-3) [
            twig: rod(mass = 0.03, length = 0.2, drag = 1e-4) * 2
        ] * 3,
        hook(mass = 0.05, com = 0.1, inertia = 1e-4),
    ],
    in_phase(all),
    locked(hook, 0.7),
    emit(energies, positions, forces),
)]
struct Reduced;

#[test]
fn of_trees_written_out() {
    closes!(Written::new(), drive: |_, _, _, _| 0.0);
}

#[test]
fn of_trees_in_loops_over_links() {
    closes!(Irregular::new(), drive: |_, _, _, _| 0.0);
}

#[test]
fn of_trees_in_loops_over_generations() {
    let model = ByGeneration::<f64>::new();
    energy_closes(&model, |_, _, omega, torques| {
        model.outside_power(omega, torques) + model.friction_power(omega)
    });
}

#[test]
fn of_driven_trees() {
    closes!(Driven::new(), drive: |model: &Driven, time, theta, omega| {
        model.drive_power(time, theta, omega)
    });
    closes!(DrivenInLoops::new(), drive: |model: &DrivenInLoops, time, theta: &[f64], omega: &[f64]| {
        model.drive_power(time, theta, omega)
    });
}

#[test]
fn of_reduced_trees() {
    closes!(Reduced::new(), drive: |_, _, _, _| 0.0);
}

/// Each sector's energy against its transfers and the powers in it.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        twig: rod(mass = 0.1, length = 0.3, friction = 1e-3) * 3
    ],
    emit(energies, positions, forces, budget(rest, canonical, velocity, parseval)),
)]
struct Budgeted;

#[test]
fn of_sectors() {
    const LINKS: usize = 4;
    let model = Budgeted::new();
    let gusts = Gusts::new(&model, 5);
    let arrays = |values: &[f64]| -> [[f64; LINKS]; 2] {
        [0, LINKS].map(|from| values[from..from + LINKS].try_into().expect("all links"))
    };
    let budgets = |time: f64, values: &[f64]| {
        let [theta, omega] = arrays(values);
        let mut torques = [0.0; LINKS];
        gusts.act(time, &theta, &omega, &mut torques);
        let all = [
            model.budget_rest_under(&theta, &omega, &torques),
            model.budget_canonical_under(&theta, &omega, &torques),
            model.budget_velocity_under(&theta, &omega, &torques),
            model.budget_parseval_under(&theta, &omega, &torques),
        ];
        let whole = model.outside_power(&omega, &torques) + model.friction_power(&omega);
        let of_sectors: f64 = all[3].powers.iter().sum();
        assert!((of_sectors - whole).abs() < 1e-12);
        let still = model.budget_parseval_under(&theta, &omega, &[0.0; LINKS]);
        let free = model.budget_parseval(&theta, &omega);
        for sector in 0..3 {
            assert_eq!(still.energies[sector], free.energies[sector]);
            assert!((still.powers[sector] - free.powers[sector]).abs() < 1e-15);
        }
        all
    };
    let system = branched_pendulum::system::OdeFn::new(
        2 * LINKS + 12,
        |time: f64, state: &[f64], rates: &mut [f64]| {
            let [theta, omega] = arrays(state);
            let mut torques = [0.0; LINKS];
            gusts.act(time, &theta, &omega, &mut torques);
            rates[..LINKS].copy_from_slice(&omega);
            let alpha = model.accelerations_under(&theta, &omega, &torques);
            rates[LINKS..2 * LINKS].copy_from_slice(&alpha);
            let feeds = budgets(time, state)
                .into_iter()
                .flat_map(|budget| (0..3).map(move |s| budget.transfers[s] + budget.powers[s]));
            for (rate, feed) in rates[2 * LINKS..].iter_mut().zip(feeds) {
                *rate = feed;
            }
        },
    );
    let mut values = Random::new(9).around_zero(2 * LINKS, 0.5);
    values.resize(2 * LINKS + 12, 0.0);
    let start = State::new(0.0, values);
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let end = method.run(&system, &start, 2.0).expect("it goes on").state;
    let energies = |state: &State<f64>| -> Vec<f64> {
        let all = budgets(state.time, &state.values).into_iter();
        all.flat_map(|budget| budget.energies).collect()
    };
    let (before, after) = (energies(&start), energies(&end));
    for (place, work) in end.values[2 * LINKS..].iter().enumerate() {
        let error = after[place] - before[place] - work;
        assert!(
            error.abs() < 1e-10,
            "{place}: {error:e} of {}",
            after[place]
        );
    }
}
