//! Promises of budgets by scale: sums, rates, antisymmetry, exact zeros,
//! many states at once.

use super::*;
use branched_pendulum::scalar::{Dual, Lanes};
use branched_pendulum::system::{Computes, functions};

/// Rounding errors of sums over generations.
const ROUNDING: f64 = 1e-14;

fn scales<M: Scales<f64>>() -> std::ops::Range<usize> {
    0..M::COPIES.len()
}

fn closes<M: Energy<f64> + Scales<f64>>(model: &M) {
    for sample in samples(model.links(), if model.links() > 31 { 2 } else { 20 }) {
        let own = budget(model, &sample);
        let (kinetic, potential) = (
            model.kinetic_energy_of(&sample.theta, &sample.omega),
            model.potential_energy_of(&sample.theta),
        );
        let sum: f64 = scales::<M>().map(|scale| own.energy(scale)).sum();
        let size = kinetic + potential.abs();
        assert!((sum - (kinetic + potential)).abs() < 10.0 * ROUNDING * size);
        let count = M::COPIES.len();
        for scale in scales::<M>() {
            let parts: f64 = (0..count).map(|g| own.energy_of(scale, g)).sum();
            assert_eq!(parts, own.energy(scale));
            assert!((0..scale).all(|generation| own.energy_of(scale, generation) == 0.0));
            for other in scales::<M>() {
                assert_eq!(own.transfer(scale, other), -own.transfer(other, scale));
            }
        }
        assert!(own.energy(count).is_nan() && own.flux(count).is_nan());
        // The flux is what the scales from one on receive from those above.
        for scale in 1..count {
            let received: f64 = (scale..count).map(|s| own.received(s)).sum();
            let most = (scale..count).map(|s| own.received(s).abs()).sum::<f64>();
            assert!((own.flux(scale) - received).abs() <= 10.0 * ROUNDING * most);
        }
    }
}

#[test]
fn energies_sum_to_that_of_the_tree() {
    closes(&Seven::new());
    closes(&Fifteen::new());
    closes(&ThirtyOne::new());
    closes(&Thirteen::new());
    closes(&Coupled::new());
    closes(&CoupledThrees::new());
}

/// Rows and powers are the rates of the energies along the motion, which dual numbers
/// differentiate.
fn are_rates<M, D>(model: &M, dual: &D)
where
    M: Pendulum<f64> + Computes<functions::AccelerationsUnderTorques, f64> + Scales<f64>,
    D: Scales<Dual<f64, 1>>,
{
    let mut worst = 0.0_f64;
    for sample in samples(model.links(), if model.links() > 31 { 2 } else { 20 }) {
        let own = budget(model, &sample);
        let mut alpha = vec![0.0; model.links()];
        let Sample {
            time,
            theta,
            omega,
            torques,
        } = &sample;
        model.accelerations_under_into(*time, theta, omega, torques, &mut alpha);
        let along = |at: &[f64], slope: &[f64]| -> Vec<Dual<f64, 1>> {
            let both = at.iter().zip(slope);
            both.map(|(&value, &slope)| {
                Dual::constant(value) + Dual::variable(0.0, 0) * Dual::constant(slope)
            })
            .collect()
        };
        let (theta, omega) = (along(theta, omega), along(omega, &alpha));
        let mut moving = ScaleBudget::new();
        dual.energies_by_scale(&mut Workspace::new(), &theta, &omega, &mut moving);
        let scales = scales::<M>();
        let rates: Vec<f64> = scales
            .map(|scale| moving.energy(scale).tangents[0])
            .collect();
        let size = rates
            .iter()
            .fold(0.0_f64, |most, rate| most.max(rate.abs()));
        for (scale, rate) in rates.into_iter().enumerate() {
            let error = own.received(scale) + own.power(scale) - rate;
            worst = worst.max(error.abs() / size);
        }
    }
    println!("{} links: {worst:.1e}", model.links());
    let generations = M::COPIES.len() as f64;
    assert!(worst < 10.0 * generations * ROUNDING, "{worst:e}");
}

#[test]
fn rows_and_powers_are_rates() {
    let dual = |x: f64| Dual::<f64, 1>::constant(x);
    let seven = Seven::<f64>::new();
    are_rates(&seven, &seven.cast(dual));
    let fifteen = Fifteen::<f64>::new();
    are_rates(&fifteen, &fifteen.cast(dual));
    let thirty_one = ThirtyOne::<f64>::new();
    are_rates(&thirty_one, &thirty_one.cast(dual));
    let thirteen = Thirteen::<f64>::new();
    are_rates(&thirteen, &thirteen.cast(dual));
    let coupled = Coupled::<f64>::new();
    are_rates(&coupled, &coupled.cast(dual));
    let coupled = CoupledThrees::<f64>::new();
    are_rates(&coupled, &coupled.cast(dual));
}

#[test]
fn rows_and_powers_of_large_trees_are_rates() {
    let dual = |x: f64| Dual::<f64, 1>::constant(x);
    let binary = InBlocks::<f64>::new();
    are_rates(&binary, &binary.cast(dual));
    closes(&binary);
    let coupled = CoupledBlocks::<f64>::new();
    are_rates(&coupled, &coupled.cast(dual));
    closes(&coupled);
    let ternary = BlocksOfThrees::<f64>::new();
    are_rates(&ternary, &ternary.cast(dual));
    closes(&ternary);
}

#[test]
fn scales_without_motion_have_exactly_nothing() {
    let model = Fifteen::<f64>::new();
    let generation = |values: [f64; 4]| -> Vec<f64> {
        let counts = [1, 2, 4, 8];
        let runs = values.into_iter().zip(counts);
        runs.flat_map(|(value, count)| vec![value; count]).collect()
    };
    let sample = Sample {
        time: 0.3,
        theta: generation([0.3, -0.8, 1.9, 0.7]),
        omega: generation([3.0, -2.1, 1.3, -5.5]),
        torques: vec![0.0; 15],
    };
    let own = budget(&model, &sample);
    assert!(own.energy(0) > 0.0);
    for scale in 1..4 {
        assert_eq!(own.energy(scale), 0.0);
        assert_eq!(own.power(scale), 0.0);
        assert_eq!(own.received(scale), 0.0);
    }
    // Below the first branching all copies still move alike.
    let mut other = sample;
    other.theta[2] += 0.1;
    let subtree = |link: usize| (link - 1) % 2 == 1;
    for link in 3..15 {
        other.theta[link] += if subtree(link) { 0.01 } else { 0.0 };
    }
    let own = budget(&model, &other);
    assert!(own.energy(1) > 0.0);
    assert_eq!([own.energy(2), own.energy(3)], [0.0; 2]);
}

#[test]
fn many_states_at_once() {
    let model = Fifteen::<f64>::new();
    let wide = model.cast(Lanes::<f64, 4>::splat);
    let samples = samples(15, 4);
    let lanes = |values: &dyn Fn(&Sample) -> &Vec<f64>| -> Vec<Lanes<f64, 4>> {
        (0..15)
            .map(|link| Lanes(std::array::from_fn(|lane| values(&samples[lane])[link])))
            .collect()
    };
    let time = Lanes(std::array::from_fn(|lane| samples[lane].time));
    let (theta, omega) = (
        lanes(&|sample| &sample.theta),
        lanes(&|sample| &sample.omega),
    );
    let torques = lanes(&|sample| &sample.torques);
    let (mut workspace, mut all) = (Workspace::new(), ScaleBudget::new());
    wide.budget_by_scale_under(&mut workspace, time, &theta, &omega, &torques, &mut all);
    for (lane, sample) in samples.iter().enumerate() {
        let own = budget(&model, sample);
        let size = (0..4).fold(0.0_f64, |most, scale| most.max(own.received(scale).abs()));
        for scale in 0..4 {
            let energy = all.energy(scale).0[lane];
            assert!((energy - own.energy(scale)).abs() < ROUNDING * own.energy(0).abs());
            for from in 0..4 {
                let error = all.transfer(from, scale).0[lane] - own.transfer(from, scale);
                assert!(error.abs() < 10.0 * ROUNDING * size);
            }
        }
    }
}

#[test]
fn slices_of_another_length_are_told() {
    let model = Seven::<f64>::new();
    let (mut workspace, mut own) = (Workspace::new(), ScaleBudget::new());
    model.budget_by_scale(&mut workspace, 0.0, &[0.0; 6], &[0.0; 7], &mut own);
    assert!(own.energy(0).is_nan() && own.transfer(0, 1).is_nan() && own.power(2).is_nan());
    let state = [0.1; 7];
    model.budget_by_scale_under(&mut workspace, 0.0, &state, &state, &[0.0; 3], &mut own);
    assert!(own.energy(0).is_nan());
    let mut energies = [0.0; 5];
    model.energies_by_sector(&mut workspace, &state, &state, &mut energies);
    assert!(energies.iter().all(|energy| energy.is_nan()));
}
