//! Emits values as expressions at their use.

use super::Emission;
use super::names::Locals;
use super::tokens::{Binding, ident, number_tokens};
use crate::program::{FusedSum, Op, ValueId};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// Largest nesting of fused operations in one line.
const MOST_NESTED: usize = 1;

impl Emission<'_> {
    /// Returns the expression by which a value is used: its name or its definition, in parentheses
    /// if it binds less tightly than `place` requires.
    pub(super) fn bound(&self, id: ValueId, locals: &Locals, place: Binding) -> TokenStream {
        if let Some(name) = locals.names.get(&id) {
            let name = ident(name);
            return quote!(#name);
        }
        let (value, binding) = self.definition(id, locals);
        if binding < place {
            quote!((#value))
        } else {
            value
        }
    }

    /// Returns `let name = value;`. A long sum of products takes several lines, because nested
    /// fused operations are hard to read. A partial sum that is subtracted from the rest is named
    /// with the opposite sign.
    pub(super) fn named(&self, id: ValueId, name: &Ident, locals: &Locals) -> TokenStream {
        let mut terms = Vec::new();
        let mut innermost = id;
        while let Some(fused) = locals.fused.get(&innermost) {
            terms.push(fused);
            innermost = fused.addend;
            if locals.names.contains_key(&innermost) {
                break;
            }
        }
        if terms.len() <= MOST_NESTED {
            let (value, _) = self.definition(id, locals);
            return quote!(let #name = #value;);
        }
        let leaf = matches!(*self.op(innermost), Op::Constant(_) | Op::Number(_));
        let first = match leaf || locals.names.contains_key(&innermost) {
            true => terms.pop().map(|fused| self.fused(fused, locals)),
            false => None,
        };
        let first = first.unwrap_or_else(|| self.bound(innermost, locals, Binding::Sum));
        let opposite = ident(&locals.opposite(&name.to_string()));
        let signs = terms.iter().filter(|fused| fused.minus_addend).count();
        let part = |signs: usize| match signs.is_multiple_of(2) {
            true => name,
            false => &opposite,
        };
        let (mut left, mut last) = (signs, part(signs));
        let mut lines = quote!(let #last = #first;);
        for fused in terms.iter().rev() {
            left -= usize::from(fused.minus_addend);
            let value = self.fused_with(fused, &quote!(#last), locals);
            last = part(left);
            lines.extend(quote!(let #last = #value;));
        }
        lines
    }

    /// Returns `x.mul_add(y, z)`, which is x y + z.
    fn fused(&self, fused: &FusedSum, locals: &Locals) -> TokenStream {
        let place = match fused.minus_addend {
            true => Binding::Atom,
            false => Binding::Sum,
        };
        let addend = self.bound(fused.addend, locals, place);
        self.fused_with(fused, &addend, locals)
    }

    fn fused_with(&self, fused: &FusedSum, addend: &TokenStream, locals: &Locals) -> TokenStream {
        let Op::Mul(x, y) = *self.op(fused.product) else {
            unreachable!("products alone are fused");
        };
        let x = if fused.minus_product {
            let x = self.bound(x, locals, Binding::Atom);
            quote!((-#x))
        } else {
            self.bound(x, locals, Binding::Atom)
        };
        let y = self.bound(y, locals, Binding::Sum);
        match fused.minus_addend {
            true => quote!(#x.mul_add(#y, -#addend)),
            false => quote!(#x.mul_add(#y, #addend)),
        }
    }

    /// Returns the definition of a value. Sums and products associate to the left, so that only
    /// right operands need parentheses.
    pub(super) fn definition(&self, id: ValueId, locals: &Locals) -> (TokenStream, Binding) {
        if let Some(fused) = locals.fused.get(&id) {
            return (self.fused(fused, locals), Binding::Atom);
        }
        let at = |id: ValueId, place: Binding| self.bound(id, locals, place);
        match *self.op(id) {
            Op::Constant(constant) => {
                let field = self.field(constant);
                (quote!(self.#field), Binding::Atom)
            }
            Op::Number(ref number) => (number_tokens(number), Binding::Atom),
            Op::Neg(a) => {
                let a = at(a, Binding::Atom);
                (quote!(-#a), Binding::Prefix)
            }
            Op::Sqrt(a) => {
                let a = at(a, Binding::Atom);
                (quote!(#a.sqrt()), Binding::Atom)
            }
            Op::Add(a, b) => {
                let (a, b) = (at(a, Binding::Sum), at(b, Binding::Product));
                (quote!(#a + #b), Binding::Sum)
            }
            Op::Sub(a, b) => {
                let (a, b) = (at(a, Binding::Sum), at(b, Binding::Product));
                (quote!(#a - #b), Binding::Sum)
            }
            Op::Mul(a, b) => {
                let (a, b) = (at(a, Binding::Product), at(b, Binding::Prefix));
                (quote!(#a * #b), Binding::Product)
            }
            Op::Div(a, b) => {
                let (a, b) = (at(a, Binding::Product), at(b, Binding::Prefix));
                (quote!(#a / #b), Binding::Product)
            }
            Op::Input(..) | Op::Sin(_) | Op::Cos(_) => {
                unreachable!("inputs, sines and cosines are always named")
            }
        }
    }
}
