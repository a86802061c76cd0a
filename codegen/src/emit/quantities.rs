//! Emits quantities of a scene as expressions in its parameters.

use super::Emission;
use super::tokens::{Binding, float};
use crate::exact::Rational;
use crate::scene::{Quantity, QuantityAtom};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

impl Emission<'_> {
    /// Emits a quantity in `f64`, computed from the fields of `parameters`.
    pub(super) fn quantity(&self, quantity: &Quantity) -> TokenStream {
        self.bound_quantity(quantity).0
    }

    fn bound_quantity(&self, quantity: &Quantity) -> (TokenStream, Binding) {
        let at =
            |quantity: &Quantity, place: Binding| enclosed(self.bound_quantity(quantity), place);
        let values = |parts: &[Quantity]| -> Vec<(TokenStream, Binding)> {
            let parts = parts.iter();
            parts.map(|part| self.bound_quantity(part)).collect()
        };
        match quantity {
            Quantity::Atom(QuantityAtom::Exact(number)) => double(number),
            Quantity::Atom(QuantityAtom::Parameter(id)) => {
                let field = format_ident!("{}", self.scene.parameters[id.0].name);
                (quote!(parameters.#field), Binding::Atom)
            }
            Quantity::Sum(parts) => sum(values(parts)),
            Quantity::Product(parts) => product(values(parts)),
            Quantity::Quotient(above, below) => {
                let (above, below) = (at(above, Binding::Product), at(below, Binding::Prefix));
                (quote!(#above / #below), Binding::Product)
            }
            Quantity::Power(base, exponent) => {
                let base = self.bound_quantity(base);
                let power = product(vec![base; exponent.unsigned_abs() as usize]);
                if *exponent > 0 {
                    return power;
                }
                let power = enclosed(power, Binding::Prefix);
                (quote!(1.0 / #power), Binding::Product)
            }
            Quantity::Negative(value) => {
                let value = at(value, Binding::Atom);
                (quote!(-#value), Binding::Prefix)
            }
        }
    }
}

fn double(number: &Rational) -> (TokenStream, Binding) {
    let size = float(number.to_f64().abs());
    match number.is_negative() {
        true => (quote!(-#size), Binding::Prefix),
        false => (quote!(#size), Binding::Atom),
    }
}

/// Emits a sum, from left to right.
pub(super) fn sum(parts: Vec<(TokenStream, Binding)>) -> (TokenStream, Binding) {
    joined(parts, &quote!(+), Binding::Sum, Binding::Product)
}

/// Emits a product, from left to right.
pub(super) fn product(parts: Vec<(TokenStream, Binding)>) -> (TokenStream, Binding) {
    joined(parts, &quote!(*), Binding::Product, Binding::Prefix)
}

/// Emits operands of an operator that associates to the left. The first operand may bind as tightly
/// as the whole; the others must bind more tightly.
fn joined(
    parts: Vec<(TokenStream, Binding)>,
    operator: &TokenStream,
    whole: Binding,
    others: Binding,
) -> (TokenStream, Binding) {
    if let [only] = parts.as_slice() {
        return only.clone();
    }
    let mut parts = parts.into_iter();
    let first = parts.next().map(|first| enclosed(first, whole));
    let rest = parts.map(|part| enclosed(part, others));
    (quote!(#first #(#operator #rest)*), whole)
}

/// Puts a value in parentheses if `place` requires a tighter binding.
pub(super) fn enclosed((value, binding): (TokenStream, Binding), place: Binding) -> TokenStream {
    match binding < place {
        true => quote!((#value)),
        false => value,
    }
}
