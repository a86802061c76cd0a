//! Symbols of the normal form under construction.

use super::formulas::{DefinitionKind, NormalFormDefinition};
use crate::mechanics::algebra::Formula;
use crate::mechanics::derivation::Derivation;
use crate::mechanics::expression::Role;

/// Spellings of a mode or a quantity in code, text and LaTeX.
pub(super) type Spelling = [&'static str; 3];

/// Symbols of the normal form under construction.
pub(super) struct Definitions<'d, 's> {
    pub(super) derivation: &'d mut Derivation<'s>,
    pub(super) list: Vec<NormalFormDefinition>,
}

impl Definitions<'_, '_> {
    /// Defines the symbol of a quantity, with the names of modes as indices.
    pub(super) fn define(
        &mut self,
        [code, text, latex]: Spelling,
        modes: &[Spelling],
        value: &Formula,
    ) -> Formula {
        let index = |part: usize| modes.iter().map(|mode| mode[part]).collect::<String>();
        let codes: Vec<&str> = modes.iter().map(|mode| mode[0]).collect();
        let spelled = match modes {
            [] => [code, text, latex].map(str::to_owned),
            _ => [
                format!("{code}_{}", codes.join("_")),
                format!("{text}_{}", index(1)),
                format!("{latex}_{{{}}}", index(2)),
            ],
        };
        self.push(spelled, DefinitionKind::Value, value)
    }

    /// Defines a symbol with these spellings.
    pub(super) fn push(
        &mut self,
        [code, text, latex]: [String; 3],
        kind: DefinitionKind,
        value: &Formula,
    ) -> Formula {
        let symbols = &mut self.derivation.symbols;
        let symbol = symbols.intern(Role::Derived, &code, &text, &latex);
        let value = self.derivation.expr(value);
        self.list.push(NormalFormDefinition {
            symbol,
            kind,
            value,
        });
        Formula::symbol(symbol)
    }

    /// Defines a quantity as the root of its square.
    pub(super) fn define_root(
        &mut self,
        quantity: Spelling,
        modes: &[Spelling],
        square: &Formula,
    ) -> Formula {
        let root = self.define(quantity, modes, square);
        self.last_is(DefinitionKind::Root);
        root
    }

    /// Changes the kind of the last definition.
    pub(super) fn last_is(&mut self, kind: DefinitionKind) {
        if let Some(own) = self.list.last_mut() {
            own.kind = kind;
        }
    }

    /// Defines the geometric mean of a quantity of the two in-phase modes.
    pub(super) fn mean(
        &mut self,
        code: &str,
        letter: &str,
        [slow, fast]: [&Formula; 2],
    ) -> Formula {
        let text = format!("√({letter}_+ {letter}_−)");
        let latex = format!("\\sqrt{{{letter}_{{+}}{letter}_{{-}}}}");
        let spelled = [code.to_owned(), text, latex];
        self.push(spelled, DefinitionKind::SpelledRoot, &(slow * fast))
    }
}
