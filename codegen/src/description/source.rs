//! A description from text, without a compiler around it.

use proc_macro2::TokenStream;

use super::parse::parse_attribute;
use super::{Description, StructItem};
use crate::report::{Faults, SyntaxMessage};

/// Reads the text between the parentheses of an attribute, as of one that stands on a
/// struct `Tree`; places in messages are those in the text. Mistakes go to `report`.
pub fn parse_text(text: &str, report: &mut Faults) -> Option<Description> {
    match text.parse::<TokenStream>() {
        Ok(tokens) => Some(parse_attribute(tokens, StructItem::unit("Tree"), report)),
        Err(error) => {
            report.error(error.span(), SyntaxMessage::NoTokens);
            None
        }
    }
}
