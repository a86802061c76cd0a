//! Energies, drive and powers of trees in loops.

use super::Emission;
use super::doc_text::doc_lines;
use crate::functions::Purpose;
use crate::scene::PassiveTorques;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// Emits the energies, from the bodies of the links.
    pub(super) fn strip_energies(&self) -> TokenStream {
        if !self.scene.requests.energies {
            return TokenStream::new();
        }
        let runtime = self.runtime();
        let energy = quote!(#runtime::Energy);
        let frame = match self.frame_note() {
            "" => None,
            note => Some(quote!(#[doc = #note])),
        };
        let (zero, rest) = match self.has_rest_angles() {
            true => (self.zero_of_potential(), " − ρ"),
            false => (self.zero_of_potential(), ""),
        };
        let between = match self.is_coupled_by(|torques| !torques.spring.is_zero()) {
            true => ", and the energy of springs between links that are not parent and child",
            false => "",
        };
        let along = match self.stores_along_lines() {
            true => ", and the energy stored along lines between points",
            false => "",
        };
        let potential = doc_lines(&[format!(
            "Potential energy U (in J) at angles `theta` (in rad), {zero}: Σ m g h + ½ κ (θ − θ_parent{rest})² over the links, h being the height of their centres of mass, κ the stiffness of torsion springs{between}{along}. NaN if the slice does not have one number per link. O(links)."
        )]);
        quote! {
            /// Kinetic energy K (in J) at angles `theta` (in rad) and angular velocities
            /// `omega` (in rad/s): Σ ½ m **V**² + ½ I ω² over the links, **V** being the
            /// velocities of their centres of mass. NaN if a slice does not have one number
            /// per link. O(links).
            #frame
            #[must_use]
            pub fn kinetic_energy(&self, theta: &[T], omega: &[T]) -> T {
                #energy::kinetic_energy_of(self, theta, omega)
            }

            #potential
            #[must_use]
            pub fn potential_energy(&self, theta: &[T]) -> T {
                #energy::potential_energy_of(self, theta)
            }
        }
    }

    /// Emits the drive as functions of time and, if energies are requested, its power and that of
    /// friction.
    pub(super) fn strip_drive(&self) -> TokenStream {
        let entries = [Purpose::Drive, Purpose::RootDrive].map(|purpose| self.entry(purpose));
        let [Some(entry), Some(root)] = entries else {
            return TokenStream::new();
        };
        let (runtime, drive, root_body) =
            (self.runtime(), self.function(entry), self.plain_body(root));
        let root_docs = self.entry_docs(root);
        let drive = quote! {
            #drive

            #root_docs
            #[inline(always)]
            fn root_drive(&self, time: T) -> #runtime::tree::RootDrive<T> {
                let [gravity_x, gravity_y, torque] = { #root_body };
                #runtime::tree::RootDrive {
                    pivot: [gravity_x, gravity_y],
                    torque,
                }
            }
        };
        let power = doc_lines(&[
            "Power (in W) of the drive on the whole tree at `time` (in s), angles `theta` (in rad) and angular velocities `omega` (in rad/s): dE/dt of E = K + U without friction. NaN if a slice does not have one number per link. O(links).".to_owned(),
            String::new(),
            "```text".to_owned(),
            "P = τ ω_root − a_x Σ m V_x − a_y Σ m V_y".to_owned(),
            "```".to_owned(),
            String::new(),
            "with the velocities **V** of the centres of mass in the frame that moves with the pivot.".to_owned(),
        ]);
        let power = self.scene.requests.energies.then(|| {
            let inner = self.inner_drive();
            quote! {
                #power
                #[must_use]
                pub fn drive_power(&self, time: T, theta: &[T], omega: &[T]) -> T {
                    let mut workspace = #runtime::system::Workspace::new();
                    self.bodies.drive_power(&mut workspace, #inner, theta, omega)
                }
            }
        });
        quote! {
            #drive

            #power
        }
    }

    /// Emits the powers of friction and of external torques, if energies are requested and external
    /// forces feed them.
    pub(super) fn strip_powers(&self) -> TokenStream {
        let requests = &self.scene.requests;
        let fed = self.mechanics.drive.is_some() || requests.forces;
        if !(requests.energies && fed) {
            return TokenStream::new();
        }
        let mut torques = self.scene.passive_torques();
        let braked = torques.any(|torques| torques.has_friction() || torques.has_drag());
        let along = self.is_damped_along_lines();
        let braked = braked || along;
        let friction = braked.then(|| {
            let (between, with_between) = match self.is_coupled_by(PassiveTorques::has_friction) {
                true => (
                    Some(quote!(+ self.tree.spring_dampers().power(omega))),
                    " and between links that are not parent and child",
                ),
                false => (None, ""),
            };
            let others = self.other_powers();
            let (angles, lines, with_lines) = match along {
                true => (
                    Some(quote!(theta: &[T],)),
                    Some(quote!(+ self.tree.translational_spring_dampers().power(theta, omega))),
                    " and of dampers along lines at angles `theta` (in rad)",
                ),
                false => (None, None, ""),
            };
            let (laws, meaning) = match self.has_nonlinear_friction() {
                true => (
                    " + D w",
                    " and of torques D = (C/s + q s) w of other friction at the rate w and the speed s = √(w² + ε²)",
                ),
                false => ("", ""),
            };
            let docs = doc_lines(&[format!(
                "Power −Σ (c (ω − ω_parent)² + k ω²{laws}) (in W) of friction c and drag k{meaning} on the whole tree{with_between}{with_lines}, never positive. The rate dE/dt of E = K + U is the sum of this power and {others}. NaN if the slice does not have one number per link. O(links)."
            )]);
            quote! {
                #docs
                #[must_use]
                pub fn friction_power(&self, #angles omega: &[T]) -> T {
                    self.bodies.friction_power(omega) #between #lines
                }
            }
        });
        let outside = requests.forces.then(|| {
            let docs = doc_lines(&self.meaning(Purpose::OutsidePower));
            quote! {
                #docs
                /// NaN if a slice does not have one number per link. O(links).
                #[must_use]
                pub fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
                    self.bodies.outside_power(omega, torques)
                }
            }
        });
        quote! {
            #friction
            #outside
        }
    }

    pub(super) fn strip_energy(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (energy, workspace) = (
            quote!(#runtime::Energy),
            quote!(#runtime::system::Workspace),
        );
        let springs = self.is_coupled_by(|torques| !torques.spring.is_zero());
        let springs = springs.then(|| quote!(+ self.tree.spring_dampers().energy(theta)));
        let lines = self.stores_along_lines();
        let lines = lines.then(|| quote!(+ self.tree.translational_spring_dampers().energy(theta)));
        quote! {
            impl<T: #runtime::Scalar> #energy<T> for #name<T> {
                fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
                    #energy::kinetic_energy_with(self, &mut #workspace::new(), theta, omega)
                }

                fn potential_energy_of(&self, theta: &[T]) -> T {
                    #energy::potential_energy_with(self, &mut #workspace::new(), theta)
                }

                fn kinetic_energy_with(
                    &self,
                    workspace: &mut #workspace<T>,
                    theta: &[T],
                    omega: &[T],
                ) -> T {
                    self.bodies.kinetic_energy(workspace, theta, omega)
                }

                fn potential_energy_with(
                    &self,
                    workspace: &mut #workspace<T>,
                    theta: &[T],
                ) -> T {
                    self.bodies.potential_energy(workspace, theta) #springs #lines
                }
            }
        }
    }
}
