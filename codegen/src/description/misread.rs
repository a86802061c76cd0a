//! Messages for members of a description that resemble something else, which the user probably
//! meant.

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::buffer::Cursor;
use syn::parse::ParseStream;
use syn::{Token, token};

use super::list::{ListFault, found};
use crate::report::{Diagnostic, SceneSetting, SyntaxMessage};

/// Returns the message for a member that does not start with a name.
pub(super) fn not_an_entry(input: ParseStream<'_>) -> ListFault {
    let found = found(input);
    let message = match found.starts_with(['"', 'r']) {
        true => SyntaxMessage::Quoted,
        false => SyntaxMessage::NotAnEntry { found },
    };
    Diagnostic::new(input.span(), message).into()
}

/// Returns the message for a name that is followed neither by a shape nor by parentheses.
pub(super) fn lone_name(name: &Ident, input: ParseStream<'_>) -> Option<ListFault> {
    if !input.is_empty() && !input.peek(Token![,]) {
        return None;
    }
    let text = name.to_string();
    let message = match (SceneSetting::named(&text), SceneSetting::nearest(&text)) {
        (Some(setting), _) => SyntaxMessage::SettingForm { setting },
        (None, Some(_)) => SyntaxMessage::unknown_entry(text),
        (None, None) => SyntaxMessage::LoneName { name: text },
    };
    Some(Diagnostic::new(name.span(), message).into())
}

/// Returns the message for `name = shape(property = value, ...)`. The name has been parsed already.
pub(super) fn shape_by_equals<'a>(name: &Ident, input: ParseStream<'a>) -> Option<ListFault> {
    let equals = |cursor: Cursor<'a>| cursor.punct().filter(|(mark, _)| mark.as_char() == '=');
    let (_, behind) = equals(input.cursor())?;
    let (shape, behind) = behind.ident()?;
    let (inside, ..) = behind.group(Delimiter::Parenthesis)?;
    let (_, behind) = inside.ident()?;
    equals(behind)?;
    let message = SyntaxMessage::LinkByEquals {
        link: name.to_string(),
        shape: shape.to_string(),
    };
    Some(Diagnostic::new(input.span(), message).into())
}

/// Returns the message for a setting that is misspelt or has the wrong punctuation; its name has
/// been parsed already. (A list without values cannot be a link, because a link without a shape
/// needs a mass.)
pub(super) fn not_a_link(name: &Ident, input: ParseStream<'_>) -> Option<ListFault> {
    if !input.peek(token::Paren) {
        return None;
    }
    let (inside, ..) = input.cursor().group(Delimiter::Parenthesis)?;
    let tokens: Vec<TokenTree> = inside.token_stream().into_iter().collect();
    let is_equals = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == '=');
    let is_mass = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if word == "mass");
    let mut pairs = tokens.windows(2);
    let has_mass = pairs.any(|pair| is_mass(&pair[0]) && is_equals(&pair[1]));
    // `foo(energies)` is a list of names.
    let second = tokens.get(1);
    let has_names = matches!(tokens.first(), Some(TokenTree::Ident(_)))
        && second.is_none_or(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == ','));
    let text = name.to_string();
    let message = match (SceneSetting::named(&text), SceneSetting::nearest(&text)) {
        (Some(setting), _) if !has_mass && !setting.in_parentheses() => {
            SyntaxMessage::SettingForm { setting }
        }
        (None, Some(_)) if !has_mass => SyntaxMessage::unknown_entry(text),
        (None, None) if has_names => SyntaxMessage::unknown_entry(text),
        _ => return None,
    };
    Some(Diagnostic::new(name.span(), message).into())
}
