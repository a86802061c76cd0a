//! One order of the Taylor coefficients of the terms that the runtime's recurrences of a tree do
//! not contain: friction, springs, drives.
//!
//! The coefficient of order k of a product, a quotient, a sine or a root is a sum of products of
//! coefficients of orders below k, Σ_{0<j<k} u[j] v[k−j], plus a contribution of the coefficients
//! of order k and 0. No such sum depends on another sum of the same order, so that all are computed
//! together. The contribution is added last; it is usually the largest term.

mod closure;

use super::Emission;
use super::names::Locals;
use super::tokens::{Binding, ident};
use crate::functions::Argument;
use crate::program::{Entry, Op, TaylorOutputs, ValueId};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

/// A factor of the products in a sum.
#[derive(Clone, Copy)]
enum Factor {
    /// Coefficient u[j] of a value.
    Value(ValueId),
    /// Product j u[j] for an angle u: the coefficient of its rate of change.
    Rate(ValueId),
}

/// Sum of products that an operation needs in each order.
struct ProductSum {
    of: Op,
    name: Ident,
    factors: [Factor; 2],
}

/// Recurrences of all terms of the equations of motion that the runtime's own recurrences do not
/// contain.
pub(super) struct Recurrences<'e> {
    pub(super) emission: &'e Emission<'e>,
    entry: &'e Entry,
    bias: &'e [ValueId],
    /// Values that the coefficients of the bias depend on.
    needed: Vec<ValueId>,
    links: usize,
    /// Names of the coefficients of order 0.
    pub(super) locals: Locals,
    /// Names of the coefficients of order k.
    names: BTreeMap<ValueId, Ident>,
    /// True for values that depend on the state or the time.
    pub(super) varies: BTreeMap<ValueId, bool>,
    sums: Vec<ProductSum>,
    /// Name of the order k, and name of the struct that contains the coefficients of the state.
    order: Ident,
    known: Ident,
    order_number: Ident,
    pub(super) inverse_order: Ident,
    time: Option<Ident>,
}

impl<'e> Recurrences<'e> {
    pub(super) fn new(emission: &'e Emission<'e>, entry: &'e Entry, bias: &'e [ValueId]) -> Self {
        let links = emission.scene.links.len();
        let needed = with_partners(emission, bias);
        let roots = TaylorOutputs::of(&entry.outputs, links).roots();
        let mut outputs = roots;
        let number = |id: &ValueId| matches!(emission.op(*id), Op::Number(_));
        outputs.extend(bias.iter().filter(|id| !number(id)));
        let all = emission.program.needed(&outputs);
        let mut locals = emission.locals(
            &Entry {
                outputs,
                ..entry.clone()
            },
            &all,
        );
        let reserved = ["coefficients", "work", "start", "tree", "bias"];
        let of_sums = ["factors", "products", "sines", "cosines"];
        for name in reserved.into_iter().chain(of_sums) {
            locals.fresh(name.to_owned());
        }
        let mut varies: BTreeMap<ValueId, bool> = BTreeMap::new();
        for &id in &needed {
            let op = emission.op(id);
            let moves = matches!(op, Op::Input(..)) || op.operands().any(|a| varies[&a]);
            varies.insert(id, moves);
        }
        let mut fresh = |name: &str| ident(&locals.fresh(name.to_owned()));
        let (order, known) = (fresh("k"), fresh("known"));
        let (order_number, inverse_order) = (fresh("order"), fresh("inverse_order"));
        let timed = needed
            .iter()
            .any(|id| matches!(emission.op(*id), Op::Input(Argument::Time, _)));
        let time = timed.then(|| fresh("time_k"));
        let mut recurrences = Self {
            emission,
            entry,
            bias,
            needed,
            links,
            locals,
            names: BTreeMap::new(),
            varies,
            sums: Vec::new(),
            order,
            known,
            order_number,
            inverse_order,
            time,
        };
        recurrences.name_factors();
        recurrences.name_coefficients();
        recurrences.find_sums();
        recurrences
    }

    /// Returns the entry point for order 0: it computes the initial values of the expansion, and
    /// the values that are used again in order k.
    pub(super) fn start(&self, of_all: &TaylorOutputs) -> Entry {
        let mut outputs = of_all.roots();
        outputs.extend(&of_all.bias);
        for &id in &self.needed {
            outputs.extend(self.read_again(id));
        }
        Entry {
            outputs,
            ..self.entry.clone()
        }
    }

    /// Returns true if the equations have no terms other than those of the runtime's recurrences.
    pub(super) fn is_empty(&self) -> bool {
        self.bias.iter().all(|id| !self.varies[id])
    }

    /// Returns the number of quads that hold the sums of products.
    fn quads(&self) -> usize {
        self.sums.len().div_ceil(4)
    }

    /// Returns the number of sums of products in each order.
    pub(super) fn count(&self) -> usize {
        self.sums.len()
    }

    /// Returns the number of quads by which the sums extend the workspace.
    pub(super) fn workspace_len(&self) -> Option<TokenStream> {
        let size = Literal::usize_unsuffixed(2 * self.quads());
        (self.quads() > 0).then(|| quote!(+ #size * (order + 1)))
    }

    /// Emits the part of the workspace for the factors of the sums.
    pub(super) fn rows(&self) -> TokenStream {
        if self.sums.is_empty() {
            return TokenStream::new();
        }
        let runtime = self.emission.runtime();
        let quads = Literal::usize_unsuffixed(self.quads());
        quote! {
            let (factors, work) =
                #runtime::emitted::taylor::rows::<T, #quads>(work, coefficients.len());
        }
    }

    /// Returns true for a sine or cosine of an angle of the tree, which is known like the angle.
    fn is_given(&self, op: &Op) -> bool {
        match *op {
            Op::Input(..) => true,
            Op::Sin(a) | Op::Cos(a) => {
                matches!(self.emission.op(a), Op::Input(Argument::Theta, _))
            }
            _ => false,
        }
    }

    /// Returns true if an operation needs a sum of products.
    fn nonlinear(&self, op: &Op) -> bool {
        match *op {
            _ if self.is_given(op) => false,
            Op::Mul(a, b) => self.varies[&a] && self.varies[&b],
            Op::Div(_, a) | Op::Sin(a) | Op::Cos(a) | Op::Sqrt(a) => self.varies[&a],
            _ => false,
        }
    }

    /// Returns the values whose order 0 is used again in order k of a value.
    fn read_again(&self, id: ValueId) -> Vec<ValueId> {
        let op = self.emission.op(id);
        if !self.nonlinear(op) {
            return Vec::new();
        }
        match *op {
            Op::Mul(a, b) => vec![a, b],
            Op::Div(_, b) => vec![b, id],
            Op::Sin(a) => vec![self.id(&Op::Cos(a))],
            Op::Cos(a) => vec![self.id(&Op::Sin(a))],
            _ => vec![id],
        }
    }

    /// Names the values that have no name in order 0 and are used again in order k.
    fn name_factors(&mut self) {
        for id in self.needed.clone() {
            for value in self.read_again(id) {
                let leaf = matches!(self.emission.op(value), Op::Constant(_) | Op::Number(_));
                if !leaf && !self.locals.names.contains_key(&value) {
                    let name = self.emission.described(value, &self.locals);
                    self.locals.claim(value, name);
                }
            }
        }
    }

    fn name_coefficients(&mut self) {
        for &id in &self.needed {
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
        for id in self.needed.clone() {
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
            let known = known.unwrap_or_else(|| self.emission.described(id, &self.locals));
            let name = ident(&self.locals.fresh(format!("sum_{known}")));
            self.sums.push(ProductSum {
                of: op,
                name,
                factors,
            });
        }
    }

    pub(super) fn id(&self, op: &Op) -> ValueId {
        match self.find(op) {
            Some(id) => id,
            None => unreachable!("the entry holds both partners of a sine and cosine"),
        }
    }

    /// Returns the value of an operation, if it is needed.
    fn find(&self, op: &Op) -> Option<ValueId> {
        let mut needed = self.needed.iter().copied();
        needed.find(|id| self.emission.op(*id) == op)
    }

    /// Returns the expression by which the coefficient of order k of a value is used.
    pub(super) fn bound(&self, id: ValueId, place: Binding) -> TokenStream {
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

    /// Returns the expression by which the coefficient of order 0 of a value is used.
    pub(super) fn zeroth(&self, id: ValueId, place: Binding) -> TokenStream {
        self.emission.bound(id, &self.locals, place)
    }

    pub(super) fn sum(&self, op: &Op) -> &Ident {
        match self.sums.iter().find(|sum| sum.of == *op) {
            Some(sum) => &sum.name,
            None => unreachable!("every operation that is not linear has a sum"),
        }
    }
}

/// Returns the values that the bias needs. If it needs a sine or cosine of the time, both are
/// included, because their recurrences need each other.
fn with_partners(emission: &Emission<'_>, bias: &[ValueId]) -> Vec<ValueId> {
    let mut outputs = bias.to_vec();
    for id in emission.program.needed(bias) {
        let partner = match *emission.op(id) {
            Op::Sin(a) => Op::Cos(a),
            Op::Cos(a) => Op::Sin(a),
            _ => continue,
        };
        let definitions = emission.program.definitions.iter().zip(0..);
        let found = definitions.filter(|(definition, _)| definition.op == partner);
        outputs.extend(found.map(|(_, id)| ValueId(id)));
    }
    emission.program.needed(&outputs)
}
