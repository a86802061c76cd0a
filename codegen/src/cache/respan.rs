//! Gives the tokens of a stored expansion the spans of the struct to which they belong.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};

/// Endings of the names that the expansion derives from the struct's name.
const DERIVED: [&str; 3] = ["", "Parameters", "Equations"];

/// Replaces the struct's attributes, visibility and name by the corresponding tokens of `item`, so
/// that the compiler reports errors about them where the user wrote them.
pub(super) fn respan(tokens: TokenStream, item: &TokenStream) -> TokenStream {
    let mut tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut written: Vec<TokenTree> = item.clone().into_iter().collect();
    let Some(at) = position_of_struct(&written) else {
        return tokens.into_iter().collect();
    };
    let name = match written.get(at + 1) {
        Some(TokenTree::Ident(name)) => name.clone(),
        _ => return tokens.into_iter().collect(),
    };
    written.truncate(at);
    // Attributes come first; each is a `#` and a group.
    let marks = written.chunks(2).take_while(|pair| is_mark(&pair[0]));
    let attributes = 2 * marks.count();
    let visibility = written.split_off(attributes.min(written.len()));
    replace(&mut tokens, 0, &written);
    if let Some(at) = position_of_struct(&tokens)
        && let Some(start) = at.checked_sub(visibility.len())
    {
        replace(&mut tokens, start, &visibility);
    }
    let names = DERIVED.map(|end| format!("{name}{end}"));
    named(tokens.into_iter().collect(), &names, &name)
}

fn position_of_struct(tokens: &[TokenTree]) -> Option<usize> {
    let mut tokens = tokens.iter();
    tokens.position(|token| matches!(token, TokenTree::Ident(word) if word == "struct"))
}

fn is_mark(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Punct(mark) if mark.as_char() == '#')
}

/// Replaces tokens from `start` on by the tokens `by`, if both have the same text.
fn replace(tokens: &mut [TokenTree], start: usize, by: &[TokenTree]) {
    let Some(tokens) = tokens.get_mut(start..start + by.len()) else {
        return;
    };
    let mut pairs = tokens.iter().zip(by);
    if pairs.all(|(kept, written)| kept.to_string() == written.to_string()) {
        tokens.clone_from_slice(by);
    }
}

/// Gives every identifier in `names` the span of `name`.
fn named(tokens: TokenStream, names: &[String], name: &Ident) -> TokenStream {
    let place = |token| match token {
        TokenTree::Group(group) => {
            let inside = named(group.stream(), names, name);
            let mut respan = Group::new(group.delimiter(), inside);
            respan.set_span(group.span());
            respan.into()
        }
        TokenTree::Ident(mut word) if names.iter().any(|known| word == known) => {
            word.set_span(name.span());
            word.into()
        }
        other => other,
    };
    tokens.into_iter().map(place).collect()
}
