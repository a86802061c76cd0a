//! A description from text, without a compiler around it.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Description, parse};
use crate::report::{Faults, SyntaxMessage};

/// Reads the text between the parentheses of an attribute, as of one that stands on a
/// struct `Tree`; places in messages are those in the text. Mistakes go to `report`.
pub fn parse_text(text: &str, report: &mut Faults) -> Option<Description> {
    match text.parse::<TokenStream>() {
        Ok(tokens) => parse(
            tokens,
            quote!(
                struct Tree;
            ),
            report,
        ),
        Err(error) => {
            report.error(error.span(), SyntaxMessage::NoTokens);
            None
        }
    }
}
