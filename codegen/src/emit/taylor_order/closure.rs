//! The closure that returns one order of the coefficients.

use super::super::tokens::{Binding, ident};
use super::{Factor, Recurrences};
use crate::functions::Argument;
use crate::program::{Op, ValueId};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

impl Recurrences<'_> {
    /// Emits the closure that computes the coefficient of order k of the bias from the known
    /// coefficients of that order.
    pub(in crate::emit) fn closure(&self) -> TokenStream {
        let (runtime, links) = (self.emission.runtime(), self.emission.links());
        let known = &self.known;
        let numbers = self.numbers_of_order();
        let inputs = self.inputs();
        let lines = self.needed.iter().filter_map(|&id| {
            let given = self.is_given(self.emission.op(id));
            let name = self.names.get(&id).filter(|_| !given)?;
            let (value, _) = self.definition(id);
            Some(quote!(let #name = #value;))
        });
        let has_sums = !self.sums.is_empty();
        let sums = has_sums.then(|| self.sums_of_products());
        let factors = has_sums.then(|| self.factors());
        let bias = self.bias.iter().map(|&id| match self.varies[&id] {
            true => self.bound(id, Binding::Sum),
            false => quote!(T::from_f64(0.0)),
        });
        quote! {
            |#known: &#runtime::emitted::taylor::KnownOrder<T, #links>| {
                #numbers
                #inputs
                #sums
                #(#lines)*
                #factors
                [#(#bias),*]
            }
        }
    }

    /// Emits, if they are used, the order as an index, as a number and as its inverse, and the
    /// coefficient of the time.
    fn numbers_of_order(&self) -> TokenStream {
        let (runtime, k, known) = (self.emission.runtime(), &self.order, &self.known);
        let (order, inverse) = (&self.order_number, &self.inverse_order);
        let turned = self
            .sums
            .iter()
            .any(|sum| matches!(sum.of, Op::Sin(_) | Op::Cos(_)));
        let counted = !self.sums.is_empty() || self.time.is_some();
        let counter = counted.then(|| quote!(let #k = #known.order;));
        let numbers = turned.then(|| {
            quote! {
                let #order = #runtime::emitted::taylor::whole::<T>(#k);
                let #inverse = T::from_f64(1.0) / #order;
            }
        });
        let time = self
            .time
            .as_ref()
            .map(|time| quote!(let #time = T::from_f64(if #k == 1 { 1.0 } else { 0.0 });));
        quote!(#counter #numbers #time)
    }

    /// Emits the sums of products Σ u[j] v[k−j] over 0 < j < k.
    fn sums_of_products(&self) -> TokenStream {
        let (runtime, k) = (self.emission.runtime(), &self.order);
        let quads = self.sums.chunks(4).enumerate().map(|(quad, sums)| {
            let quad = Literal::usize_unsuffixed(quad);
            let names = sums.iter().map(|sum| {
                let name = &sum.name;
                quote!(#name)
            });
            let names = names.chain(std::iter::repeat_n(quote!(_), 4 - sums.len()));
            quote!(let [#(#names),*] = products[#quad].0;)
        });
        quote! {
            let products = #runtime::emitted::taylor::sums(#k, factors);
            #(#quads)*
        }
    }

    /// Emits the lines that store the factors' coefficients of order k, for the sums of higher
    /// orders.
    fn factors(&self) -> TokenStream {
        let (k, order) = (&self.order, &self.order_number);
        let side = |side: usize| {
            let factors = self.sums.iter().map(move |sum| match sum.factors[side] {
                Factor::Value(id) => self.bound(id, Binding::Sum),
                Factor::Rate(id) => {
                    let angle = self.bound(id, Binding::Prefix);
                    quote!(#order * #angle)
                }
            });
            self.in_quads(factors)
        };
        let (left, right) = (side(0), side(1));
        quote!(factors[#k - 1] = [[#(#left),*], [#(#right),*]];)
    }

    /// Returns `Quad([a, b, c, d]), …`, padded with zeros to whole quads.
    fn in_quads(&self, values: impl Iterator<Item = TokenStream>) -> Vec<TokenStream> {
        let runtime = self.emission.runtime();
        let mut values: Vec<TokenStream> = values.collect();
        values.resize(4 * self.quads(), quote!(T::from_f64(0.0)));
        let quads = values.chunks(4);
        quads
            .map(|quad| quote!(#runtime::emitted::taylor::Quad([#(#quad),*])))
            .collect()
    }

    /// Emits the known coefficients of order k, split into elements.
    fn inputs(&self) -> TokenStream {
        let angle = |index: usize| self.find(&Op::Input(Argument::Theta, index));
        let lists = [
            self.list("theta", |index| Some(Op::Input(Argument::Theta, index))),
            self.list("omega", |index| Some(Op::Input(Argument::Omega, index))),
            self.list("sines", |index| angle(index).map(Op::Sin)),
            self.list("cosines", |index| angle(index).map(Op::Cos)),
        ];
        lists.into_iter().flatten().collect()
    }

    /// Returns `let [theta_parent_k, _, theta_bob_k] = known.theta;`, if any element is used.
    fn list(&self, list: &str, op: impl Fn(usize) -> Option<Op>) -> Option<TokenStream> {
        let name = |index| {
            let id = self.find(&op(index)?).filter(|id| self.is_read(*id))?;
            self.names.get(&id)
        };
        let names: Vec<Option<&Ident>> = (0..self.links).map(name).collect();
        let read = names.iter().any(Option::is_some);
        let elements = names.into_iter().map(|name| match name {
            Some(name) => quote!(#name),
            None => quote!(_),
        });
        let (known, list) = (&self.known, ident(list));
        read.then(|| quote!(let [#(#elements),*] = #known.#list;))
    }

    /// Returns true if a known coefficient of order k is used. Sines and cosines are known like
    /// angles, and are not computed from each other.
    fn is_read(&self, id: ValueId) -> bool {
        let formed = |other: &&ValueId| !self.is_given(self.emission.op(**other));
        let mut formed = self.needed.iter().filter(formed);
        let reads = |other: &ValueId| self.emission.op(*other).operands().any(|read| read == id);
        self.bias.contains(&id) || formed.any(reads)
    }
}
