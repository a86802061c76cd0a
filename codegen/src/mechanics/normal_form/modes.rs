//! Linear modes in closed form.

use super::definitions::{Definitions, Spelling};
use super::unit;
use crate::mechanics::algebra::Formula;
use crate::mechanics::expression::{Role, SymbolId};
use crate::mechanics::frame::MassMatrix;

pub(super) const SINGLE: Spelling = ["1", "1", "1"];
const SLOW: Spelling = ["plus", "+", "+"];
const FAST: Spelling = ["minus", "−", "-"];
pub(super) const DIFFERENCE: Spelling = ["difference", "d", "d"];

/// A linear mode. Its motion is θ_i = u_i X with X = x/√J and the canonical coordinate x, which
/// oscillates with the amplitude √(2 I).
pub(super) struct Mode {
    pub(super) name: Spelling,
    /// Amplitude u of each link.
    pub(super) shape: Vec<Formula>,
    /// Amplitude of each link relative to its parent.
    pub(super) joints: Vec<Formula>,
    /// Modal inertia uᵀ M u.
    pub(super) inertia: Formula,
    /// Linear frequency Ω.
    pub(super) frequency: Formula,
    /// Scale J = Ω uᵀ M u of the action.
    pub(super) scale: Formula,
    /// Coordinate X, and velocity divided by Ω.
    pub(super) variables: [SymbolId; 2],
}

impl Definitions<'_, '_> {
    /// Derives the frequency and the scale of a mode from its shape.
    pub(super) fn mode(
        &mut self,
        name: Spelling,
        [shape, joints]: [Vec<Formula>; 2],
        [mass, stiffness]: [&MassMatrix; 2],
    ) -> Mode {
        let inertia = product(mass, &shape, &shape);
        let stiffness = product(stiffness, &shape, &shape);
        let (inertia, square) = match inertia.is_term() {
            true => (inertia.clone(), (&stiffness / &inertia).expand()),
            false => {
                let inertia = self.define(["modal_inertia", "m", "m"], &[name], &inertia);
                (inertia.clone(), &stiffness / &inertia)
            }
        };
        let frequency = self.define_root(["frequency", "Ω", "\\Omega"], &[name], &square);
        let scale = &frequency * &inertia;
        let scale = self.define(["action_scale", "J", "J"], &[name], &scale);
        let [code, text, latex] = name;
        let variables = ["X", "Y"].map(|letter| {
            self.derivation.symbols.intern(
                Role::Bookkeeping,
                &format!("{letter}_{code}"),
                &format!("{letter}_{text}"),
                &format!("{letter}_{{{latex}}}"),
            )
        });
        Mode {
            name,
            shape,
            joints,
            inertia,
            frequency,
            scale,
            variables,
        }
    }

    /// Derives the two in-phase modes of a tree of two orbits, the slow one first. The amplitude of the
    /// first orbit's link is 1, that of the second orbit's links is r, and β_2 r² + β_1 r − β_0 = 0.
    pub(super) fn two_modes(
        &mut self,
        is_second: &[bool],
        matrices: [&MassMatrix; 2],
    ) -> Vec<Mode> {
        let links = is_second.len();
        let [first, second] = [false, true].map(|own| unit(links, |link| is_second[link] == own));
        let [mass, stiffness] = matrices.map(|matrix| {
            [
                product(matrix, &first, &first),
                product(matrix, &first, &second),
                product(matrix, &second, &second),
            ]
        });
        let minor = |a: usize, b: usize| {
            (&(&mass[a] * &stiffness[b]) - &(&mass[b] * &stiffness[a])).expand()
        };
        let mut balance =
            |code, text, latex, value: Formula| self.define([code, text, latex], &[], &value);
        let quadratic = balance("shape_balance_2", "β_2", "\\beta_2", minor(1, 2));
        let linear = balance("shape_balance_1", "β_1", "\\beta_1", minor(0, 2));
        let constant = balance("shape_balance_0", "β_0", "\\beta_0", minor(1, 0));
        let square = &(&linear * &linear) + &(&Formula::integer(4) * &(&constant * &quadratic));
        let root = self.define_root(["shape_root", "β", "\\beta"], &[], &square);
        let below = (&Formula::integer(2) * &quadratic).pow(-1);
        let ratios = [
            (SLOW, &(&root - &linear) * &below),
            (FAST, &-(&root + &linear) * &below),
        ];
        let modes = ratios.map(|(name, ratio)| {
            let ratio = self.define(["ratio", "r", "r"], &[name], &ratio);
            let joint = &ratio - &Formula::integer(1);
            let joint = self.define(["joint_ratio", "ρ", "\\rho"], &[name], &joint);
            let of_links = |of_second: &Formula, of_first: i64| -> Vec<Formula> {
                let links = is_second.iter();
                let links = links.map(|&second| match second {
                    true => of_second.clone(),
                    false => Formula::integer(of_first),
                });
                links.collect()
            };
            self.mode(name, [of_links(&ratio, 1), of_links(&joint, 1)], matrices)
        });
        modes.into_iter().collect()
    }
}

/// Returns uᵀ M v, multiplied out.
pub(super) fn product(matrix: &MassMatrix, u: &[Formula], v: &[Formula]) -> Formula {
    let mut terms = Vec::new();
    for (a, b, entry) in matrix.iter() {
        terms.push(entry * &(&u[a] * &v[b]));
        if a != b {
            terms.push(entry * &(&u[b] * &v[a]));
        }
    }
    terms.into_iter().sum::<Formula>().expand()
}
