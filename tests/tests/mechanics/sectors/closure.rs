//! Budgets along a trajectory: what flows into a sector is what it gains.

use branched_pendulum::integrate::{Dop853, Integrator, Options};
use branched_pendulum::system::{OdeFn, State};
use branched_pendulum_codegen::functions::{Argument, Purpose, ResultShape};
use branched_pendulum_codegen::program::Entry;
use branched_pendulum_compiler_tests::random::Random;

use super::oracle::DEFINITIONS;
use crate::support::{Compiled, compile};

const LINKS: usize = 15;
const SECTORS: usize = 8;

/// Four generations with friction in every joint, shaken and turned at the
/// root.
const SCENE: &str = "gravity = 9.80665, \
    arm: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3, \
        mass_ratio = 0.5, length_ratio = 0.7, friction = 2e-5, drag = 1e-5), \
    drive(torque = 0.05 * cos(7 * t), x = 0.01 * sin(9 * t), y = 0.004 * cos(23 * t)), \
    emit(energies, budget(canonical, parseval, velocity, rest))";

/// Accelerations and all budgets as one entry point, so that a step costs one
/// evaluation.
fn in_one_go() -> Compiled {
    let mut compiled = compile(SCENE);
    let entries = std::iter::once("accelerations").chain(DEFINITIONS.map(|(_, entry)| entry));
    let outputs = entries.flat_map(|name| {
        let entry = compiled.program.entry(name).expect("asked for");
        entry.outputs.clone()
    });
    let everything = Entry {
        name: "everything".to_owned(),
        purpose: Purpose::Accelerations,
        arguments: vec![Argument::Time, Argument::Theta, Argument::Omega],
        outputs: outputs.collect(),
        shape: ResultShape::Vector,
    };
    compiled.program.entries.push(everything);
    compiled
}

#[test]
fn every_budget_closes_over_ten_seconds() {
    let compiled = in_one_go();
    let evaluate = |time: f64, state: &[f64]| {
        let (theta, omega) = (&state[..LINKS], &state[LINKS..2 * LINKS]);
        compiled.evaluate("everything", &[&[time], theta, omega])
    };
    let budgets = |time: f64, state: &[f64]| {
        let all = evaluate(time, state);
        let budgets = all[LINKS..].chunks(3 * SECTORS).map(<[f64]>::to_vec);
        budgets.collect::<Vec<Vec<f64>>>()
    };
    // The state is followed by ∫ (W + P) dt of every sector and definition.
    let dimension = 2 * LINKS + DEFINITIONS.len() * SECTORS;
    let system = OdeFn::new(dimension, |time: f64, state: &[f64], rates: &mut [f64]| {
        let all = evaluate(time, state);
        let (alpha, budgets) = all.split_at(LINKS);
        rates[..LINKS].copy_from_slice(&state[LINKS..2 * LINKS]);
        rates[LINKS..2 * LINKS].copy_from_slice(alpha);
        for (budget, rates) in budgets
            .chunks(3 * SECTORS)
            .zip(rates[2 * LINKS..].chunks_mut(SECTORS))
        {
            for (sector, rate) in rates.iter_mut().enumerate() {
                *rate = budget[SECTORS + sector] + budget[2 * SECTORS + sector];
            }
        }
    });
    let mut random = Random::new(17);
    let mut start = random.around_zero(LINKS, 0.6);
    start.extend(random.around_zero(LINKS, 1.0));
    start.resize(dimension, 0.0);
    let first = budgets(0.0, &start);
    let times: Vec<f64> = (1..=100).map(|k| 0.1 * f64::from(k)).collect();
    let mut errors = [[0.0_f64; SECTORS]; 4];
    let mut largest = [0.0_f64; 4];
    let mut powers = [0.0_f64; SECTORS];
    Dop853::new(Options::with_tolerance(1e-9))
        .sample(&system, &State::new(0.0, start), &times, |time, state| {
            let now = budgets(time, state);
            let flows = state[2 * LINKS..].chunks(SECTORS);
            for (definition, (now, flow)) in now.iter().zip(flows).enumerate() {
                for sector in 0..SECTORS {
                    let gained = now[sector] - first[definition][sector];
                    let error = &mut errors[definition][sector];
                    *error = error.max((flow[sector] - gained).abs());
                    largest[definition] = largest[definition].max(now[sector].abs());
                    powers[sector] = powers[sector].max(now[2 * SECTORS + sector].abs());
                }
            }
        })
        .expect("the run succeeds");
    // Every sector is fed or braked, or leaving powers out would not show.
    assert!(powers.iter().all(|power| *power > 1e-6), "{powers:?}");
    for (((_, entry), errors), largest) in DEFINITIONS.iter().zip(&errors).zip(&largest) {
        let worst = errors.iter().fold(0.0_f64, |most, error| most.max(*error));
        println!("{entry}: {worst:.2e} J of {largest:.2e} J");
        assert!(
            worst <= 1e-9 * largest,
            "{entry}: {worst:e} J of {largest:e} J"
        );
    }
}
