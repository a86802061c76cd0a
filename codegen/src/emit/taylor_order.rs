//! One order of the Taylor coefficients: what becomes of each operation.
//!
//! The coefficient of order k of a product, a quotient, a sine or a root is a
//! sum of products of coefficients below k, Σ_{0<j<k} u[j] v[k−j], and what the
//! coefficients of order k and 0 add to it. No such sum depends on another one
//! of its order, so that all are formed at once, side by side; what is added
//! last is newest, and in general largest.

use super::Emission;
use super::function::{Binding, ident};
use super::names::Locals;
use crate::exact::Rational;
use crate::program::{Argument, Entry, Op, ValueId};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

/// The sums are formed in blocks of so many.
const BLOCK: usize = 4;

/// One factor of the products in a sum.
#[derive(Clone, Copy)]
enum Factor {
    /// u[j].
    Value(ValueId),
    /// j u[j]: the rate of change of an angle.
    Rate(ValueId),
}

/// The sum of products that an operation needs in each order.
struct Sum {
    of: Op,
    name: Ident,
    factors: [Factor; 2],
}

/// All orders of an entry.
pub(super) struct Recurrences<'e> {
    emission: &'e Emission<'e>,
    needed: &'e [ValueId],
    links: usize,
    accelerations: &'e [ValueId],
    /// Names of the coefficients of order 0.
    pub(super) locals: Locals,
    /// Names of those of order k.
    names: BTreeMap<ValueId, Ident>,
    /// Whether a value depends on the state or the time.
    varies: BTreeMap<ValueId, bool>,
    sums: Vec<Sum>,
    /// What k is called.
    pub(super) order: Ident,
    order_number: Ident,
    inverse_order: Ident,
    time: Option<Ident>,
}

impl<'e> Recurrences<'e> {
    pub(super) fn new(emission: &'e Emission<'e>, entry: &'e Entry, needed: &'e [ValueId]) -> Self {
        let links = emission.scene.links.len();
        let mut locals = emission.locals(entry, needed);
        let reserved = ["coefficients", "factors", "accelerations", "orders"];
        for name in reserved.into_iter().chain(["sines", "cosines"]) {
            locals.fresh(name.to_owned());
        }
        let mut varies: BTreeMap<ValueId, bool> = BTreeMap::new();
        for &id in needed {
            let op = emission.op(id);
            let moves = matches!(op, Op::Input(..)) || op.operands().any(|a| varies[&a]);
            varies.insert(id, moves);
        }
        let mut fresh = |name: &str| ident(&locals.fresh(name.to_owned()));
        let order = fresh("k");
        let (order_number, inverse_order) = (fresh("order"), fresh("inverse_order"));
        let timed = needed
            .iter()
            .any(|id| matches!(emission.op(*id), Op::Input(Argument::Time, _)));
        let time = timed.then(|| fresh("time_k"));
        let mut recurrences = Self {
            emission,
            needed,
            links,
            accelerations: &entry.outputs[..links],
            locals,
            names: BTreeMap::new(),
            varies,
            sums: Vec::new(),
            order,
            order_number,
            inverse_order,
            time,
        };
        recurrences.name_factors();
        recurrences.name_coefficients();
        recurrences.find_sums();
        recurrences
    }

    /// Number of sums of products, filled up to whole blocks.
    pub(super) fn lanes(&self) -> usize {
        self.sums.len().max(1).next_multiple_of(BLOCK)
    }

    /// Number of sums of products in each order.
    pub(super) fn count(&self) -> usize {
        self.sums.len()
    }

    /// Whether an operation needs a sum of products.
    fn nonlinear(&self, op: &Op) -> bool {
        match *op {
            Op::Mul(a, b) => self.varies[&a] && self.varies[&b],
            Op::Div(_, a) | Op::Sin(a) | Op::Cos(a) | Op::Sqrt(a) => self.varies[&a],
            _ => false,
        }
    }

    /// Names what is written in place in order 0 and is read again in order k.
    fn name_factors(&mut self) {
        for &id in self.needed {
            let op = self.emission.op(id).clone();
            if !self.nonlinear(&op) {
                continue;
            }
            // The sine and cosine of an angle do not read its order 0.
            let read: Vec<ValueId> = match op {
                Op::Mul(a, b) => vec![a, b],
                Op::Div(_, b) => vec![b, id],
                _ => vec![id],
            };
            for value in read {
                let leaf = matches!(self.emission.op(value), Op::Constant(_) | Op::Number(_));
                if !leaf && !self.locals.names.contains_key(&value) {
                    let name = self.emission.describe(value, &self.locals);
                    self.locals.claim(value, name.unwrap_or_default());
                }
            }
        }
    }

    fn name_coefficients(&mut self) {
        for &id in self.needed {
            let time = matches!(self.emission.op(id), Op::Input(Argument::Time, _));
            if time && let Some(name) = &self.time {
                self.names.insert(id, name.clone());
            } else if self.varies[&id]
                && let Some(name) = self.locals.names.get(&id).cloned()
            {
                let name = self.locals.fresh(format!("{name}_k"));
                self.names.insert(id, ident(&name));
            }
        }
    }

    fn find_sums(&mut self) {
        for &id in self.needed {
            let op = self.emission.op(id).clone();
            if !self.nonlinear(&op) {
                continue;
            }
            let factors = match op {
                Op::Mul(a, b) => [Factor::Value(a), Factor::Value(b)],
                Op::Div(_, b) => [Factor::Value(id), Factor::Value(b)],
                Op::Sqrt(_) => [Factor::Value(id), Factor::Value(id)],
                Op::Sin(a) => [Factor::Rate(a), Factor::Value(self.id(&Op::Cos(a)))],
                Op::Cos(a) => [Factor::Rate(a), Factor::Value(self.id(&Op::Sin(a)))],
                _ => unreachable!("other operations are linear"),
            };
            let known = self.locals.names.get(&id).cloned();
            let known = known.or_else(|| self.emission.describe(id, &self.locals));
            let wanted = known.map_or_else(|| "sum".to_owned(), |name| format!("sum_{name}"));
            let name = ident(&self.locals.fresh(wanted));
            self.sums.push(Sum {
                of: op,
                name,
                factors,
            });
        }
    }

    fn id(&self, op: &Op) -> ValueId {
        let found = self.needed.iter().find(|id| self.emission.op(**id) == op);
        match found {
            Some(&id) => id,
            None => unreachable!("the entry holds both partners of a sine and cosine"),
        }
    }

    /// What is done for the order k, of which the angles and velocities are
    /// known.
    pub(super) fn turn(&self) -> TokenStream {
        let runtime = self.emission.runtime();
        let (k, order, inverse) = (&self.order, &self.order_number, &self.inverse_order);
        let turned = self
            .sums
            .iter()
            .any(|sum| matches!(sum.of, Op::Sin(_) | Op::Cos(_)));
        let numbers = turned.then(|| {
            quote! {
                let #order = #runtime::taylor::whole::<T>(#k);
                let #inverse = T::from_f64(1.0) / #order;
            }
        });
        let time = self
            .time
            .as_ref()
            .map(|time| quote!(let #time = T::from_f64(if #k == 1 { 1.0 } else { 0.0 });));
        let filling = self.lanes() - self.sums.len();
        let names = self.sums.iter().map(|sum| &sum.name);
        let names = names
            .map(|name| quote!(#name))
            .chain(std::iter::repeat_n(quote!(_), filling));
        let inputs = self.inputs();
        let lines = self.needed.iter().filter_map(|&id| {
            let input = matches!(self.emission.op(id), Op::Input(..));
            let name = self.names.get(&id).filter(|_| !input)?;
            let (value, _) = self.definition(id);
            Some(quote!(let #name = #value;))
        });
        let zeros = || std::iter::repeat_n(quote!(T::from_f64(0.0)), filling);
        let side = |side: usize| {
            let factors = self.sums.iter().map(move |sum| match sum.factors[side] {
                Factor::Value(id) => self.bound(id, Binding::Sum),
                Factor::Rate(id) => {
                    let angle = self.bound(id, Binding::Prefix);
                    quote!(#order * #angle)
                }
            });
            factors.chain(zeros())
        };
        let (left, right) = (side(0), side(1));
        let accelerations = self.accelerations.iter().map(|&id| match self.varies[&id] {
            true => self.bound(id, Binding::Sum),
            false => quote!(T::from_f64(0.0)),
        });
        quote! {
            #numbers
            #time
            #inputs
            let [#(#names),*] = #runtime::taylor::sums(#k, factors);
            #(#lines)*
            factors[#k - 1] = [[#(#left),*], [#(#right),*]];
            #runtime::taylor::advance(coefficients, #k, &[#(#accelerations),*]);
        }
    }

    /// `let [theta_parent_k, _, omega_parent_k, _] = coefficients[k];`
    fn inputs(&self) -> TokenStream {
        let elements = [Argument::Theta, Argument::Omega]
            .into_iter()
            .flat_map(|argument| {
                (0..self.links).map(move |index| {
                    let input = Op::Input(argument, index);
                    let found = self
                        .needed
                        .iter()
                        .find(|id| *self.emission.op(**id) == input);
                    match found.and_then(|id| self.names.get(id)) {
                        Some(name) => quote!(#name),
                        None => quote!(_),
                    }
                })
            });
        let k = &self.order;
        quote!(let [#(#elements),*] = coefficients[#k];)
    }

    /// The coefficient of order k where it is used.
    fn bound(&self, id: ValueId, place: Binding) -> TokenStream {
        if let Some(name) = self.names.get(&id) {
            return quote!(#name);
        }
        let (value, binding) = self.definition(id);
        if binding < place {
            quote!((#value))
        } else {
            value
        }
    }

    /// The coefficient of order 0 where it is used.
    fn zeroth(&self, id: ValueId, place: Binding) -> TokenStream {
        self.emission.bound(id, &self.locals, place)
    }

    fn sum(&self, op: &Op) -> &Ident {
        match self.sums.iter().find(|sum| sum.of == *op) {
            Some(sum) => &sum.name,
            None => unreachable!("every operation that is not linear has a sum"),
        }
    }

    /// The recurrence of an operation, in the coefficients of order k and 0.
    fn definition(&self, id: ValueId) -> (TokenStream, Binding) {
        let op = self.emission.op(id);
        let varies = |id: &ValueId| self.varies[id];
        let at = |id: ValueId, place: Binding| self.bound(id, place);
        let zeroth = |id: ValueId| self.zeroth(id, Binding::Atom);
        match *op {
            Op::Neg(a) => {
                let a = at(a, Binding::Atom);
                (quote!(-#a), Binding::Prefix)
            }
            Op::Add(a, b) | Op::Sub(a, b) if varies(&a) && varies(&b) => {
                let (a, b) = (at(a, Binding::Sum), at(b, Binding::Product));
                let value = match op {
                    Op::Add(..) => quote!(#a + #b),
                    _ => quote!(#a - #b),
                };
                (value, Binding::Sum)
            }
            Op::Add(a, _) | Op::Sub(a, _) if varies(&a) => (at(a, Binding::Atom), Binding::Atom),
            Op::Add(_, b) => (at(b, Binding::Atom), Binding::Atom),
            Op::Sub(_, b) => {
                let b = at(b, Binding::Atom);
                (quote!(-#b), Binding::Prefix)
            }
            Op::Mul(a, b) if varies(&a) && varies(&b) => {
                // (u v)[k] = Σ u[j] v[k−j] + u[0] v[k] + u[k] v[0]
                let (u, v) = (at(a, Binding::Prefix), at(b, Binding::Prefix));
                let (u_0, v_0) = (zeroth(a), zeroth(b));
                let sum = self.sum(op);
                (quote!(#sum + (#u_0 * #v + #u * #v_0)), Binding::Sum)
            }
            Op::Mul(a, b) => {
                let (constant, moving) = if varies(&a) { (b, a) } else { (a, b) };
                let constant = self.zeroth(constant, Binding::Prefix);
                let moving = at(moving, Binding::Prefix);
                (quote!(#constant * #moving), Binding::Product)
            }
            Op::Div(a, b) if varies(&b) => {
                // u = v w, solved for w[k].
                let (sum, w_0) = (self.sum(op), zeroth(id));
                let v = at(b, Binding::Prefix);
                let rest = quote!(#sum + #v * #w_0);
                if *self.emission.op(a) == Op::Number(Rational::from(1)) {
                    return (quote!(-(#rest) * #w_0), Binding::Product);
                }
                let v_0 = zeroth(b);
                if varies(&a) {
                    let u = at(a, Binding::Sum);
                    (quote!((#u - (#rest)) / #v_0), Binding::Product)
                } else {
                    (quote!(-(#rest) / #v_0), Binding::Product)
                }
            }
            Op::Div(a, b) => {
                let (u, v_0) = (at(a, Binding::Product), zeroth(b));
                (quote!(#u / #v_0), Binding::Product)
            }
            Op::Sqrt(a) => {
                // u = w w, solved for w[k].
                let (sum, w_0) = (self.sum(op), zeroth(id));
                let u = at(a, Binding::Sum);
                (quote!((#u - #sum) / (#w_0 + #w_0)), Binding::Product)
            }
            Op::Sin(angle) | Op::Cos(angle) => {
                // k s[k] = Σ j a[j] c[k−j], k c[k] = −Σ j a[j] s[k−j]
                let (sum, inverse) = (self.sum(op), &self.inverse_order);
                let angle_k = at(angle, Binding::Prefix);
                if matches!(op, Op::Sin(_)) {
                    let cos = zeroth(self.id(&Op::Cos(angle)));
                    (quote!(#sum * #inverse + #angle_k * #cos), Binding::Sum)
                } else {
                    let sin = zeroth(self.id(&Op::Sin(angle)));
                    (
                        quote!(-(#sum * #inverse + #angle_k * #sin)),
                        Binding::Prefix,
                    )
                }
            }
            Op::Input(..) | Op::Constant(_) | Op::Number(_) => {
                unreachable!("inputs have names, constants no coefficient of order k")
            }
        }
    }
}
