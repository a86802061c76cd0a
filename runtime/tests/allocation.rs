//! No method allocates in its steps: a million of them, counted. What is read from damaged
//! texts asks for no more memory than the text has.

#![cfg(feature = "std")]

mod counting;
#[cfg(feature = "serde")]
mod damaged;

use std::num::NonZeroUsize;

use branched_pendulum::TaylorPendulum;
use branched_pendulum::approximate::{Approximation, ForcedApproximation, Linear};
use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::integrate::{Crossing, Event, Frames, Solver};
use branched_pendulum::integrate::{LaneMethod, Projected};
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Sector, SectorCoordinate};
use branched_pendulum::system::{LinkName, OdeFn, TaylorOde, Workspace};
use branched_pendulum::taylor::Quad;
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, Order, RigidLink, SectorBudget, StateInput, SymmetricTree,
};
use counting::allocations;

const STEP: f64 = 1e-3;
const STEPS: u64 = 1_000_000;

fn oscillator() -> impl Ode<f64> {
    OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = -y[0];
    })
}

/// Allocations of a run from its second step on, each step being asked for a
/// value inside.
fn in_steps<O: Ode<f64>>(ode: &O, method: &impl Integrator<f64, O>) -> u64 {
    let (mut before, mut after, mut steps) = (None, 0, 0_u64);
    let start = State::at_rest(0.0, &[1.0]);
    method
        .integrate(ode, &start, STEP * STEPS as f64, |step| {
            let mut value = [0.0; 2];
            let middle = 0.5 * (step.start_time() + step.end_time());
            step.eval(middle, &mut value).unwrap();
            steps += 1;
            after = allocations();
            before.get_or_insert(after);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(steps >= STEPS - 1, "{steps}");
    after - before.unwrap()
}

/// Allocations of a million frames and steps, with changes of state and equations.
fn in_frames<O: Ode<f64>>(ode: O, method: &impl Integrator<f64, O>) -> u64 {
    let start = State::at_rest(0.0, &[1.0]);
    let mut stepper = method.start(ode, &start).unwrap();
    let before = allocations();
    for number in 0..250_000 {
        stepper.advance(0.7 * STEP).unwrap();
        stepper.step().unwrap();
        let end = stepper.time() + 1.5 * STEP;
        while stepper.step_to(end).unwrap().is_some() {}
        if number % 10 == 0 {
            let _ = stepper.ode_mut();
            stepper.set_state(0.0, &[1.0, 0.1]).unwrap();
        }
    }
    allocations() - before
}

fn options() -> Options<f64> {
    Options {
        initial_step: Some(STEP),
        max_step: Some(STEP),
        step_limit: u64::MAX,
        compensated: true,
        beta: 0.04,
        ..Options::with_tolerance(1e-6)
    }
}

#[test]
fn the_counter_counts() {
    let before = allocations();
    let boxed = std::hint::black_box(Box::new(1));
    assert_eq!((allocations() - before, *boxed), (1, 1));
}

#[test]
fn explicit_pairs() {
    let ode = oscillator();
    assert_eq!(in_steps(&ode, &Dopri5::new(options())), 0);
    assert_eq!(in_steps(&ode, &Dop853::new(options())), 0);
    assert_eq!(in_steps(&ode, &Verner98::new(options())), 0);
    assert_eq!(in_frames(&ode, &Dop853::new(options())), 0);
}

#[test]
fn methods_with_fixed_steps() {
    let ode = oscillator();
    assert_eq!(in_steps(&ode, &Rk4::new(STEP)), 0);
    for solver in [Solver::FixedPoint, Solver::Newton] {
        let method = Gauss {
            solver,
            ..Gauss::new(GaussOrder::Four, STEP)
        };
        assert_eq!(in_steps(&ode, &method), 0);
        assert_eq!(in_frames(&ode, &method), 0);
    }
    assert_eq!(in_frames(&ode, &Gauss::for_animation(STEP)), 0);
}

#[test]
fn frames_in_real_time() {
    let ode = oscillator();
    let start = State::at_rest(0.0, &[1.0]);
    let mut frames = Frames::new(&ode, &start, STEP).unwrap();
    let damped = [[0.1, 0.02], [0.02, 0.2]];
    let linear = Linear::of_matrices(&damped, &damped, &damped).unwrap();
    let mut modes = linear.frames(STEP).unwrap();
    let mut state = [1.0, 0.0, 0.0, 0.5];
    let before = allocations();
    for _ in 0..100_000 {
        frames.advance(2.5 * STEP);
        frames.set_state(0.0, &[1.0, 0.1]).unwrap();
        modes.step_under(&mut state, &[0.1, 0.2]);
        modes.advance();
        modes.angles_into(&mut state[..2]);
        state[0] += modes.validity(&state);
    }
    assert_eq!(allocations() - before, 0);
}

#[test]
fn projection_onto_the_energy() {
    let energy = |y: &[f64], gradient: &mut [f64]| {
        gradient.copy_from_slice(y);
        0.5 * (y[0] * y[0] + y[1] * y[1])
    };
    let ode = oscillator();
    assert_eq!(in_steps(&ode, &Projected::new(Rk4::new(STEP), &energy)), 0);
    let gauss = Gauss::new(GaussOrder::Two, STEP);
    assert_eq!(in_steps(&ode, &Projected::new(gauss, &energy)), 0);
}

/// The oscillator by its Taylor coefficients.
struct Series;

impl Ode<f64> for Series {
    fn dimension(&self) -> usize {
        2
    }

    fn rates(&self, _time: f64, y: &[f64], rates: &mut [f64]) {
        rates.copy_from_slice(&[y[1], -y[0]]);
    }
}

impl TaylorOde<f64> for Series {
    fn workspace(&self, _order: usize) -> usize {
        0
    }

    fn taylor(&self, _time: f64, y: &[f64], coefficients: &mut [f64], _work: &mut [Quad<f64>]) {
        let (mut position, mut velocity) = (y[0], y[1]);
        for (k, row) in coefficients.as_chunks_mut().0.iter_mut().enumerate() {
            *row = [position, velocity];
            let next = 1.0 / (k + 1) as f64;
            (position, velocity) = (velocity * next, -position * next);
        }
    }
}

#[test]
fn taylor_series() {
    let options = Options {
        beta: 0.0,
        ..options()
    };
    let method = Taylor::new(options);
    assert_eq!(in_steps(&Series, &method), 0);
    assert_eq!(in_frames(Series, &method), 0);
}

/// y'' = −k y, which holds k.
#[derive(Clone, Copy)]
struct Oscillator<T>(T);

impl<T: Scalar> Model<T> for Oscillator<T> {
    type Of<S: Scalar> = Oscillator<S>;
    const KNOWN_LINKS: Option<usize> = Some(1);

    fn links(&self) -> usize {
        1
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        LinkName::in_list(&["oscillator"], index)
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Oscillator<S> {
        Oscillator(convert(self.0))
    }
}

impl<T: Scalar> Pendulum<T> for Oscillator<T> {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        _omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        alpha(0, -(self.0 * theta(0)));
    }
}

impl<T: Scalar> TaylorPendulum<T> for Oscillator<T> {
    fn taylor_workspace(&self, _order: usize) -> usize {
        0
    }

    #[inline(always)]
    fn taylor_coefficients_into(
        &self,
        _time: T,
        theta: &[T],
        omega: &[T],
        coefficients: &mut [T],
        _work: &mut [Quad<T>],
    ) {
        let (mut position, mut velocity) = (theta[0], omega[0]);
        for (k, row) in coefficients.as_chunks_mut().0.iter_mut().enumerate() {
            *row = [position, velocity];
            let next = T::from_f64(1.0 / (k + 1) as f64);
            (position, velocity) = (velocity * next, -(self.0 * position * next));
        }
    }

    #[inline(always)]
    fn taylor_coefficients_of<S: Scalar>(
        pendulum: &Oscillator<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        coefficients: &mut [S],
        work: &mut [Quad<S>],
    ) {
        pendulum.taylor_coefficients_into(time, theta, omega, coefficients, work);
    }
}

/// Allocations of ensembles in lanes whose trajectories make so many steps, and
/// have a sample in each.
fn in_lanes(method: &impl LaneMethod<AbsoluteAngles<Oscillator<f64>>, f64>, steps: u32) -> u64 {
    let starts = vec![State::at_rest(0.0, &[1.0]); 11];
    let releases: Vec<_> = (0..11)
        .map(|i| {
            (
                AbsoluteAngles(Oscillator(1.0 + 0.1 * f64::from(i))),
                starts[0].clone(),
            )
        })
        .collect();
    let times: Vec<f64> = (0..steps).map(|i| STEP * (f64::from(i) + 0.5)).collect();
    let (ensemble, end) = (
        Ensemble::new().threads(NonZeroUsize::MIN),
        STEP * f64::from(steps),
    );
    let (model, starts) = (&AbsoluteAngles(Oscillator(1.0)), starts.as_slice());
    let before = allocations();
    let ends = [
        ensemble.integrate_in_lanes(method, model, starts, end),
        ensemble.integrate_models_in_lanes(method, &releases, end),
    ];
    let samples = [
        ensemble.sample_in_lanes(method, model, starts, &times),
        ensemble.sample_models_in_lanes(method, &releases, &times),
    ];
    let after = allocations();
    for (end, samples) in ends.iter().flatten().zip(samples.iter().flatten()) {
        assert!(end.as_ref().unwrap().report.accepted >= u64::from(steps) - 1);
        assert_eq!(samples.states().len(), times.len());
    }
    after - before
}

#[test]
fn lanes() {
    fn count(method: &impl LaneMethod<AbsoluteAngles<Oscillator<f64>>, f64>) {
        assert_eq!(in_lanes(method, 10), in_lanes(method, 10_000));
    }
    count(&Dopri5::new(options()));
    count(&Dop853::new(options()));
    count(&Verner98::new(options()));
    count(&Taylor::new(Options {
        beta: 0.0,
        ..options()
    }));
}

#[test]
fn events() {
    let position = |_time: f64, y: &[f64]| y[0];
    let events = [Event::new(Crossing::Either, &position).with_checks(2)];
    let start = State::at_rest(0.0, &[1.0]);
    let (mut before, mut after) = (None, 0);
    Dopri5::new(options())
        .integrate_with_events(&oscillator(), &start, STEP * STEPS as f64, &events, |_| {
            after = allocations();
            before.get_or_insert(after);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(after - before.unwrap(), 0);
}

/// Energy transfers of a tree in numbers, after the first evaluation with a workspace.
#[test]
fn no_transfer_allocates() {
    let link = |parent: Option<usize>| RigidLink {
        parent,
        mass: 0.1,
        inertia: 1e-3,
        com: [0.05, 0.0],
        pivot: [if parent.is_some() { 0.2 } else { 0.0 }, 0.0],
        spring: 0.1,
        rest: 0.0,
        friction: 1e-3,
        drag: 1e-3,
        laws: [[1e-3, 0.0, 0.1, 1e-3, 0.2], [0.0, 0.0, 1.0, 0.0, 1.0]]
            .map(FrictionLaw::of_constants),
    };
    let coordinate = |name: &str, weights: &[(usize, f64)]| {
        SectorCoordinate::new(name.to_owned(), weights.to_vec())
    };
    let means = vec![
        coordinate("parent", &[(0, 1.0)]),
        coordinate("m", &[(1, 1.0), (2, 1.0)]),
    ];
    let sectors = [
        Sector::new("in_phase".to_owned(), means),
        Sector::new(
            "d".to_owned(),
            vec![coordinate("d", &[(1, 1.0), (2, -1.0)])],
        ),
    ];
    let links = [link(None), link(Some(0)), link(Some(0))];
    let tree = SymmetricTree::<f64>::new(&links, 9.81, &sectors).unwrap();
    let given = StateInput::Momenta {
        coordinates: &[0.4, 0.3, 0.1],
        momenta: &[0.02, -0.01, 0.01],
    };
    let (mut workspace, mut w) = (Workspace::new(), [Transfer::default(); 2]);
    let (mut energies, mut powers) = ([[0.0; 2]; 2], [0.0; 2]);
    let (mut matrix, mut budget) = ([0.0; 4], SectorBudget::new());
    let mut expansion = tree.expansion::<5>(&[]);
    let mut all = || {
        tree.exact_transfers(&mut workspace, given, &mut w);
        tree.energies(&mut workspace, given, &mut energies);
        tree.powers(
            &mut workspace,
            NonConservative::Friction,
            given,
            &mut powers,
        );
        tree.transfer_matrix(&mut workspace, given, &mut matrix);
        let by = EnergyDefinition::Parseval;
        tree.budget(
            &mut workspace,
            by,
            &[NonConservative::Friction],
            given,
            &mut budget,
        );
        let state = [&[0.4, 0.3, 0.1][..], &[0.02, -0.01, 0.01]];
        expansion.transfers(Order::Amplitude, 4, state, &mut w);
        assert!(w[1].total().is_finite() && matrix[1].is_finite());
    };
    all();
    let before = allocations();
    for _ in 0..1000 {
        all();
    }
    assert_eq!(allocations() - before, 0);
}
