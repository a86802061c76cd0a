//! Methods evaluate in memory that they keep.

use core::cell::Cell;

use branched_pendulum::analysis::variational::{ByTangents, Variational};
use branched_pendulum::integrate::Projected;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::Workspace;

/// A pendulum that counts evaluations in memory of their own.
#[derive(Default)]
struct Counted(Cell<u32>);

impl<T: Scalar> Ode<T> for Counted {
    fn dimension(&self) -> usize {
        2
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.0.set(self.0.get() + 1);
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, _: &mut Workspace<T>, _time: T, state: &[T], rates: &mut [T]) {
        rates[0] = state[1];
        rates[1] = -state[0].sin_cos().0;
    }
}

fn run<O: Ode<f64> + ?Sized>(method: &impl Integrator<f64, O>, ode: &O, start: &State<f64>) {
    method.run(ode, start, 1.0).unwrap();
}

#[test]
fn every_method_evaluates_with_its_workspace() {
    let ode = Counted::default();
    let start = State::at_rest(0.0, &[1.0]);
    let options = || Options::with_tolerance(1e-6);
    let energy = |y: &[f64], gradient: &mut [f64]| {
        gradient.copy_from_slice(&[y[0].sin(), y[1]]);
        0.5 * y[1] * y[1] - y[0].cos()
    };
    run(&Dopri5::new(options()), &ode, &start);
    run(&Dop853::new(options()), &ode, &start);
    run(&Verner98::new(options()), &ode, &start);
    run(&Rk4::new(0.1), &ode, &start);
    run(&Gauss::new(GaussOrder::Four, 0.1), &ode, &start);
    run(&Gauss::<f64>::for_animation(0.1), &ode, &start);
    run(&Projected::new(Rk4::new(0.1), &energy), &ode, &start);
    let tangents: ByTangents<_, Dual<f64, 1>, _> = ByTangents::new(&ode);
    let with_deviation = State::new(0.0, vec![1.0, 0.0, 1.0, 0.0]);
    run(
        &Dop853::new(options()),
        &Variational::new(&tangents, 1),
        &with_deviation,
    );
    run(
        &Dop853::new(options()),
        &Variational::new(&tangents, 0),
        &start,
    );
    assert_eq!(ode.0.get(), 0);
}
