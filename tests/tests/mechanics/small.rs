//! Small differences that act back, against the whole tree and against their own
//! Lagrangian.

use std::f64::consts::PI;

use branched_pendulum::SmallDifferences;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{DifferencePatterns, InPhaseMotion, PatternError, SmallOde};
use branched_pendulum::{Transverse, WholeTree};
use branched_pendulum_compiler_tests::random::Random;

use super::transverse::{crown, fifteen, paper};

crown!(Crown, emit(energies));
crown!(CrownSmall, in_phase(all), emit(small, energies));
crown!(HandsSmall, in_phase(all), emit(small(finger, arm)));

fifteen!(Fifteen, emit(energies));
fifteen!(FifteenSmall, in_phase(tree), emit(small));

paper!(Paper, emit(energies));
paper!(PaperSmall, in_phase(child), emit(small, energies));

const HANDS: (&str, &[f64]) = ("hand", &[1.0, -1.0, 0.0, 1.0, -1.0, 0.0]);

fn crown_patterns() -> DifferencePatterns {
    DifferencePatterns::chosen::<f64, _>(&CrownSmall::<f64>::new(), CrownSmall::WHOLE, &[HANDS])
        .expect("patterns of three sectors")
}

/// A random state of angles and differences, the latter of this size.
fn state<M: SmallDifferences<f64>>(model: &M, size: f64, random: &mut Random) -> Vec<f64> {
    let count = SmallOde(model).dimension() / 2 - model.links();
    let mut state = random.around_zero(model.links(), PI);
    state.extend(random.around_zero(count, size));
    state.extend(random.around_zero(model.links(), 5.0));
    state.extend(random.around_zero(count, 5.0 * size));
    state
}

/// A state with differences of another size.
fn scaled<M: Pendulum<f64>>(model: &M, state: &[f64], size: f64) -> Vec<f64> {
    let half = state.len() / 2;
    let scale = |(index, &value): (usize, &f64)| match index % half < model.links() {
        true => value,
        false => size * value,
    };
    state.iter().enumerate().map(scale).collect()
}

/// Largest error of the accelerations of angles in phase and of differences, at a size of
/// differences, against the whole tree.
fn errors<M: SmallDifferences<f64>, W: Pendulum<f64>>(
    (model, whole): (&M, &W),
    patterns: &DifferencePatterns,
    state: &[f64],
    size: f64,
) -> [f64; 2] {
    let state = scaled(model, state, size);
    let half = state.len() / 2;
    let mut found = vec![0.0; 2 * half];
    SmallOde(model).rates(0.7, &state, &mut found);
    let full = patterns.to_whole(&state);
    let mut rates = vec![0.0; full.len()];
    AbsoluteAngles(whole).rates(0.7, &full, &mut rates);
    // Velocities and accelerations, as angles and rates would be.
    let links = full.len() / 2;
    let angles = patterns.to_whole(&vec![0.0; 2 * half]);
    let shifted: Vec<f64> = (0..2 * links)
        .map(|i| rates[i] + if i < links { angles[i] } else { 0.0 })
        .collect();
    let expected = patterns.to_small(&shifted);
    let mut largest = [0.0_f64; 2];
    for index in half..2 * half {
        let of = usize::from(index - half >= model.links());
        largest[of] = largest[of].max((found[index] - expected[index]).abs());
    }
    largest
}

/// Order in the size of the differences with which errors vanish: of angles in phase, and
/// of differences.
fn order<M: SmallDifferences<f64>, W: Pendulum<f64>>(
    models: (&M, &W),
    patterns: &DifferencePatterns,
    sizes: [f64; 2],
) -> [f64; 2] {
    let mut random = Random::new(21);
    let states: Vec<Vec<f64>> = (0..30).map(|_| state(models.0, 1.0, &mut random)).collect();
    let sums = sizes.map(|size| {
        let errors = states
            .iter()
            .map(|state| errors(models, patterns, state, size));
        errors.fold([0.0; 2], |sums, error| {
            [sums[0] + error[0], sums[1] + error[1]]
        })
    });
    let order = |of: usize| (sums[0][of] / sums[1][of]).ln() / (sizes[0] / sizes[1]).ln();
    [order(0), order(1)]
}

#[test]
fn errors_of_pairs_are_of_third_order_and_of_means_of_fourth() {
    let paper = (&PaperSmall::new(), &Paper::new());
    let patterns = DifferencePatterns::of::<f64, _>(paper.0, PaperSmall::WHOLE).expect("a pair");
    let [means, differences] = order(paper, &patterns, [2e-2, 1e-2]);
    assert!(means > 3.9 && differences > 2.9, "{means} {differences}");

    let fifteen = (&FifteenSmall::new(), &Fifteen::new());
    let tree: WholeTree = FifteenSmall::WHOLE;
    let patterns = DifferencePatterns::of::<f64, _>(fifteen.0, tree).expect("pairs");
    let [means, differences] = order(fifteen, &patterns, [1e-2, 5e-3]);
    assert!(means > 3.8 && differences > 2.8, "{means} {differences}");
}

macro_rules! braked {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            parent(mass = 0.13, com = 0.08, inertia = 1.9e-3, joint = 0.27,
                friction(coulomb = 2e-2, width = 2)) [
                child(mass = 0.11, com = 0.043, inertia = 0.5e-3,
                    friction(viscous = 1e-5, coulomb = 5e-2, quadratic = 1e-3, width = 2),
                    drag(quadratic = 2e-3, width = 2)) * 2
            ],
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}

braked!(Braked);
braked!(BrakedSmall, in_phase(child), emit(small));

/// The second derivatives of friction act on the motion in phase.
#[test]
fn friction_of_all_kinds_keeps_the_orders() {
    let models = (&BrakedSmall::new(), &Braked::new());
    let patterns = DifferencePatterns::of::<f64, _>(models.0, BrakedSmall::WHOLE).expect("a pair");
    let [means, differences] = order(models, &patterns, [1e-2, 5e-3]);
    assert!(means > 3.8 && differences > 2.8, "{means} {differences}");
}

/// Friction, drag, springs, offsets and a drive; three copies, whose third-order terms do
/// not cancel.
#[test]
fn errors_of_three_copies_are_an_order_lower() {
    let models = (&CrownSmall::new(), &Crown::new());
    let [means, differences] = order(models, &crown_patterns(), [2e-3, 1e-3]);
    assert!(means > 2.8 && differences > 1.8, "{means} {differences}");
}

/// The state counts the sectors in the order in which they are named.
#[test]
fn named_sectors_alone_act_back() {
    assert_eq!(<HandsSmall as SmallDifferences<f64>>::SMALL, [2, 0]);
    let models = (&HandsSmall::new(), &Crown::new());
    let patterns = DifferencePatterns::of::<f64, _>(models.0, HandsSmall::WHOLE).expect("pairs");
    let [means, differences] = order(models, &patterns, [2e-3, 1e-3]);
    assert!(means > 3.7 && differences > 2.7, "{means} {differences}");
}

/// Of a state with no differences, those of the reduced model, and exactly none.
fn in_phase<M: SmallDifferences<f64>>(model: &M) {
    let mut random = Random::new(22);
    for _ in 0..100 {
        let state = state(model, 0.0, &mut random);
        let half = state.len() / 2;
        let mut rates = vec![0.0; 2 * half];
        SmallOde(model).rates(0.7, &state, &mut rates);
        let mut alpha = vec![0.0; model.links()];
        let (theta, omega) = (&state[..model.links()], &state[half..half + model.links()]);
        model.accelerations_into(0.7, theta, omega, &mut alpha);
        let (means, differences) = rates[half..].split_at(model.links());
        let largest = alpha.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        for (found, expected) in means.iter().zip(&alpha) {
            assert!((found - expected).abs() <= 1e-12 * largest);
        }
        assert!(differences.iter().all(|&second| second == 0.0));
    }
}

#[test]
fn without_differences_the_motion_is_in_phase() {
    in_phase(&CrownSmall::new());
    in_phase(&FifteenSmall::new());
    in_phase(&PaperSmall::new());
}

/// At the accelerations that come of the reaction, differences of any size follow the
/// transverse equations.
#[test]
fn differences_follow_the_transverse_equations() {
    let model = CrownSmall::new();
    let mut random = Random::new(23);
    for _ in 0..100 {
        let state = state(&model, 0.3, &mut random);
        let half = state.len() / 2;
        let mut rates = vec![0.0; 2 * half];
        SmallOde(&model).rates(0.7, &state, &mut rates);
        let links = CrownSmall::LINKS;
        let motion = InPhaseMotion {
            theta: &state[..links],
            omega: &state[half..half + links],
            alpha: &rates[half..half + links],
        };
        let largest = rates.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        let mut place = links;
        for &number in <CrownSmall as SmallDifferences<f64>>::SMALL {
            let count = <CrownSmall as Transverse<f64>>::TRANSVERSE[number].links;
            let mut expected = vec![0.0; count];
            model.transverse_accelerations_into(
                number,
                0.7,
                motion,
                &state[place..place + count],
                &state[half + place..half + place + count],
                &mut expected,
            );
            for (found, expected) in rates[half + place..].iter().zip(&expected) {
                assert!((found - expected).abs() <= 1e-11 * largest);
            }
            place += count;
        }
    }
}

/// d/dt ∂L/∂v − ∂L/∂q of the emitted energy: E = K + U with K quadratic in the rates, so
/// that momenta are differences of energies, without rounding but that of the
/// arithmetic; their rates along the motion, and slopes, by dual numbers.
#[test]
fn accelerations_solve_the_equations_of_the_emitted_lagrangian() {
    let model = FifteenSmall::new();
    let wide = SmallOde(FifteenSmall::<Dual<f64, 1>>::default());
    let mut random = Random::new(24);
    for _ in 0..30 {
        let state = state(&model, 0.5, &mut random);
        let half = state.len() / 2;
        let mut rates = vec![0.0; 2 * half];
        SmallOde(&model).rates(0.0, &state, &mut rates);
        let energy = |state: &[f64], slopes: &[f64]| {
            let pairs = state.iter().zip(slopes);
            let dual = pairs.map(|(&value, &slope)| Dual {
                value,
                tangents: [slope],
            });
            wide.energy(&dual.collect::<Vec<_>>())
        };
        for own in 0..half {
            let momentum_rate = {
                let moved = |step: f64| {
                    let mut moved = state.clone();
                    moved[half + own] += step;
                    energy(&moved, &rates).tangents[0]
                };
                0.5 * (moved(1.0) - moved(-1.0))
            };
            let mut unit = vec![0.0; 2 * half];
            unit[own] = 1.0;
            let mut still = state.clone();
            still[half..].fill(0.0);
            let whole = energy(&state, &unit).tangents[0];
            let potential = energy(&still, &unit).tangents[0];
            let slope = whole - 2.0 * potential;
            let size = energy(&state, &unit).value + momentum_rate.abs() + slope.abs();
            assert!((momentum_rate - slope).abs() <= 1e-11 * size, "{own}");
        }
    }
}

/// Energies are those of the whole tree through second order: what is left falls with the
/// fourth power.
#[test]
fn energies_are_those_of_the_whole_tree() {
    let (model, whole) = (PaperSmall::new(), Paper::new());
    let patterns = DifferencePatterns::of::<f64, _>(&model, PaperSmall::WHOLE).expect("a pair");
    let mut random = Random::new(25);
    let states: Vec<Vec<f64>> = (0..30).map(|_| state(&model, 1.0, &mut random)).collect();
    let error = |size: f64| -> f64 {
        let errors = states.iter().map(|state| {
            let state = scaled(&model, state, size);
            let full = patterns.to_whole(&state);
            let (theta, omega) = full.split_at(3);
            let expected = whole.kinetic_energy_of(theta, omega) + whole.potential_energy_of(theta);
            (SmallOde(&model).energy(&state) - expected).abs()
        });
        errors.sum()
    };
    let ratio = error(0.04) / error(0.02);
    assert!((ratio - 16.0).abs() < 0.1, "{ratio}");
}

fn end<O: Ode<f64>>(ode: &O, start: &State<f64>, span: f64) -> Vec<f64> {
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let end = method.run(ode, start, span);
    end.expect("a regular motion").state.values
}

/// Beyond where the model is good.
#[test]
fn it_keeps_an_energy_of_its_own() {
    let model = PaperSmall::new();
    let ode = SmallOde(&model);
    let start = State::at_rest(0.0, &[35.0_f64.to_radians(), 0.0, 0.3]);
    let before: f64 = ode.energy(&start.values);
    let after = ode.energy(&end(&ode, &start, 30.0));
    assert!((after - before).abs() < 1e-10 * before, "{after} {before}");
    let in_phase = end(
        &ode,
        &State::at_rest(0.0, &[35.0_f64.to_radians(), 0.0, 0.0]),
        30.0,
    );
    assert_eq!([in_phase[2], in_phase[5]], [0.0; 2]);
}

/// The reaction is what the whole tree does to second order: over two seconds the
/// change of the parent's motion by the difference is as there, with an error that falls
/// with the fourth power of the difference; and that of the difference with the third.
#[test]
fn the_reaction_is_that_of_the_whole_tree() {
    let (model, whole) = (PaperSmall::new(), Paper::new());
    let ode = SmallOde(&model);
    let angle = 40.0_f64.to_radians();
    let small = |size: f64| end(&ode, &State::at_rest(0.0, &[angle, 0.0, size]), 2.0);
    let full = |size: f64| {
        let start = State::at_rest(0.0, &[angle, size, -size]);
        end(&AbsoluteAngles(&whole), &start, 2.0)
    };
    let alone = small(0.0);
    let sizes = [0.08, 0.04];
    let errors = sizes.map(|size| {
        let (small, full) = (small(size), full(size));
        let reaction = (small[0] - alone[0]).abs();
        let mean = (small[0] - full[0]).abs();
        assert!(mean < 3.0 * size * size * reaction, "{mean} {reaction}");
        [mean, (small[2] - 0.5 * (full[1] - full[2])).abs()]
    });
    let order = |of: usize| (errors[0][of] / errors[1][of]).log2();
    assert!((order(0) - 4.0).abs() < 0.2, "{}", order(0));
    assert!((order(1) - 3.0).abs() < 0.2, "{}", order(1));
}

#[test]
fn lanes_are_as_single_motions() {
    let ode = SmallOde(PaperSmall::<f64>::new());
    let starts: Vec<State<f64>> = (0..11)
        .map(|i| State::at_rest(0.0, &[0.06 * f64::from(i), 0.0, 0.02 * f64::from(i)]))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes = Ensemble::new().integrate_in_lanes(&method, &ode, &starts, 5.0);
    let plain = Ensemble::new().integrate(&method, &ode, &starts, 5.0);
    for (lane, plain) in lanes.into_iter().zip(plain) {
        let (lane, plain) = (lane.unwrap().state.values, plain.unwrap().state.values);
        for (lane, plain) in lane.iter().zip(&plain) {
            assert!((lane - plain).abs() < 1e-8);
        }
    }
}

#[test]
fn states_go_to_the_whole_tree_and_back() {
    let patterns = crown_patterns();
    let state = state(&CrownSmall::new(), 0.7, &mut Random::new(26));
    let back = patterns.to_small(&patterns.to_whole(&state));
    for (back, value) in back.iter().zip(&state) {
        assert!((back - value).abs() < 1e-14);
    }
    assert!(patterns.to_small(&state).is_empty() && patterns.to_whole(&[0.0; 3]).is_empty());
}

#[test]
fn weights_that_are_no_pattern() {
    let refused = |weights: &[(&str, &[f64])]| {
        DifferencePatterns::chosen::<f64, _>(&CrownSmall::<f64>::new(), CrownSmall::WHOLE, weights)
            .expect_err("no pattern")
    };
    assert_eq!(refused(&[]), PatternError::Choice { sector: "hand" });
    assert_eq!(refused(&[("leg", &[1.0])]), PatternError::Sector);
    let length = PatternError::Length {
        expected: 2,
        found: 1,
    };
    assert_eq!(refused(&[HANDS, ("arm", &[1.0])]), length);
    for weights in [
        [0.0, 0.0],
        [1.0, 1.0],
        [f64::NAN, 1.0],
        [f64::INFINITY, 1.0],
    ] {
        assert_eq!(refused(&[HANDS, ("arm", &weights)]), PatternError::Weights);
    }
}
