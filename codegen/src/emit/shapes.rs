//! Types in which functions return their outputs.

use super::Emission;
use crate::functions::{Argument, ResultShape};
use crate::program::Entry;
use proc_macro2::TokenStream;
use quote::quote;

/// Returns the type of an argument, with its length if it is an array.
pub(super) fn argument_type(argument: Argument, length: &TokenStream) -> TokenStream {
    match argument {
        Argument::Time => quote!(T),
        Argument::Forces => quote!(&[[T; 2]; #length]),
        Argument::Theta
        | Argument::Omega
        | Argument::AbsoluteMomenta
        | Argument::Coordinates
        | Argument::Rates
        | Argument::Momenta
        | Argument::Alpha
        | Argument::Weights
        | Argument::Actions
        | Argument::Difference(_)
        | Argument::DifferenceRate(_)
        | Argument::SmallDifferences
        | Argument::SmallRates
        | Argument::Torques
        | Argument::SmallTorques
        | Argument::Prescribed(_)
        | Argument::Absolute
        | Argument::Symmetric
        | Argument::Constants
        | Argument::Body
        | Argument::Motion
        | Argument::Response
        | Argument::Sums
        | Argument::Elimination
        | Argument::Carried
        | Argument::Pivot
        | Argument::Given(_) => quote!(&[T; #length]),
    }
}

/// Returns the type of a result with this number of outputs; `length` emits the lengths of arrays.
pub(super) fn result_type(
    runtime: &TokenStream,
    shape: ResultShape,
    outputs: usize,
    length: impl Fn(usize) -> TokenStream,
) -> TokenStream {
    let array = |count| {
        let length = length(count);
        quote!([T; #length])
    };
    match shape {
        ResultShape::Scalar => quote!(T),
        ResultShape::Vector => array(outputs),
        ResultShape::Rows(rows, columns) => {
            let (row, rows) = (array(columns), length(rows));
            quote!([#row; #rows])
        }
        ResultShape::Arrays(lengths) => {
            let arrays = lengths.into_iter().flatten().map(array);
            quote!((#(#arrays),*))
        }
        ResultShape::Split(first) => {
            let rest = array(outputs - first);
            let first = if first == 1 { quote!(T) } else { array(first) };
            quote!((#first, #rest))
        }
        ResultShape::Transfer => quote!(#runtime::Transfer<T>),
        ResultShape::Transfers(count) => {
            let count = length(count);
            quote!([#runtime::Transfer<T>; #count])
        }
        ResultShape::Budget(count) => {
            let count = length(count);
            quote!(#runtime::Budget<T, #count>)
        }
    }
}

impl Emission<'_> {
    /// Returns the outputs in the form in which the function returns them.
    pub(super) fn shaped(&self, entry: &Entry, values: Vec<TokenStream>) -> TokenStream {
        let runtime = self.runtime();
        match entry.shape {
            ResultShape::Scalar => quote!(#(#values)*),
            ResultShape::Vector => quote!([#(#values),*]),
            ResultShape::Rows(_, length) => {
                let rows = values.chunks(length).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
            ResultShape::Arrays(lengths) => {
                let mut rest = values.as_slice();
                let arrays = lengths.into_iter().flatten().map(|length| {
                    let (array, others) = rest.split_at(length);
                    rest = others;
                    quote!([#(#array),*])
                });
                quote!((#(#arrays),*))
            }
            ResultShape::Split(first) => match values.split_at(first) {
                ([first], rest) => quote!((#first, [#(#rest),*])),
                (first, rest) => quote!(([#(#first),*], [#(#rest),*])),
            },
            ResultShape::Transfer => {
                let (kinetic, potential) = (&values[0], &values[1]);
                quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
            }
            ResultShape::Transfers(_) => {
                let transfers = values.chunks(2).map(|parts| {
                    let (kinetic, potential) = (&parts[0], &parts[1]);
                    quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
                });
                quote!([#(#transfers),*])
            }
            ResultShape::Budget(count) => {
                let (energies, rest) = values.split_at(count);
                let (transfers, powers) = rest.split_at(count);
                quote! {
                    #runtime::Budget {
                        energies: [#(#energies),*],
                        transfers: [#(#transfers),*],
                        powers: [#(#powers),*],
                    }
                }
            }
        }
    }
}
