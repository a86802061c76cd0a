//! Emits the functions of links with prescribed motion: their docs, and the runtime's trait.

use super::Emission;
use super::docs::wrapped_names;
use crate::scene::PrescribedSet;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn prescribed_meaning(&self, set: usize) -> Vec<String> {
        let members = self.scene.prescribed[set].members.iter();
        let members: Vec<&str> = members.map(String::as_str).collect();
        let names = wrapped_names(&members);
        vec![
            format!(
                "Angular accelerations (in rad/s²) of all links if some have `prescribed` accelerations (in rad/s²), and the reactions: the torques (in N m) that these links need in addition to `torques`. The prescribed links are, in this order, {names}"
            ),
            String::new(),
            format!(
                "M(θ) θ̈ + b(θ, ω{}) = Q + R: the accelerations of the other links and the reactions R are computed together, by the method of [`accelerations`](Self::accelerations). `theta` and `omega` include the prescribed links. The power of the reactions is R·ω.",
                self.and_time()
            ),
        ]
    }

    /// Emits the sets of prescribed links.
    fn prescribed_sets(&self) -> TokenStream {
        let sets = self.scene.prescribed.iter();
        let sets = sets.map(|PrescribedSet { links, .. }| {
            let links = links.iter().map(|link| Literal::usize_unsuffixed(link.0));
            quote!(&[#(#links),*])
        });
        quote! {
            #[inline]
            fn prescribed_links(&self, set: usize) -> ::core::option::Option<&[usize]> {
                const SETS: &[&[usize]] = &[#(#sets),*];
                SETS.get(set).copied()
            }
        }
    }

    /// Emits `impl Prescribed`; slices of a wrong length give NaN.
    pub(super) fn prescribed_trait(&self) -> Option<TokenStream> {
        if self.scene.prescribed.is_empty() {
            return None;
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        let links = self.prescribed_sets();
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                #links
            }
        })
    }
}
