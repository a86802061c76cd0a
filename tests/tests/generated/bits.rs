//! Emitted code agrees with its program bit for bit: what the interpreter
//! computes operation by operation is what the compiled function returns.

use std::collections::BTreeMap;

use branched_pendulum::tree::{BodyEquations, LinkEquations, LinkMotion, Row};
use branched_pendulum::{Budget, Scalar, Transfer};
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::scene;
use branched_pendulum_tests::scenes::{
    blades::Blades,
    branch::{Branch, BranchParameters},
    chain::Chain,
    driven::{Driven, DrivenParameters},
    driven_loops::{DrivenLoops, DrivenLoopsEquations, DrivenLoopsParameters},
    generations::Generations,
    nested::Nested,
    observed::{Observed, ObservedParameters},
    offset::Offset,
    paper::Paper,
    paper_expanded,
    simple::Simple,
    sweep::{Sweep, SweepParameters},
    triplet::Triplet,
    unequal::Unequal,
};

const STATES: usize = 200;

/// Results of a compiled function, as a list.
trait Values {
    fn values(self) -> Vec<f64>;
}

impl Values for f64 {
    fn values(self) -> Vec<f64> {
        vec![self]
    }
}

impl<const N: usize> Values for [f64; N] {
    fn values(self) -> Vec<f64> {
        self.to_vec()
    }
}

impl<const N: usize, const M: usize> Values for [[f64; N]; M] {
    fn values(self) -> Vec<f64> {
        self.concat()
    }
}

impl Values for Transfer<f64> {
    fn values(self) -> Vec<f64> {
        vec![self.kinetic, self.potential]
    }
}

impl<const S: usize> Values for [Transfer<f64>; S] {
    fn values(self) -> Vec<f64> {
        self.into_iter().flat_map(Values::values).collect()
    }
}

impl<const S: usize> Values for Budget<f64, S> {
    fn values(self) -> Vec<f64> {
        [self.energies, self.transfers, self.powers].concat()
    }
}

/// Compares functions of a compiled model with the entries of the same name.
macro_rules! agree {
    ($scene:literal, $model:expr, $parameters:expr, $n:literal,
     $(timed: [$($timed:ident),*], rates: [$($rates:ident),*],)?
     $(forces: [$($forces:ident),*], under: [$($under:ident),*], fed: [$($fed:ident),*],
       braked: [$($braked:ident),*], none: [$($none:ident),*],)?
     two: [$($two:ident),*], one: [$($one:ident),*]) => {{
        let stages = scene($scene);
        let model = $model;
        let parameters: &[f64] = &$parameters;
        let mut random = Random::new(7);
        let mut checked = 0;
        let mut ready = BTreeMap::new();
        for _ in 0..STATES {
            let first: [f64; $n] = random.array(-4.0, 4.0);
            let second: [f64; $n] = random.array(-9.0, 9.0);
            let time = random.between(-5.0, 50.0);
            let third: [f64; $n] = random.array(-2.0, 2.0);
            let pushes: [[f64; 2]; $n] = std::array::from_fn(|_| random.array(-3.0, 3.0));
            let input = |argument: Argument, index: usize| match argument {
                Argument::Omega
                | Argument::Rates
                | Argument::AbsoluteMomenta
                | Argument::Momenta => second[index],
                Argument::Time => time,
                Argument::Torques => third[index],
                Argument::Forces => pushes[index / 2][index % 2],
                _ => first[index],
            };
            let mut compare = |name: &'static str, compiled: Vec<f64>| {
                let interpreter = ready.entry(name).or_insert_with(|| {
                    let interpreter = stages.program.interpreter(name, parameters);
                    interpreter.unwrap_or_else(|| panic!("no entry {name}"))
                });
                let interpreted = interpreter.evaluate(Scalar::sin_cos, input);
                let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&compiled), bits(&interpreted), "{name} at {first:?}, {second:?}");
            };
            $($(compare(stringify!($forces), model.$forces(&first, &pushes).values());
                checked += 1;)*
            $(compare(stringify!($under), model.$under(&first, &second, &third).values());
                checked += 1;)*
            $(compare(stringify!($fed), model.$fed(&second, &third).values()); checked += 1;)*
            $(compare(stringify!($braked), model.$braked(&second).values()); checked += 1;)*
            $(compare(stringify!($none), model.$none().values()); checked += 1;)*)?
            $($(compare(stringify!($timed), model.$timed(time, &first, &second).values());
                checked += 1;)*
            $(compare(stringify!($rates), model.$rates(&second).values()); checked += 1;)*)?
            $(compare(stringify!($two), model.$two(&first, &second).values()); checked += 1;)*
            $(compare(stringify!($one), model.$one(&first).values()); checked += 1;)*
        }
        // Every entry of the scene is among those compared.
        assert_eq!(checked, STATES * stages.program.entries.len());
    }};
}

#[test]
fn branch() {
    let parameters = BranchParameters {
        twig_mass: 0.03,
        twig_length: 0.2,
    };
    agree!("branch", Branch::new(parameters).unwrap(), [0.03, 0.2], 5,
        forces: [pivot_torques, centre_torques, end_torques], under: [accelerations_under],
        fed: [outside_power], braked: [friction_power], none: [link_properties],
        two: [accelerations, kinetic_energy, momenta, velocities, canonical_rates,
              pivot_velocities, centre_velocities, end_velocities],
        one: [potential_energy, pivots, centres, ends]);
}

#[test]
fn simple() {
    agree!("simple", Simple::new(), [], 1, two: [accelerations], one: []);
}

/// The paper's scene, by the macro and as committed.
macro_rules! paper_agrees {
    ($model:expr) => {
        agree!("paper", $model, [], 3,
            two: [accelerations, kinetic_energy, momenta, velocities, canonical_rates, symmetric_accelerations,
                  symmetric_momenta, symmetric_velocities, hamiltonian, antiphase_energy,
                  transfer_angle_1, transfer_amplitude_2, transfer_quadratic_form,
                  transfer_exact, transfer_exact_from_rates],
            one: [potential_energy, mass_matrix, stiffness_matrix, to_symmetric, from_symmetric])
    };
}

#[test]
fn paper() {
    paper_agrees!(Paper::new());
}

#[test]
fn committed_expansion_of_the_paper() {
    paper_agrees!(paper_expanded::Paper::new());
}

#[test]
fn chain() {
    agree!("chain", Chain::new(), [], 2,
        two: [accelerations, kinetic_energy], one: [potential_energy]);
}

#[test]
fn triplet() {
    agree!("triplet", Triplet::new(), [], 4,
        two: [accelerations, momenta, velocities, canonical_rates, symmetric_accelerations, symmetric_momenta,
              symmetric_velocities, antiphase_energy_d1, antiphase_energy_d2,
              transfer_amplitude_2_d1, transfer_amplitude_2_d2, transfer_quadratic_form_d1,
              transfer_quadratic_form_d2, transfer_exact_d1, transfer_exact_d2,
              transfer_exact_from_rates_d1, transfer_exact_from_rates_d2,
              antiphase_friction_power_d1, antiphase_friction_power_d2,
              antiphase_friction_power_from_rates_d1, antiphase_friction_power_from_rates_d2],
        one: [to_symmetric, from_symmetric]);
}

#[test]
fn unequal() {
    agree!("unequal", Unequal::new(), [], 3,
        two: [accelerations, kinetic_energy, momenta, velocities, canonical_rates, symmetric_accelerations,
              symmetric_momenta, symmetric_velocities, hamiltonian, antiphase_energy,
              transfer_exact, transfer_exact_from_rates, transfer_growth,
              transfer_growth_from_rates, transfer_forcing, transfer_forcing_from_rates,
              antiphase_friction_power, antiphase_friction_power_from_rates],
        one: [potential_energy, mass_matrix, stiffness_matrix, to_symmetric, from_symmetric]);
}

/// Functions of angles and of actions.
#[test]
fn blades() {
    let (stages, model) = (scene("blades"), Blades::new());
    let mut random = Random::new(7);
    for _ in 0..STATES {
        let [theta, omega]: [[f64; 3]; 2] = [4.0, 9.0].map(|most| random.array(-most, most));
        let actions: [f64; 2] = random.array(0.0, 0.1);
        let compiled = [
            (
                "accelerations",
                model.accelerations(&theta, &omega).to_vec(),
            ),
            ("kinetic_energy", vec![model.kinetic_energy(&theta, &omega)]),
            ("potential_energy", vec![model.potential_energy(&theta)]),
            (
                "normal_form_actions",
                model.normal_form_actions(&theta).to_vec(),
            ),
            (
                "normal_form_frequencies",
                model.normal_form_frequencies(&actions).to_vec(),
            ),
            (
                "normal_form_coupling",
                vec![model.normal_form_coupling(&actions)],
            ),
            (
                "normal_form_growth_rate_squared",
                vec![model.normal_form_growth_rate_squared(&actions)],
            ),
            (
                "normal_form_thresholds",
                model.normal_form_thresholds(&theta).to_vec(),
            ),
        ];
        assert_eq!(compiled.len(), stages.program.entries.len());
        for (name, compiled) in compiled {
            let input = |argument: Argument, index: usize| match argument {
                Argument::Actions => actions[index],
                Argument::Omega => omega[index],
                Argument::Theta => theta[index],
                other => unreachable!("no function of this scene takes {other:?}"),
            };
            let interpreted = stages.program.evaluate(Scalar::sin_cos, name, &[], input);
            let interpreted = interpreted.unwrap_or_else(|| panic!("no entry {name}"));
            let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&compiled), bits(&interpreted), "{name}");
        }
    }
}

#[test]
fn offset() {
    agree!("offset", Offset::new(), [], 3,
        two: [accelerations, kinetic_energy], one: [potential_energy]);
}

#[test]
fn observed() {
    let model = Observed::new(ObservedParameters { m: 0.10531 }).expect("possible parameters");
    agree!("observed", model, [0.10531], 3,
        two: [accelerations, momenta, velocities, canonical_rates, symmetric_accelerations, symmetric_momenta,
              symmetric_velocities,
              twist, twist_rate, twist_friction_rate, twist_from_momenta, twist_rate_from_momenta,
              height, height_rate, height_from_momenta, height_rate_from_momenta,
              energy, energy_rate, energy_friction_rate, energy_from_momenta,
              energy_rate_from_momenta,
              antiphase, antiphase_rate, antiphase_friction_rate, antiphase_from_momenta,
              antiphase_rate_from_momenta,
              mixed, mixed_rate, mixed_friction_rate, mixed_from_momenta,
              mixed_rate_from_momenta],
        one: [to_symmetric, from_symmetric]);
}

#[test]
fn sweep() {
    let parameters = SweepParameters {
        g: 9.7,
        trunk_mass: 0.21,
        c: 3e-3,
        twig_length: 0.17,
    };
    let model = Sweep::new(parameters).expect("possible parameters");
    agree!("sweep", model, [9.7, 0.21, 3e-3, 0.17], 3,
        two: [accelerations, momenta, velocities, canonical_rates], one: []);
}

#[test]
fn driven() {
    let parameters = DrivenParameters {
        push: 0.3,
        pace: 7.1,
        phase: -0.4,
        sway: 0.05,
    };
    let model = Driven::new(parameters).expect("possible parameters");
    agree!("driven", model, [0.3, 7.1, -0.4, 0.05], 3,
        timed: [accelerations, canonical_rates, symmetric_accelerations, drive_power,
                antiphase_drive_power, antiphase_drive_power_from_rates],
        rates: [friction_power],
        two: [kinetic_energy, momenta, velocities, symmetric_momenta, symmetric_velocities,
              hamiltonian, antiphase_energy, transfer_exact, transfer_exact_from_rates,
              antiphase_friction_power, antiphase_friction_power_from_rates],
        one: [potential_energy, to_symmetric, from_symmetric]);
}

#[test]
fn nested() {
    agree!("nested", Nested::new(), [], 7,
        timed: [accelerations, canonical_rates, symmetric_accelerations, budget_rest, budget_canonical,
                budget_velocity, budget_parseval, symmetric_budget_rest,
                symmetric_budget_canonical, symmetric_budget_velocity,
                symmetric_budget_parseval],
        rates: [],
        two: [momenta, velocities, symmetric_momenta, symmetric_velocities, sector_transfers,
              sector_transfer_matrix, symmetric_sector_transfers, symmetric_sector_transfer_matrix,
              sector_transfers_amplitude_2, sector_transfers_amplitude_4],
        one: [mass_matrix, stiffness_matrix, to_symmetric, from_symmetric]);
}

/// A function whose parts share their values in an array computes what an
/// undivided one would; places of the array serve several values.
#[test]
fn functions_in_parts() {
    let tokens = scene("generations").tokens().to_string();
    for part in ["budget_parseval_part_1", "budget_parseval_part_2"] {
        assert!(tokens.contains(&format!("fn {part} ")), "no {part}");
    }
    let function = tokens.split("pub fn ");
    let mut function = function.filter(|code| code.starts_with("budget_parseval "));
    let function = function.next().expect("the scene has it");
    let given = function.matches("; shared_values [").count();
    let size = function
        .split_once("let mut shared_values = [T :: from_f64 (0.0) ; ")
        .and_then(|(_, rest)| rest.split_once(']'))
        .and_then(|(size, _)| size.trim().parse::<usize>().ok());
    let size = size.expect("the parts share an array");
    assert!(given > size, "{given} values in {size} places");
    agree!("generations", Generations::new(), [], 15,
        two: [accelerations, budget_rest, budget_canonical, budget_velocity, budget_parseval,
              sector_transfers, sector_transfer_matrix], one: []);
}

/// The functions of one link in loops, on rows of any numbers.
#[test]
fn functions_of_a_link_in_loops() {
    type E = DrivenLoopsEquations;
    let stages = scene("driven_loops");
    let parameters = DrivenLoopsParameters {
        push: 0.3,
        pace: 7.1,
    };
    let model = DrivenLoops::new(parameters).expect("possible parameters");
    let mut random = Random::new(7);
    let mut compared = std::collections::BTreeSet::new();
    for _ in 0..STATES {
        let constants: <E as LinkEquations>::Constants<f64> = row(&mut random);
        let [sine, cosine, omega, joint_angle, joint_rate] = random.array(-2.0, 2.0);
        let link = LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque: 0.0,
            prescribed: 0.0,
        };
        let response: <E as LinkEquations>::Response<f64> = row(&mut random);
        let sums: <E as LinkEquations>::Sums<f64> = row(&mut random);
        let elimination: <E as LinkEquations>::Elimination<f64> = row(&mut random);
        let carried: <E as LinkEquations>::Carried<f64> = row(&mut random);
        let pivot: [f64; 2] = row(&mut random);
        let body: <E as BodyEquations>::Body<f64> = row(&mut random);
        let given: [f64; 3] = row(&mut random);
        let [x, y, _] = given;
        let time = random.between(-5.0, 50.0);
        let input = |argument: Argument, index: usize| match argument {
            Argument::Constants => constants[index],
            Argument::Motion => [sine, cosine, omega, joint_angle, joint_rate][index],
            Argument::Response => response[index],
            Argument::Sums => sums[index],
            Argument::Elimination => elimination[index],
            Argument::Carried => carried[index],
            Argument::Pivot => pivot[index],
            Argument::Body => body[index],
            Argument::Given(_) => given[index],
            _ => time,
        };
        let (answer, kept) = E::inner(&constants, link, sums);
        let (alpha, handed_down) = E::accelerate(&constants, link, elimination, pivot);
        let compiled = [
            ("leaf", E::leaf(&constants, link).to_vec()),
            ("attach", E::attach(&constants, link, response).to_vec()),
            ("inner", [answer.as_slice(), &kept].concat()),
            ("pivot", E::pivot(&constants, link, carried).to_vec()),
            ("accelerate", [&[alpha], handed_down.as_slice()].concat()),
            (
                "accelerate_leaf",
                vec![E::accelerate_leaf(&constants, link, pivot)],
            ),
            (
                "pivot_velocity",
                E::pivot_velocity(&body, link, [x, y]).to_vec(),
            ),
            (
                "kinetic_energy",
                E::kinetic_energy(&body, link, [x, y]).to_vec(),
            ),
            (
                "potential_energy",
                E::potential_energy(&body, link).to_vec(),
            ),
            ("friction_loss", E::friction_loss(&body, link).to_vec()),
            ("drive_power", E::drive_power(&body, link, given).to_vec()),
            ("drive", model.drive(time).to_vec()),
        ];
        for (name, compiled) in compiled {
            let program = &stages.program;
            let interpreted = program.evaluate(Scalar::sin_cos, name, &[0.3, 7.1], input);
            let interpreted = interpreted.unwrap_or_else(|| panic!("no entry {name}"));
            let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&compiled), bits(&interpreted), "{name}");
            compared.insert(name);
        }
    }
    // What the model alone sees are gravity and drive at the root.
    compared.extend(["root_gravity", "root_drive"]);
    let entries = stages.program.entries.iter();
    assert!(entries.map(|entry| entry.name.as_str()).eq([
        "leaf",
        "attach",
        "inner",
        "pivot",
        "accelerate",
        "accelerate_leaf",
        "pivot_velocity",
        "kinetic_energy",
        "potential_energy",
        "friction_loss",
        "drive_power",
        "root_gravity",
        "root_drive",
        "drive"
    ]));
    assert_eq!(compared.len(), stages.program.entries.len());
}

fn row<R: Row<f64>>(random: &mut Random) -> R {
    let mut row = R::filled(0.0);
    for value in row.as_mut() {
        *value = random.between(-2.0, 2.0);
    }
    row
}

#[test]
fn single_precision_is_the_same_code() {
    let (single, double) = (Paper::<f32>::default(), Paper::new());
    let mut random = Random::new(3);
    for _ in 0..STATES {
        let theta: [f32; 3] = random.array(-3.0, 3.0).map(|x: f64| x as f32);
        let omega: [f32; 3] = random.array(-3.0, 3.0).map(|x: f64| x as f32);
        let low = single.accelerations(&theta, &omega);
        let high = double.accelerations(&theta.map(f64::from), &omega.map(f64::from));
        let scale = high.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        for (low, high) in low.iter().zip(high) {
            assert!((f64::from(*low) - high).abs() < 200.0 * f64::from(f32::EPSILON) * scale);
        }
    }
}
