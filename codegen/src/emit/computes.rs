//! Functions of a state on slices, which the runtime makes all its forms of.

use super::Emission;
use super::tokens::ident;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// A function of the runtime's `functions`, with the names that the code of the model calls its
/// slices and numbers by.
pub(super) struct SliceFunction<'a> {
    pub(super) name: &'a str,
    /// Slices that are given.
    pub(super) given: &'a [&'a str],
    /// Slices that are written.
    pub(super) results: &'a [&'a str],
    /// Which of several functions, where there are several.
    pub(super) index: Option<&'a str>,
}

impl Emission<'_> {
    /// `impl Computes`, with the body in the arithmetic of `T`, and where it is another, that
    /// with a `workspace`.
    pub(super) fn computes(
        &self,
        function: &SliceFunction<'_>,
        body: &TokenStream,
        with_workspace: Option<&TokenStream>,
    ) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let other = super::other_scalar(name);
        let (at, names) = self.names_of_arguments(function);
        let arguments = quote! {
            #at: #runtime::system::At<T>,
            given: &[&[T]],
            results: &mut [&mut [T]],
        };
        let whole = |body: &TokenStream| quote! { #names #body };
        let with_workspace = with_workspace.map(|body| {
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
        let body = whole(body);
        let function = ident(function.name);
        quote! {
            impl<T: #runtime::Scalar> #runtime::system::Computes<
                #runtime::system::functions::#function, T,
            > for #name<T> {
                type On<#other: #runtime::Scalar> = #name<#other>;

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

    /// The name of the argument `at`, which begins with an underscore where nothing reads it, and
    /// the lines that give slices, time and index their names.
    fn names_of_arguments(&self, function: &SliceFunction<'_>) -> (Ident, TokenStream) {
        let runtime = self.runtime();
        let [given, results] =
            [function.given, function.results].map(|names| names.iter().map(|name| ident(name)));
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
