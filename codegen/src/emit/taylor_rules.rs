//! Recurrences of the operations: the coefficient of order k from known ones.

use super::taylor_order::Recurrences;
use super::tokens::Binding;
use crate::exact::Rational;
use crate::program::{Op, ValueId};
use proc_macro2::TokenStream;
use quote::quote;

impl Recurrences<'_> {
    /// Returns the recurrence of an operation, in terms of the coefficients of orders k and 0.
    pub(super) fn definition(&self, id: ValueId) -> (TokenStream, Binding) {
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
                let (u, v) = (at(a, Binding::Product), at(b, Binding::Prefix));
                let (u_0, v_0) = (zeroth(a), zeroth(b));
                let sum = self.sum(op);
                (quote!(#sum + (#u_0 * #v + #u * #v_0)), Binding::Sum)
            }
            Op::Mul(a, b) => {
                let (constant, moving) = if varies(&a) { (b, a) } else { (a, b) };
                let constant = self.zeroth(constant, Binding::Product);
                let moving = at(moving, Binding::Prefix);
                (quote!(#constant * #moving), Binding::Product)
            }
            Op::Div(a, b) if varies(&b) => self.quotient(id, [a, b]),
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
            Op::Sin(angle) | Op::Cos(angle) => self.turn(op, angle),
            Op::Input(..) | Op::Constant(_) | Op::Number(_) => {
                unreachable!("inputs have names, constants no coefficient of order k")
            }
        }
    }

    /// Returns the recurrence of a quotient whose divisor is not constant.
    fn quotient(&self, id: ValueId, [a, b]: [ValueId; 2]) -> (TokenStream, Binding) {
        // u = v w, solved for w[k].
        let (sum, w_0) = (
            self.sum(self.emission.op(id)),
            self.zeroth(id, Binding::Atom),
        );
        let v = self.bound(b, Binding::Prefix);
        let rest = quote!(#sum + #v * #w_0);
        if *self.emission.op(a) == Op::Number(Rational::from(1)) {
            return (quote!(-(#rest) * #w_0), Binding::Product);
        }
        let v_0 = self.zeroth(b, Binding::Atom);
        if self.varies[&a] {
            let u = self.bound(a, Binding::Sum);
            (quote!((#u - (#rest)) / #v_0), Binding::Product)
        } else {
            (quote!(-(#rest) / #v_0), Binding::Product)
        }
    }

    /// Returns the recurrence of the sine or cosine of an angle.
    fn turn(&self, op: &Op, angle: ValueId) -> (TokenStream, Binding) {
        // k s[k] = Σ j a[j] c[k−j], k c[k] = −Σ j a[j] s[k−j]
        let (sum, inverse) = (self.sum(op), &self.inverse_order);
        let angle_k = self.bound(angle, Binding::Product);
        let zeroth = |of: Op| self.zeroth(self.id(&of), Binding::Atom);
        if matches!(op, Op::Sin(_)) {
            let cos = zeroth(Op::Cos(angle));
            (quote!(#sum * #inverse + #angle_k * #cos), Binding::Sum)
        } else {
            let sin = zeroth(Op::Sin(angle));
            (
                quote!(-(#sum * #inverse + #angle_k * #sin)),
                Binding::Prefix,
            )
        }
    }
}
