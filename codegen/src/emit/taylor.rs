//! The function for the Taylor coefficients of the motion: order 0 as in the
//! accelerations, then one turn of a loop for each further order.

use super::Emission;
use super::docs::doc_lines;
use super::function::{Binding, ident};
use super::taylor_order::Recurrences;
use crate::program::{Argument, Entry};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn taylor_coefficients(&self, entry: &Entry) -> TokenStream {
        let needed = self.program.needed(&entry.outputs);
        let recurrences = Recurrences::new(self, entry, &needed);
        let locals = &recurrences.locals;
        let gathered = self.gathered(entry, &needed);
        let whole = gathered.whole;
        let read = self.read(entry, &needed, whole.is_some().then_some(&gathered.inputs));
        let inputs = entry
            .arguments
            .iter()
            .filter(|argument| whole != Some(**argument) || self.reads(**argument, &read))
            .map(|&argument| self.take_apart(argument, &read, locals));
        let lines = self.lines(&gathered, &needed, locals);
        let lines = lines.into_iter().map(|line| line.tokens);
        let accelerations: Vec<TokenStream> = entry.outputs[..self.scene.links.len()]
            .iter()
            .map(|&id| self.bound(id, locals, Binding::Sum))
            .collect();
        let turn = recurrences.turn();
        let k = &recurrences.order;
        let docs = self.taylor_docs(entry, recurrences.count());
        let name = ident(&entry.name);
        let runtime = self.runtime();
        let links = self.links();
        let components = Literal::usize_unsuffixed(2 * self.scene.links.len());
        let lanes = Literal::usize_unsuffixed(recurrences.lanes());
        let time = entry
            .arguments
            .contains(&Argument::Time)
            .then(|| quote!(time: T,));
        quote! {
            #docs
            pub fn #name(
                &self,
                #time
                theta: &[T; #links],
                omega: &[T; #links],
                coefficients: &mut [[T; #components]],
                factors: &mut [[[T; #lanes]; 2]],
            ) {
                #(#inputs)*
                #(#lines)*
                let accelerations = [#(#accelerations),*];
                let orders = #runtime::taylor::begin(
                    coefficients, factors, theta, omega, &accelerations,
                );
                for #k in orders {
                    #turn
                }
            }
        }
    }

    fn taylor_docs(&self, entry: &Entry, sums: usize) -> TokenStream {
        let mut lines = self.meaning(entry.purpose);
        let operations = self.program.operations(&entry.outputs);
        lines.push(String::new());
        lines.push(format!(
            "Cost of order 0: {operations}. Each order k > 0: no sin_cos, two products and two sums in the place of each product of variables, and {sums} sums of k − 1 products, side by side."
        ));
        doc_lines(&lines)
    }

    /// The runtime's trait for it, in slices of any length.
    pub(super) fn taylor_pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let entry = self.program.entry("taylor_coefficients");
        let Some(entry) = entry else {
            unreachable!("the request makes the entry");
        };
        let needed = self.program.needed(&entry.outputs);
        let lanes = Recurrences::new(self, entry, &needed).lanes();
        let (lanes, factors) = (
            Literal::usize_unsuffixed(lanes),
            Literal::usize_unsuffixed(2 * lanes),
        );
        let components = Literal::usize_unsuffixed(2 * self.scene.links.len());
        let time = self.time_name();
        let argument = self.mechanics.drive.as_ref().map(|_| quote!(time,));
        let body = self.with_arrays(
            &["theta", "omega"],
            quote!({
                let (coefficients, _) = coefficients.as_chunks_mut::<#components>();
                let (factors, _) = factors.as_chunks_mut::<#lanes>();
                let (factors, _) = factors.as_chunks_mut::<2>();
                self.taylor_coefficients(#argument theta, omega, coefficients, factors)
            }),
            quote!(coefficients.fill(T::from_f64(f64::NAN))),
        );
        quote! {
            impl<T: #runtime::Scalar> #runtime::TaylorPendulum<T> for #name<T> {
                const FACTORS: usize = #factors;

                fn taylor_coefficients_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    coefficients: &mut [T],
                    factors: &mut [T],
                ) {
                    #body
                }
            }
        }
    }
}
