//! Rows of a link's constants with named fields, for trees whose rows are computed by other code.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::ident;
use crate::program::{Column, LoopTree};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

impl Emission<'_> {
    /// Emits the rows that the equations of motion read, and those of energies and powers.
    pub(super) fn named_rows(&self, strips: &LoopTree) -> TokenStream {
        let constants = self.named_row("Row", "the equations read", &strips.columns);
        let energies = self.scene.requests.energies;
        let body = energies
            .then(|| self.named_row("BodyRow", "energies and powers read", &strips.body_columns));
        quote!(#constants #body)
    }

    fn named_row(&self, suffix: &str, readers: &str, columns: &[Column]) -> TokenStream {
        let (vis, name) = (&self.item.vis, format_ident!("{}{suffix}", self.item.ident));
        let docs = doc_lines(&[format!("The constants of a link that {readers}.")]);
        let fields = columns.iter().map(|column| {
            let (docs, name) = (doc_lines(&[sentence(*column)]), ident(column.name()));
            quote! {
                #docs
                #vis #name: T
            }
        });
        let names = columns.iter().map(|column| ident(column.name()));
        let names: Vec<_> = names.collect();
        let count = Literal::usize_unsuffixed(columns.len());
        quote! {
            #docs
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            #vis struct #name<T> {
                #(#fields,)*
            }

            impl<T> #name<T> {
                /// Returns the constants in the order of the columns.
                #vis fn into_array(self) -> [T; #count] {
                    let Self { #(#names),* } = self;
                    [#(#names),*]
                }
            }
        }
    }
}

/// Returns the meaning of a column as a sentence.
fn sentence(column: Column) -> String {
    let meaning = column.meaning();
    let mut letters = meaning.chars();
    match letters.next() {
        Some(first) => format!("{}{}.", first.to_uppercase(), letters.as_str()),
        None => String::new(),
    }
}
