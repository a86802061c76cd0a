//! The program says what was derived: expressions rebuilt from it are equal to
//! those of the mechanics, symbol by symbol, and its solutions solve.

use branched_pendulum_codegen::functions::Counting;
use branched_pendulum_codegen::mechanics::algebra::Formula;
use branched_pendulum_codegen::mechanics::expression::{Expr, SymbolId};
use branched_pendulum_codegen::mechanics::{MatrixEntry, Temporal, Trigonometric};
use branched_pendulum_codegen::program::Rebuilt;

use crate::fixtures::FRICTIONAL;
use crate::formulas::{Algebra, inside, product};
use branched_pendulum_compiler_tests::source;

use crate::support::{Compiled, compile_item, compile_paper, energies};

impl Algebra<'_> {
    /// The outputs of an entry point, from its program.
    fn rebuilt(&self, entry: &str) -> Vec<Formula> {
        let program = &self.compiled.program;
        let rebuilt = Rebuilt::new(program, self.mechanics());
        let entry = program.entry(entry).expect("the entry point");
        entry
            .outputs
            .iter()
            .map(|&output| Formula::from_expr(&rebuilt.value(output).expect("rebuilt")))
            .collect()
    }

    /// The derived expression in what programs are written in: single angles and rates,
    /// and w solved for.
    fn spelt_out(&self, formula: &Formula) -> Formula {
        let table = &self.mechanics().trigonometry;
        let symbol = |wanted: Trigonometric| {
            let found = table.iter().find(|(_, meaning)| **meaning == wanted);
            Formula::symbol(*found.expect("every angle has its sine and cosine").0)
        };
        let turned: Vec<(SymbolId, Formula)> = table
            .iter()
            .filter_map(|(&id, meaning)| {
                let (a, b) = match *meaning {
                    Trigonometric::CosBetween(a, b) | Trigonometric::SinBetween(a, b) => (a, b),
                    _ => return None,
                };
                let (cos_a, sin_a) = (symbol(Trigonometric::Cos(a)), symbol(Trigonometric::Sin(a)));
                let (cos_b, sin_b) = (symbol(Trigonometric::Cos(b)), symbol(Trigonometric::Sin(b)));
                let value = match *meaning {
                    Trigonometric::CosBetween(..) => &(&cos_a * &cos_b) + &(&sin_a * &sin_b),
                    _ => &(&sin_a * &cos_b) - &(&cos_a * &sin_b),
                };
                Some((id, value))
            })
            .collect();
        formula
            .substitute(&self.functions_of_time())
            .substitute(&self.written_out())
            .substitute(&[self.determinant()])
            .substitute(&turned)
            .substitute(&self.joints())
    }

    /// Angles and rates of joints.
    fn joints(&self) -> Vec<(SymbolId, Formula)> {
        let joints = self.mechanics().joints.iter();
        joints
            .map(|(&id, joint)| (id, Formula::from_expr(&joint.formula())))
            .collect()
    }

    /// Torque and accelerations of the drive, where there is one.
    fn functions_of_time(&self) -> Vec<(SymbolId, Formula)> {
        let drive = self.mechanics().drive.iter();
        drive
            .flat_map(|drive| &drive.temporal)
            .filter_map(|(&id, meaning)| match meaning {
                Temporal::Given(value) => Some((id, Formula::from_expr(value))),
                _ => None,
            })
            .collect()
    }

    /// Fails unless the outputs of an entry point are the derived expressions,
    /// after `replacements` in the latter.
    fn assert_rebuilt(&self, entry: &str, derived: &[&Expr], replacements: &[(SymbolId, Formula)]) {
        let found = self.rebuilt(entry);
        assert_eq!(found.len(), derived.len(), "{entry}");
        for (index, (found, derived)) in found.iter().zip(derived).enumerate() {
            let derived = Formula::from_expr(derived).substitute(replacements);
            let difference = found - &self.spelt_out(&derived);
            assert!(difference.together().is_zero(), "{entry}[{index}]");
        }
    }

    /// Fails unless Σ_j M_ij x_j + rest_i = 0 for the entry point's outputs x.
    fn assert_solves(&self, entry: &str, mass: &[MatrixEntry], rest: &[Formula]) {
        let solution = self.rebuilt(entry);
        for (row, rest) in rest.iter().enumerate() {
            let products: Formula = solution
                .iter()
                .enumerate()
                .map(|(column, x)| &self.spelt_out(&self.entry(mass, row, column)) * x)
                .sum();
            // The comparison can fail: without the rest it does.
            assert!(!products.together().is_zero(), "{entry}: row {row}");
            let residual = &products + &self.spelt_out(rest);
            assert!(residual.together().is_zero(), "{entry}: row {row}");
        }
    }
}

#[test]
fn energies_and_momenta() {
    let compiled = compile_paper();
    inside(&compiled, |algebra| {
        let frame = &algebra.mechanics().absolute;
        algebra.assert_rebuilt("kinetic_energy", &[&energies(frame).kinetic], &[]);
        algebra.assert_rebuilt("potential_energy", &[&energies(frame).potential], &[]);
        let momenta: Vec<&Expr> = frame.momentum.iter().flatten().collect();
        algebra.assert_rebuilt("momenta", &momenta, &[]);
        let symmetric = algebra.symmetric();
        let momenta: Vec<&Expr> = symmetric.momentum.iter().flatten().collect();
        algebra.assert_rebuilt("symmetric_momenta", &momenta, &[]);
    });
}

#[test]
fn energy_transfers() {
    let compiled = compile_paper();
    inside(&compiled, |algebra| {
        let frame = algebra.symmetric();
        let transfer = &algebra.mechanics().transfers[0];
        let energy = &Formula::from_expr(&transfer.energy.kinetic)
            + &Formula::from_expr(&transfer.energy.potential);
        let energy = energy.to_expr(&algebra.mechanics().symbols);
        algebra.assert_rebuilt("antiphase_energy", &[&energy], &[]);
        let angle = transfer.truncated(Counting::Angle, 1).expect("asked for");
        let parts = [&angle.kinetic, &angle.potential];
        algebra.assert_rebuilt("transfer_angle_1", &parts, &[]);
        let amplitude = transfer
            .truncated(Counting::Amplitude, 2)
            .expect("asked for");
        let parts = [&amplitude.kinetic, &amplitude.potential];
        algebra.assert_rebuilt("transfer_amplitude_2", &parts, &[]);
        let form: Vec<&Expr> = transfer.quadratic_form.iter().flatten().collect();
        algebra.assert_rebuilt("transfer_quadratic_form", &form, &[]);
        let exact = transfer.exact.as_ref().expect("asked for");
        let parts = [&exact.kinetic, &exact.potential];
        let momenta: Vec<(SymbolId, Formula)> = frame
            .momenta
            .iter()
            .zip(frame.momentum.iter().flatten())
            .map(|(&id, value)| (id, Formula::from_expr(value)))
            .collect();
        algebra.assert_rebuilt("transfer_exact_from_rates", &parts, &momenta);
        let velocities: Vec<(SymbolId, Formula)> = frame
            .velocities
            .iter()
            .copied()
            .zip(algebra.rebuilt("symmetric_velocities"))
            .collect();
        algebra.assert_rebuilt("transfer_exact", &parts, &velocities);
    });
}

/// The power of friction and drag on H_d of a pair is −(c + k) p_d θ̇_d / M:
/// beside their mean, both children turn by θ̇_d and −θ̇_d against the parent
/// and against the ground.
#[test]
fn friction_power() {
    let compiled = compile_item(FRICTIONAL);
    inside(&compiled, |algebra| {
        let friction = &algebra.mechanics().transfers[0].friction;
        let both = &algebra.s("c_child") + &algebra.s("k_child");
        let expected =
            -(&product([&both, &algebra.s("p_d"), &algebra.s("ω_d")]) / &algebra.s("M_child"));
        algebra.assert_equal("friction", friction, &expected);
    });
}

/// M α + b = 0, with friction, in both sets of coordinates.
#[test]
fn accelerations_solve_the_equations_of_motion() {
    let compiled = compile_item(FRICTIONAL);
    inside(&compiled, |algebra| {
        for (entry, frame) in [
            ("accelerations", &algebra.mechanics().absolute),
            ("symmetric_accelerations", algebra.symmetric()),
        ] {
            let bias: Vec<Formula> = frame.bias.iter().map(Formula::from_expr).collect();
            algebra.assert_solves(entry, &frame.mass, &bias);
        }
    });
}

/// Accelerations of a driven tree solve its equations of motion, and the powers
/// belong to it.
#[test]
fn drive() {
    // The elimination is that of the derived equations, symbol by symbol; the
    // recursion has its own constants and uses cos² + sin² = 1.
    let path = source::fixture("scenes/driven.rs");
    let text = std::fs::read_to_string(path).expect("the fixture exists");
    let compiled = compile_item(&text.replacen("emit(", "solve = factorization, emit(", 1));
    inside(&compiled, |algebra| {
        let mechanics = algebra.mechanics();
        for (entry, frame) in [
            ("accelerations", &mechanics.absolute),
            ("symmetric_accelerations", algebra.symmetric()),
        ] {
            let bias: Vec<Formula> = frame.bias.iter().map(Formula::from_expr).collect();
            algebra.assert_solves(entry, &frame.mass, &bias);
        }
        let drive = mechanics.drive.as_ref().expect("the scene has one");
        for (entry, power) in [
            ("drive_power", &drive.power),
            ("friction_power", &mechanics.friction_power),
        ] {
            let power = power.as_ref().expect("the scene asks for energies");
            algebra.assert_rebuilt(entry, &[power], &[]);
        }
    });
}

/// The drive of H_d of a pair: −(h p_d/M) sin θ_d (a_y cos θ_m − a_x sin θ_m).
#[test]
fn antiphase_drive_power() {
    let compiled: Compiled = source::scene("driven").into();
    inside(&compiled, |algebra| {
        let drive = &algebra.mechanics().transfers[0].drive;
        let up = product([&algebra.s("a_y"), &algebra.s("cos θ_m")]);
        let aside = product([&algebra.s("a_x"), &algebra.s("sin θ_m")]);
        let lever = product([
            &algebra.s("h_twig"),
            &algebra.s("p_d"),
            &algebra.s("sin θ_d"),
        ]);
        let expected = -(&(&lever * &(&up - &aside)) / &algebra.s("M_twig"));
        let difference = &Formula::from_expr(drive) - &expected;
        assert!(difference.together().is_zero());
        let frame = algebra.symmetric();
        let momenta = frame.momentum.iter().flatten();
        let momenta: Vec<(SymbolId, Formula)> = frame
            .momenta
            .iter()
            .zip(momenta)
            .map(|(&id, value)| (id, Formula::from_expr(value)))
            .collect();
        algebra.assert_rebuilt("antiphase_drive_power_from_rates", &[drive], &momenta);
        algebra.assert_rebuilt("antiphase_drive_power", &[drive], &[]);
    });
}

/// The powers are those of the generalized forces: Σ Q_i ω_i.
#[test]
fn powers_are_those_of_the_forces() {
    let compiled: Compiled = source::scene("driven").into();
    inside(&compiled, |algebra| {
        let mechanics = algebra.mechanics();
        let drive = mechanics.drive.as_ref().expect("the scene has one");
        let sum = |forces: &[Expr], velocities: &[SymbolId]| -> Formula {
            let terms = forces.iter().zip(velocities);
            terms
                .map(|(force, &v)| &Formula::from_expr(force) * &Formula::symbol(v))
                .sum()
        };
        let frame = &mechanics.absolute;
        for (forces, power) in [
            (&frame.drive, &drive.power),
            (&frame.dissipative_forces, &mechanics.friction_power),
        ] {
            let power = Formula::from_expr(power.as_ref().expect("asked for"));
            let difference = &sum(forces, &frame.velocities) - &power;
            let difference = difference.substitute(&algebra.joints());
            assert!(!power.is_zero() && difference.expand().is_zero());
        }
    });
}

/// M q̇ − p = 0, in both sets of coordinates.
#[test]
fn velocities_solve_for_momenta() {
    let compiled = compile_paper();
    inside(&compiled, |algebra| {
        for (entry, frame) in [
            ("velocities", &algebra.mechanics().absolute),
            ("symmetric_velocities", algebra.symmetric()),
        ] {
            let momenta: Vec<Formula> = frame
                .momenta
                .iter()
                .map(|&momentum| -Formula::symbol(momentum))
                .collect();
            algebra.assert_solves(entry, &frame.mass, &momenta);
        }
    });
}

/// H = K + U with K = ½ q̇ᵀ p and q̇ as the program solves it.
#[test]
fn hamiltonian() {
    let compiled = compile_paper();
    inside(&compiled, |algebra| {
        let frame = algebra.symmetric();
        let velocities: Vec<(SymbolId, Formula)> = frame
            .velocities
            .iter()
            .copied()
            .zip(algebra.rebuilt("symmetric_velocities"))
            .collect();
        let energy = &Formula::from_expr(&energies(frame).kinetic)
            + &Formula::from_expr(&energies(frame).potential);
        let energy = energy.to_expr(&algebra.mechanics().symbols);
        algebra.assert_rebuilt("hamiltonian", &[&energy], &velocities);
    });
}
