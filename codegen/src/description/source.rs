//! Parsing of a description from text, outside a procedural macro.

use proc_macro2::TokenStream;

use super::parse::parse_attribute;
use super::{Description, StructItem};
use crate::report::{Faults, SyntaxMessage};

/// Parses the text between the parentheses of an attribute, as if it were on a struct `Tree`. Spans
/// in messages refer to the text. Mistakes are added to `report`.
pub fn parse_text(text: &str, report: &mut Faults) -> Option<Description> {
    match text.parse::<TokenStream>() {
        Ok(tokens) => Some(parse_attribute(tokens, StructItem::unit("Tree"), report)),
        Err(error) => {
            report.error(error.span(), SyntaxMessage::NoTokens);
            None
        }
    }
}
