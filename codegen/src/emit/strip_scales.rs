//! Energies by scale (generation of the branching) of trees in loops: the functions of one link,
//! and the trait of the model.

use super::Emission;
use crate::functions::{Purpose, ScaleFunction};
use crate::mechanics::expression::NamedFormula;
use crate::scene::{Layout, PassiveTorques};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Emits `impl ScaleEquations` and `impl Scales`, if energies by scale are requested.
    pub(super) fn strip_scales(&self) -> TokenStream {
        let (equations, model) = (self.scale_equations(), self.scales_of_model());
        quote!(#equations #model)
    }

    /// Returns the number of copies in each generation under each link of the one before, if
    /// energies by scale are requested.
    fn scale_copies(&self) -> Option<Vec<usize>> {
        let Layout::Generations { branching, .. } = self.scene.layout else {
            return None;
        };
        let generations = 0..self.scene.links.len();
        let copies = generations.map(|generation| if generation == 0 { 1 } else { branching });
        (self.scene.requests.scales()).then(|| copies.collect())
    }

    /// Emits `impl ScaleEquations`.
    pub(super) fn scale_equations(&self) -> Option<TokenStream> {
        self.scale_copies()?;
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let functions = ScaleFunction::ALL.into_iter().filter_map(|function| {
            let results = Literal::usize_unsuffixed(function.results());
            self.equation_function(Purpose::Scale(function), &quote!([T; #results]))
        });
        let any = |force: fn(&PassiveTorques) -> bool| self.scene.passive_torques().any(force);
        let springs = any(|torques| !torques.spring.is_zero());
        let friction = any(PassiveTorques::has_friction);
        let drag = any(PassiveTorques::has_drag);
        let moved = self.has_moving_pivot();
        Some(quote! {
            // For the lint about commas: all tokens have the span of the attribute, see `emit`.
            #[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
            impl #runtime::tree::ScaleEquations for #equations {
                const SPRINGS: bool = #springs;
                const FRICTION: bool = #friction;
                const DRAG: bool = #drag;
                const DRIVEN: bool = #moved;

                #(#functions)*
            }
        })
    }

    /// Emits `impl Scales` of the model.
    fn scales_of_model(&self) -> Option<TokenStream> {
        let copies = self.scale_copies()?.into_iter();
        let copies = copies.map(Literal::usize_unsuffixed);
        let (runtime, name) = (self.runtime(), &self.item.ident);
        let budgets = self.budgets_by_scale();
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Scales<T> for #name<T> {
                const COPIES: &'static [usize] = &[#(#copies),*];

                fn energies_by_scale(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    theta: &[T],
                    omega: &[T],
                    budget: &mut #runtime::ScaleBudget<T>,
                ) {
                    self.tree.energies_by_scale(workspace, theta, omega, budget);
                }

                fn energies_by_sector(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    theta: &[T],
                    omega: &[T],
                    energies: &mut [T],
                ) {
                    self.tree.energies_by_sector(workspace, theta, omega, energies);
                }

                #budgets
            }
        })
    }

    /// Emits the functions of the energies by scale and their rates, without and with external
    /// torques.
    fn budgets_by_scale(&self) -> TokenStream {
        let (runtime, time) = (self.runtime(), self.time_name());
        let drive = match self.mechanics.drive {
            Some(_) => {
                let drive = self.inner_drive();
                quote!(::core::option::Option::Some(#drive))
            }
            None => quote!(::core::option::Option::None),
        };
        quote! {
            fn budget_by_scale(
                &self,
                workspace: &mut #runtime::system::Workspace<T>,
                #time: T,
                theta: &[T],
                omega: &[T],
                budget: &mut #runtime::ScaleBudget<T>,
            ) {
                let given = [theta, omega, &[]];
                self.tree.budget_by_scale(workspace, #drive, given, budget);
            }

            fn budget_by_scale_under(
                &self,
                workspace: &mut #runtime::system::Workspace<T>,
                #time: T,
                theta: &[T],
                omega: &[T],
                torques: &[T],
                budget: &mut #runtime::ScaleBudget<T>,
            ) {
                let given = [theta, omega, torques];
                self.tree.budget_by_scale_under(workspace, #drive, given, budget);
            }
        }
    }

    /// Returns the formulas of a function of one link.
    pub(super) fn scale_formulas(&self, function: ScaleFunction) -> Vec<NamedFormula> {
        let mechanics = self.mechanics;
        let (Some(scales), Some(forces), Some(body)) =
            (&mechanics.scales, &mechanics.joint_forces, &mechanics.body)
        else {
            return Vec::new();
        };
        let named = match function {
            ScaleFunction::Torques => 0..4,
            ScaleFunction::Velocity => 4..8,
            ScaleFunction::Moment => 8..12,
            ScaleFunction::Energy => 12..13,
            ScaleFunction::Eliminate => 13..14,
            ScaleFunction::Flow => 14..18,
            ScaleFunction::Slope => 18..19,
            ScaleFunction::Inertial => 19..20,
            ScaleFunction::Factor => 0..0,
        };
        let formulas = scales.formulas(forces, body).into_iter();
        formulas.skip(named.start).take(named.len()).collect()
    }
}
