//! Emits the functions of a state of trees in loops, on slices and on arrays, which the runtime's
//! sweep computes.

use super::Emission;
use super::computes::SliceBody;
use super::doc_text::doc_lines;
use super::tokens::ident;
use crate::functions::Purpose;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// Description of an emitted function that takes arrays, for a tree whose code is a loop over its
/// links.
pub(super) struct ArrayFunction {
    pub(super) name: Ident,
    pub(super) docs: Vec<String>,
    /// Arguments after the angular velocities.
    pub(super) given: TokenStream,
    pub(super) result: TokenStream,
    pub(super) body: TokenStream,
}

impl Emission<'_> {
    /// Emits `impl Computes` of each requested function on slices; its results are NaN for slices
    /// of a wrong length.
    pub(super) fn slice_functions_in_loops(&self) -> TokenStream {
        let forced = self.scene.requests.forces;
        let forced = forced.then(|| (Purpose::AccelerationsUnder, self.sweep_under_torques()));
        let prescribed = self.scene.prescribed.first();
        let prescribed =
            prescribed.map(|_| (Purpose::Prescribed(0), self.sweep_with_prescribed_links()));
        let inverse = self.scene.requests.inverse_dynamics;
        let inverse = inverse.then(|| (Purpose::InverseDynamics, self.sweep_of_given_motion()));
        let pullbacks = self.pullbacks_in_loops().into_iter();
        let pullbacks = pullbacks.map(|own| (own.purpose(), self.sweep_pullback(own)));
        let functions = forced.into_iter().chain(prescribed).chain(inverse);
        let functions = functions.chain(pullbacks);
        let functions = functions.filter_map(|(purpose, [plain, with_workspace])| {
            let body = SliceBody {
                coordinates: None,
                plain,
                with_workspace: Some(with_workspace),
            };
            Some(self.computes(purpose, purpose.slices()?, &body))
        });
        functions.collect()
    }

    /// Returns the computation of the accelerations under torques, in the arithmetic of the scalar
    /// and with a workspace.
    fn sweep_under_torques(&self) -> [TokenStream; 2] {
        let drive = self.drive_at_time();
        [
            quote! {
                self.tree.evaluate_under(#drive, [theta, omega, torques], alpha);
            },
            quote! {
                let given: [&[T]; 3] = [theta, omega, torques];
                self.tree.accelerations_under_with(workspace, #drive, given, alpha);
            },
        ]
    }

    /// Returns the computation of the torques that a given motion needs, in the arithmetic of the
    /// scalar and with a workspace.
    fn sweep_of_given_motion(&self) -> [TokenStream; 2] {
        let drive = self.drive_at_time();
        [
            quote! {
                let motion: [&[T]; 3] = [theta, omega, alpha];
                self.tree.evaluate_inverse_dynamics(#drive, motion, ::core::option::Option::None, torques);
            },
            quote! {
                let motion: [&[T]; 3] = [theta, omega, alpha];
                self.tree.inverse_dynamics_with(
                    workspace, #drive, motion, ::core::option::Option::None, torques,
                );
            },
        ]
    }

    /// Returns the computation of the accelerations with prescribed links, in the arithmetic of the
    /// scalar and with a workspace.
    fn sweep_with_prescribed_links(&self) -> [TokenStream; 2] {
        let (runtime, drive) = (self.runtime(), self.drive_at_time());
        let motion = quote! {
            let links = #runtime::Prescribed::prescribed_links(self, set);
            let motion =
                #runtime::system::PrescribedMotion { theta, omega, torques, prescribed };
        };
        [
            quote! {
                #motion
                self.tree.evaluate_prescribed(#drive, links, motion, [alpha, reactions]);
            },
            quote! {
                #motion
                self.tree.accelerations_prescribed_with(
                    workspace, #drive, links, motion, [alpha, reactions],
                );
            },
        ]
    }

    /// Emits the functions on arrays of a tree in a loop over its links.
    pub(super) fn array_functions(&self) -> TokenStream {
        let own = self.free_accelerations();
        let forced = self.scene.requests.forces;
        let forced = forced.then(|| self.accelerations_under_torques());
        let sets = 0..self.scene.prescribed.len();
        let prescribed = sets.map(|number| self.accelerations_of_prescribed(number));
        let inverse = self.scene.requests.inverse_dynamics;
        let inverse = inverse.then(|| self.torques_of_motion());
        let pullbacks = self.pullbacks_in_loops().into_iter();
        let pullbacks = pullbacks.map(|own| self.pullback_on_arrays(own));
        quote!(#own #forced #(#prescribed)* #inverse #(#pullbacks)*)
    }

    /// Emits `accelerations` on arrays.
    fn free_accelerations(&self) -> TokenStream {
        let (links, drive) = (self.links(), self.drive_at_time());
        self.array_function(ArrayFunction {
            name: ident("accelerations"),
            docs: vec![format!(
                "Angular accelerations (in rad/s²) at {}angles `theta` (in rad) and angular velocities `omega` (in rad/s), in fused arithmetic if the machine supports it. O(links).",
                self.at_time()
            )],
            given: quote!(),
            result: self.array_of_links(),
            body: quote! {
                let mut alpha = [T::from_f64(0.0); #links];
                self.tree.accelerations_into(#drive, theta, omega, &mut alpha);
                alpha
            },
        })
    }

    /// Emits `accelerations_under` on arrays.
    fn accelerations_under_torques(&self) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        self.array_function(ArrayFunction {
            name: ident("accelerations_under"),
            docs: self.meaning(Purpose::AccelerationsUnder),
            given: quote!(torques: &[T; #links],),
            result: self.array_of_links(),
            body: quote! {
                let mut alpha = [T::from_f64(0.0); #links];
                let mut workspace = #runtime::system::Workspace::new();
                let given: [&[T]; 3] = [theta, omega, torques];
                self.tree.accelerations_under_with(&mut workspace, #drive, given, &mut alpha);
                alpha
            },
        })
    }

    /// Emits `accelerations_prescribed_…` on arrays, which also returns the reactions.
    fn accelerations_of_prescribed(&self, number: usize) -> TokenStream {
        let (links, set) = (self.links(), &self.scene.prescribed[number]);
        let prescribed = Literal::usize_unsuffixed(set.links.len());
        self.array_function(ArrayFunction {
            name: format_ident!("accelerations_prescribed_{}", set.name),
            docs: self.meaning(Purpose::Prescribed(number)),
            given: quote!(torques: &[T; #links], prescribed: &[T; #prescribed],),
            result: quote!(([T; #links], [T; #prescribed])),
            body: self.prescribed_body(number),
        })
    }

    /// Emits the body of `accelerations_prescribed` for a set.
    fn prescribed_body(&self, number: usize) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        let prescribed = Literal::usize_unsuffixed(self.scene.prescribed[number].links.len());
        let number = Literal::usize_unsuffixed(number);
        quote! {
            let mut alpha = [T::from_f64(0.0); #links];
            let mut reactions = [T::from_f64(0.0); #prescribed];
            let mut workspace = #runtime::system::Workspace::new();
            let links = #runtime::Prescribed::prescribed_links(self, #number);
            let motion =
                #runtime::system::PrescribedMotion { theta, omega, torques, prescribed };
            self.tree.accelerations_prescribed_with(
                &mut workspace, #drive, links, motion, [&mut alpha, &mut reactions],
            );
            (alpha, reactions)
        }
    }

    /// Emits `inverse_dynamics` on arrays.
    fn torques_of_motion(&self) -> TokenStream {
        let (runtime, links, drive) = (self.runtime(), self.links(), self.drive_at_time());
        self.array_function(ArrayFunction {
            name: ident("inverse_dynamics"),
            docs: self.meaning(Purpose::InverseDynamics),
            given: quote!(alpha: &[T; #links],),
            result: self.array_of_links(),
            body: quote! {
                let mut workspace = #runtime::system::Workspace::new();
                let motion: [&[T]; 3] = [theta, omega, alpha];
                let mut torques = [T::from_f64(0.0); #links];
                self.tree.inverse_dynamics_with(
                    &mut workspace, #drive, motion, ::core::option::Option::None, &mut torques,
                );
                torques
            },
        })
    }

    fn array_of_links(&self) -> TokenStream {
        let links = self.links();
        quote!([T; #links])
    }

    /// Emits a function of angles, velocities and other arrays, which returns its results.
    pub(super) fn array_function(&self, function: ArrayFunction) -> TokenStream {
        let links = self.links();
        let time = self.mechanics.drive.is_some().then(|| quote!(time: T,));
        let ArrayFunction {
            name,
            docs,
            given,
            result,
            body,
        } = function;
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
                #body
            }
        }
    }
}
