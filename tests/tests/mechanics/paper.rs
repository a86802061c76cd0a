//! The derived formulas are the paper's: symbolic equality, with the paper's
//! formulas written out here from its text.
//!
//! Link 1 is `parent`, links 2 and 3 are the copies of `child`. Equation
//! numbers are labels of the paper's source.

use branched_pendulum_codegen::functions::Counting;
use branched_pendulum_codegen::mechanics::algebra::Formula;
use branched_pendulum_codegen::mechanics::expression::Expr;

use crate::fixtures::NAMED;
use crate::formulas::{inside, n, product};
use crate::letters::{Letters, in_both_scenes};
use crate::support::{compile_item, energies};

fn sum<const N: usize>(terms: [Formula; N]) -> Formula {
    terms.into_iter().sum()
}

/// The relations between the constants and the apparatus, below Eq. (U//th123).
#[test]
fn constants() {
    let compiled = compile_item(NAMED);
    inside(&compiled, |algebra| {
        let [m_1, m_2, d_1, d_2, i_1, i_2, l, g] =
            ["m_1", "m_2", "d_1", "d_2", "i_1", "i_2", "l", "g"].map(|name| algebra.s(name));
        let expected = [
            // M_1 = I_1 + m_1 d_1² + 2 m_2 ℓ²
            (
                "M_parent",
                sum([i_1, &m_1 * &d_1.pow(2), product([&n(2), &m_2, &l.pow(2)])]),
            ),
            // M_2 = I_2 + m_2 d_2²
            ("M_child", &i_2 + &(&m_2 * &d_2.pow(2))),
            // μ = m_2 ℓ d_2
            ("μ_child,parent", product([&m_2, &l, &d_2])),
            // G_1 = m_1 g d_1 + 2 m_2 g ℓ
            (
                "G_parent",
                &product([&m_1, &g, &d_1]) + &product([&n(2), &m_2, &g, &l]),
            ),
            // G_2 = m_2 g d_2
            ("G_child", product([&m_2, &g, &d_2])),
        ];
        for (name, expected) in expected {
            let constant = algebra.mechanics().constant(algebra.id(name));
            let value = &constant.expect("a constant").value;
            let difference = &Formula::from_expr(value) - &expected;
            assert!(difference.expand().is_zero(), "{name} = {value:?}");
        }
    });
}

/// M and U in the absolute angles, Eqs. (M//th123) and (U//th123).
#[test]
fn lagrangian_in_absolute_angles() {
    in_both_scenes(|algebra, letters| {
        let frame = &algebra.mechanics().absolute;
        let coupling =
            |child: usize| &letters.mu * &algebra.s(&format!("cos(θ_child_{child} − θ_parent)"));
        let mass = [
            [letters.m_1.clone(), coupling(1), coupling(2)],
            [coupling(1), letters.m_2.clone(), n(0)],
            [coupling(2), n(0), letters.m_2.clone()],
        ];
        for (row, entries) in mass.iter().enumerate() {
            for (column, expected) in entries.iter().enumerate() {
                let derived = algebra.entry(&frame.mass, row, column);
                assert!((&derived - expected).expand().is_zero());
            }
        }
        let cos = |link: &str| algebra.s(&format!("cos θ_{link}"));
        let potential = sum([
            &letters.g_1 * &(&n(1) - &cos("parent")),
            &letters.g_2 * &(&(&n(2) - &cos("child_1")) - &cos("child_2")),
        ]);
        let derived = Formula::from_expr(&energies(frame).potential);
        assert!((&derived - &potential).expand().is_zero());
    });
}

/// M̃ and U in θ_1, θ_m, θ_d, Eqs. (M*) and (U.thMD*).
#[test]
fn lagrangian_in_symmetric_coordinates() {
    in_both_scenes(|algebra, letters| {
        let frame = algebra.symmetric();
        let two_mu = &n(2) * &letters.mu;
        let (cos_d, sin_d) = (algebra.s("cos θ_d"), algebra.s("sin θ_d"));
        let with_m = product([&two_mu, &letters.c, &cos_d]);
        let with_d = -product([&two_mu, &letters.s, &sin_d]);
        let two_m_2 = &n(2) * &letters.m_2;
        let mass = [
            [letters.m_1.clone(), with_m.clone(), with_d.clone()],
            [with_m, two_m_2.clone(), n(0)],
            [with_d, n(0), two_m_2],
        ];
        for (row, entries) in mass.iter().enumerate() {
            for (column, expected) in entries.iter().enumerate() {
                let derived = algebra.entry(&frame.mass, row, column);
                assert!((&derived - expected).expand().is_zero());
            }
        }
        let potential = sum([
            &letters.g_1 * &(&n(1) - &algebra.s("cos θ_parent")),
            product([&n(2), &letters.g_2]),
            -product([&n(2), &letters.g_2, &algebra.s("cos θ_m"), &cos_d]),
        ]);
        let derived = Formula::from_expr(&energies(frame).potential);
        assert!((&derived - &potential).expand().is_zero());
    });
}

/// D, below Eq. (invM*).
#[test]
fn determinant() {
    in_both_scenes(|algebra, letters| {
        let expected = &product([&n(2), &letters.m_1, &letters.m_2])
            - &product([&n(4), &letters.mu.pow(2), &letters.c.pow(2)]);
        let (_, value) = algebra.determinant();
        assert!((&value - &expected).expand().is_zero(), "{value:?}");
    });
}

/// Both matrices of Eq. (invM*).
#[test]
fn inverse_mass_matrix_to_first_order() {
    in_both_scenes(|algebra, letters| {
        let Letters {
            m_1,
            m_2,
            mu,
            theta_d,
            c,
            s,
            d,
            ..
        } = letters;
        let expansion = algebra.mechanics().expansion.as_ref().expect("a transfer");
        let written = expansion.written_out.as_ref().expect("a small block");
        let off = -(&product([&n(2), mu, c]) / d);
        let leading = [
            [&product([&n(2), m_2]) / d, off.clone(), n(0)],
            [off, m_1 / d, n(0)],
            [n(0), n(0), product([&n(2), m_2]).pow(-1)],
        ];
        let factor = &product([&n(2), mu, theta_d, s]) / d;
        let with_m = &factor * &-(&product([mu, c]) / m_2);
        let first = [
            [n(0), n(0), factor.clone()],
            [n(0), n(0), with_m.clone()],
            [factor, with_m, n(0)],
        ];
        let check = |name: &str, derived: &[Vec<Expr>], expected: &[[Formula; 3]; 3]| {
            assert_eq!(derived.len(), 3);
            for (row, (derived, expected)) in derived.iter().zip(expected).enumerate() {
                assert_eq!(derived.len(), 3);
                for (column, (derived, expected)) in derived.iter().zip(expected).enumerate() {
                    let what = format!("{name}[{row}][{column}]");
                    algebra.assert_equal(&what, derived, expected);
                }
            }
        };
        check("leading", &written.inverse, &leading);
        check("first order", &written.inverse_first_order, &first);
    });
}

/// The inverse is one: M̃ (M⁽⁰⁾⁻¹ + first order) = 1 + O(θ_d²).
#[test]
fn the_expanded_inverse_is_an_inverse() {
    in_both_scenes(|algebra, _| {
        let expansion = algebra.mechanics().expansion.as_ref().expect("a transfer");
        let written = expansion.written_out.as_ref().expect("a small block");
        let frame = algebra.symmetric();
        let theta_d = algebra.id("θ_d");
        let small_angle = [
            (algebra.id("cos θ_d"), n(1)),
            (algebra.id("sin θ_d"), Formula::symbol(theta_d)),
        ];
        for row in 0..3 {
            for column in 0..3 {
                let entry: Formula = (0..3)
                    .map(|k| {
                        let mass = algebra.entry(&frame.mass, row, k).substitute(&small_angle);
                        let inverse = &Formula::from_expr(&written.inverse[k][column])
                            + &Formula::from_expr(&written.inverse_first_order[k][column]);
                        &mass * &inverse
                    })
                    .sum();
                let orders = entry.coefficients(&[theta_d]);
                let order = |power: u32| {
                    let found = orders.get(&vec![power]);
                    found.cloned().unwrap_or_else(Formula::zero)
                };
                let unit = n(i64::from(row == column));
                assert!(algebra.vanishes(&(&order(0) - &unit), &["M_child"]));
                assert!(algebra.vanishes(&order(1), &["M_child"]));
            }
        }
    });
}

/// K to first order in θ_d, Eq. (K.approx): ½ pᵀ M̃⁻¹ p with the derived
/// inverse.
#[test]
fn kinetic_energy_to_first_order() {
    in_both_scenes(|algebra, letters| {
        let Letters {
            m_1,
            m_2,
            mu,
            p_1,
            p_m,
            p_d,
            theta_d,
            c,
            s,
            d,
            ..
        } = letters;
        let expected = sum([
            &(m_2 * &p_1.pow(2)) / d,
            &(&(&(m_1 * p_m) - &product([&n(4), mu, c, p_1])) * p_m) / &(&n(2) * d),
            &p_d.pow(2) / &(&n(4) * m_2),
            &product([&n(2), mu, s, &letters.x(), p_d, theta_d]) / &(m_2 * d),
        ]);
        let expansion = algebra.mechanics().expansion.as_ref().expect("a transfer");
        let written = expansion.written_out.as_ref().expect("a small block");
        let p = [p_1, p_m, p_d];
        let mut derived = Formula::zero();
        for row in 0..3 {
            for column in 0..3 {
                let inverse = &Formula::from_expr(&written.inverse[row][column])
                    + &Formula::from_expr(&written.inverse_first_order[row][column]);
                derived = &derived + &product([&n(2).pow(-1), p[row], &inverse, p[column]]);
            }
        }
        assert!(algebra.vanishes(&(&derived - &expected), &["M_child"]));
    });
}

/// H_d, Eq. (Hd).
#[test]
fn sub_hamiltonian() {
    in_both_scenes(|algebra, letters| {
        let energy = &algebra.mechanics().transfers[0].energy;
        let kinetic = &letters.p_d.pow(2) / &(&n(4) * &letters.m_2);
        algebra.assert_equal("kinetic", &energy.kinetic, &kinetic);
        let potential = &letters.g_2 * &algebra.s("sin θ_d").pow(2);
        algebra.assert_equal("potential", &energy.potential, &potential);
    });
}

/// The comparison can fail: the text above Eq. (Hd) prints G_1 once where it
/// must be G_2, and a sign or a factor is noticed too.
#[test]
fn a_misprint_is_noticed() {
    in_both_scenes(|algebra, letters| {
        let transfer = &algebra.mechanics().transfers[0];
        let potential = Formula::from_expr(&transfer.energy.potential);
        let misprint = &letters.g_1 * &algebra.s("sin θ_d").pow(2);
        assert!(!algebra.vanishes(&(&potential - &misprint), &["M_child"]));
        let angle = transfer
            .truncated(Counting::Angle, 1)
            .expect("the scene asks for it");
        let kinetic = Formula::from_expr(&angle.kinetic);
        assert!(!algebra.vanishes(&(&kinetic + &kinetic), &["M_child"]));
        let twice = &n(2) * &kinetic;
        assert!(!algebra.vanishes(&(&kinetic - &twice), &["M_child"]));
    });
}

/// W_K and W_P, Eqs. (WK) and (WP).
#[test]
fn energy_transfer_to_first_order_in_the_angle() {
    in_both_scenes(|algebra, letters| {
        let Letters {
            m_2,
            mu,
            g_2,
            p_1,
            p_m,
            p_d,
            theta_d,
            c,
            s,
            d,
            ..
        } = letters;
        let braces = &-(m_2 * p_1) + &product([mu, c, p_m]);
        let kinetic = &product([mu, s, &braces, &p_d.pow(2)]) / &(&m_2.pow(2) * d);
        let lift = &n(1) - &algebra.s("cos θ_m");
        let potential = &product([g_2, &lift, p_d, theta_d]) / m_2;
        let angle = algebra.mechanics().transfers[0].truncated(Counting::Angle, 1);
        let angle = angle.expect("the scene asks for it");
        algebra.assert_equal("W_K", &angle.kinetic, &kinetic);
        algebra.assert_equal("W_P", &angle.potential, &potential);
    });
}

/// The consistent quadratic form W₂ of physics §5, whole and by coefficient.
#[test]
fn energy_transfer_to_second_order_in_the_amplitude() {
    in_both_scenes(|algebra, letters| {
        let Letters {
            m_1,
            m_2,
            mu,
            g_2,
            p_1,
            p_m,
            p_d,
            theta_d,
            c,
            s,
            d,
            ..
        } = letters;
        let x = letters.x();
        // ω_1 = (2 M_2 p_1 − 2 μ c p_m)/D, ω_m = (M_1 p_m − 2 μ c p_1)/D
        let omega_1 = &(&n(2) * &x) / d;
        let omega_m = &(&(m_1 * p_m) - &product([&n(2), mu, c, p_1])) / d;
        let a_pp = -(&product([mu, s, &x]) / &(&m_2.pow(2) * d));
        let lift = &(g_2 * &(&n(1) - &algebra.s("cos θ_m"))) / m_2;
        let inertial = sum([
            &product([&mu.pow(2), &s.pow(2), &omega_1.pow(2)]) / m_2,
            product([mu, c, &omega_1, &omega_m]),
        ]);
        let a_pq = &lift - &(&inertial / m_2);
        let a_qq = &product([&n(4), g_2, mu, s, &x]) / &(m_2 * d);
        let transfer = &algebra.mechanics().transfers[0];
        let form = transfer.quadratic_form.as_ref().expect("one difference");
        algebra.assert_equal("a_pp", &form[0], &a_pp);
        algebra.assert_equal("a_pq", &form[1], &a_pq);
        algebra.assert_equal("a_qq", &form[2], &a_qq);
        let whole = sum([
            &a_pp * &p_d.pow(2),
            product([&a_pq, p_d, theta_d]),
            &a_qq * &theta_d.pow(2),
        ]);
        let potential = product([&lift, p_d, theta_d]);
        let amplitude = transfer
            .truncated(Counting::Amplitude, 2)
            .expect("asked for");
        algebra.assert_equal("kinetic", &amplitude.kinetic, &(&whole - &potential));
        algebra.assert_equal("potential", &amplitude.potential, &potential);
    });
}

/// The exact W of physics §5: G_2 sin(2θ_d) θ̇_d + (p_d/2M_2) ∂L/∂θ_d.
#[test]
fn exact_energy_transfer() {
    in_both_scenes(|algebra, letters| {
        let Letters {
            m_2,
            mu,
            g_2,
            p_d,
            c,
            s,
            ..
        } = letters;
        let [omega_1, omega_m, omega_d] = ["ω_parent", "ω_m", "ω_d"].map(|name| algebra.s(name));
        let (cos_d, sin_d) = (algebra.s("cos θ_d"), algebra.s("sin θ_d"));
        // ∂K/∂θ_d at fixed velocities, from Eq. (M*).
        let kinetic_slope = -sum([
            product([&n(2), mu, c, &sin_d, &omega_1, &omega_m]),
            product([&n(2), mu, s, &cos_d, &omega_1, &omega_d]),
        ]);
        let potential_slope = product([&n(2), g_2, &algebra.s("cos θ_m"), &sin_d]);
        let rate = p_d / &(&n(2) * m_2);
        // ∂V/∂θ_d of V = G_2 sin² θ_d.
        let own_slope = product([&n(2), g_2, &sin_d, &cos_d]);
        let expected = [
            // {H_d, K − T}
            sum([&own_slope * &(&omega_d - &rate), &rate * &kinetic_slope]),
            // {H_d, U − V}
            &rate * &(&own_slope - &potential_slope),
        ];
        let exact = algebra.mechanics().transfers[0].exact.as_ref();
        let exact = exact.expect("asked for");
        algebra.assert_equal("kinetic", &exact.kinetic, &expected[0]);
        algebra.assert_equal("potential", &exact.potential, &expected[1]);
    });
}
