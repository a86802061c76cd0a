//! Emits the computation of the constants from numbers and parameters.

use super::Emission;
use super::quantities::{enclosed, product, sum};
use super::tokens::{Binding, number_tokens};
use crate::program::{ConstantDefinition, ConstantId, ConstantOp};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

impl Emission<'_> {
    /// Returns `let` lines for all stored constants, and the struct literal.
    pub(super) fn constants(&self) -> TokenStream {
        if let Some(strips) = &self.program.strips {
            return self.strip_values(strips);
        }
        let (lines, fields) = self.constant_lines();
        quote! {
            #(#lines)*
            Self { #(#fields),* }
        }
    }

    /// Returns `let` lines for all stored constants, and the names of the fields that store them.
    fn constant_lines(&self) -> (Vec<TokenStream>, Vec<Ident>) {
        let stored = self.stored_constants();
        let fields: BTreeMap<ConstantId, Ident> =
            stored.iter().map(|&id| (id, self.field(id))).collect();
        let mut formed = self.shared_constants(&stored);
        formed.extend(stored);
        let (lines, _) = self.formed_lines(formed, |id| fields.get(&id).cloned());
        (lines, fields.into_values().collect())
    }

    /// Returns the sums and products that stored constants use more than once. If they were written
    /// out at every use, the length of the code would grow exponentially with their nesting.
    fn shared_constants(&self, stored: &[ConstantId]) -> BTreeSet<ConstantId> {
        let setup = &self.program.setup;
        let is_formed = |definition: &ConstantDefinition| definition.exact.is_none();
        let mut readers: BTreeMap<ConstantId, usize> = BTreeMap::new();
        for id in setup.behind(stored.iter().copied(), is_formed) {
            let definition = setup.get(id);
            if is_formed(definition) {
                for (operand, times) in definition.op.readings() {
                    *readers.entry(operand).or_default() += times;
                }
            }
        }
        let is_shared = |&(id, count): &(ConstantId, usize)| {
            let definition = setup.get(id);
            let arithmetic = matches!(
                definition.op,
                ConstantOp::Product(..) | ConstantOp::Add(..) | ConstantOp::Sub(..)
            );
            count > 1 && arithmetic && is_formed(definition)
        };
        let shared = readers.into_iter().filter(is_shared);
        shared.map(|(id, _)| id).collect()
    }

    /// Returns `let` lines for constants, operands first, with the names of the results: the name
    /// given by `field`, or the constant's own name.
    pub(super) fn formed_lines(
        &self,
        formed: BTreeSet<ConstantId>,
        field: impl Fn(ConstantId) -> Option<Ident>,
    ) -> (Vec<TokenStream>, BTreeMap<ConstantId, Ident>) {
        let mut known = BTreeMap::new();
        let mut lines = Vec::new();
        for id in formed {
            let own = || format_ident!("{}", self.program.setup.get(id).name);
            let name = field(id).unwrap_or_else(own);
            let (value, _) = self.constant_value(id, &known);
            lines.push(quote!(let #name = #value;));
            known.insert(id, name);
        }
        (lines, known)
    }

    pub(super) fn constant_value(
        &self,
        id: ConstantId,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> (TokenStream, Binding) {
        let definition = self.program.setup.get(id);
        if let Some(exact) = &definition.exact {
            return (number_tokens(exact), Binding::Atom);
        }
        let at = |operand: ConstantId| match known.get(&operand) {
            Some(name) => (quote!(#name), Binding::Atom),
            None => self.constant_value(operand, known),
        };
        match definition.op {
            ConstantOp::Number(ref number) => (number_tokens(number), Binding::Atom),
            ConstantOp::Parameter(index) => {
                let name = format_ident!("{}", self.scene.parameters[index].name);
                (quote!(parameters.#name), Binding::Atom)
            }
            ConstantOp::Named(_, formed) | ConstantOp::Called(formed) => at(formed),
            ConstantOp::Product(ref number, ref powers) => {
                let mut above = vec![(number_tokens(number), Binding::Atom)];
                let mut below = Vec::new();
                for &(id, power) in powers {
                    let side = if power > 0 { &mut above } else { &mut below };
                    side.extend(vec![at(id); power.unsigned_abs() as usize]);
                }
                // A factor of one changes no bit.
                if number.is_one() && above.len() > 1 {
                    above.remove(0);
                }
                let above = product(above);
                if below.is_empty() {
                    return above;
                }
                let above = enclosed(above, Binding::Product);
                let below = enclosed(product(below), Binding::Prefix);
                (quote!(#above / #below), Binding::Product)
            }
            ConstantOp::Add(a, b) => sum(vec![at(a), at(b)]),
            ConstantOp::Sub(a, b) => {
                let (a, b) = (at(a).0, enclosed(at(b), Binding::Product));
                (quote!(#a - #b), Binding::Sum)
            }
        }
    }
}
