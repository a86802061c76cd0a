//! Trees in generations: the equations of one link of each kind, and the model
//! that takes them through the tree.

use super::Emission;
use super::columns::Constants as Table;
use super::quantities::Numbers;
use super::tokens::count;
use crate::scene::{Constants, Forces, Generations};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

impl Emission<'_> {
    /// The equations and the functions of a model in generations.
    pub(super) fn generations(&self, generations: &Generations) -> TokenStream {
        let equations = self.generation_equations(generations);
        let functions = self.generation_functions();
        let pendulum = self.generation_pendulum(generations);
        let energy = self
            .scene
            .requests
            .energies
            .then(|| self.loop_energy("generations"));
        quote! {
            #equations
            #functions
            #pendulum
            #energy
        }
    }

    pub(super) fn equations_name(&self) -> Ident {
        format_ident!("{}Equations", self.item.ident)
    }

    pub(super) fn generations_docs(&self, generations: &Generations) -> Vec<String> {
        let Generations {
            branching,
            links,
            constants: _,
        } = generations;
        let count = self.scene.links.len();
        let energies = match self.scene.requests.energies {
            true => "",
            false => " Energies can be asked for with `emit(energies)`.",
        };
        let mut lines = vec![
            format!(
                "A planar tree of {links} rigid links in {count} generations, {branching} under each link but the last ones. Angles are absolute, in radians from the downward vertical; SI units throughout."
            ),
            String::new(),
            "Links stand generation by generation, and in a generation copy by copy: copy c (from 0) under link i of a generation of n links is number c n + i of the next one. `link` finds one by its path.".into(),
            String::new(),
            format!(
                "The code is loops over generations, O(links), in vectors of siblings, and on all cores where there are many. The first evaluation allocates room, later ones nothing.{energies}"
            ),
        ];
        self.drive_lines(&mut lines);
        lines
    }

    /// The numbers of constants, of a leaf's and an inner link's answers, and of
    /// what is kept.
    pub(super) fn recursion_sizes(&self) -> [Literal; 4] {
        let forces = Forces::of(self.scene);
        let torque = usize::from(forces.in_joints());
        [forces.columns().len(), 5 + torque, 5 + torque, 3].map(Literal::usize_unsuffixed)
    }

    /// The type of the model's one field, `generations`.
    pub(super) fn generations_type(&self) -> TokenStream {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let sizes = self.recursion_sizes();
        quote!(#runtime::generations::Generations<#equations, T, #(#sizes),*>)
    }

    /// `Self { … }`, the constants in place: one row a generation.
    pub(super) fn generations_value(&self, constants: &Constants) -> TokenStream {
        let runtime = self.runtime();
        let [motion, motion_value] = self.constant_rows(Table::Motion, &constants.motion);
        let [energy, energy_value] = match self.scene.requests.energies && !self.has_bodies() {
            true => self.constant_rows(Table::Energy, &constants.energy),
            false => [TokenStream::new(), quote!([])],
        };
        let root = self.quantity(&constants.root, Numbers::Scalar);
        let (extra, fields) = self.loop_values(constants.per_lever.as_ref());
        quote! {
            #motion
            #energy
            #extra
            Self {
                generations: #runtime::generations::Generations::new(
                    #motion_value,
                    [T::from_f64(0.0), #root],
                    &#energy_value,
                ),
                #(#fields),*
            }
        }
    }

    fn generation_equations(&self, generations: &Generations) -> TokenStream {
        let copies = self.scene.links.iter().enumerate().map(|(generation, _)| {
            Literal::usize_unsuffixed(if generation == 0 {
                1
            } else {
                generations.branching
            })
        });
        let names = self.scene.links.iter().map(|link| &link.name);
        self.recursion(
            generations.links,
            &quote!(#(#copies),*),
            &quote!(#(#names),*),
        )
    }

    /// The energies of a model in loops, which its field `loops` computes.
    pub(super) fn energies_of(&self, loops: &TokenStream) -> TokenStream {
        if !self.scene.requests.energies {
            return TokenStream::new();
        }
        let frame = match self.frame_note() {
            "" => None,
            note => Some(quote!(#[doc = #note])),
        };
        quote! {
            /// Kinetic energy K (in J) at angles `theta` (in rad) and angular velocities
            /// `omega` (in rad/s): Σ ½ m **V**² + ½ I ω² over the links, **V** being the
            /// velocities of their centres of mass. NaN for slices of another length than
            /// there are links. O(links).
            #frame
            #[must_use]
            pub fn kinetic_energy(&self, theta: &[T], omega: &[T]) -> T {
                self.#loops.kinetic_energy(theta, omega)
            }

            /// Potential energy U (in J) at angles `theta` (in rad), zero where all are
            /// zero: Σ m g h + ½ κ (θ − θ_parent)² over the links, h being the height of
            /// their centres of mass, κ the stiffness of torsion springs. NaN for a slice
            /// of another length than there are links. O(links).
            #[must_use]
            pub fn potential_energy(&self, theta: &[T]) -> T {
                self.#loops.potential_energy(theta)
            }
        }
    }

    fn generation_functions(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let loops = self.generations_type();
        let energies = self.energies_of(&self.energy_field("generations"));
        let (allow, drive) = (self.drive_lint(), self.loop_drive());
        quote! {
            #allow
            impl<T: #runtime::Scalar> #name<T> {
                /// Index of the link at the end of a path from the root: of each
                /// generation the copy, counted from 0. The root's path is empty. `None`
                /// where there is no such link.
                #[must_use]
                pub fn link(path: &[usize]) -> ::core::option::Option<usize> {
                    <#loops>::link(path)
                }

                /// Sets how many threads compute where the tree is large enough for
                /// several. Results do not depend on it.
                pub fn set_threads(&mut self, threads: ::core::num::NonZeroUsize) {
                    self.generations.set_threads(threads);
                }

                #energies
                #drive
            }
        }
    }

    fn generation_pendulum(&self, generations: &Generations) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let links = count(generations.links);
        let loops = self.generations_type();
        let cast = self.loop_cast("generations");
        let (time, body) = (self.time_name(), self.loop_accelerations("generations"));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
                const LINKS: usize = #links;
                const LINK_NAMES: &'static [&'static str] = &[];

                fn link_name(
                    index: usize,
                ) -> ::core::option::Option<#runtime::generations::LinkName> {
                    <#loops>::link_name(index)
                }

                fn accelerations_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    alpha: &mut [T],
                ) {
                    #body
                }
            }

            #cast
        }
    }

    /// The energies of what the model's one field holds.
    pub(super) fn loop_energy(&self, field: &str) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let field = self.energy_field(field);
        quote! {
            impl<T: #runtime::Scalar> #runtime::Energy<T> for #name<T> {
                fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
                    self.#field.kinetic_energy(theta, omega)
                }

                fn potential_energy_of(&self, theta: &[T]) -> T {
                    self.#field.potential_energy(theta)
                }
            }
        }
    }
}
