//! Names and numbers as tokens, and binding strengths of expressions.

use crate::exact::Rational;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// Binding strength (precedence) of an emitted expression.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

/// Returns `T::from_f64(2.0)`, or `T::from_parts(0.1, -5.551115123125783e-18)` for a number that is
/// not exactly an `f64`.
pub(super) fn number_tokens(number: &Rational) -> TokenStream {
    let [high, low] = part_tokens(number);
    match number.to_parts().1 == 0.0 {
        true => quote!(T::from_f64(#high)),
        false => quote!(T::from_parts(#high, #low)),
    }
}

/// Returns the `f64` nearest to a number, and the `f64` nearest to the remainder.
pub(super) fn part_tokens(number: &Rational) -> [TokenStream; 2] {
    let signed = |value: f64, size: Literal| match value.is_sign_negative() {
        true => quote!(-#size),
        false => quote!(#size),
    };
    let (high, low) = number.to_parts();
    if low == 0.0 {
        return [signed(high, float(high.abs())), quote!(0.0)];
    }
    [high, low].map(|part| signed(part, float(part.abs())))
}

/// Returns a positive number, with an exponent if it would have leading or trailing zeros.
pub(super) fn float(value: f64) -> Literal {
    let plain = Literal::f64_unsuffixed(value);
    if value == 0.0 || (1e-4..1e16).contains(&value) {
        return plain;
    }
    format!("{value:e}").parse().unwrap_or(plain)
}

/// Returns a number of links with its digits in groups of three: `1_048_575`.
pub(super) fn count(number: usize) -> Literal {
    let digits = number.to_string();
    let grouped: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .filter_map(|group| std::str::from_utf8(group).ok())
        .collect();
    let plain = Literal::usize_unsuffixed(number);
    match digits.len() > 4 {
        true => grouped.join("_").parse().unwrap_or(plain),
        false => plain,
    }
}
