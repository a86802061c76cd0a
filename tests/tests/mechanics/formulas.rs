//! Formulas inside the algebra: symbols by their text, and a normal form in
//! which equal formulas are equal.

use branched_pendulum_codegen::mechanics::algebra::{self, Formula};
use branched_pendulum_codegen::mechanics::expression::{Expr, SymbolId};
use branched_pendulum_codegen::mechanics::{Frame, MatrixEntry, Mechanics, Trigonometric, text};

use crate::support::Compiled;

/// The formulas of one scene.
pub(crate) struct Algebra<'a> {
    pub(crate) compiled: &'a Compiled,
}

/// Runs `work` inside the algebra.
pub(crate) fn inside<R: Send>(
    compiled: &Compiled,
    work: impl FnOnce(&Algebra<'_>) -> R + Send,
) -> R {
    algebra::run(|| work(&Algebra { compiled })).unwrap_or_else(|error| panic!("{error}"))
}

/// An integer.
pub(crate) fn n(value: i64) -> Formula {
    Formula::integer(value)
}

/// The product of some factors.
pub(crate) fn product<const N: usize>(factors: [&Formula; N]) -> Formula {
    factors
        .into_iter()
        .fold(n(1), |product, factor| &product * factor)
}

impl Algebra<'_> {
    pub(crate) fn mechanics(&self) -> &Mechanics {
        &self.compiled.mechanics
    }

    pub(crate) fn id(&self, text: &str) -> SymbolId {
        let mechanics = self.mechanics();
        let symbols = &mechanics.symbols;
        let parameter = || {
            let mut parameters = mechanics.parameters.iter().copied();
            parameters.find(|&id| symbols.get(id).text == text)
        };
        symbols
            .find(text)
            .or_else(parameter)
            .unwrap_or_else(|| panic!("no symbol `{text}`"))
    }

    /// The symbol spelled `text`.
    pub(crate) fn s(&self, text: &str) -> Formula {
        Formula::symbol(self.id(text))
    }

    /// Entry (row, column) of a symmetric matrix.
    pub(crate) fn entry(&self, matrix: &[MatrixEntry], row: usize, column: usize) -> Formula {
        let (row, column) = (row.max(column), row.min(column));
        matrix
            .iter()
            .find(|entry| (entry.row, entry.column) == (row, column))
            .map_or_else(Formula::zero, |entry| Formula::from_expr(&entry.value))
    }

    pub(crate) fn symmetric(&self) -> &Frame {
        self.mechanics()
            .symmetric
            .as_ref()
            .expect("the scene asks for symmetric coordinates")
    }

    /// Every in-phase velocity w written out over D.
    pub(crate) fn written_out(&self) -> Vec<(SymbolId, Formula)> {
        let expansion = self.mechanics().expansion.as_ref().expect("a transfer");
        let written = expansion.written_out.as_ref().expect("a small block");
        expansion
            .velocities
            .iter()
            .zip(&written.velocities)
            .map(|(id, value)| (*id, Formula::from_expr(value)))
            .collect()
    }

    /// D and its value.
    pub(crate) fn determinant(&self) -> (SymbolId, Formula) {
        let expansion = self.mechanics().expansion.as_ref().expect("a transfer");
        let written = expansion.written_out.as_ref().expect("a small block");
        (
            written.determinant,
            Formula::from_expr(&written.determinant_value),
        )
    }

    /// cos² → 1 − sin² of every angle and difference of angles.
    pub(crate) fn reduce(&self, formula: &Formula) -> Formula {
        let table = &self.mechanics().trigonometry;
        let mut reduced = formula.expand();
        for (&cos, meaning) in table {
            let partner = match *meaning {
                Trigonometric::Cos(a) => Trigonometric::Sin(a),
                Trigonometric::CosBetween(a, b) => Trigonometric::SinBetween(a, b),
                _ => continue,
            };
            let sin = table.iter().find(|(_, other)| **other == partner);
            let (&sin, _) = sin.expect("a cosine has its sine");
            let square = &n(1) - &Formula::symbol(sin).pow(2);
            reduced = reduced
                .coefficients(&[cos])
                .into_iter()
                .map(|(power, coefficient)| {
                    let odd = Formula::symbol(cos).pow((power[0] % 2) as i32);
                    let even = square.pow((power[0] / 2) as i32);
                    product([&coefficient, &odd, &even])
                })
                .sum::<Formula>()
                .expand();
        }
        reduced
    }

    /// Returns true if a polynomial in the symbols, over powers of D and of the
    /// symbols in `denominators`, is identically zero: w written out,
    /// multiplied by all denominators, D written out, sines and cosines
    /// reduced.
    pub(crate) fn vanishes(&self, difference: &Formula, denominators: &[&str]) -> bool {
        let (determinant, value) = self.determinant();
        let mut cleared = difference.substitute(&self.written_out()).expand();
        let common = denominators
            .iter()
            .map(|text| self.s(text))
            .fold(Formula::symbol(determinant), |product, s| &product * &s);
        cleared = (&cleared * &common.pow(4)).expand();
        let polynomial = cleared.substitute(&[(determinant, value)]);
        self.reduce(&polynomial).is_zero()
    }

    /// Fails unless `derived` equals `expected`, both over powers of D and
    /// M_child.
    pub(crate) fn assert_equal(&self, what: &str, derived: &Expr, expected: &Formula) {
        let difference = &Formula::from_expr(derived) - expected;
        assert!(
            self.vanishes(&difference, &["M_child"]),
            "{what}: derived {}, expected {}",
            text(derived, &self.mechanics().symbols),
            text(
                &expected.to_expr(&self.mechanics().symbols),
                &self.mechanics().symbols
            ),
        );
    }
}
