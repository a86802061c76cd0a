//! Trees in loops: the model that holds a tree of links.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::ident;
use crate::functions::Purpose;
use crate::program::LoopTree;
use crate::scene::Layout;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// The fields of a model in loops that are no constants of its drive.
const FIELDS: [&str; 3] = ["tree", "bodies", "properties"];

impl Emission<'_> {
    /// The equations and the functions of a model in loops.
    pub(super) fn in_strips(&self, strips: &LoopTree) -> TokenStream {
        let equations = self.link_equations(strips);
        let functions = self.strip_functions();
        let pendulum = self.strip_pendulum();
        let energies = self.scene.requests.energies;
        let energy = energies.then(|| self.strip_energy());
        let positions = self.positions_trait();
        let forced = self.scene.requests.forces.then(|| self.strip_forced());
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
            #forced
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

    /// `Tree<…>`, the model's first field.
    pub(super) fn tree_type(&self) -> TokenStream {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        quote!(#runtime::tree::Tree<#equations, T>)
    }

    /// The fields of the model.
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
        let first = std::iter::once(tree).chain(bodies).chain(properties);
        first.chain(stored).collect()
    }

    fn strip_functions(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let own = match self.scene.layout {
            Layout::Generations { .. } => self.generation_functions(),
            _ => {
                let under = self.scene.requests.forces;
                let under = under.then(|| self.array_function(Purpose::AccelerationsUnder));
                let own = self.array_function(Purpose::Accelerations);
                let sets = 0..self.scene.prescribed.len();
                let prescribed =
                    sets.map(|number| self.array_function(Purpose::Prescribed(number)));
                quote!(#own #under #(#prescribed)*)
            }
        };
        let (energies, drive) = (self.strip_energies(), self.strip_drive());
        let powers = self.strip_powers();
        // Of commas: all tokens stand where the attribute does, see `emit`.
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
            }
        }
    }

    fn generation_functions(&self) -> TokenStream {
        let tree = self.tree_type();
        quote! {
            /// Index of the link at the end of a path from the root: of each
            /// generation the copy, counted from 0. The root's path is empty. `None`
            /// where there is no such link.
            #[must_use]
            pub fn link(path: &[usize]) -> ::core::option::Option<usize> {
                <#tree>::link(path)
            }

            /// Sets how many threads compute where the tree is large enough for
            /// several. Results do not depend on it.
            pub fn set_threads(&mut self, threads: ::core::num::NonZeroUsize) {
                self.tree.set_threads(threads);
            }
        }
    }

    /// `accelerations` on arrays, those under torques from outside, or those of which some
    /// are prescribed, with the reactions.
    fn array_function(&self, purpose: Purpose) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        let time = self.mechanics.drive.is_some().then(|| quote!(time: T,));
        let alone = quote!([T; #links]);
        let (name, docs, given, result, body) = match purpose {
            Purpose::Prescribed(number) => {
                let set = &self.scene.prescribed[number];
                let held = Literal::usize_unsuffixed(set.links.len());
                (
                    format_ident!("accelerations_prescribed_{}", set.name),
                    self.meaning(purpose),
                    quote!(torques: &[T; #links], prescribed: &[T; #held],),
                    quote!(([T; #links], [T; #held])),
                    self.prescribed_body(number),
                )
            }
            Purpose::AccelerationsUnder => (
                ident("accelerations_under"),
                self.meaning(purpose),
                quote!(torques: &[T; #links],),
                alone,
                quote! {
                    let mut workspace = #runtime::system::Workspace::new();
                    let given: [&[T]; 3] = [theta, omega, torques];
                    self.tree.accelerations_under_with(&mut workspace, #drive, given, &mut alpha);
                    alpha
                },
            ),
            _ => (
                ident("accelerations"),
                vec![format!(
                    "Angular accelerations (in rad/s²) at {}angles `theta` (in rad) and angular velocities `omega` (in rad/s), in fused arithmetic where the machine has it. O(links).",
                    self.at_time()
                )],
                quote!(),
                alone,
                quote! {
                    self.tree.accelerations_into(#drive, theta, omega, &mut alpha);
                    alpha
                },
            ),
        };
        let docs = doc_lines(&docs);
        quote! {
            #docs
            #[must_use]
            pub fn #name(
                &self,
                #time
                theta: &[T; #links],
                omega: &[T; #links],
                #given
            ) -> #result {
                let mut alpha = [T::from_f64(0.0); #links];
                #body
            }
        }
    }

    /// What `accelerations_prescribed` of a set does with its arrays.
    fn prescribed_body(&self, number: usize) -> TokenStream {
        let (runtime, drive) = (self.runtime(), self.drive_at_time());
        let held = Literal::usize_unsuffixed(self.scene.prescribed[number].links.len());
        let number = Literal::usize_unsuffixed(number);
        quote! {
            let mut reactions = [T::from_f64(0.0); #held];
            let mut workspace = #runtime::system::Workspace::new();
            let held = #runtime::Prescribed::prescribed_links(self, #number);
            let motion =
                #runtime::system::PrescribedMotion { theta, omega, torques, prescribed };
            self.tree.accelerations_prescribed_with(
                &mut workspace, #drive, held, motion, [&mut alpha, &mut reactions],
            );
            (alpha, reactions)
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

                fn room(&self) -> usize {
                    self.tree.room()
                }

                #[inline(always)]
                fn in_registers<R: #runtime::emitted::Simd<T>>(
                    &self,
                    #time: T,
                    room: &mut [T],
                ) -> impl #runtime::system::InRegisters<R> {
                    self.tree.in_registers(#drive, room)
                }
            }
        }
    }

    /// `impl Model`, with a cast of the tree, of all tables and of each constant that is stored.
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

    /// The fields on another scalar.
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
        let first = std::iter::once(tree).chain(bodies).chain(properties);
        first.chain(stored).collect()
    }
}
