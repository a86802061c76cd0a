//! Projection onto the energy: what it keeps, what it costs, and where there is
//! nothing to project onto.

use branched_pendulum::integrate::{InputError, Projected};
use branched_pendulum::prelude::*;
use branched_pendulum::system::CanonicalEnergy;

use crate::problems::{BranchedDouble, Problem, watch};

/// A pendulum: H = p²/2 − cos q.
fn pendulum() -> impl Ode<f64> {
    Problem::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = -y[0].sin();
    })
}

fn energy(y: &[f64], gradient: &mut [f64]) -> f64 {
    gradient[0] = y[0].sin();
    gradient[1] = y[1];
    0.5 * y[1] * y[1] - y[0].cos()
}

fn energy_at(y: &[f64]) -> f64 {
    energy(y, &mut [0.0; 2])
}

fn end<O: Ode<f64>>(method: &impl Integrator<f64, O>, ode: &O, start: &State<f64>) -> Vec<f64> {
    let end = method.integrate(ode, start, 4.0, watch).unwrap();
    end.state.values
}

#[test]
fn the_order_stays() {
    let (ode, start) = (pendulum(), State::at_rest(0.0, &[2.0]));
    let exact = end(&Verner98::new(Options::with_tolerance(1e-14)), &ode, &start);
    let errors = |run: &dyn Fn(f64) -> Vec<f64>| {
        [0.1, 0.05].map(|step| {
            let found = run(step);
            (found[0] - exact[0]).hypot(found[1] - exact[1])
        })
    };
    let rk4 = errors(&|step| end(&Projected::new(Rk4::new(step), &energy), &ode, &start));
    let gauss = |order, factor: f64| {
        errors(&|step| {
            end(
                &Projected::new(Gauss::new(order, factor * step), &energy),
                &ode,
                &start,
            )
        })
    };
    for ([coarse, fine], order) in [
        (rk4, 4.0),
        (gauss(GaussOrder::Two, 1.0), 2.0),
        (gauss(GaussOrder::Four, 1.0), 4.0),
        (gauss(GaussOrder::Six, 2.0), 6.0),
    ] {
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.2, "{found} for {order}");
    }
}

/// Rk4 alone drifts by some parts in ten thousand; held to the energy it does not, for
/// one freedom and, in canonical variables, for three.
#[test]
fn the_energy_is_kept_to_rounding() {
    let (ode, start) = (pendulum(), State::at_rest(0.0, &[2.0]));
    let initial = energy_at(&start.values);
    let worst = |method: &dyn Fn(&mut f64)| {
        let mut worst = 0.0_f64;
        method(&mut worst);
        worst
    };
    let free = worst(&|worst| {
        let observer = |step: &mut DenseStep<'_, f64>| {
            *worst = worst.max((energy_at(step.end()) - initial).abs());
            core::ops::ControlFlow::Continue(())
        };
        Rk4::new(0.2)
            .integrate(&ode, &start, 200.0, observer)
            .unwrap();
    });
    assert!(free > 1e-4, "{free}");
    let held = worst(&|worst| {
        let observer = |step: &mut DenseStep<'_, f64>| {
            *worst = worst.max((energy_at(step.end()) - initial).abs());
            core::ops::ControlFlow::Continue(())
        };
        let method = Projected::new(Rk4::new(0.2), &energy);
        method.integrate(&ode, &start, 200.0, observer).unwrap();
    });
    assert!(held < 2e-14, "{held}");

    let tree = BranchedDouble::paper();
    let start = State::at_rest(0.0, &[0.5, 1e-3, -1e-3]);
    let initial = tree.hamiltonian(&start.values);
    let mut worst = 0.0_f64;
    let method = Projected::new(Gauss::new(GaussOrder::Two, 0.02), CanonicalEnergy(&tree));
    let ode = CanonicalVariables(&tree);
    let observer = |step: &mut DenseStep<'_, f64>| {
        worst = worst.max((tree.hamiltonian(step.end()) / initial - 1.0).abs());
        core::ops::ControlFlow::Continue(())
    };
    let solution = method.integrate(&ode, &start, 20.0, observer).unwrap();
    assert_eq!(solution.report.rejected, 0);
    assert!(worst < 2e-14, "{worst}");
}

/// Area of the image of a small parallelogram in phase space, over its own.
fn area_ratio(method: &impl Integrator<f64, Problem<f64>>) -> f64 {
    let ode = Problem::new(
        2,
        (|_time, y, rates| {
            rates[0] = y[1];
            rates[1] = -y[0].sin();
        }) as fn(f64, &[f64], &mut [f64]),
    );
    let h = 1e-5;
    let image = |q: f64, p: f64| {
        let start = State::new(0.0, vec![1.0 + q, 0.5 + p]);
        end(method, &ode, &start)
    };
    let slope = |a: Vec<f64>, b: Vec<f64>| [(a[0] - b[0]) / (2.0 * h), (a[1] - b[1]) / (2.0 * h)];
    let by_q = slope(image(h, 0.0), image(-h, 0.0));
    let by_p = slope(image(0.0, h), image(0.0, -h));
    by_q[0] * by_p[1] - by_q[1] * by_p[0]
}

/// Gauss keeps areas of phase space; projected, it does not.
#[test]
fn the_symplectic_property_is_lost() {
    let gauss = Gauss::new(GaussOrder::Two, 0.5);
    let free = (area_ratio(&gauss) - 1.0).abs();
    let held = (area_ratio(&Projected::new(gauss, &energy)) - 1.0).abs();
    assert!(free < 1e-8, "{free}");
    assert!(held > 1e-4, "{held}");
}

/// The values inside a step lead to the corrected end.
#[test]
fn dense_output_reaches_the_projected_end() {
    let (ode, start) = (pendulum(), State::at_rest(0.0, &[2.0]));
    let check = |step: &mut DenseStep<'_, f64>| {
        let (mut value, end) = ([0.0; 2], step.end().to_vec());
        step.eval(step.end_time(), &mut value).unwrap();
        assert!((value[0] - end[0]).hypot(value[1] - end[1]) < 1e-14);
        core::ops::ControlFlow::Continue(())
    };
    let gauss = Projected::new(Gauss::new(GaussOrder::Two, 0.3), &energy);
    gauss.integrate(&ode, &start, 3.0, check).unwrap();
    let rk4 = Projected::new(Rk4::new(0.3), &energy);
    rk4.integrate(&ode, &start, 3.0, check).unwrap();
}

#[test]
fn what_cannot_be_projected_is_an_error_with_the_last_state() {
    let (ode, start) = (pendulum(), State::at_rest(0.0, &[2.0]));
    // The value moves, and the gradient says that it does not.
    let flat = |y: &[f64], gradient: &mut [f64]| {
        gradient.fill(0.0);
        y[0]
    };
    let method = Projected::new(Gauss::new(GaussOrder::Two, 0.1), &flat);
    let error = method.integrate(&ode, &start, 1.0, watch).unwrap_err();
    let IntegrationError::NotProjected {
        deviation,
        last,
        report,
        ..
    } = &error
    else {
        panic!("{error}");
    };
    assert!(*deviation != 0.0 && last == &start);
    assert_eq!(
        (report.stop, report.rejected),
        (StopReason::NotProjected, 10)
    );
    assert!(error.to_string().contains("off the level"), "{error}");
    assert_eq!(error.last_state(), Some(&start));

    let undefined = |_: &[f64], gradient: &mut [f64]| {
        gradient.fill(1.0);
        f64::NAN
    };
    let method = Projected::new(Rk4::new(0.1), &undefined);
    let error = method.integrate(&ode, &start, 1.0, watch).unwrap_err();
    assert!(
        matches!(error, IntegrationError::NonFinite { .. }),
        "{error}"
    );

    let method = Projected {
        tolerance: 0.0,
        ..Projected::new(Rk4::new(0.1), &energy)
    };
    let error = method.integrate(&ode, &start, 1.0, watch).unwrap_err();
    let IntegrationError::Input(InputError::Tolerance { name, .. }) = error else {
        panic!("{error}");
    };
    assert_eq!(name, "projection");
}
