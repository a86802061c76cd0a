//! Fixed steps as long as a frame: bounded, with and without friction, in both
//! precisions.

use branched_pendulum::prelude::*;

use crate::problems::BranchedDouble;

/// The pendulum with friction in its pivots, in angles and velocities: the
/// torques −c (ω_i − ω_parent) and their opposites, solved along with the rest.
struct Rubbed {
    pendulum: BranchedDouble,
    friction: f64,
}

impl<T: Scalar> Ode<T> for Rubbed {
    fn dimension(&self) -> usize {
        6
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let (theta, omega) = state.split_at(3);
        let (velocities, alpha) = rates.split_at_mut(3);
        velocities.copy_from_slice(omega);
        self.pendulum.accelerations_into(time, theta, omega, alpha);
        // M Δα = Q by the same elimination.
        let number = T::from_f64;
        let c = number(self.friction);
        let mut torque = -(c * omega[0]);
        let mut inertia = number(self.pendulum.m1);
        let m2 = number(self.pendulum.m2);
        let own = [1, 2].map(|j| {
            let coupling = number(self.pendulum.mu) * (theta[j] - theta[0]).sin_cos().1;
            (coupling, c * (omega[0] - omega[j]))
        });
        for (coupling, push) in own {
            torque = torque - push - coupling * push / m2;
            inertia = inertia - coupling * coupling / m2;
        }
        let root = torque / inertia;
        alpha[0] = alpha[0] + root;
        for (j, (coupling, push)) in [1, 2].into_iter().zip(own) {
            alpha[j] = alpha[j] + (push - coupling * root) / m2;
        }
    }
}

fn energy<T: Real>(pendulum: &BranchedDouble, state: &[T]) -> f64 {
    let (theta, omega) = state.split_at(3);
    let kinetic: T = pendulum.kinetic_energy_of(theta, omega);
    let potential: T = pendulum.potential_energy_of(theta);
    kinetic.to_f64() + potential.to_f64()
}

/// Smallest and largest energy, relative to the first, over ten minutes of wild
/// motion, and the account.
fn energy_range<T: Real>(friction: f64, step: f64) -> (f64, f64, Report<T>) {
    let pendulum = BranchedDouble::paper();
    let start = State::at_rest(T::ZERO, &[1.5, 1e-3, -1e-3].map(T::from_f64));
    let initial = energy(&pendulum, &start.values);
    let ode = Rubbed {
        pendulum: BranchedDouble::paper(),
        friction,
    };
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    let method = Gauss::for_animation(T::from_f64(step));
    let solution = method
        .integrate(&ode, &start, T::from_f64(600.0), |step| {
            let ratio = energy(&pendulum, step.end()) / initial;
            (least, most) = (least.min(ratio), most.max(ratio));
            ControlFlow::Continue(())
        })
        .unwrap();
    (least, most, solution.report)
}

#[test]
fn energy_of_wild_motion_stays_in_bounds() {
    for step in [1.0 / 60.0, 1.0 / 120.0] {
        let double = energy_range::<f64>(0.0, step);
        let single = energy_range::<f32>(0.0, step);
        assert_eq!((double.2.rejected, single.2.rejected), (0, 0));
        for (least, most) in [(double.0, double.1), (single.0, single.1)] {
            assert!(least > 0.97 && most < 1.03, "{step}: {least} {most}");
        }
    }
}

#[test]
fn friction_of_any_strength_only_takes() {
    for friction in [1e-5, 1e-3, 1.0, 1e3] {
        let (least, most, _) = energy_range::<f64>(friction, 1.0 / 60.0);
        assert!(most < 1.01 && least >= 0.0, "{friction}: {least} {most}");
    }
}
