//! Emits the number of links of the model and their names.

use super::Emission;
use super::tokens::count;
use crate::scene::Layout;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// Emits the constants of the type, and `impl Model` with the function `cast`.
    pub(super) fn model_trait(&self, cast: &TokenStream) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let other = super::other_scalar(name);
        // The links of generations are too many for a list.
        let (links, listed, found) = match self.scene.layout {
            Layout::Generations { links, .. } => {
                let tree = self.tree_type();
                (links, None, quote!(<#tree>::link_name(index)))
            }
            Layout::Unrolled | Layout::Links => {
                let names = self.scene.links.iter().map(|link| &link.name);
                let listed = quote! {
                    /// Names of the links, in the order of the angles.
                    pub const LINK_NAMES: &'static [&'static str] = &[#(#names),*];
                };
                let found = quote! {
                    #runtime::system::LinkName::in_list(<#name<f64>>::LINK_NAMES, index)
                };
                (self.scene.links.len(), Some(listed), found)
            }
        };
        let links = count(links);
        quote! {
            // As for the functions, see `emit`.
            #[allow(clippy::possible_missing_comma)]
            #[allow(dead_code)]
            impl #name<f64> {
                /// Number of links, each with one angle.
                pub const LINKS: usize = #links;

                #listed
            }

            impl<T: #runtime::Scalar> #runtime::Model<T> for #name<T> {
                type Of<#other: #runtime::Scalar> = #name<#other>;

                const KNOWN_LINKS: ::core::option::Option<usize> =
                    ::core::option::Option::Some(#links);

                #[inline(always)]
                fn links(&self) -> usize {
                    #links
                }

                fn link_name(
                    &self,
                    index: usize,
                ) -> ::core::option::Option<#runtime::system::LinkName<'_>> {
                    #found
                }

                #cast
            }
        }
    }
}
