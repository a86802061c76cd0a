//! Links whose motion is handed over: docs, and the runtime's trait.

use super::Emission;
use super::computes::SliceFunction;
use super::docs::wrapped_names;
use crate::functions::Purpose;
use crate::scene::PrescribedSet;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// The function of the runtime's trait.
const ACCELERATIONS: SliceFunction<'_> = SliceFunction {
    name: "AccelerationsOfHeldLinks",
    given: &["theta", "omega", "torques", "prescribed"],
    results: &["alpha", "reactions"],
    index: Some("set"),
};

impl Emission<'_> {
    pub(super) fn prescribed_meaning(&self, set: usize) -> Vec<String> {
        let members = self.scene.prescribed[set].members.iter();
        let members: Vec<&str> = members.map(String::as_str).collect();
        let names = wrapped_names(&members);
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

    /// The sets of the runtime's trait.
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

    /// `impl Prescribed`; NaN for slices of a wrong length.
    pub(super) fn prescribed_trait(&self) -> Option<TokenStream> {
        if self.scene.prescribed.is_empty() {
            return None;
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        let links = self.prescribed_sets();
        let accelerations = match self.scene.in_loops() {
            true => self.prescribed_in_loops(),
            false => self.prescribed_written_out(),
        };
        Some(quote! {
            #accelerations

            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                #links
            }
        })
    }

    /// The accelerations of held links, by the tree's sweep.
    fn prescribed_in_loops(&self) -> TokenStream {
        let (runtime, drive) = (self.runtime(), self.drive_at_time());
        let motion = quote! {
            let links = #runtime::Prescribed::prescribed_links(self, set);
            let motion =
                #runtime::system::PrescribedMotion { theta, omega, torques, prescribed };
        };
        self.computes(
            &ACCELERATIONS,
            &quote! {
                #motion
                self.tree.evaluate_prescribed(#drive, links, motion, [alpha, reactions]);
            },
            Some(&quote! {
                #motion
                self.tree.accelerations_prescribed_with(
                    workspace, #drive, links, motion, [alpha, reactions],
                );
            }),
        )
    }

    /// The accelerations of held links, by a function for each set.
    fn prescribed_written_out(&self) -> TokenStream {
        let outputs = ["alpha", "reactions"];
        let arms = (0..self.scene.prescribed.len()).map(|number| {
            let (purpose, pattern) = (Purpose::Prescribed(number), quote!((first, second)));
            let written = self.fill_both(outputs, &pattern, purpose);
            let number = Literal::usize_unsuffixed(number);
            quote!(#number => #written,)
        });
        let unknown = self.unknown(&outputs);
        let body = quote! {
            match set {
                #(#arms)*
                _ => #unknown
            }
        };
        self.computes(&ACCELERATIONS, &body, None)
    }
}
