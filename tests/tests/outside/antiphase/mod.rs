//! Powers on H_d of friction, drive and torques from outside, by momenta and by rates.

mod balance;

use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;

/// H_d of the paper's pendulum, whose power is that of the half difference.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(forces, transfer(exact)),
)]
struct Paper;

/// Equal copies on a shaken pivot.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.2, length = 0.3, friction = 2e-3) [
        twig: rod(mass = 0.1, length = 0.2, friction = 1e-3, drag = 4e-4) * 2
    ],
    drive(x = 0.05 * cos(7 * t), y = 0.03 * sin(5 * t)),
    emit(forces, transfer(exact)),
)]
struct Equal;

/// Copies that differ, on a shaken pivot.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = 1e-4) [
        child(
            mass = each(0.10531, 0.112), com = each(0.043, 0.045), inertia = 0.516e-3,
            friction = each(2e-4, 3e-4), drag = each(0, 1e-4),
        ) * 2
    ],
    drive(x = 0.05 * cos(7 * t), y = 0.03 * sin(5 * t)),
    emit(forces, transfer(exact)),
)]
struct Unequal;

/// Three copies with dry joints, and two differences.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.3, length = 0.3) [
        twig: rod(
            mass = 0.1, length = 0.2,
            friction(viscous = 1e-3, coulomb = 2e-3, width = 0.5), drag(quadratic = 1e-4),
        ) * 3
    ],
    drive(x = 0.05 * cos(7 * t), y = 0.03 * sin(5 * t)),
    emit(forces, transfer(exact)),
)]
struct Triple;

/// Acceleration of the shaken pivots.
fn acceleration(time: f64) -> [f64; 2] {
    [
        -0.05 * 49.0 * (7.0 * time).cos(),
        -0.03 * 25.0 * (5.0 * time).sin(),
    ]
}

/// Torque on a child, whose mass moment about its pivot is given, under such an acceleration.
fn inertial(time: f64, moment: f64, theta: f64) -> f64 {
    let [x, y] = acceleration(time);
    -moment * (x * theta.cos() + y * theta.sin())
}

/// Torques on the children of friction, and of the drive: forces on links, without the
/// compiler's formulas.
trait Hand<const LINKS: usize> {
    fn friction(omega: &[f64; LINKS]) -> [f64; LINKS];
    fn drive(time: f64, theta: &[f64; LINKS]) -> [f64; LINKS];
}

impl Hand<3> for Equal {
    fn friction(omega: &[f64; 3]) -> [f64; 3] {
        let child = |own: f64| -1e-3 * (own - omega[0]) - 4e-4 * own;
        [0.0, child(omega[1]), child(omega[2])]
    }

    fn drive(time: f64, theta: &[f64; 3]) -> [f64; 3] {
        let child = |own: f64| inertial(time, 0.1 * 0.1, own);
        [0.0, child(theta[1]), child(theta[2])]
    }
}

impl Hand<3> for Unequal {
    fn friction(omega: &[f64; 3]) -> [f64; 3] {
        let child = |c: f64, drag: f64, own: f64| -c * (own - omega[0]) - drag * own;
        [0.0, child(2e-4, 0.0, omega[1]), child(3e-4, 1e-4, omega[2])]
    }

    fn drive(time: f64, theta: &[f64; 3]) -> [f64; 3] {
        [
            0.0,
            inertial(time, 0.10531 * 0.043, theta[1]),
            inertial(time, 0.112 * 0.045, theta[2]),
        ]
    }
}

impl Hand<4> for Triple {
    fn friction(omega: &[f64; 4]) -> [f64; 4] {
        let child = |own: f64| {
            let rate = own - omega[0];
            let dry = 2e-3 * rate / rate.hypot(0.5);
            // The width of a law that is given none.
            -1e-3 * rate - dry - 1e-4 * own.hypot(0.01) * own
        };
        [0.0, child(omega[1]), child(omega[2]), child(omega[3])]
    }

    fn drive(time: f64, theta: &[f64; 4]) -> [f64; 4] {
        let child = |own: f64| inertial(time, 0.1 * 0.1, own);
        [0.0, child(theta[1]), child(theta[2]), child(theta[3])]
    }
}

/// Function of time, symmetric coordinates, what is said of their motion, and torques.
type Power<'m, const LINKS: usize> =
    Box<dyn Fn(f64, &[f64; LINKS], &[f64; LINKS], &[f64; LINKS]) -> f64 + 'm>;

/// A power on H_d: from momenta, from rates, and the torques on the links behind it from time,
/// angles, angular velocities and torques from outside.
struct Case<'m, const LINKS: usize> {
    of: &'static str,
    forms: [Power<'m, LINKS>; 2],
    hand: fn(f64, [&[f64; LINKS]; 3]) -> [f64; LINKS],
}

/// Compares each power in both forms with ∂H_d/∂p_d times the torque on the difference: H_d
/// is quadratic in the momentum, so that its slope is a difference of two values.
fn assert_powers<const LINKS: usize>(
    from_symmetric: impl Fn(&[f64; LINKS]) -> [f64; LINKS],
    momenta_of: impl Fn(&[f64; LINKS], &[f64; LINKS]) -> [f64; LINKS],
    (difference, energy): (usize, impl Fn(&[f64; LINKS], &[f64; LINKS]) -> f64),
    cases: &[Case<'_, LINKS>],
) {
    let mut unit = [0.0; LINKS];
    unit[difference] = 1.0;
    let weights = from_symmetric(&unit);
    for Case { of, forms, hand } in cases {
        let mut random = Random::new(6);
        let mut largest = 0.0_f64;
        for _ in 0..100 {
            let time = random.between(-3.0, 3.0);
            let coordinates: [f64; LINKS] = random.array(-3.0, 3.0);
            let rates: [f64; LINKS] = random.array(-9.0, 9.0);
            let torques: [f64; LINKS] = random.array(-0.1, 0.1);
            let momenta = momenta_of(&coordinates, &rates);
            let at = |momentum: f64| {
                let mut moved = momenta;
                moved[difference] = momentum;
                energy(&coordinates, &moved)
            };
            let own = momenta[difference];
            let shift = own.abs().max(1e-3);
            let velocity = (at(own + shift) - at(own - shift)) / (2.0 * shift);
            let (theta, omega) = (from_symmetric(&coordinates), from_symmetric(&rates));
            let hand = hand(time, [&theta, &omega, &torques]);
            let parts = weights.iter().zip(hand).map(|(weight, own)| weight * own);
            let expected = velocity * parts.clone().sum::<f64>();
            let size: f64 = parts.map(f64::abs).sum();
            let scale = 1e-12 * (velocity.abs() * size + 1e-2 * velocity.abs() + 1e-2 * size);
            let [momenta, rates] = [&momenta, &rates];
            for (form, motion) in forms.iter().zip([momenta, rates]) {
                let found = form(time, &coordinates, motion, &torques);
                assert!((found - expected).abs() < scale, "{of}: {found} {expected}");
            }
            largest = largest.max(expected.abs() / scale);
        }
        // The comparison is of something.
        assert!(largest > 1e9, "{of}: {largest}");
    }
}

/// Friction, drive and torques from outside on a model.
macro_rules! assert_all_powers {
    (
        $name:ident, $difference:literal, $energy:ident,
        $friction:ident, $friction_from_rates:ident,
        $drive:ident, $drive_from_rates:ident,
        $outside:ident, $outside_from_rates:ident
    ) => {{
        let model = $name::new();
        assert_powers(
            |symmetric| model.from_symmetric(symmetric),
            |q, v| model.symmetric_momenta(q, v),
            ($difference, |q: &_, p: &_| model.$energy(q, p)),
            &[
                Case {
                    of: "friction",
                    forms: [
                        Box::new(|_, q, p, _| model.$friction(q, p)),
                        Box::new(|_, q, v, _| model.$friction_from_rates(q, v)),
                    ],
                    hand: |_, [_, omega, _]| <$name as Hand<_>>::friction(omega),
                },
                Case {
                    of: "drive",
                    forms: [
                        Box::new(|time, q, p, _| model.$drive(time, q, p)),
                        Box::new(|time, q, v, _| model.$drive_from_rates(time, q, v)),
                    ],
                    hand: |time, [theta, _, _]| <$name as Hand<_>>::drive(time, theta),
                },
                Case {
                    of: "torques from outside",
                    forms: [
                        Box::new(|_, q, p, torques| model.$outside(q, p, torques)),
                        Box::new(|_, q, v, torques| model.$outside_from_rates(q, v, torques)),
                    ],
                    hand: |_, [_, _, torques]| *torques,
                },
            ],
        );
    }};
}

#[test]
fn powers_on_equal_and_unequal_copies() {
    assert_all_powers!(
        Equal,
        2,
        antiphase_energy,
        antiphase_friction_power,
        antiphase_friction_power_from_rates,
        antiphase_drive_power,
        antiphase_drive_power_from_rates,
        antiphase_outside_power,
        antiphase_outside_power_from_rates
    );
    assert_all_powers!(
        Unequal,
        2,
        antiphase_energy,
        antiphase_friction_power,
        antiphase_friction_power_from_rates,
        antiphase_drive_power,
        antiphase_drive_power_from_rates,
        antiphase_outside_power,
        antiphase_outside_power_from_rates
    );
}

#[test]
fn powers_on_each_difference_of_three_copies() {
    assert_all_powers!(
        Triple,
        2,
        antiphase_energy_d1,
        antiphase_friction_power_d1,
        antiphase_friction_power_from_rates_d1,
        antiphase_drive_power_d1,
        antiphase_drive_power_from_rates_d1,
        antiphase_outside_power_d1,
        antiphase_outside_power_from_rates_d1
    );
    assert_all_powers!(
        Triple,
        3,
        antiphase_energy_d2,
        antiphase_friction_power_d2,
        antiphase_friction_power_from_rates_d2,
        antiphase_drive_power_d2,
        antiphase_drive_power_from_rates_d2,
        antiphase_outside_power_d2,
        antiphase_outside_power_from_rates_d2
    );
}

#[test]
fn power_of_torques_without_friction_and_drive() {
    let model = Paper::new();
    assert_powers(
        |symmetric| model.from_symmetric(symmetric),
        |q, v| model.symmetric_momenta(q, v),
        (2, |q: &_, p: &_| model.antiphase_energy(q, p)),
        &[Case {
            of: "torques from outside",
            forms: [
                Box::new(|_, q, p, torques| model.antiphase_outside_power(q, p, torques)),
                Box::new(|_, q, v, torques| {
                    model.antiphase_outside_power_from_rates(q, v, torques)
                }),
            ],
            hand: |_, [_, _, torques]| *torques,
        }],
    );
}
