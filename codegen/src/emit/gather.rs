//! One call for the sines and cosines of all angles that are arguments: the
//! runtime computes several at a time.

use super::Emission;
use super::names::Locals;
use crate::program::{Argument, Entry, Op, ValueId};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// The inputs whose sine or cosine an entry needs, if they are several, in
    /// their order; and the argument that they are, if they are all of one.
    pub(super) fn gathered(
        &self,
        entry: &Entry,
        needed: &[ValueId],
    ) -> (Vec<ValueId>, Option<Argument>) {
        let turned = |id: ValueId| {
            needed
                .iter()
                .any(|other| matches!(*self.op(*other), Op::Sin(a) | Op::Cos(a) if a == id))
        };
        let mut angles: Vec<(usize, usize, ValueId)> = needed
            .iter()
            .filter_map(|&id| match *self.op(id) {
                Op::Input(argument, index) if turned(id) => {
                    let place = entry.arguments.iter().position(|a| *a == argument)?;
                    Some((place, index, id))
                }
                _ => None,
            })
            .collect();
        if angles.len() < 2 {
            return (Vec::new(), None);
        }
        angles.sort_unstable();
        let (first, last) = (angles[0].0, angles[angles.len() - 1].0);
        let all = first == last && angles.len() == self.scene.links.len();
        let whole = all.then(|| entry.arguments[first]);
        (angles.into_iter().map(|(.., id)| id).collect(), whole)
    }

    /// `let (sines, cosines) = T::sin_cos_each(theta);` and what they are called.
    pub(super) fn sin_cos_each(
        &self,
        angles: &[ValueId],
        whole: Option<Argument>,
        needed: &[ValueId],
        locals: &Locals,
    ) -> TokenStream {
        let names = |op: fn(ValueId) -> Op| {
            angles
                .iter()
                .map(move |&angle| self.local(&op(angle), needed, locals))
        };
        let (sines, cosines) = (names(Op::Sin), names(Op::Cos));
        let argument = match whole {
            Some(argument) => {
                let name = Ident::new(argument.name(), Span::call_site());
                quote!(#name)
            }
            None => {
                let inputs = angles
                    .iter()
                    .map(|&id| self.local(self.op(id), needed, locals));
                quote!(&[#(#inputs),*])
            }
        };
        quote! {
            let (sines, cosines) = T::sin_cos_each(#argument);
            let [#(#sines),*] = sines;
            let [#(#cosines),*] = cosines;
        }
    }

    /// Whether the code names an element of an argument.
    pub(super) fn reads(&self, argument: Argument, read: &[ValueId]) -> bool {
        read.iter()
            .any(|&id| matches!(*self.op(id), Op::Input(of, _) if of == argument))
    }

    /// The inputs that the code names: all that are needed but those that are
    /// turned only, where their argument is passed on as it is.
    pub(super) fn read(
        &self,
        entry: &Entry,
        needed: &[ValueId],
        passed_on: Option<&Vec<ValueId>>,
    ) -> Vec<ValueId> {
        let used = |id: ValueId| {
            entry.outputs.contains(&id)
                || needed.iter().any(|other| match self.op(*other) {
                    Op::Sin(_) | Op::Cos(_) => false,
                    op => op.operands().any(|operand| operand == id),
                })
        };
        needed
            .iter()
            .copied()
            .filter(|&id| {
                matches!(self.op(id), Op::Input(..))
                    && (used(id) || !passed_on.is_some_and(|angles| angles.contains(&id)))
            })
            .collect()
    }
}
