//! One call for the sines and cosines of all angles that are arguments or are
//! formed of them (means, half differences): the runtime computes several at a
//! time.

use super::Emission;
use super::names::Locals;
use super::tokens::Binding;
use crate::functions::Argument;
use crate::program::{Entry, Op, ValueId};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Angles whose sines and cosines are asked for at once.
#[derive(Default)]
pub(super) struct Gathered {
    /// Inputs, before anything else.
    pub(super) inputs: Vec<ValueId>,
    /// The argument that they are, if they are all of one.
    pub(super) whole: Option<Argument>,
    /// Angles that something has to be formed for first, with the inputs where
    /// those are not handed on as a whole.
    pub(super) formed: Vec<ValueId>,
}

impl Emission<'_> {
    /// The angles whose sine or cosine an entry needs and that no other sine or
    /// cosine goes into, if they are several, in their order.
    pub(super) fn gathered(&self, entry: &Entry, needed: &[ValueId]) -> Gathered {
        let mut turned = BTreeSet::new();
        // Values that a sine or cosine goes into.
        let mut late = BTreeSet::new();
        for &id in needed {
            let op = self.op(id);
            if let Op::Sin(angle) | Op::Cos(angle) = *op {
                turned.insert(angle);
                late.insert(id);
            } else if op.operands().any(|operand| late.contains(&operand)) {
                late.insert(id);
            }
        }
        let formed = turned.iter().copied().filter(|id| {
            !late.contains(id)
                && !matches!(self.op(*id), Op::Input(argument, _) if *argument != Argument::Time)
        });
        let mut formed: Vec<ValueId> = formed.collect();
        let mut angles: Vec<(usize, usize, ValueId)> = needed
            .iter()
            .filter_map(|&id| match *self.op(id) {
                Op::Input(Argument::Time, _) => None,
                Op::Input(argument, index) if turned.contains(&id) => {
                    let place = entry.arguments.iter().position(|a| *a == argument)?;
                    Some((place, index, id))
                }
                _ => None,
            })
            .collect();
        angles.sort_unstable();
        let ends = angles.first().zip(angles.last());
        let one = ends.filter(|(first, last)| first.0 == last.0);
        let all = one.filter(|_| angles.len() == self.scene.links.len() && angles.len() > 1);
        let whole = all.map(|(first, _)| entry.arguments[first.0]);
        let mut inputs: Vec<ValueId> = angles.into_iter().map(|(.., id)| id).collect();
        if whole.is_none() && !formed.is_empty() {
            formed.splice(0..0, inputs.drain(..));
        }
        let several = |angles: Vec<ValueId>| match angles.len() {
            0 | 1 => Vec::new(),
            _ => angles,
        };
        Gathered {
            inputs: several(inputs),
            whole,
            formed: several(formed),
        }
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
        let (sines, cosines): (Vec<_>, Vec<_>) = names(Op::Sin).zip(names(Op::Cos)).unzip();
        let argument = match whole {
            Some(argument) => {
                let name = Ident::new(argument.name(), Span::call_site());
                quote!(#name)
            }
            None => {
                let angles = angles
                    .iter()
                    .map(|&id| self.bound(id, locals, Binding::Sum));
                quote!(&[#(#angles),*])
            }
        };
        // Those that nothing reads have no name.
        let taken = |array: &str, elements: &[TokenStream]| {
            let unread = elements.iter().all(|name| name.to_string() == "_");
            let array = Ident::new(array, Span::call_site());
            match unread {
                true => (quote!(_), TokenStream::new()),
                false => (quote!(#array), quote!(let [#(#elements),*] = #array;)),
            }
        };
        let (sine_array, sines) = taken("sines", &sines);
        let (cosine_array, cosines) = taken("cosines", &cosines);
        quote! {
            let (#sine_array, #cosine_array) = T::sin_cos_each(#argument);
            #sines
            #cosines
        }
    }

    /// Returns true if the code names an element of an argument.
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
        let formed = needed.iter().map(|&id| self.op(id));
        let formed = formed.filter(|op| !matches!(op, Op::Sin(_) | Op::Cos(_)));
        let mut used: BTreeSet<ValueId> = entry.outputs.iter().copied().collect();
        used.extend(formed.flat_map(Op::operands));
        needed
            .iter()
            .copied()
            .filter(|&id| {
                matches!(self.op(id), Op::Input(..))
                    && (used.contains(&id) || !passed_on.is_some_and(|angles| angles.contains(&id)))
            })
            .collect()
    }
}
