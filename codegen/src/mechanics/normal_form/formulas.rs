//! Symbols of the normal form with their definitions, as plain data.

use crate::mechanics::expression::{Expr, NamedFormula, SymbolId, Symbols};
use std::collections::BTreeSet;

/// Relation between a symbol and the expression that defines it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefinitionKind {
    /// The symbol is the value.
    Value,
    /// The symbol is the value, and a function returns this value alone.
    Result,
    /// The symbol is the square root of the value.
    Root,
    /// The symbol is the square root of the value, and is spelled as a root.
    SpelledRoot,
}

/// Definition of a symbol of the normal form.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalFormDefinition {
    /// The symbol.
    pub symbol: SymbolId,
    /// Relation between symbol and value.
    pub kind: DefinitionKind,
    /// Value in symbols that are defined before it, constants and angles.
    pub value: Expr,
}

/// Normal form of an in-phase motion with one or two modes, and of a difference next to it.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalFormFormulas {
    /// Definitions of all symbols, those of the actions by the angles of a release from rest among
    /// them.
    pub definitions: Vec<NormalFormDefinition>,
    /// Actions I of the in-phase modes, the slow mode first.
    pub actions: Vec<SymbolId>,
    /// Frequencies ω(I) of the in-phase modes and of the difference.
    pub frequencies: Vec<SymbolId>,
    /// Growth of the difference, if there are copies.
    pub growth: Option<ResonantGrowth>,
}

/// Growth of a difference by the resonance 2 ω_d ≈ ω_+ + ω_−.
#[derive(Clone, Debug, PartialEq)]
pub struct ResonantGrowth {
    /// Coupling κ(I).
    pub coupling: SymbolId,
    /// Square λ² = κ² − δ² of the growth rate, with the detuning δ.
    pub rate_squared: SymbolId,
    /// Squares of the factors by which the angles of a release must be multiplied so that |δ| = κ.
    pub thresholds: [SymbolId; 2],
}

impl NormalFormFormulas {
    /// Returns the definition of a symbol.
    pub fn definition(&self, symbol: SymbolId) -> Option<&NormalFormDefinition> {
        self.definitions.iter().find(|own| own.symbol == symbol)
    }

    /// Returns these symbols and all symbols that their definitions use, except those of `given`.
    pub fn needed(&self, wanted: &[SymbolId], given: &BTreeSet<SymbolId>) -> Vec<SymbolId> {
        let (mut all, mut next) = (wanted.to_vec(), 0);
        while let Some(&symbol) = all.get(next) {
            next += 1;
            if let Some(definition) = self.definition(symbol) {
                definition.value.for_each_symbol(&mut |used| {
                    if !all.contains(&used) && !given.contains(&used) {
                        all.push(used);
                    }
                });
            }
        }
        all
    }

    /// Returns the definitions of [`needed`](Self::needed) symbols as equations.
    pub fn formulas(
        &self,
        symbols: &Symbols,
        wanted: &[SymbolId],
        given: &BTreeSet<SymbolId>,
    ) -> Vec<NamedFormula> {
        let needed = self.needed(wanted, given).into_iter();
        let formulas = needed.filter_map(|symbol| {
            let NormalFormDefinition { kind, value, .. } = self.definition(symbol)?;
            let formula = NamedFormula::of_symbol(symbols, symbol, value);
            match kind {
                DefinitionKind::Value | DefinitionKind::Result => Some(formula),
                DefinitionKind::Root => Some(NamedFormula {
                    left: format!("{}²", formula.left),
                    left_latex: format!("{}^{{2}}", formula.left_latex),
                    ..formula
                }),
                DefinitionKind::SpelledRoot => None,
            }
        });
        formulas.collect()
    }
}
