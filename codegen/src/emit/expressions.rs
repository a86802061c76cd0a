//! Values as expressions, where they are used.

use super::Emission;
use super::function::{Binding, ident, number_tokens};
use super::names::Locals;
use crate::program::{Fused, Op, ValueId};
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// A value where it is used: its name, or its definition in parentheses if
    /// that binds less tightly than its place asks for.
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

    /// `x.mul_add(y, z)`, which is x y + z.
    fn fused(&self, fused: &Fused, locals: &Locals) -> TokenStream {
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
        let z = if fused.minus_addend {
            let z = self.bound(fused.addend, locals, Binding::Atom);
            quote!(-#z)
        } else {
            self.bound(fused.addend, locals, Binding::Sum)
        };
        quote!(#x.mul_add(#y, #z))
    }

    /// A value's definition. Sums and products associate to the left, so that
    /// only right operands need parentheses.
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
