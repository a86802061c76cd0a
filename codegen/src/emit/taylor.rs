//! The function for the Taylor coefficients of the motion: the constants that the runtime's
//! recurrences need, and the other terms of the equation, at the start and as a closure for one
//! order.

use super::Emission;
use super::doc_text::doc_lines;
use super::names::Locals;
use super::taylor_order::Recurrences;
use super::tokens::{Binding, ident};
use crate::exact::Rational;
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, Op, TaylorOutputs, ValueId};
use crate::scene::LinkId;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn taylor_coefficients(&self, entry: &Entry) -> TokenStream {
        let outputs = TaylorOutputs::of(&entry.outputs, self.scene.links.len());
        let recurrences = Recurrences::new(self, entry, &outputs.bias);
        let locals = &recurrences.locals;
        let start = recurrences.start(&outputs);
        let needed = self.program.needed(&start.outputs);
        let gathered = self.gathered(&start, &needed);
        let whole = gathered.whole;
        let read = self.read(&start, &needed, whole.is_some().then_some(&gathered.inputs));
        let inputs = self.inputs_at_start(entry, &read, locals);
        let lines = self.lines(&gathered, &needed, locals);
        let (lines, sines) = match whole == Some(Argument::Theta) && lines.len() == 1 {
            true => sines_alone(),
            false => {
                let lines = lines.into_iter().map(|line| line.tokens);
                (lines.collect(), self.sines_at_start(&outputs, locals))
            }
        };
        let bias_0 = self.taylor_numbers(&outputs.bias, locals);
        let constants = self.link_constants(&outputs, locals);
        let runtime = self.runtime();
        let (links, quads) = (self.links(), self.quads());
        let (rows, bias) = self.bias_by_order(&recurrences);
        let connectivity = self.connectivity(&outputs);
        let docs = self.taylor_docs(entry, &outputs, recurrences.count());
        let name = ident(&entry.name);
        let is_driven = entry.arguments.contains(&Argument::Time);
        let time = is_driven.then(|| quote!(time: T,));
        quote! {
            #docs
            #[inline(always)]
            pub fn #name(
                &self,
                #time
                theta: &[T; #links],
                omega: &[T; #links],
                coefficients: &mut [[[T; #links]; 2]],
                work: &mut [#runtime::emitted::taylor::Quad<T>],
            ) {
                #connectivity
                #(#inputs)*
                #lines
                let start = #runtime::emitted::taylor::Start {
                    theta,
                    omega,
                    #sines,
                    bias: #bias_0,
                };
                let constants = #constants;
                #rows
                #runtime::emitted::taylor::expand::<T, Tree, #links, #quads, _>(
                    &start, &constants, coefficients, work, #bias,
                );
            }
        }
    }

    /// Emits patterns that split arguments into those elements that are read.
    fn inputs_at_start(
        &self,
        entry: &Entry,
        read: &[ValueId],
        locals: &Locals,
    ) -> Vec<TokenStream> {
        // Angles and velocities are also passed on as a whole.
        let arguments = entry.arguments.iter();
        arguments
            .filter(|argument| **argument == Argument::Time || self.reads(**argument, read))
            .map(|&argument| self.destructure(argument, read, locals))
            .collect()
    }

    /// Emits the sines and cosines at the initial state, whose arrays are computed by other lines.
    fn sines_at_start(&self, outputs: &TaylorOutputs, locals: &Locals) -> TokenStream {
        let [sines, cosines] =
            [&outputs.sines, &outputs.cosines].map(|values| self.taylor_numbers(values, locals));
        quote!(sines: #sines, cosines: #cosines)
    }

    /// Emits the rows of factors, the closure for the bias of one order, and the call of `expand`
    /// that receives them.
    fn bias_by_order(&self, recurrences: &Recurrences<'_>) -> (TokenStream, TokenStream) {
        let (runtime, links) = (self.runtime(), self.links());
        match recurrences.is_empty() {
            true => (
                TokenStream::new(),
                quote! {
                    ::core::option::Option::None::<
                        fn(&#runtime::emitted::taylor::KnownOrder<T, #links>) -> [T; #links],
                    >
                },
            ),
            false => {
                let (rows, closure) = (recurrences.rows(), recurrences.closure());
                (
                    quote!(#rows let bias = #closure;),
                    quote!(::core::option::Option::Some(bias)),
                )
            }
        }
    }

    /// Emits `[…]`.
    fn taylor_numbers(&self, values: &[ValueId], locals: &Locals) -> TokenStream {
        let values = values
            .iter()
            .map(|&id| self.bound(id, locals, Binding::Sum));
        quote!([#(#values),*])
    }

    /// Emits `LinkConstants { … }`.
    fn link_constants(&self, outputs: &TaylorOutputs, locals: &Locals) -> TokenStream {
        let list = |values: &[ValueId]| self.taylor_numbers(values, locals);
        let pairs = |[along, lateral]: &[Vec<ValueId>; 2]| {
            let pairs = along.iter().zip(lateral).map(|(&x, &y)| list(&[x, y]));
            quote!([#(#pairs),*])
        };
        let inertias = list(&outputs.inertias);
        let (moments, attachments) = (pairs(&outputs.moments), pairs(&outputs.attachments));
        let [weights, lateral_weights] = outputs.weights.each_ref().map(|values| list(values));
        let runtime = self.runtime();
        quote! {
            #runtime::emitted::taylor::LinkConstants {
                inertias: #inertias,
                moments: #moments,
                attachments: #attachments,
                weights: #weights,
                lateral_weights: #lateral_weights,
            }
        }
    }

    /// Returns the number of groups of four that hold one number per link.
    fn quads(&self) -> Literal {
        Literal::usize_unsuffixed(self.scene.links.len().div_ceil(4))
    }

    /// Emits the type that contains the parent of each link.
    fn connectivity(&self, outputs: &TaylorOutputs) -> TokenStream {
        let (runtime, links) = (self.runtime(), self.links());
        let parents = self.scene.links.iter().map(|link| {
            let LinkId(parent) = link.parent.unwrap_or(LinkId(0));
            Literal::usize_unsuffixed(parent)
        });
        let sides = [&outputs.moments[1], &outputs.attachments[1]];
        let zero = Op::Number(Rational::from(0));
        let lateral = sides.into_iter().flatten().any(|&id| *self.op(id) != zero);
        quote! {
            struct Tree;
            impl #runtime::emitted::taylor::Connectivity<#links> for Tree {
                const PARENTS: [usize; #links] = [#(#parents),*];
                const LATERAL: bool = #lateral;
            }
        }
    }

    fn taylor_docs(&self, entry: &Entry, outputs: &TaylorOutputs, sums: usize) -> TokenStream {
        let mut lines = self.meaning(entry.purpose);
        let start = [&outputs.sines, &outputs.cosines, &outputs.bias];
        let operations = self
            .program
            .operations(&start.into_iter().flatten().copied().collect::<Vec<_>>());
        let mut products = format!("{} products of series", 4 * self.scene.links.len());
        if sums > 0 {
            products += &format!(", and {sums} in functions of the time");
        }
        lines.push(String::new());
        lines.push(format!(
            "Cost of order 0: {operations}, and one elimination along the tree. Each order k: {products}, of k terms each."
        ));
        doc_lines(&lines)
    }

    /// Emits the runtime's trait, on slices of any length.
    pub(super) fn taylor_pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let Some(entry) = self.entry(Purpose::TaylorCoefficients) else {
            unreachable!("the request makes the entry");
        };
        let outputs = TaylorOutputs::of(&entry.outputs, self.scene.links.len());
        let links = self.links();
        let rows = Recurrences::new(self, entry, &outputs.bias).workspace_len();
        let argument = self.mechanics.drive.as_ref().map(|_| quote!(time,));
        let body = self.with_arrays(
            &[vec!["theta", "omega"]],
            quote!({
                let (coefficients, _) = coefficients.as_chunks_mut::<#links>();
                let (coefficients, _) = coefficients.as_chunks_mut::<2>();
                self.taylor_coefficients(#argument theta, omega, coefficients, work)
            }),
            self.unknown(&["coefficients"]),
        );
        let (time, other) = (self.time_name(), super::other_scalar(name));
        quote! {
            impl<T: #runtime::Scalar> #runtime::TaylorPendulum<T> for #name<T> {
                fn taylor_workspace(&self, order: usize) -> usize {
                    #runtime::emitted::taylor::workspace(#links, order) #rows
                }

                #[inline(always)]
                fn taylor_coefficients_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    coefficients: &mut [T],
                    work: &mut [#runtime::emitted::taylor::Quad<T>],
                ) {
                    #body
                }

                #[inline(always)]
                fn taylor_coefficients_of<#other: #runtime::Scalar>(
                    pendulum: &#name<#other>,
                    time: #other,
                    theta: &[#other],
                    omega: &[#other],
                    coefficients: &mut [#other],
                    work: &mut [#runtime::emitted::taylor::Quad<#other>],
                ) {
                    #runtime::TaylorPendulum::taylor_coefficients_into(
                        pendulum, time, theta, omega, coefficients, work,
                    );
                }
            }
        }
    }
}

/// Returns the line that computes all sines and cosines if nothing else is computed at the initial
/// state, and the names of the resulting arrays.
fn sines_alone() -> (TokenStream, TokenStream) {
    (
        quote!(let (sines, cosines) = T::sin_cos_each(theta);),
        quote!(sines, cosines),
    )
}
