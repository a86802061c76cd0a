//! Parser of values: arithmetic on decimal literals and names.

use proc_macro2::{Delimiter, Ident, Literal, Punct, Span, TokenStream};
use syn::buffer::Cursor;
use syn::ext::IdentExt as _;
use syn::parse::ParseStream;
use syn::{Token, token};

use super::Multiplicity;
use super::list::{ListFault, expected, next_name, parse_all, shortened};
use crate::exact::{ExactError, Rational};
use crate::report::{Diagnostic, SyntaxMessage, ValueMessage};

/// Highest total power of parameters below a `^`. Masses and lengths need no higher one, and the
/// emitted code writes out every factor.
const MAX_DEGREE: u32 = 8;

/// Accepted use of `each(...)`, for messages.
pub(super) const EACH_WHOLE: &str = "`each(...)` around whole values, as in `each(2 * a, 2 * b)`";

/// A value as written in the source.
#[derive(Debug, Clone)]
pub struct Expression {
    /// Tokens of the value, or only the first of them if the compiler cannot join spans.
    pub span: Span,
    /// Form and parts of the value.
    pub kind: ExpressionKind,
}

/// Kinds of [`Expression`].
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// A decimal literal, read exactly.
    Number(Rational),
    /// A parameter of the model.
    Name(Ident),
    /// A sum. A difference is a sum with [`Negative`](Self::Negative) members.
    Sum(Vec<Expression>),
    /// The product of all factors, divided by all divisors.
    Product {
        /// Factors, at least one.
        factors: Vec<Expression>,
        /// Divisors; empty without a `/`.
        divisors: Vec<Expression>,
    },
    /// A power with a literal exponent.
    Power(Box<Expression>, i32),
    /// The value with the opposite sign.
    Negative(Box<Expression>),
    /// A function call. The name has not been checked yet.
    Call {
        /// Name of the function.
        function: Ident,
        /// The expression in its parentheses.
        argument: Box<Expression>,
    },
}

impl Expression {
    /// Calls `visit` with every name in the value, in the order written.
    pub fn for_each_name(&self, visit: &mut impl FnMut(&Ident)) {
        match &self.kind {
            ExpressionKind::Number(_) => {}
            ExpressionKind::Name(name) => visit(name),
            ExpressionKind::Sum(members) => members.iter().for_each(|m| m.for_each_name(visit)),
            ExpressionKind::Product { factors, divisors } => {
                for part in factors.iter().chain(divisors) {
                    part.for_each_name(visit);
                }
            }
            ExpressionKind::Power(base, _)
            | ExpressionKind::Negative(base)
            | ExpressionKind::Call { argument: base, .. } => base.for_each_name(visit),
        }
    }

    /// Parses an expression and stops at its end.
    pub(super) fn parse(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let start = input.span();
        let mut members = vec![Self::term(input)?];
        loop {
            let sign = input.span();
            let negative = if input.peek(Token![+]) {
                punctuation::<Token![+]>(input)?;
                false
            } else if input.peek(Token![-]) {
                punctuation::<Token![-]>(input)?;
                true
            } else {
                break;
            };
            members.push(Self::term(input)?.signed(negative, sign));
        }
        Ok(single(members).unwrap_or_else(|members| Self {
            span: spanning(start, &members),
            kind: ExpressionKind::Sum(members),
        }))
    }

    /// Parses a term: factors with `*` and `/` between them.
    fn term(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let start = input.span();
        let mut factors = vec![Self::factor(input)?];
        let mut divisors = Vec::new();
        let mut last = factors.first().map_or(start, |factor| factor.span);
        loop {
            let side = if input.peek(Token![*]) {
                punctuation::<Token![*]>(input)?;
                &mut factors
            } else if input.peek(Token![/]) {
                punctuation::<Token![/]>(input)?;
                &mut divisors
            } else {
                break;
            };
            let factor = Self::factor(input)?;
            last = factor.span;
            side.push(factor);
        }
        Ok(match single(factors) {
            Ok(only) if divisors.is_empty() => only,
            factors => Self {
                span: start.join(last).unwrap_or(start),
                kind: ExpressionKind::Product {
                    factors: factors.map_or_else(|several| several, |only| vec![only]),
                    divisors,
                },
            },
        })
    }

    /// Parses a power, optionally preceded by a minus sign.
    fn factor(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let sign = input.span();
        let negative = minus(input);
        Ok(Self::power(input)?.signed(negative, sign))
    }

    /// Parses a primary expression and its exponent, if it has one.
    fn power(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let base = Self::primary(input)?;
        if !input.peek(Token![^]) {
            return Ok(base);
        }
        punctuation::<Token![^]>(input)?;
        let start = input.span();
        let exponent = if input.peek(token::Paren) {
            parse_all(parenthesised(input)?, exponent)
                .map_err(|_| Diagnostic::new(start, ValueMessage::Exponent))?
        } else {
            exponent(input)?
        };
        if input.peek(Token![^]) {
            return Err(Diagnostic::new(input.span(), ValueMessage::ChainedPower).into());
        }
        let power = Self {
            span: base.span.join(start).unwrap_or(base.span),
            kind: ExpressionKind::Power(Box::new(base), exponent),
        };
        if power.degree() > MAX_DEGREE {
            let limit = MAX_DEGREE;
            return Err(Diagnostic::new(start, ValueMessage::Degree { limit }).into());
        }
        Ok(power)
    }

    /// Returns the highest total power of names and functions. Divisors count like factors.
    fn degree(&self) -> u32 {
        match &self.kind {
            ExpressionKind::Number(_) => 0,
            ExpressionKind::Name(_) | ExpressionKind::Call { .. } => 1,
            ExpressionKind::Sum(members) => {
                members.iter().map(Self::degree).max().unwrap_or_default()
            }
            ExpressionKind::Product { factors, divisors } => factors
                .iter()
                .chain(divisors)
                .fold(0, |sum, part| sum.saturating_add(part.degree())),
            ExpressionKind::Power(base, exponent) => {
                base.degree().saturating_mul(exponent.unsigned_abs())
            }
            ExpressionKind::Negative(base) => base.degree(),
        }
    }

    /// Parses a literal, a name, a function call or an expression in parentheses.
    fn primary(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let span = input.span();
        if let Some(name) = path(input) {
            return Err(Diagnostic::new(span, ValueMessage::RustConstant { name }).into());
        }
        // A fragment that `macro_rules!` has passed on is a unit, as if it were in parentheses.
        if let Some(tokens) = invisible_group(input) {
            return parse_all((tokens, span), Self::parse);
        }
        if input.peek(token::Paren) {
            return parse_all(parenthesised(input)?, Self::parse);
        }
        if is_literal(input) {
            let value = number(input)?;
            // A name with `=` after it is the next property.
            if let Some(unit) = next_name(input)
                && !input.peek2(Token![=])
                && !input.peek2(Token![:])
            {
                return Err(Diagnostic::new(input.span(), SyntaxMessage::Unit { unit }).into());
            }
            let kind = ExpressionKind::Number(value);
            return Ok(Self { span, kind });
        }
        if input.peek(syn::Ident::peek_any) {
            let name = Ident::parse_any(input).map_err(|_| expected(input, Self::WHAT))?;
            if input.peek(token::Paren) && name == "each" {
                let message = SyntaxMessage::Expected {
                    what: EACH_WHOLE,
                    found: "each(...)".to_owned(),
                };
                return Err(Diagnostic::new(name.span(), message).into());
            }
            if input.peek(token::Paren) {
                let (inside, end) = parenthesised(input)?;
                let argument = Box::new(parse_all((inside, end), Self::parse)?);
                let function = name;
                let kind = ExpressionKind::Call { function, argument };
                let span = span.join(end).unwrap_or(span);
                return Ok(Self { span, kind });
            }
            let kind = ExpressionKind::Name(name);
            return Ok(Self { span, kind });
        }
        Err(expected(input, Self::WHAT))
    }

    /// Name of a missing value in messages.
    const WHAT: &'static str = "a number or the name of a parameter";

    /// Returns the value, with the opposite sign if `negative`; `sign` is the span of the minus.
    fn signed(self, negative: bool, sign: Span) -> Self {
        if !negative {
            return self;
        }
        Self {
            span: sign.join(self.span).unwrap_or(sign),
            kind: ExpressionKind::Negative(Box::new(self)),
        }
    }
}

/// Returns the only member, or all members as the error if there are several.
fn single(mut members: Vec<Expression>) -> Result<Expression, Vec<Expression>> {
    match (members.pop(), members.is_empty()) {
        (Some(only), true) => Ok(only),
        (last, _) => {
            members.extend(last);
            Err(members)
        }
    }
}

/// Returns the span from `start` to the end of the last member.
fn spanning(start: Span, members: &[Expression]) -> Span {
    members
        .last()
        .and_then(|last| start.join(last.span))
        .unwrap_or(start)
}

/// Consumes a punctuation mark that is known to be the next token.
fn punctuation<T: syn::parse::Parse>(input: ParseStream<'_>) -> Result<(), ListFault> {
    match input.parse::<T>() {
        Ok(_) => Ok(()),
        Err(_) => Err(expected(input, Expression::WHAT)),
    }
}

/// Consumes a minus if there is one, and returns true if there was.
fn minus(input: ParseStream<'_>) -> bool {
    input.peek(Token![-]) && input.parse::<Token![-]>().is_ok()
}

/// Parses parentheses; returns the tokens in them and the span of the closing one.
fn parenthesised(input: ParseStream<'_>) -> Result<(TokenStream, Span), ListFault> {
    input
        .step(|cursor| match cursor.group(Delimiter::Parenthesis) {
            Some((inside, span, rest)) => Ok(((inside.token_stream(), span.close()), rest)),
            None => Err(cursor.error("")),
        })
        .map_err(|_| expected(input, "`(`"))
}

/// Parses a group without delimiters; returns its tokens, or `None` if the next token is not such a
/// group.
fn invisible_group(input: ParseStream<'_>) -> Option<TokenStream> {
    input
        .step(|cursor| match cursor.group(Delimiter::None) {
            Some((inside, _, rest)) => Ok((inside.token_stream(), rest)),
            None => Err(cursor.error("")),
        })
        .ok()
}

/// Returns the text of the next tokens if they are a path with `::`.
fn path(input: ParseStream<'_>) -> Option<String> {
    let (mut text, mut rest) = (String::new(), input.cursor());
    loop {
        if let Some(behind) = separator(rest) {
            text.push_str("::");
            rest = behind;
        } else if !text.is_empty() && !text.ends_with("::") {
            break;
        }
        let (name, behind) = rest.ident()?;
        text.push_str(&name.to_string());
        rest = behind;
    }
    text.contains("::").then_some(text)
}

/// Returns the position after `::`, if it comes next.
fn separator(cursor: Cursor<'_>) -> Option<Cursor<'_>> {
    let (first, rest) = cursor.punct()?;
    let (second, rest) = rest.punct()?;
    let is_colon = |mark: Punct| mark.as_char() == ':';
    (is_colon(first) && is_colon(second)).then_some(rest)
}

/// Parses a decimal literal.
pub(super) fn number(input: ParseStream<'_>) -> Result<Rational, ListFault> {
    let span = input.span();
    // `.5` is two tokens: a point and the digits behind it.
    let text = match is_leading_point(input) {
        true => {
            punctuation::<Token![.]>(input)?;
            format!("0.{}", literal(input, Expression::WHAT)?)
        }
        false => literal(input, Expression::WHAT)?,
    };
    Rational::parse_decimal(&text).map_err(|error| {
        let message = match error {
            ExactError::Exponent => ValueMessage::NumberRange,
            ExactError::TooLong => ValueMessage::NumberLength,
            ExactError::Malformed | ExactError::DivisionByZero => ValueMessage::NotDecimal {
                text: shortened(text),
            },
        };
        Diagnostic::new(span, message).into()
    })
}

/// Returns true if the next tokens are a decimal point and digits after it.
fn is_leading_point(input: ParseStream<'_>) -> bool {
    let point = input
        .cursor()
        .punct()
        .filter(|(mark, _)| mark.as_char() == '.');
    let digits = point.and_then(|(_, behind)| behind.literal());
    digits.is_some_and(|(digits, _)| digits.to_string().starts_with(|c: char| c.is_ascii_digit()))
}

/// Returns true if the next token is a literal. `true` counts as a literal, which is refused later:
/// it is not a name either.
fn is_literal(input: ParseStream<'_>) -> bool {
    if is_leading_point(input) {
        return true;
    }
    let next = input.cursor();
    let is_bool = |(word, _): (Ident, _)| word == "true" || word == "false";
    next.literal().is_some() || next.ident().is_some_and(is_bool)
}

/// Parses a literal and returns its text. `what` names the literal in a message.
pub(super) fn literal(input: ParseStream<'_>, what: &'static str) -> Result<String, ListFault> {
    input
        .parse::<Literal>()
        .map(|literal| literal.to_string())
        .map_err(|_| expected(input, what))
}

/// Parses an exponent: a whole number with an optional minus.
fn exponent(input: ParseStream<'_>) -> Result<i32, ListFault> {
    let span = input.span();
    let negative = minus(input);
    let fault = || ListFault::from(Diagnostic::new(span, ValueMessage::Exponent));
    let text = literal(input, "a whole number").map_err(|_| fault())?;
    let magnitude: i32 = text.replace('_', "").parse().map_err(|_| fault())?;
    Ok(if negative { -magnitude } else { magnitude })
}

/// Parses a whole number; numbers beyond `u32` become `u32::MAX`.
pub(super) fn whole_number(
    input: ParseStream<'_>,
    what: &'static str,
) -> Result<Multiplicity, ListFault> {
    let (span, fault) = (input.span(), expected(input, what));
    let digits = literal(input, what)?.replace('_', "");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(fault);
    }
    let count = digits.parse().unwrap_or(u32::MAX);
    Ok(Multiplicity { count, span })
}
