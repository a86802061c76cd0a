//! Values: arithmetic on decimal literals and names.

use proc_macro2::{Delimiter, Ident, Literal, Span, TokenStream};
use syn::ext::IdentExt as _;
use syn::parse::ParseStream;
use syn::{Token, token};

use super::Multiplicity;
use super::list::{ListFault, expected, next_name, parse_all, shortened};
use crate::exact::{ExactError, Rational};
use crate::report::{Diagnostic, SyntaxMessage, ValueMessage};

/// Highest total power of parameters under a `^`: masses and lengths have no
/// use for more, and the emitted code writes every factor out.
const MAX_DEGREE: u32 = 8;

/// The place of `each(...)`.
pub(super) const EACH_WHOLE: &str = "`each(...)` around whole values, as in `each(2 * a, 2 * b)`";

/// A value as written.
#[derive(Debug, Clone)]
pub struct Expression {
    /// Tokens of the value; the first of them where the compiler does not join spans.
    pub span: Span,
    /// Form and parts of the value.
    pub kind: ExpressionKind,
}

/// The kinds of [`Expression`].
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// A decimal literal, exactly.
    Number(Rational),
    /// A parameter of the model.
    Name(Ident),
    /// A sum; a difference has [`Negative`](Self::Negative) members.
    Sum(Vec<Expression>),
    /// The product of all factors, divided by all divisors.
    Product {
        /// At least one.
        factors: Vec<Expression>,
        /// None without a `/`.
        divisors: Vec<Expression>,
    },
    /// A power with a literal exponent.
    Power(Box<Expression>, i32),
    /// The opposite.
    Negative(Box<Expression>),
    /// A function of a value, whether or not there is one of that name.
    Call {
        /// The function.
        function: Ident,
        /// The expression in its parentheses.
        argument: Box<Expression>,
    },
}

impl Expression {
    /// Calls `visit` with every name of a value, in the order written.
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

    /// Parses an expression and stops where it ends.
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

    /// Parses a product.
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

    /// Parses a power, or its opposite.
    fn factor(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let sign = input.span();
        let negative = minus(input);
        Ok(Self::power(input)?.signed(negative, sign))
    }

    /// Parses a primary and its exponent.
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

    /// The highest total power of names and functions, divisors counted like
    /// factors.
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

    /// Parses a literal, a name, a function of an expression or an expression
    /// in parentheses.
    fn primary(input: ParseStream<'_>) -> Result<Self, ListFault> {
        let span = input.span();
        // A fragment that `macro_rules!` passed on keeps together as if it
        // stood in parentheses.
        if let Some(tokens) = invisible_group(input) {
            return parse_all((tokens, span), Self::parse);
        }
        if input.peek(token::Paren) {
            return parse_all(parenthesised(input)?, Self::parse);
        }
        if is_literal(input) {
            let value = number(input)?;
            // A name with a value of its own is the next property.
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

    /// Wording for a value where one is missing.
    const WHAT: &'static str = "a number or the name of a parameter";

    /// The opposite if `negative`, by a minus at `sign`.
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

/// The only member, or all of them.
fn single(mut members: Vec<Expression>) -> Result<Expression, Vec<Expression>> {
    match (members.pop(), members.is_empty()) {
        (Some(only), true) => Ok(only),
        (last, _) => {
            members.extend(last);
            Err(members)
        }
    }
}

/// The place from `start` to the end of the last member.
fn spanning(start: Span, members: &[Expression]) -> Span {
    members
        .last()
        .and_then(|last| start.join(last.span))
        .unwrap_or(start)
}

/// Takes a punctuation mark that was peeked at.
fn punctuation<T: syn::parse::Parse>(input: ParseStream<'_>) -> Result<(), ListFault> {
    match input.parse::<T>() {
        Ok(_) => Ok(()),
        Err(_) => Err(expected(input, Expression::WHAT)),
    }
}

/// Takes a minus where there is one.
fn minus(input: ParseStream<'_>) -> bool {
    input.peek(Token![-]) && input.parse::<Token![-]>().is_ok()
}

/// The tokens in parentheses and the place where they end.
fn parenthesised(input: ParseStream<'_>) -> Result<(TokenStream, Span), ListFault> {
    input
        .step(|cursor| match cursor.group(Delimiter::Parenthesis) {
            Some((inside, span, rest)) => Ok(((inside.token_stream(), span.close()), rest)),
            None => Err(cursor.error("")),
        })
        .map_err(|_| expected(input, "`(`"))
}

/// The tokens of a group without delimiters, where one comes next.
fn invisible_group(input: ParseStream<'_>) -> Option<TokenStream> {
    input
        .step(|cursor| match cursor.group(Delimiter::None) {
            Some((inside, _, rest)) => Ok((inside.token_stream(), rest)),
            None => Err(cursor.error("")),
        })
        .ok()
}

/// Parses a decimal literal.
pub(super) fn number(input: ParseStream<'_>) -> Result<Rational, ListFault> {
    let span = input.span();
    let text = literal(input, Expression::WHAT)?;
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

/// Returns true if a literal comes next. `true` is one, and refused: a name it is not either.
fn is_literal(input: ParseStream<'_>) -> bool {
    let next = input.cursor();
    let is_bool = |(word, _): (Ident, _)| word == "true" || word == "false";
    next.literal().is_some() || next.ident().is_some_and(is_bool)
}

/// The text of a literal.
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

/// A whole number; all beyond `u32` count as `u32::MAX`.
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
