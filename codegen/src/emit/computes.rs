//! Emits functions of a state on slices, from which the runtime derives all other forms.

use super::Emission;
use super::tokens::ident;
use crate::functions::{Naming, Purpose, ResultShape, SliceFunction};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Parts of an implementation of `Computes` that differ between functions.
pub(super) struct SliceBody {
    /// The number of coordinates, if it is not that of the links.
    pub(super) coordinates: Option<TokenStream>,
    /// The computation in the arithmetic of `T`.
    pub(super) plain: TokenStream,
    /// The computation with a `workspace`, if it is another one.
    pub(super) with_workspace: Option<TokenStream>,
}

impl Emission<'_> {
    /// Emits `impl Computes` of each function on slices for which the program has an entry: its
    /// results are NaN for slices of a wrong length and for an index without a function.
    pub(super) fn slice_functions(&self) -> TokenStream {
        let mut found: Vec<(SliceFunction, Vec<Purpose>)> = Vec::new();
        for entry in &self.program.entries {
            let Some(function) = entry.purpose.slices() else {
                continue;
            };
            match found.iter_mut().find(|(known, _)| *known == function) {
                Some((_, purposes)) => purposes.push(entry.purpose),
                None => found.push((function, vec![entry.purpose])),
            }
        }
        let functions = found.into_iter().map(|(function, purposes)| {
            let mut values = purposes.iter().map(|&of| self.fill(function.results, of));
            let body = match (function.index, values.next()) {
                (None, Some(only)) => only,
                (index, first) => {
                    let index = index.map(ident);
                    let arms = first.into_iter().chain(values).enumerate();
                    let arms = arms.map(|(number, value)| {
                        let number = Literal::usize_unsuffixed(number);
                        quote!(#number => #value)
                    });
                    let unknown = self.unknown(function.results);
                    quote! {
                        match #index {
                            #(#arms,)*
                            _ => #unknown,
                        }
                    }
                }
            };
            let body = SliceBody {
                coordinates: self.coordinates(&purposes),
                plain: body,
                with_workspace: None,
            };
            self.computes(purposes[0], function, &body)
        });
        functions.collect()
    }

    /// Emits the number of coordinates whose accelerations functions return, if it is not the number
    /// of links: these functions return the accelerations of differences too. There is no number if
    /// the functions return different ones.
    fn coordinates(&self, purposes: &[Purpose]) -> Option<TokenStream> {
        let entries = purposes.iter().filter_map(|&purpose| self.entry(purpose));
        let counts: BTreeSet<usize> = entries
            .filter(|entry| matches!(entry.shape, ResultShape::Vector))
            .map(|entry| entry.outputs.len())
            .collect();
        let own = self.scene.links.len();
        let count = match counts.into_iter().collect::<Vec<_>>()[..] {
            [] => return None,
            [only] if only == own => return None,
            [only] => {
                let only = Literal::usize_unsuffixed(only);
                quote!(::core::option::Option::Some(#only))
            }
            [_, _, ..] => quote!(::core::option::Option::None),
        };
        Some(quote!(const COORDINATES: ::core::option::Option<usize> = #count;))
    }

    /// Emits `impl Computes`. `purpose` is one of those that the function implements.
    pub(super) fn computes(
        &self,
        purpose: Purpose,
        function: SliceFunction,
        body: &SliceBody,
    ) -> TokenStream {
        let SliceBody {
            coordinates,
            plain,
            with_workspace,
        } = body;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let other = super::other_scalar(name);
        let (at, names) = self.names_of_arguments(purpose, function);
        let arguments = quote! {
            #at: #runtime::system::At<T>,
            given: &[&[T]],
            results: &mut [&mut [T]],
        };
        let whole = |body: &TokenStream| quote! { #names #body };
        let with_workspace = with_workspace.as_ref().map(|body| {
            let body = whole(body);
            quote! {
                fn compute_with(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    #arguments
                ) {
                    #body
                }
            }
        });
        let body = whole(plain);
        let function = ident(function.name);
        quote! {
            impl<T: #runtime::Scalar> #runtime::system::Computes<
                #runtime::system::functions::#function, T,
            > for #name<T> {
                type On<#other: #runtime::Scalar> = #name<#other>;

                #coordinates

                #[inline(always)]
                fn on<#other: #runtime::Scalar>(
                    &self,
                    convert: impl ::core::ops::Fn(T) -> #other,
                ) -> #name<#other> {
                    #runtime::Model::cast(self, convert)
                }

                #[inline(always)]
                fn compute(&self, #arguments) {
                    #body
                }

                #with_workspace
            }
        }
    }

    /// Returns the name of the argument `at`, with a leading underscore if it is not used, and the
    /// lines that name slices, time and index.
    fn names_of_arguments(
        &self,
        purpose: Purpose,
        function: SliceFunction,
    ) -> (Ident, TokenStream) {
        let runtime = self.runtime();
        let signature = Naming::of(self.scene, self.mechanics).signature(purpose);
        let given = signature.slices().map(ident);
        let results = function.results.iter().map(|name| ident(name));
        let slices = quote! {
            let (&[#(#given),*], [#(#results),*]) = (given, &mut *results) else {
                return #runtime::emitted::no_answer(results);
            };
        };
        let time = self.mechanics.drive.is_some();
        let time = time.then(|| quote!(let time = at.time;));
        let index = function.index.map(|index| {
            let index = ident(index);
            quote!(let #index = at.index;)
        });
        let at = match (&time, &index) {
            (None, None) => ident("_at"),
            _ => ident("at"),
        };
        (at, quote! { #slices #time #index })
    }
}
