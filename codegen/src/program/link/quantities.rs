//! Conversion of quantities of links to constants of the model.

use crate::functions::LINK_PROPERTIES;
use crate::mechanics::Mechanics;
use crate::program::lower::Lowering;
use crate::program::{ConstantId, Setup, ValueId};
use crate::scene::QuantityAtom::{Exact, Parameter};
use crate::scene::{Link, Offset, Quantity};

impl Lowering<'_> {
    /// Converts a quantity of the description to a constant.
    pub(super) fn quantity(&mut self, quantity: &Quantity) -> ConstantId {
        let mechanics: &Mechanics = self.mechanics;
        match quantity {
            Quantity::Atom(Exact(number)) => self.builder.setup.number(number.clone()),
            Quantity::Atom(Parameter(id)) => self.constant(mechanics.parameters[id.0]),
            Quantity::Sum(parts) => self.folded(parts, Setup::add, 0),
            Quantity::Product(parts) => self.folded(parts, Setup::mul, 1),
            Quantity::Quotient(above, below) => {
                let (above, below) = (self.quantity(above), self.quantity(below));
                self.builder.setup.div(above, below)
            }
            Quantity::Power(base, exponent) => {
                let base = self.quantity(base);
                self.builder.setup.power(base, *exponent)
            }
            Quantity::Negative(value) => {
                let value = self.quantity(value);
                self.builder.setup.neg(value)
            }
        }
    }

    fn folded(
        &mut self,
        parts: &[Quantity],
        operation: fn(&mut Setup, ConstantId, ConstantId) -> ConstantId,
        start: i64,
    ) -> ConstantId {
        let start = self.builder.setup.number(start.into());
        parts.iter().fold(start, |total, part| {
            let part = self.quantity(part);
            operation(&mut self.builder.setup, total, part)
        })
    }

    pub(in crate::program) fn value_of(&mut self, quantity: &Quantity) -> ValueId {
        let constant = self.quantity(quantity);
        self.builder.constant(constant)
    }

    pub(super) fn values_of(&mut self, point: &Offset) -> [ValueId; 2] {
        [self.value_of(&point.along), self.value_of(&point.lateral)]
    }

    /// Returns the properties of a link as constants.
    pub(super) fn link_properties(&mut self, link: &Link) -> [ConstantId; LINK_PROPERTIES.len()] {
        link.properties().map(|quantity| self.quantity(quantity))
    }
}
