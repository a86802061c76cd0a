//! Links whose motion is handed over: docs, and the runtime's trait.

use super::Emission;
use super::docs::wrapped_names;
use crate::functions::Purpose;
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
        let sets = &self.scene.prescribed;
        if sets.is_empty() {
            return None;
        }
        if self.scene.in_loops() {
            return Some(self.prescribed_in_loops());
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        let links = self.prescribed_sets();
        let outputs = ["alpha", "reactions"];
        let arms = (0..sets.len()).map(|number| {
            let (purpose, pattern) = (Purpose::Prescribed(number), quote!((first, second)));
            let written = self.fill_both(outputs, &pattern, purpose);
            let number = Literal::usize_unsuffixed(number);
            quote!(#number => #written,)
        });
        let unknown = self.unknown(&outputs);
        let accelerations = self.on_any_scalar(
            ["Prescribed", "accelerations_prescribed", "pendulum"],
            &quote!(set, time, motion, alpha, reactions),
            |time, t| {
                quote! {
                    set: usize, #time: #t, motion: #runtime::system::PrescribedMotion<'_, #t>,
                    alpha: &mut [#t], reactions: &mut [#t]
                }
            },
            &quote! {
                let #runtime::system::PrescribedMotion { theta, omega, torques, prescribed } =
                    motion;
                match set {
                    #(#arms)*
                    _ => #unknown
                }
            },
        );
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                #links

                #accelerations
            }
        })
    }

    /// The function of a tree in loops.
    fn prescribed_in_loops(&self) -> TokenStream {
        let (name, runtime, time) = (&self.item.ident, self.runtime(), self.time_name());
        let (links, other) = (self.prescribed_sets(), super::other_scalar(name));
        let drive = self.drive_at_time();
        let drive_of = self.drive_of(&quote!(pendulum));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                #links

                fn accelerations_prescribed_into(
                    &self,
                    set: usize,
                    time: T,
                    motion: #runtime::system::PrescribedMotion<'_, T>,
                    alpha: &mut [T],
                    reactions: &mut [T],
                ) {
                    let mut workspace = #runtime::system::Workspace::new();
                    #runtime::Prescribed::accelerations_prescribed_with(
                        self, &mut workspace, set, time, motion, alpha, reactions,
                    );
                }

                fn accelerations_prescribed_with(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    set: usize,
                    #time: T,
                    motion: #runtime::system::PrescribedMotion<'_, T>,
                    alpha: &mut [T],
                    reactions: &mut [T],
                ) {
                    let links = #runtime::Prescribed::prescribed_links(self, set);
                    self.tree.accelerations_prescribed_with(
                        workspace, #drive, links, motion, [alpha, reactions],
                    );
                }

                #[inline(always)]
                fn accelerations_prescribed_of<#other: #runtime::Scalar>(
                    pendulum: &#name<#other>,
                    set: usize,
                    #time: #other,
                    motion: #runtime::system::PrescribedMotion<'_, #other>,
                    alpha: &mut [#other],
                    reactions: &mut [#other],
                ) {
                    let links = #runtime::Prescribed::prescribed_links(pendulum, set);
                    pendulum.tree.evaluate_prescribed(
                        #drive_of, links, motion, [alpha, reactions],
                    );
                }
            }
        }
    }
}
