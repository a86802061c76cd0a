//! Links whose motion is handed over: docs, and the runtime's trait.

use super::Emission;
use super::docs::wrapped_names;
use crate::functions::Purpose;
use crate::scene::{LinkId, PrescribedSet};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    fn prescribed_names(&self, set: &PrescribedSet) -> String {
        let links = set.links.iter();
        let names: Vec<&str> = links
            .map(|&LinkId(link)| self.scene.links[link].name.as_str())
            .collect();
        wrapped_names(&names)
    }

    pub(super) fn prescribed_meaning(&self, set: usize) -> Vec<String> {
        let names = self.prescribed_names(&self.scene.prescribed[set]);
        vec![
            format!(
                "Angular accelerations (in rad/s²) of all links where some have `prescribed` ones (in rad/s²), and the reactions: the torques (in N m) on these, beyond `torques`, that make them move so. They are, in this order, {names}"
            ),
            String::new(),
            format!(
                "M(θ) θ̈ + b(θ, ω{}) = Q + R: the accelerations of the other links are solved for, and with them the reactions R, by the solve of [`accelerations`](Self::accelerations). Angles and angular velocities of the prescribed links stand in `theta` and `omega` as for all links. The power of the reactions is R·ω.",
                self.and_time()
            ),
        ]
    }

    /// `impl Prescribed`; NaN for slices of a wrong length.
    pub(super) fn prescribed_trait(&self) -> Option<TokenStream> {
        let sets = &self.scene.prescribed;
        if sets.is_empty() {
            return None;
        }
        let (name, runtime, time) = (&self.item.ident, self.runtime(), self.time_name());
        let constants = sets.iter().map(|PrescribedSet { name, links }| {
            let links = links.iter().map(|link| Literal::usize_unsuffixed(link.0));
            quote! {
                #runtime::system::PrescribedLinks { name: #name, links: &[#(#links),*] }
            }
        });
        let outputs = ["alpha", "reactions"];
        let arms = (0..sets.len()).map(|number| {
            let (purpose, pattern) = (Purpose::Prescribed(number), quote!((first, second)));
            let written = self.fill_both(outputs, &pattern, purpose);
            let number = Literal::usize_unsuffixed(number);
            quote!(#number => #written,)
        });
        let unknown = self.unknown(&outputs);
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                const PRESCRIBED: &'static [#runtime::system::PrescribedLinks] =
                    &[#(#constants),*];

                #[inline]
                fn accelerations_prescribed_into(
                    &self,
                    set: usize,
                    #time: T,
                    motion: #runtime::system::PrescribedMotion<'_, T>,
                    alpha: &mut [T],
                    reactions: &mut [T],
                ) {
                    let #runtime::system::PrescribedMotion { theta, omega, torques, prescribed } =
                        motion;
                    match set {
                        #(#arms)*
                        _ => #unknown
                    }
                }
            }
        })
    }
}
