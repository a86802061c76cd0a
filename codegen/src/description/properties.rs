//! Parser of link properties: names and values.

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use syn::parse::ParseStream;
use syn::{Token, token};

use super::expression::EACH_WHOLE;
use super::list::{List, ListFault, colon, expected, group, identifier, list, parse_all, take};
use super::{Expression, Property, Value};
use crate::report::Faults;

/// Parses a property of a link, or all properties in the parentheses of a friction law.
pub(super) fn properties(
    input: ParseStream<'_>,
    report: &mut Faults,
) -> Result<List<Property>, ListFault> {
    let name = identifier(input, "a property, as in `mass = 0.1`")?;
    let is_law = ["friction", "drag"].iter().any(|law| name == law);
    if is_law && input.peek(token::Paren) {
        let laws = group(input, Delimiter::Parenthesis, "`(` and its laws")?;
        let mut laws = list(laws, report, property);
        for property in &mut laws.members {
            property.within = Some(name.clone());
        }
        return Ok(laws);
    }
    Ok(List {
        members: vec![property_value(name, input)?],
        damaged: false,
    })
}

pub(super) fn property(input: ParseStream<'_>, _: &mut Faults) -> Result<Property, ListFault> {
    let name = identifier(input, "a property, as in `mass = 0.1`")?;
    property_value(name, input)
}

/// Parses the value of a property, after its name.
pub(super) fn property_value(name: Ident, input: ParseStream<'_>) -> Result<Property, ListFault> {
    colon(&name, input)?;
    take::<Token![=]>(input, "`=` and a value")?;
    let value = match each(input) {
        Some((span, values)) => Value::Each {
            values: parse_all(values, |input| {
                let mut values = vec![point(input)?];
                while !input.is_empty() {
                    take::<Token![,]>(input, "`,`")?;
                    if !input.is_empty() {
                        values.push(point(input)?);
                    }
                }
                Ok(values)
            })?,
            span,
        },
        None => point(input)?,
    };
    if matches!(value, Value::Each { .. }) && !input.is_empty() && !input.peek(Token![,]) {
        return Err(expected(input, EACH_WHOLE));
    }
    Ok(Property {
        within: None,
        name,
        value,
    })
}

/// Parses a single value or a pair.
fn point(input: ParseStream<'_>) -> Result<Value, ListFault> {
    match pair(input) {
        Some(pair) => parse_all(pair, |input| {
            let along = Expression::parse(input)?;
            take::<Token![,]>(input, "`,`")?;
            let lateral = Expression::parse(input)?;
            Ok(Value::Pair(along, lateral))
        }),
        None => Expression::parse(input).map(Value::Single),
    }
}

/// Parses `each` and its parentheses. Returns the span of the word and the tokens in the
/// parentheses, or `None` if there is something else.
fn each(input: ParseStream<'_>) -> Option<(Span, (TokenStream, Span))> {
    input
        .step(|cursor| match cursor.ident() {
            Some((word, rest)) if word == "each" => match rest.group(Delimiter::Parenthesis) {
                Some((inside, span, rest)) => {
                    let tokens = (inside.token_stream(), span.close());
                    Ok(((word.span(), tokens), rest))
                }
                None => Err(cursor.error("")),
            },
            _ => Err(cursor.error("")),
        })
        .ok()
}

/// Parses parentheses that contain a comma at the top level. Returns their tokens, or `None` if
/// there is something else.
fn pair(input: ParseStream<'_>) -> Option<(TokenStream, Span)> {
    let is_comma = |token: TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    input
        .step(|cursor| match cursor.group(Delimiter::Parenthesis) {
            Some((inside, span, rest)) if inside.token_stream().into_iter().any(is_comma) => {
                Ok(((inside.token_stream(), span.close()), rest))
            }
            _ => Err(cursor.error("")),
        })
        .ok()
}
