//! Trees in loops: the equations of one link as an implementation of the runtime's
//! trait, and the model that holds a tree of them.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::{count, ident};
use crate::functions::{Argument, LinkFunction, Purpose};
use crate::program::{Entry, LoopTree, Op};
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
        quote! {
            #equations
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
    fn tree_type(&self) -> TokenStream {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        quote!(#runtime::tree::Tree<#equations, T>)
    }

    /// The fields of the model.
    pub(super) fn strip_fields(&self) -> Vec<TokenStream> {
        let (runtime, tree) = (self.runtime(), self.tree_type());
        let bodies = self.scene.requests.energies;
        let bodies = bodies.then(|| quote!(bodies: #runtime::tree::Bodies<T>));
        let stored = self.stored_constants().into_iter().map(|id| {
            let field = self.field(id);
            quote!(#field: T)
        });
        let tree = quote!(tree: #tree);
        let properties = self.scene.requests.positions;
        let properties = properties.then(|| quote!(properties: #runtime::tree::PropertyTable<T>));
        let first = std::iter::once(tree).chain(bodies).chain(properties);
        first.chain(stored).collect()
    }

    /// The equations of one link: a type without values, and its trait.
    pub(super) fn link_equations(&self, strips: &LoopTree) -> TokenStream {
        let (vis, name, runtime) = (&self.item.vis, self.equations_name(), self.runtime());
        let docs = doc_lines(&self.equations_docs());
        let length = |argument| Literal::usize_unsuffixed(strips.length(argument));
        let [constants, response, sums, elimination, carried] = [
            Argument::Constants,
            Argument::Response,
            Argument::Sums,
            Argument::Elimination,
            Argument::Carried,
        ]
        .map(length);
        let (mut copies, mut names) = (Vec::new(), Vec::new());
        if let Layout::Generations { branching, .. } = self.scene.layout {
            for (generation, link) in self.scene.links.iter().enumerate() {
                let number = if generation == 0 { 1 } else { branching };
                copies.push(Literal::usize_unsuffixed(number));
                names.push(&link.name);
            }
        }
        let (joints, torque) = (strips.has_joint_torques, strips.has_drive_torque);
        let forced = strips.has_outside_torques.then(|| {
            quote!(
                const FORCED: bool = true;
            )
        });
        let held = strips.has_held_links.then(|| {
            quote!(
                const HELD: bool = true;
            )
        });
        let functions = LinkFunction::ALL.into_iter();
        let functions = functions.filter_map(|function| self.link_function(function));
        quote! {
            #docs
            #[derive(
                ::core::clone::Clone,
                ::core::marker::Copy,
                ::core::fmt::Debug,
                ::core::cmp::PartialEq,
            )]
            #vis struct #name;

            // Of commas: all tokens stand where the attribute does, see `emit`.
            #[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
            impl #runtime::tree::LinkEquations for #name {
                type Constants<T: #runtime::Scalar> = [T; #constants];
                type Response<T: #runtime::Scalar> = [T; #response];
                type Sums<T: #runtime::Scalar> = [T; #sums];
                type Elimination<T: #runtime::Scalar> = [T; #elimination];
                type Carried<T: #runtime::Scalar> = [T; #carried];

                const COPIES: &'static [usize] = &[#(#copies),*];
                const NAMES: &'static [&'static str] = &[#(#names),*];
                const JOINTS: bool = #joints;
                const TORQUE: bool = #torque;
                #forced
                #held

                #(#functions)*
            }
        }
    }

    /// A function of the trait.
    fn link_function(&self, function: LinkFunction) -> Option<TokenStream> {
        let result = match function {
            LinkFunction::Leaf => quote!(Self::Response<T>),
            LinkFunction::Attach => quote!(Self::Sums<T>),
            LinkFunction::Inner => quote!((Self::Response<T>, Self::Elimination<T>)),
            LinkFunction::Pivot => quote!([T; 2]),
            LinkFunction::Accelerate => quote!((T, Self::Carried<T>)),
            LinkFunction::AccelerateLeaf => quote!(T),
        };
        self.equation_function(Purpose::Link(function), &result)
    }

    /// A function of a trait of equations, from its entry point.
    pub(super) fn equation_function(
        &self,
        purpose: Purpose,
        result: &TokenStream,
    ) -> Option<TokenStream> {
        let entry = self.entry(purpose)?;
        let (runtime, docs, name) = (self.runtime(), self.entry_docs(entry), ident(&entry.name));
        let body = match self.handed_on(entry) {
            Some(body) => body,
            None => self.plain_body(entry),
        };
        let arguments = entry.arguments.iter().map(|&argument| {
            let name = ident(argument.name());
            let kind = match argument {
                Argument::Constants => quote!(&Self::Constants<T>),
                Argument::Motion => quote!(#runtime::tree::LinkMotion<T>),
                Argument::Response => quote!(Self::Response<T>),
                Argument::Sums => quote!(Self::Sums<T>),
                Argument::Elimination => quote!(Self::Elimination<T>),
                Argument::Carried => quote!(Self::Carried<T>),
                Argument::Given(function) => {
                    let given = Literal::usize_unsuffixed(function.given().len());
                    quote!([T; #given])
                }
                _ => quote!([T; 2]),
            };
            quote!(#name: #kind)
        });
        Some(quote! {
            #docs
            #[inline(always)]
            fn #name<T: #runtime::Scalar>(#(#arguments),*) -> #result {
                #body
            }
        })
    }

    /// The body of a function that returns its last argument as it is.
    fn handed_on(&self, entry: &Entry) -> Option<TokenStream> {
        let (&last, others) = entry.arguments.split_last()?;
        let mut outputs = (0..).zip(&entry.outputs);
        let same = outputs.all(|(index, &id)| *self.op(id) == Op::Input(last, index));
        let names = others
            .iter()
            .map(|argument| format_ident!("{}", argument.name()));
        let last = format_ident!("{}", last.name());
        same.then(|| quote!(#(let _ = #names;)* #last))
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
                let prescribed = sets.map(|number| self.prescribed_function(number));
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

    /// `accelerations` on arrays, or those under torques from outside.
    fn array_function(&self, purpose: Purpose) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        let time = self.mechanics.drive.is_some().then(|| quote!(time: T,));
        let (name, docs, torques, call) = match purpose {
            Purpose::AccelerationsUnder => (
                quote!(accelerations_under),
                self.meaning(purpose),
                Some(quote!(torques: &[T; #links],)),
                quote! {
                    let mut workspace = #runtime::system::Workspace::new();
                    let given: [&[T]; 3] = [theta, omega, torques];
                    self.tree.accelerations_under_with(&mut workspace, #drive, given, &mut alpha);
                },
            ),
            _ => (
                quote!(accelerations),
                vec![format!(
                    "Angular accelerations (in rad/s²) at {}angles `theta` (in rad) and angular velocities `omega` (in rad/s), in fused arithmetic where the machine has it. O(links).",
                    self.at_time()
                )],
                None,
                quote!(self.tree.accelerations_into(#drive, theta, omega, &mut alpha);),
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
                #torques
            ) -> [T; #links] {
                let mut alpha = [T::from_f64(0.0); #links];
                #call
                alpha
            }
        }
    }

    fn strip_pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (time, drive) = (self.time_name(), self.drive_at_time());
        let (links, names, by_path) = match self.scene.layout {
            Layout::Generations { links, .. } => {
                let tree = self.tree_type();
                let by_path = quote! {
                    fn link_name(
                        index: usize,
                    ) -> ::core::option::Option<#runtime::tree::LinkName> {
                        <#tree>::link_name(index)
                    }
                };
                (links, Vec::new(), Some(by_path))
            }
            _ => {
                let names = self.scene.links.iter().map(|link| &link.name);
                (self.scene.links.len(), names.collect(), None)
            }
        };
        let links = count(links);
        let (fields, other) = (self.cast_fields(), super::other_scalar(name));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
                const LINKS: usize = #links;
                const LINK_NAMES: &'static [&'static str] = &[#(#names),*];

                #by_path

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
            }

            impl<T: #runtime::Scalar> #runtime::Cast<T> for #name<T> {
                type Of<#other: #runtime::Scalar> = #name<#other>;

                fn cast<#other: #runtime::Scalar>(
                    &self,
                    convert: impl ::core::ops::Fn(T) -> #other,
                ) -> #name<#other> {
                    #name { #(#fields),* }
                }

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
