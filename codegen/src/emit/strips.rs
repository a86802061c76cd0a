//! Trees in loops: the model, which contains a tree of links.

use super::Emission;
use crate::program::LoopTree;
use crate::scene::Layout;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

/// Fields of a model in loops that are not constants of its drive.
const FIELDS: [&str; 4] = ["tree", "pullback", "bodies", "properties"];

impl Emission<'_> {
    /// Emits the equations and the functions of a model in loops.
    pub(super) fn in_strips(&self, strips: &LoopTree) -> TokenStream {
        let equations = self.link_equations(strips);
        let functions = self.strip_functions();
        let pendulum = self.strip_pendulum();
        let energies = self.scene.requests.energies;
        let energy = energies.then(|| self.strip_energy());
        let positions = self.positions_trait();
        let functions_on_slices = self.slice_functions_in_loops();
        let prescribed = self.prescribed_trait();
        let scales = self.strip_scales();
        let bodies = self.body_equations();
        quote! {
            #equations
            #bodies
            #functions
            #pendulum
            #energy
            #positions
            #functions_on_slices
            #prescribed
            #scales
        }
    }

    /// Returns true if a field of the model in loops has this name.
    pub(super) fn is_loop_field(&self, name: &str) -> bool {
        self.scene.in_loops() && FIELDS.contains(&name)
    }

    pub(super) fn equations_name(&self) -> Ident {
        format_ident!("{}Equations", self.item.ident)
    }

    /// Returns `Tree<…>`, the type of the model's first field.
    pub(super) fn tree_type(&self) -> TokenStream {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        quote!(#runtime::tree::Tree<#equations, T>)
    }

    /// Emits the fields of the model.
    pub(super) fn strip_fields(&self) -> Vec<TokenStream> {
        let (runtime, tree, equations) = (self.runtime(), self.tree_type(), self.equations_name());
        let bodies = self.scene.requests.energies;
        let bodies = bodies.then(|| quote!(bodies: #runtime::tree::Bodies<#equations, T>));
        let stored = self.stored_constants().into_iter().map(|id| {
            let field = self.field(id);
            quote!(#field: T)
        });
        let tree = quote!(tree: #tree);
        let properties = self.scene.requests.positions;
        let properties =
            properties.then(|| quote!(properties: #runtime::tree::PropertyTable<#equations, T>));
        let pullback = self.pullback_type().map(|own| quote!(pullback: #own));
        let first = std::iter::once(tree).chain(pullback);
        let tables = bodies.into_iter().chain(properties);
        first.chain(tables).chain(stored).collect()
    }

    fn strip_functions(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let own = match self.scene.layout {
            Layout::Generations { .. } => self.generation_functions(),
            Layout::Unrolled | Layout::Links => self.array_functions(),
        };
        let (energies, drive) = (self.strip_energies(), self.strip_drive());
        let powers = self.strip_powers();
        let drive_pullback = self.drive_pullback();
        // For the lint about commas: all tokens have the span of the attribute, see `emit`.
        let allow = self.mechanics.drive.is_some();
        let allow = allow.then(|| quote!(#[allow(clippy::possible_missing_comma)]));
        quote! {
            #allow
            #[allow(dead_code)]
            impl<T: #runtime::Scalar> #name<T> {
                #own

                #energies
                #drive
                #powers
                #drive_pullback
            }
        }
    }

    fn generation_functions(&self) -> TokenStream {
        let tree = self.tree_type();
        let pullback = self.pullback_type();
        let pullback = pullback.map(|_| quote!(self.pullback.set_threads(threads);));
        quote! {
            /// Returns the index of the link at the end of a path from the root,
            /// which has the number of a copy (from 0) for each generation. The
            /// root's path is empty. `None` if there is no such link.
            #[must_use]
            pub fn link(path: &[usize]) -> ::core::option::Option<usize> {
                <#tree>::link(path)
            }

            /// Sets the number of threads that compute the tree, if it is large
            /// enough for several. Results do not depend on it.
            pub fn set_threads(&mut self, threads: ::core::num::NonZeroUsize) {
                self.tree.set_threads(threads);
                #pullback
            }
        }
    }

    fn strip_pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (time, drive) = (self.time_name(), self.drive_at_time());
        let model = self.model_of_tables();
        quote! {
            #model

            impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
                #[inline(always)]
                fn evaluate(
                    &self,
                    #time: T,
                    theta: impl ::core::ops::Fn(usize) -> T,
                    omega: impl ::core::ops::Fn(usize) -> T,
                    alpha: impl ::core::ops::FnMut(usize, T),
                ) {
                    self.tree.evaluate(#drive, theta, omega, alpha);
                }

                #[inline(always)]
                fn evaluate_with(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    #time: T,
                    given: [&[T]; 2],
                    alpha: &mut [T],
                ) {
                    let [theta, omega] = given;
                    let torques = ::core::option::Option::None;
                    let states = #runtime::tree::LinkStates { theta, omega, torques };
                    self.tree.evaluate_apart(workspace, #drive, states, alpha);
                }

                fn accelerations_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    alpha: &mut [T],
                ) {
                    self.tree.accelerations_into(#drive, theta, omega, alpha);
                }

                fn accelerations_with(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    alpha: &mut [T],
                ) {
                    self.tree.accelerations_with(workspace, #drive, theta, omega, alpha);
                }

                fn workspace_len(&self) -> usize {
                    self.tree.workspace_len()
                }

                #[inline(always)]
                fn in_registers<R: #runtime::emitted::Simd<T>>(
                    &self,
                    #time: T,
                    buffer: &mut [T],
                ) -> impl #runtime::system::InRegisters<R> {
                    self.tree.in_registers(#drive, buffer)
                }
            }
        }
    }

    /// Emits `impl Model`, with the conversion of the tree, of all tables and of each stored
    /// constant to another scalar.
    fn model_of_tables(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (fields, other) = (self.cast_fields(), super::other_scalar(name));
        self.model_trait(&quote! {
            fn cast<#other: #runtime::Scalar>(
                &self,
                convert: impl ::core::ops::Fn(T) -> #other,
            ) -> #name<#other> {
                #name { #(#fields),* }
            }
        })
    }

    /// Emits the fields, converted to another scalar.
    fn cast_fields(&self) -> Vec<TokenStream> {
        let stored = self.stored_constants().into_iter();
        let stored = stored.map(|id| {
            let field = self.field(id);
            quote!(#field: convert(self.#field))
        });
        let bodies = self.scene.requests.energies;
        let bodies = bodies.then(|| quote!(bodies: self.bodies.cast(&convert)));
        let properties = self.scene.requests.positions;
        let properties = properties.then(|| quote!(properties: self.properties.cast(&convert)));
        let tree = quote!(tree: self.tree.cast(&convert));
        let pullback = self.pullback_type();
        let pullback = pullback.map(|_| quote!(pullback: self.pullback.cast(&convert)));
        let first = std::iter::once(tree).chain(pullback);
        let tables = bodies.into_iter().chain(properties);
        first.chain(tables).chain(stored).collect()
    }
}
