//! The struct with the attribute, and a limit on the nesting of tokens.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};

use super::{OuterAttribute, StructItem};
use crate::report::{Faults, SyntaxMessage, TreeMessage};

/// Deepest accepted nesting of brackets and parentheses. Longer chains of links can be written with
/// `generations`.
pub(super) const MAX_NESTING: usize = 64;

/// Returns the span of a token inside more than [`MAX_NESTING`] groups, if there is one. Works
/// without recursion, so that parsing afterwards may recurse.
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

/// Returns the span of a word among tokens.
fn span_of(word: &str, tokens: TokenStream) -> Option<Span> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Ident(own) if own == word => Some(own.span()),
        TokenTree::Group(group) => span_of(word, group.stream()),
        _ => None,
    })
}

/// Types that emitted models name without a path: their type parameter and primitive types.
const RESERVED_TYPES: [&str; 5] = ["T", "f64", "usize", "bool", "str"];

impl StructItem {
    /// Creates a struct without fields and attributes, `struct NAME;`.
    pub(super) fn unit(name: &str) -> Self {
        let ident = Ident::new(name, Span::call_site());
        Self {
            attrs: Vec::new(),
            vis: TokenStream::new(),
            tokens: quote!(struct #ident;),
            ident,
        }
    }

    /// Returns the span of a trait in the struct's `derive` attributes, if it is there.
    pub fn derived(&self, name: &str) -> Option<Span> {
        let derives = self.attrs.iter().filter(|attribute| attribute.is("derive"));
        derives
            .into_iter()
            .find_map(|derive| span_of(name, derive.tokens.clone()))
    }

    /// Returns true if the struct has the name of a type that the emitted code uses.
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

    /// Returns true if the attribute has the given name.
    pub fn is(&self, name: &str) -> bool {
        self.name.as_ref().is_some_and(|own| own == name)
    }
}

impl ToTokens for OuterAttribute {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        self.tokens.to_tokens(tokens);
    }
}

/// Parses the struct to which the attribute is attached.
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
