//! The struct that an attribute stands on, and how deep tokens may nest.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};

use super::{OuterAttribute, StructItem};
use crate::report::{Faults, SyntaxMessage, TreeMessage};

/// Deepest nesting of brackets and parentheses. A chain of more links is what
/// `generations` is for.
pub(super) const MAX_NESTING: usize = 64;

/// A token below [`MAX_NESTING`] groups, if there is one. Looks without
/// recursion, so that parsing afterwards may recurse.
pub(super) fn deepest(tokens: &TokenStream) -> Option<Span> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(level) = open.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) if open.len() > MAX_NESTING => return Some(group.span()),
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(_) => {}
            None => {
                open.pop();
            }
        }
    }
    None
}

/// The place of a word among tokens.
fn place_of(word: &str, tokens: TokenStream) -> Option<Span> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Ident(own) if own == word => Some(own.span()),
        TokenTree::Group(group) => place_of(word, group.stream()),
        _ => None,
    })
}

/// Types that emitted models name without a path: their type parameter, and
/// primitive ones.
const RESERVED_TYPES: [&str; 5] = ["T", "f64", "usize", "bool", "str"];

impl StructItem {
    /// The struct without fields and attributes, `struct NAME;`.
    pub(super) fn unit(name: &str) -> Self {
        let ident = Ident::new(name, Span::call_site());
        Self {
            attrs: Vec::new(),
            vis: TokenStream::new(),
            tokens: quote!(struct #ident;),
            ident,
        }
    }

    /// The place of a trait among those that are derived for the struct.
    pub fn derived(&self, name: &str) -> Option<Span> {
        let derives = self.attrs.iter().filter(|attribute| attribute.is("derive"));
        derives
            .into_iter()
            .find_map(|derive| place_of(name, derive.tokens.clone()))
    }

    /// Returns true if the struct is called as a type that the code of a model names.
    pub fn is_reserved(&self) -> bool {
        RESERVED_TYPES.iter().any(|name| self.ident == name)
    }
}

impl OuterAttribute {
    fn of(attribute: &syn::Attribute) -> Self {
        Self {
            name: attribute.path().get_ident().cloned(),
            tokens: attribute.to_token_stream(),
        }
    }

    /// Returns true if that is its name.
    pub fn is(&self, name: &str) -> bool {
        self.name.as_ref().is_some_and(|own| own == name)
    }
}

impl ToTokens for OuterAttribute {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        self.tokens.to_tokens(tokens);
    }
}

/// Reads the struct.
pub(super) fn parse_item(tokens: TokenStream, report: &mut Faults) -> Option<StructItem> {
    if deepest(&tokens).is_some() {
        report.error(Span::call_site(), SyntaxMessage::NotAStruct);
        return None;
    }
    let first = tokens.clone().into_iter().next();
    let Ok(item) = syn::parse2::<syn::ItemStruct>(tokens.clone()) else {
        let span = first.map_or_else(Span::call_site, |token| token.span());
        report.error(span, SyntaxMessage::NotAStruct);
        return None;
    };
    let name = item.ident.to_string();
    if !item.fields.is_empty() {
        report.error(
            item.ident.span(),
            SyntaxMessage::StructFields { name: name.clone() },
        );
    }
    if !item.generics.params.is_empty() || item.generics.where_clause.is_some() {
        let name = name.clone();
        report.error(item.ident.span(), SyntaxMessage::StructGenerics { name });
    }
    let item = StructItem {
        attrs: item.attrs.iter().map(OuterAttribute::of).collect(),
        vis: item.vis.to_token_stream(),
        ident: item.ident,
        tokens,
    };
    if item.is_reserved() {
        report.error(item.ident.span(), TreeMessage::ReservedName { name });
    }
    Some(item)
}
