//! Calls of functions on slices of any length, as the runtime's traits pass them. If a length is
//! wrong, the results are NaN, which integrators report at once.

use super::Emission;
use super::tokens::ident;
use crate::functions::{Argument, Purpose, ResultShape};
use crate::program::Entry;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Returns the entry point for a purpose.
    pub(super) fn entry(&self, purpose: Purpose) -> Option<&Entry> {
        let mut entries = self.program.entries.iter();
        entries.find(|entry| entry.purpose == purpose)
    }

    /// Emits the conversion of slices to arrays with the same names; the slices of a group have the
    /// same length.
    pub(super) fn with_arrays(
        &self,
        groups: &[Vec<&str>],
        success: TokenStream,
        failure: TokenStream,
    ) -> TokenStream {
        let runtime = self.runtime();
        let idents = |group: &Vec<&str>| group.iter().map(|name| ident(name)).collect();
        let names: Vec<Vec<Ident>> = groups.iter().map(idents).collect();
        let arrays = names.iter();
        let arrays = arrays.map(|group| quote!(#runtime::emitted::arrays([#(#group),*])));
        let patterns = names.iter();
        let patterns = patterns.map(|group| quote!(::core::option::Option::Some([#(#group),*])));
        let (arrays, pattern) = match names.len() {
            1 => (quote!(#(#arrays)*), quote!(#(#patterns)*)),
            _ => (quote!((#(#arrays),*)), quote!((#(#patterns),*))),
        };
        quote! {
            match #arrays {
                #pattern => #success,
                _ => #failure,
            }
        }
    }

    /// Passes the call of a function on slices, which have the names of its arguments, to `made`;
    /// emits `failure` for wrong lengths.
    pub(super) fn at_slices(
        &self,
        purpose: Purpose,
        made: impl Fn(TokenStream) -> TokenStream,
        failure: TokenStream,
    ) -> TokenStream {
        let Some(entry) = self.entry(purpose) else {
            return failure;
        };
        let mut groups: Vec<Vec<&str>> = Vec::new();
        let mut length = None;
        let arrays = entry.arguments.iter();
        for &argument in arrays.filter(|argument| **argument != Argument::Time) {
            let own = Some(self.argument_length(argument));
            match groups.last_mut() {
                Some(group) if length == own => group.push(argument.name()),
                _ => groups.push(vec![argument.name()]),
            }
            length = own;
        }
        let name = ident(&entry.name);
        let arguments = entry.arguments.iter();
        let arguments = arguments.map(|argument| ident(argument.name()));
        let call = quote!(self.#name(#(#arguments),*));
        self.with_arrays(&groups, made(call), failure)
    }

    /// Emits the number that a function returns for slices.
    pub(super) fn value_at_slices(&self, purpose: Purpose) -> TokenStream {
        self.at_slices(purpose, |call| call, quote!(T::from_f64(f64::NAN)))
    }

    /// Emits the filling of outputs with NaN.
    pub(super) fn unknown(&self, outputs: &[&str]) -> TokenStream {
        let runtime = self.runtime();
        let outputs = outputs.iter().map(|output| ident(output));
        quote!({ #(#runtime::emitted::unknown(#outputs);)* })
    }

    /// Emits code that calls a function with slices and writes its result, one array or
    /// several, to `outputs`.
    pub(super) fn fill(&self, outputs: &[&str], purpose: Purpose) -> TokenStream {
        if outputs.len() > 1 {
            return self.fill_each(outputs, purpose);
        }
        let runtime = self.runtime();
        let names: Vec<Ident> = outputs.iter().map(|output| ident(output)).collect();
        let write = |call| quote!(#runtime::emitted::write(#(#names),*, &#call));
        self.at_slices(purpose, write, self.unknown(outputs))
    }

    /// Emits code that writes the arrays returned by a function to as many slices. The function
    /// returns rows of equal length, or a tuple.
    fn fill_each(&self, outputs: &[&str], purpose: Purpose) -> TokenStream {
        let runtime = self.runtime();
        let names: Vec<Ident> = outputs.iter().map(|output| ident(output)).collect();
        let arrays = ["first", "second", "third", "fourth"].map(ident);
        let arrays = &arrays[..outputs.len()];
        let shape = self.entry(purpose).map(|entry| entry.shape);
        let pattern = match matches!(shape, Some(ResultShape::Rows(..))) {
            true => quote!([#(#arrays),*]),
            false => quote!((#(#arrays),*)),
        };
        let write = |call| {
            quote! {{
                let #pattern = #call;
                #runtime::emitted::write_each([#(#names),*], [#(&#arrays),*]);
            }}
        };
        self.at_slices(purpose, write, self.unknown(outputs))
    }
}
