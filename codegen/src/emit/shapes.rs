//! The shapes in which functions return their outputs.

use super::Emission;
use crate::program::{Entry, Shape};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn result_type(&self, entry: &Entry) -> TokenStream {
        let length = Literal::usize_unsuffixed(entry.outputs.len());
        let runtime = self.runtime();
        match entry.shape {
            Shape::Scalar => quote!(T),
            Shape::Vector => quote!([T; #length]),
            Shape::Rows(length) => {
                let rows = Literal::usize_unsuffixed(entry.outputs.len() / length);
                let length = Literal::usize_unsuffixed(length);
                quote!([[T; #length]; #rows])
            }
            Shape::Arrays(first) => {
                let rest = Literal::usize_unsuffixed(entry.outputs.len() - first);
                let first = Literal::usize_unsuffixed(first);
                quote!(([T; #first], [T; #rest]))
            }
            Shape::Split(first) => {
                let rest = Literal::usize_unsuffixed(entry.outputs.len() - first);
                let first = match first {
                    1 => quote!(T),
                    _ => {
                        let first = Literal::usize_unsuffixed(first);
                        quote!([T; #first])
                    }
                };
                quote!((#first, [T; #rest]))
            }
            Shape::Transfer => quote!(#runtime::Transfer<T>),
            Shape::Transfers(count) => {
                let count = Literal::usize_unsuffixed(count);
                quote!([#runtime::Transfer<T>; #count])
            }
            Shape::Budget(count) => {
                let count = Literal::usize_unsuffixed(count);
                quote!(#runtime::Budget<T, #count>)
            }
        }
    }

    /// The outputs in the shape in which the function returns them.
    pub(super) fn shaped(&self, entry: &Entry, values: Vec<TokenStream>) -> TokenStream {
        let runtime = self.runtime();
        match entry.shape {
            Shape::Scalar => quote!(#(#values)*),
            Shape::Vector => quote!([#(#values),*]),
            Shape::Rows(length) => {
                let rows = values.chunks(length).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
            Shape::Arrays(first) => {
                let (first, second) = values.split_at(first);
                quote!(([#(#first),*], [#(#second),*]))
            }
            Shape::Split(first) => {
                let (first, second) = values.split_at(first);
                match first {
                    [first] => quote!((#first, [#(#second),*])),
                    _ => quote!(([#(#first),*], [#(#second),*])),
                }
            }
            Shape::Transfer => {
                let (kinetic, potential) = (&values[0], &values[1]);
                quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
            }
            Shape::Transfers(_) => {
                let transfers = values.chunks(2).map(|parts| {
                    let (kinetic, potential) = (&parts[0], &parts[1]);
                    quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
                });
                quote!([#(#transfers),*])
            }
            Shape::Budget(count) => {
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
