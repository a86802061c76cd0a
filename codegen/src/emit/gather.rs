//! Combines the sines and cosines of all angles that are arguments, or that are computed from
//! arguments (means and half differences), in one call, since the runtime computes several at a
//! time.

use super::Emission;
use super::names::Locals;
use super::tokens::Binding;
use crate::functions::Argument;
use crate::program::{Entry, Op, ValueId};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Angles whose sines and cosines are computed in one call.
#[derive(Default)]
pub(super) struct Gathered {
    /// Angles that are inputs, which come first.
    pub(super) inputs: Vec<ValueId>,
    /// Argument that consists exactly of these inputs, if there is one.
    pub(super) whole: Option<Argument>,
    /// Angles that must be computed first. Includes the inputs if these are not passed as a whole
    /// argument.
    pub(super) formed: Vec<ValueId>,
}

impl Emission<'_> {
    /// Returns the angles whose sine or cosine an entry point needs and that depend on no other
    /// sine or cosine, in their order. Returns none if there is only one.
    pub(super) fn gathered(&self, entry: &Entry, needed: &[ValueId]) -> Gathered {
        let mut turned = BTreeSet::new();
        // Values that depend on a sine or cosine.
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

    /// Returns `let (sines, cosines) = T::sin_cos_each(theta);` and the lines that name the
    /// elements.
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
        // Elements that nothing reads have no name.
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

    /// Returns true if the emitted code names an element of an argument.
    pub(super) fn reads(&self, argument: Argument, read: &[ValueId]) -> bool {
        read.iter()
            .any(|&id| matches!(*self.op(id), Op::Input(of, _) if of == argument))
    }

    /// Returns the inputs that the emitted code names: all needed ones, except angles whose
    /// argument is passed as a whole and that only occur in sines and cosines.
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
