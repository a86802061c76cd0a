//! The function for the Taylor coefficients of the motion: the constants that the
//! recurrences of the runtime ask for, and what is not among these, at the start
//! and as a closure for one order.

use super::Emission;
use super::doc_text::doc_lines;
use super::taylor_order::Recurrences;
use super::tokens::{Binding, ident};
use crate::exact::Rational;
use crate::program::{Argument, Entry, Expansion, Op, ValueId};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn taylor_coefficients(&self, entry: &Entry) -> TokenStream {
        let expansion = Expansion::of_outputs(&entry.outputs, &self.mechanics.absolute);
        let recurrences = Recurrences::new(self, entry, &expansion.bias);
        let locals = &recurrences.locals;
        let start = recurrences.start(&expansion);
        let needed = self.program.needed(&start.outputs);
        let gathered = self.gathered(&start, &needed);
        let whole = gathered.whole;
        let read = self.read(&start, &needed, whole.is_some().then_some(&gathered.inputs));
        // Angles and velocities are handed on besides.
        let inputs = entry
            .arguments
            .iter()
            .filter(|argument| **argument == Argument::Time || self.reads(**argument, &read))
            .map(|&argument| self.take_apart(argument, &read, locals));
        let lines = self.lines(&gathered, &needed, locals);
        let sines_alone = whole == Some(Argument::Theta) && lines.len() == 1;
        let list = |values: &[ValueId]| {
            let values = values
                .iter()
                .map(|&id| self.bound(id, locals, Binding::Sum));
            quote!([#(#values),*])
        };
        let (lines, sines) = match sines_alone {
            true => (
                quote!(let (sines, cosines) = T::sin_cos_each(theta);),
                quote!(sines, cosines),
            ),
            false => {
                let lines = lines.into_iter().map(|line| line.tokens);
                let (sines, cosines) = (list(&expansion.sines), list(&expansion.cosines));
                (lines.collect(), quote!(sines: #sines, cosines: #cosines))
            }
        };
        let bias_0 = list(&expansion.bias);
        let (inertias, weights) = (list(&expansion.inertias), list(&expansion.weights));
        let lateral_weights = list(&expansion.lateral_weights);
        let runtime = self.runtime();
        let couplings = expansion.couplings.iter().map(|(links, [cosine, sine])| {
            let [row, column] = links.map(Literal::usize_unsuffixed);
            let cosine = self.bound(*cosine, locals, Binding::Sum);
            let sine = if *self.op(*sine) == Op::Number(Rational::from(0)) {
                quote!(::core::option::Option::None)
            } else {
                let sine = self.bound(*sine, locals, Binding::Sum);
                quote!(::core::option::Option::Some(#sine))
            };
            quote! {
                #runtime::emitted::taylor::Coupling { links: [#row, #column], cosine: #cosine, sine: #sine }
            }
        });
        let (links, quads) = (self.links(), self.quads());
        let (rows, bias) = match recurrences.is_empty() {
            true => (
                TokenStream::new(),
                quote! {
                    ::core::option::Option::None::<
                        fn(&#runtime::emitted::taylor::Known<T, #links>) -> [T; #links],
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
        };
        let docs = self.taylor_docs(entry, &expansion, recurrences.count());
        let name = ident(&entry.name);
        let time = entry
            .arguments
            .contains(&Argument::Time)
            .then(|| quote!(time: T,));
        quote! {
            #docs
            #[inline(always)]
            pub fn #name(
                &self,
                #time
                theta: &[T; #links],
                omega: &[T; #links],
                coefficients: &mut [[[T; #links]; 2]],
                work: &mut [#runtime::taylor::Quad<T>],
            ) {
                #(#inputs)*
                #lines
                let start = #runtime::emitted::taylor::Start {
                    theta,
                    omega,
                    #sines,
                    bias: #bias_0,
                };
                let tree = #runtime::emitted::taylor::Tree {
                    inertias: #inertias,
                    couplings: &[#(#couplings),*],
                    weights: #weights,
                    lateral_weights: #lateral_weights,
                };
                #rows
                #runtime::emitted::taylor::expand::<T, #links, #quads, _>(
                    &start, &tree, coefficients, work, #bias,
                );
            }
        }
    }

    /// Groups of four that hold a number of each link.
    fn quads(&self) -> Literal {
        Literal::usize_unsuffixed(self.scene.links.len().div_ceil(4))
    }

    fn taylor_docs(&self, entry: &Entry, expansion: &Expansion, sums: usize) -> TokenStream {
        let mut lines = self.meaning(entry.purpose);
        let start = [&expansion.sines, &expansion.cosines, &expansion.bias];
        let operations = self
            .program
            .operations(&start.into_iter().flatten().copied().collect::<Vec<_>>());
        let mut products = format!("{} products of series", 4 * self.scene.links.len());
        if sums > 0 {
            products += &format!(", and {sums} in functions of the time");
        }
        lines.push(String::new());
        lines.push(format!(
            "Cost of order 0: {operations}, and the inverse of the mass matrix. Each order k: {products}, of k terms each."
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
        let expansion = Expansion::of_outputs(&entry.outputs, &self.mechanics.absolute);
        let links = self.links();
        let rows = Recurrences::new(self, entry, &expansion.bias).room();
        let time = self.time_name();
        let argument = self.mechanics.drive.as_ref().map(|_| quote!(time,));
        let body = self.with_arrays(
            &["theta", "omega"],
            quote!({
                let (coefficients, _) = coefficients.as_chunks_mut::<#links>();
                let (coefficients, _) = coefficients.as_chunks_mut::<2>();
                self.taylor_coefficients(#argument theta, omega, coefficients, work)
            }),
            quote!(coefficients.fill(T::from_f64(f64::NAN))),
        );
        quote! {
            impl<T: #runtime::Scalar> #runtime::TaylorPendulum<T> for #name<T> {
                #[inline(always)]
                fn taylor_coefficients_of<S: #runtime::Scalar>(
                    pendulum: &#name<S>,
                    time: S,
                    theta: &[S],
                    omega: &[S],
                    coefficients: &mut [S],
                    work: &mut [#runtime::taylor::Quad<S>],
                ) {
                    pendulum.taylor_coefficients_into(time, theta, omega, coefficients, work);
                }

                fn taylor_workspace(order: usize) -> usize {
                    #runtime::emitted::taylor::workspace(#links, order) #rows
                }

                #[inline(always)]
                fn taylor_coefficients_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    coefficients: &mut [T],
                    work: &mut [#runtime::taylor::Quad<T>],
                ) {
                    #body
                }
            }
        }
    }
}
