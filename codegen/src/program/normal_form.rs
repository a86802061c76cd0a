//! Entry points of the resonant normal form of degree 4.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::{Environment, Lowering};
use crate::functions::NormalFormFunction::{Actions, Coupling, Frequencies, Growth, Thresholds};
use crate::functions::{Argument, Purpose};
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{DefinitionKind, Mechanics, NormalFormDefinition, NormalFormFormulas};

impl Lowering<'_> {
    /// Returns the value of a symbol of the normal form.
    pub(super) fn of_normal_form(
        &mut self,
        environment: &mut Environment<'_>,
        definition: &NormalFormDefinition,
    ) -> ValueId {
        let value = self.expr(environment, &definition.value);
        let code = &self.mechanics.symbols.get(definition.symbol).code;
        let value = match definition.kind {
            // A result gets no `let`.
            DefinitionKind::Result => {
                self.builder.hint(value, code);
                return value;
            }
            DefinitionKind::Value => value,
            DefinitionKind::Root | DefinitionKind::SpelledRoot => {
                self.builder.hint(value, &format!("{code}_squared"));
                self.builder.sqrt(value)
            }
        };
        self.builder.name(value, code)
    }
}

impl EntryList<'_, '_> {
    /// Adds the functions of the normal form: of the angles of a release, or of the actions.
    pub(super) fn normal_form(&mut self, mechanics: &Mechanics, form: &NormalFormFormulas) {
        let frame = &mechanics.absolute;
        let mut released = Environment::new(frame, Argument::Theta, None, None);
        let mut at_actions = released.clone();
        for (index, &action) in form.actions.iter().enumerate() {
            let value = self.lowering.builder.input(Argument::Actions, index);
            at_actions.supply(action, value);
        }
        let mut push = |environment: &mut Environment<'_>, function, symbols: &[SymbolId]| {
            let values = symbols.iter();
            let values = values.map(|&symbol| self.lowering.symbol(environment, symbol));
            let values = values.collect();
            self.push(Purpose::NormalForm(function), values);
        };
        push(&mut released, Actions, &form.actions);
        push(&mut at_actions, Frequencies, &form.frequencies);
        if let Some(growth) = &form.growth {
            push(&mut at_actions, Coupling, &[growth.coupling]);
            push(&mut at_actions, Growth, &[growth.rate_squared]);
            push(&mut released, Thresholds, &growth.thresholds);
        }
    }
}
