//! Derivatives in reverse mode of the accelerations of trees in loops.

use super::Emission;
use super::strip_slices::ArrayFunction;
use super::tokens::ident;
use crate::functions::{Naming, Purpose};
use crate::program::{ConstantId, LoopTree, PowerConstants, passive_link_columns};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

/// A pullback of the accelerations: without torques from outside, or with them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LoopPullback {
    Free,
    UnderTorques,
}

impl LoopPullback {
    pub(super) fn purpose(self) -> Purpose {
        match self {
            Self::Free => Purpose::AccelerationsPullback,
            Self::UnderTorques => Purpose::AccelerationsUnderPullback,
        }
    }
}

impl Emission<'_> {
    /// Returns the requested pullbacks.
    pub(super) fn pullbacks_in_loops(&self) -> Vec<LoopPullback> {
        match (self.power_constants(), self.scene.requests.forces) {
            (None, _) => Vec::new(),
            (Some(_), false) => vec![LoopPullback::Free],
            (Some(_), true) => vec![LoopPullback::Free, LoopPullback::UnderTorques],
        }
    }

    fn power_constants(&self) -> Option<&PowerConstants> {
        self.program.strips.as_ref()?.power.as_ref()
    }

    /// Returns the type of the model's field that has the derivatives.
    pub(super) fn pullback_type(&self) -> Option<TokenStream> {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let power = self.power_constants();
        power.map(|_| quote!(#runtime::tree::PullbackTree<#equations, T>))
    }

    /// Emits the tables of constants and of the places of derivatives, and the value of the model's
    /// field, which reads a local `tree`.
    pub(super) fn pullback_values(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<(TokenStream, TokenStream)> {
        let power = strips.power.as_ref()?;
        let (runtime, shape) = (self.runtime(), self.shape());
        let rows = power.rows.iter().map(Vec::as_slice).collect();
        let columns = passive_link_columns();
        let [table, rows] = self.table("passive_links", "derivatives", &columns, rows, known);
        let (laws, gravity) = (power.laws, self.known_value(power.gravity, known));
        let torques = strips.columns.iter().enumerate();
        let torques = torques.filter(|(_, column)| column.is_passive_torque());
        let torques = torques.map(|(index, _)| Literal::usize_unsuffixed(index));
        let (places, with_slopes) = self.slopes(power, known).unzip();
        let value = quote! {
            #runtime::tree::PullbackTree::new(
                &tree,
                &[#(#torques),*],
                #runtime::tree::VirtualPower::new(
                    #shape,
                    #gravity,
                    #runtime::tree::PassiveLink::of_rows(&#rows, [#(#laws),*]),
                ) #with_slopes,
            )
        };
        Some((quote!(#table #places), value))
    }

    /// Emits the places of the derivatives of constants by parameters, and the call that adds these
    /// derivatives to the virtual power; `None` without parameters.
    fn slopes(
        &self,
        power: &PowerConstants,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<(TokenStream, TokenStream)> {
        let parameters = self.scene.parameters.len();
        if parameters == 0 {
            return None;
        }
        let (runtime, parameters) = (self.runtime(), Literal::usize_unsuffixed(parameters));
        let count = Literal::usize_unsuffixed(power.slopes.len());
        let places = power.slopes.iter().map(|own| {
            let numbers = own.place.map(Literal::usize_unsuffixed);
            quote!([#(#numbers),*])
        });
        let slopes = power.slopes.iter();
        let slopes = slopes.map(|own| self.known_value(own.slope, known));
        let table = quote! {
            /// Places of the derivatives of constants by parameters: index of the group, of the
            /// constant in it, and of the parameter. The groups are gravity, the rows of
            /// `PASSIVE_LINKS`, then springs and friction between links, then lines.
            static SLOPES: [[usize; 3]; #count] = [#(#places),*];
        };
        let with_slopes = quote! {
            .with_slopes(#runtime::tree::ParameterSlopes::new(#parameters, &SLOPES, &[#(#slopes),*]))
        };
        Some((table, with_slopes))
    }

    /// Returns the computation of a pullback, in the arithmetic of the scalar and with a workspace.
    pub(super) fn sweep_pullback(&self, pullback: LoopPullback) -> [TokenStream; 2] {
        let runtime = self.runtime();
        let option = quote!(::core::option::Option);
        let [torques, torques_adjoint] = match pullback {
            LoopPullback::Free => [quote!(#option::None), quote!(#option::None)],
            LoopPullback::UnderTorques => [
                quote!(#option::Some(torques)),
                quote!(#option::Some(&mut **torques_adjoint)),
            ],
        };
        let drive = self.pivot_drive();
        let calls = [
            quote!(evaluate_pullback(&self.tree, #drive, state, slopes)),
            quote!(pullback_with(&self.tree, workspace, #drive, state, slopes)),
        ];
        calls.map(|call| {
            let rest = self.with_drive_pullback(&quote!(self.pullback.#call));
            quote! {
                let state =
                    #runtime::tree::WeightedState { theta, omega, torques: #torques, weights };
                let slopes = #runtime::tree::StateSlopes {
                    theta: theta_adjoint,
                    omega: omega_adjoint,
                    torques: #torques_adjoint,
                    parameters: &mut **parameters_adjoint,
                };
                #rest
            }
        })
    }

    /// Returns the drive with the acceleration of the root's pivot along the axes of the equations.
    fn pivot_drive(&self) -> TokenStream {
        let runtime = self.runtime();
        match self.mechanics.drive {
            Some(_) => {
                let inner = self.inner_drive();
                quote!({
                    let [x, y, _] = #inner;
                    let root = self.root_drive(time);
                    ::core::option::Option::Some(#runtime::tree::PivotDrive { root, pivot: [x, y] })
                })
            }
            None => quote!(::core::option::Option::None),
        }
    }

    /// Emits the call of a pullback. If the drive depends on parameters, adds the derivatives through
    /// it.
    fn with_drive_pullback(&self, call: &TokenStream) -> TokenStream {
        if self.entry(Purpose::DrivePullback).is_none() {
            return quote!(#call;);
        }
        let y = match self.scene.stands() {
            true => quote!(-y),
            false => quote!(y),
        };
        quote! {
            let [x, y, torque] = #call;
            let by_drive = self.drive_pullback(time, [x, #y, torque]);
            for (slope, more) in
                ::core::iter::Iterator::zip(parameters_adjoint.iter_mut(), by_drive)
            {
                *slope = *slope + more;
            }
        }
    }

    /// Emits the derivatives of the drive by the parameters, if it depends on some.
    pub(super) fn drive_pullback(&self) -> Option<TokenStream> {
        let entry = self.entry(Purpose::DrivePullback)?;
        let (docs, body) = (self.entry_docs(entry), self.plain_body(entry));
        let count = Literal::usize_unsuffixed(entry.outputs.len());
        Some(quote! {
            #docs
            fn drive_pullback(&self, time: T, given: [T; 3]) -> [T; #count] {
                #body
            }
        })
    }

    /// Emits a pullback on arrays.
    pub(super) fn pullback_on_arrays(&self, pullback: LoopPullback) -> TokenStream {
        let (runtime, links, purpose) = (self.runtime(), self.links(), pullback.purpose());
        let Some(function) = purpose.slices() else {
            return TokenStream::new();
        };
        let marker = ident(function.name);
        let (given_torques, torques) = match pullback {
            LoopPullback::Free => (None, None),
            LoopPullback::UnderTorques => {
                (Some(quote!(torques: &[T; #links],)), Some(quote!(torques,)))
            }
        };
        let time = match self.mechanics.drive {
            Some(_) => quote!(time),
            None => quote!(T::from_f64(0.0)),
        };
        let names: Vec<Ident> = function.results.iter().map(|name| ident(name)).collect();
        // There is one result for each array, the last by the parameters.
        let parameters = Literal::usize_unsuffixed(self.scene.parameters.len());
        let mut lengths = vec![links.clone(); names.len()];
        if let Some(last) = lengths.last_mut() {
            *last = parameters;
        }
        let given = Literal::usize_unsuffixed(names.len());
        self.array_function(ArrayFunction {
            name: ident(
                &Naming::of(self.scene, self.mechanics)
                    .signature(purpose)
                    .name,
            ),
            docs: self.meaning(purpose),
            given: quote!(#given_torques weights: &[T; #links],),
            result: quote!((#([T; #lengths]),*)),
            body: quote! {
                #(let mut #names = [T::from_f64(0.0); #lengths];)*
                let given: [&[T]; #given] = [theta, omega, #torques weights];
                #runtime::system::Computes::<#runtime::system::functions::#marker, T>::compute_with(
                    self,
                    &mut #runtime::system::Workspace::new(),
                    #runtime::system::At::time(#time),
                    &given,
                    &mut [#(&mut #names),*],
                );
                (#(#names),*)
            },
        })
    }
}
