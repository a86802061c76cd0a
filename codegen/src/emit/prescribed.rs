//! Links whose motion is handed over: docs, and the runtime's trait.

use super::Emission;
use super::doc_text::doc_lines;
use super::docs::wrapped_names;
use crate::functions::Purpose;
use crate::scene::PrescribedSet;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

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
        let runtime = self.runtime();
        let sets = self.scene.prescribed.iter();
        let sets = sets.map(|PrescribedSet { name, links, .. }| {
            let links = links.iter().map(|link| Literal::usize_unsuffixed(link.0));
            quote! {
                #runtime::system::PrescribedLinks { name: #name, links: &[#(#links),*] }
            }
        });
        quote! {
            const PRESCRIBED: &'static [#runtime::system::PrescribedLinks] = &[#(#sets),*];
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
        let (name, runtime, time) = (&self.item.ident, self.runtime(), self.time_name());
        let (constants, other) = (self.prescribed_sets(), super::other_scalar(name));
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
                #constants

                #[inline(always)]
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

                #[inline(always)]
                fn accelerations_prescribed_of<#other: #runtime::Scalar>(
                    pendulum: &#name<#other>,
                    set: usize,
                    time: #other,
                    motion: #runtime::system::PrescribedMotion<'_, #other>,
                    alpha: &mut [#other],
                    reactions: &mut [#other],
                ) {
                    #runtime::Prescribed::accelerations_prescribed_into(
                        pendulum, set, time, motion, alpha, reactions,
                    );
                }
            }
        })
    }

    /// That of a tree in loops.
    fn prescribed_in_loops(&self) -> TokenStream {
        let (name, runtime, time) = (&self.item.ident, self.runtime(), self.time_name());
        let (constants, other) = (self.prescribed_sets(), super::other_scalar(name));
        let drive = self.drive_at_time();
        let drive_of = self.drive_of(&quote!(pendulum));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
                #constants

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
                    let links = <Self as #runtime::Prescribed<T>>::PRESCRIBED.get(set);
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
                    let links = <Self as #runtime::Prescribed<T>>::PRESCRIBED.get(set);
                    pendulum.tree.evaluate_prescribed(
                        #drive_of, links, motion, [alpha, reactions],
                    );
                }
            }
        }
    }

    /// Accelerations and reactions of a tree in loops, on arrays.
    pub(super) fn prescribed_function(&self, number: usize) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        let time = self.mechanics.drive.is_some().then(|| quote!(time: T,));
        let docs = doc_lines(&self.prescribed_meaning(number));
        let set = &self.scene.prescribed[number];
        let name = format_ident!("accelerations_prescribed_{}", set.name);
        let held = Literal::usize_unsuffixed(set.links.len());
        let number = Literal::usize_unsuffixed(number);
        quote! {
            #docs
            #[must_use]
            pub fn #name(
                &self,
                #time
                theta: &[T; #links],
                omega: &[T; #links],
                torques: &[T; #links],
                prescribed: &[T; #held],
            ) -> ([T; #links], [T; #held]) {
                let (mut alpha, mut reactions) = (
                    [T::from_f64(0.0); #links],
                    [T::from_f64(0.0); #held],
                );
                let mut workspace = #runtime::system::Workspace::new();
                let held = <Self as #runtime::Prescribed<T>>::PRESCRIBED.get(#number);
                let motion = #runtime::system::PrescribedMotion { theta, omega, torques, prescribed };
                self.tree.accelerations_prescribed_with(
                    &mut workspace, #drive, held, motion, [&mut alpha, &mut reactions],
                );
                (alpha, reactions)
            }
        }
    }
}
