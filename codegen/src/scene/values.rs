//! Conversion of expressions to quantities, with exact arithmetic; collects parameters and
//! conditions.

use proc_macro2::{Ident, Span};

use super::names::check_parameter;
use super::{Magnitudes, Parameter, ParameterId, Quantity, QuantityAtom, Requirement, Sign};
use crate::description::{Expression, ExpressionKind, ParameterClause};
use crate::exact::{ExactError, Rational};
use crate::report::{Faults, SyntaxMessage, ValueMessage, nearest};

/// Purpose of a value: its name, unit and condition.
pub(super) struct Usage<'a> {
    /// Name of the value in messages, as in "mass of `child`".
    pub(super) what: String,
    /// Unit of the value; empty for a pure number and for an operand of a function of time.
    pub(super) unit: &'a str,
    /// Condition on the sign of the value.
    pub(super) sign: Sign,
}

/// Parameters and conditions found so far.
#[derive(Default)]
pub(super) struct Values {
    pub(super) parameters: Vec<Parameter>,
    /// Span of the first use or declaration of each parameter.
    pub(super) spans: Vec<Span>,
    pub(super) requirements: Vec<Requirement>,
    /// True if the description declares all parameters.
    declared: bool,
}

impl Values {
    /// Creates the list of parameters; if the description declares any, with these.
    pub(super) fn declared(clause: Option<&ParameterClause>, report: &mut Faults) -> Self {
        let mut values = Self::default();
        for name in clause.iter().flat_map(|clause| &clause.names) {
            let text = name.to_string();
            if check_parameter(&text, name.span(), report).is_none() {
                continue;
            }
            if values.parameters.iter().any(|known| known.name == text) {
                let message = SyntaxMessage::duplicate_property(name);
                report.error(name.span(), message);
                continue;
            }
            values.add(name);
        }
        // The part that could not be parsed may have declared more.
        values.declared = clause.is_some_and(|clause| !clause.damaged);
        values
    }

    fn add(&mut self, name: &Ident) {
        self.spans.push(name.span());
        self.parameters.push(Parameter {
            name: name.to_string(),
            doc: String::new(),
            sign: Sign::Any,
        });
    }

    fn undeclared(&self, name: String) -> ValueMessage {
        let known: Vec<&str> = self.parameters.iter().map(|p| p.name.as_str()).collect();
        let nearest = nearest(&name, &known).map(str::to_owned);
        ValueMessage::UndeclaredParameter { name, nearest }
    }

    /// Evaluates an expression; returns `None` after reporting a mistake.
    pub(super) fn evaluate(
        &mut self,
        expression: &Expression,
        usage: &Usage<'_>,
        report: &mut Faults,
    ) -> Option<Quantity> {
        let value = match &expression.kind {
            ExpressionKind::Name(name) => self.parameter(name, usage, true, report)?,
            _ => self.operand(expression, usage, report)?,
        };
        self.accept(value, usage, expression.span, report)
    }

    /// Checks a value against its conditions: literals at once, expressions of parameters by a
    /// requirement that the model checks.
    pub(super) fn accept(
        &mut self,
        value: Quantity,
        usage: &Usage<'_>,
        span: Span,
        report: &mut Faults,
    ) -> Option<Quantity> {
        if let Some(message) = unrepresentable(&value) {
            report.error(span, message);
            return None;
        }
        let Usage { what, unit, sign } = usage;
        let magnitudes = Magnitudes::of(unit, *sign);
        match value.exact() {
            Some(number) => {
                if let Some(message) = violation(number, what, *sign, &magnitudes) {
                    report.error(span, message);
                    return None;
                }
            }
            None => {
                let known = self.requirements.iter().any(|known| {
                    known.quantity == value
                        && known.sign >= *sign
                        && known.magnitudes.are_within(&magnitudes)
                });
                if !known {
                    self.requirements.push(Requirement {
                        what: what.clone(),
                        quantity: value.clone(),
                        sign: *sign,
                        magnitudes,
                    });
                }
            }
        }
        Some(value)
    }

    /// Adds the requirement that gravity keeps the sign that it is written with, because all
    /// directions depend on it.
    pub(super) fn require_direction(&mut self, gravity: &Quantity, what: &str) {
        let sign = match gravity.is_written_negative() {
            true => Sign::Standing,
            false => Sign::Hanging,
        };
        let own = |known: &&mut Requirement| known.what == what && known.quantity == *gravity;
        if let Some(requirement) = self.requirements.iter_mut().find(own) {
            requirement.sign = sign;
        }
    }

    /// Evaluates an operand of an expression.
    pub(super) fn operand(
        &mut self,
        expression: &Expression,
        usage: &Usage<'_>,
        report: &mut Faults,
    ) -> Option<Quantity> {
        let mut operands =
            |parts: &[Expression]| all(parts.iter().map(|part| self.operand(part, usage, report)));
        let value = match &expression.kind {
            ExpressionKind::Number(number) => Ok(Quantity::number(number.clone())),
            ExpressionKind::Name(name) => return self.parameter(name, usage, false, report),
            ExpressionKind::Sum(members) => Ok(Quantity::sum(operands(members)?)),
            ExpressionKind::Product { factors, divisors } => {
                let (factors, values) = (operands(factors), operands(divisors));
                let (factors, values) = (factors?, values?);
                if let Some(at) = values.iter().position(Quantity::is_zero) {
                    let span = divisors.get(at).map_or(expression.span, |zero| zero.span);
                    report.error(span, ValueMessage::DivisionByZero);
                    return None;
                }
                Quantity::product(factors).divided_by(Quantity::product(values))
            }
            ExpressionKind::Power(base, exponent) => {
                self.operand(base, usage, report)?.power(*exponent)
            }
            ExpressionKind::Negative(value) => Ok(self.operand(value, usage, report)?.negative()),
            ExpressionKind::Call { function, .. } => {
                let name = function.to_string();
                report.error(function.span(), ValueMessage::FunctionCall { name });
                return None;
            }
        };
        match value {
            Ok(value) if value.exact().is_some_and(|number| !number.is_short()) => {
                report.error(expression.span, ValueMessage::NumberLength);
                None
            }
            Ok(value) => Some(value),
            Err(error) => {
                report.error(expression.span, message_for(error));
                None
            }
        }
    }

    /// Returns the parameter with the given name. `alone` is true if the value consists only of
    /// this parameter.
    fn parameter(
        &mut self,
        name: &Ident,
        usage: &Usage<'_>,
        alone: bool,
        report: &mut Faults,
    ) -> Option<Quantity> {
        let text = name.to_string();
        check_parameter(&text, name.span(), report)?;
        let known = self.parameters.iter().position(|known| known.name == text);
        let index = known.unwrap_or(self.parameters.len());
        if known.is_none() {
            if self.declared {
                report.error(name.span(), self.undeclared(text));
                return None;
            }
            self.add(name);
        }
        let role = match (alone, usage.unit) {
            (false, _) => format!("part of the {}", usage.what),
            (true, "") => usage.what.clone(),
            (true, unit) => format!("{}, {unit}", usage.what),
        };
        if let Some(parameter) = self.parameters.get_mut(index) {
            if !parameter.doc.split("; ").any(|known| known == role) {
                if !parameter.doc.is_empty() {
                    parameter.doc.push_str("; ");
                }
                parameter.doc.push_str(&role);
            }
            if alone {
                parameter.sign = parameter.sign.max(usage.sign);
            }
        }
        Some(Quantity::parameter(ParameterId(index)))
    }
}

/// Collects the values. All are evaluated, even if one is `None`.
pub(super) fn all<T>(values: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let values: Vec<Option<T>> = values.collect();
    values.into_iter().collect()
}

/// Reports declared parameters that no value uses.
pub(super) fn check_used(parameters: &[Parameter], spans: &[Span], report: &mut Faults) {
    for (parameter, &span) in parameters.iter().zip(spans) {
        if parameter.doc.is_empty() {
            let name = parameter.name.clone();
            report.error(span, ValueMessage::UnusedParameter { name });
        }
    }
}

/// Returns the message for a failed operation on exact numbers.
pub(super) fn message_for(error: ExactError) -> ValueMessage {
    match error {
        ExactError::DivisionByZero => ValueMessage::DivisionByZero,
        ExactError::TooLong | ExactError::Malformed | ExactError::Exponent => {
            ValueMessage::NumberLength
        }
    }
}

/// Largest number of characters of a number in a message; longer ones are rounded.
const LONGEST_NUMBER: usize = 30;

/// Returns the message about a number of the wrong sign or magnitude.
fn violation(
    number: &Rational,
    what: &str,
    sign: Sign,
    magnitudes: &Magnitudes,
) -> Option<ValueMessage> {
    let (what, mut value) = (what.to_owned(), number.to_string());
    if value.len() > LONGEST_NUMBER {
        value = format!("{:e}", number.to_f64());
    }
    match sign {
        Sign::NonNegative if number.is_negative() => {
            return Some(ValueMessage::Negative { what, value });
        }
        Sign::Positive if number.is_negative() || number.is_zero() => {
            return Some(ValueMessage::NotPositive { what, value });
        }
        Sign::Any | Sign::Hanging | Sign::Standing | Sign::NonNegative | Sign::Positive => {}
    }
    (!magnitudes.hold(number.to_f64())).then_some(ValueMessage::Magnitude {
        what,
        value,
        range: magnitudes.text,
    })
}

/// Returns the message about a value whose numbers are too long, or do not fit an `f64` and would
/// become zero or infinite; `None` for other values.
pub(super) fn unrepresentable(value: &Quantity) -> Option<ValueMessage> {
    value.atoms().into_iter().rev().find_map(|atom| {
        let QuantityAtom::Exact(number) = atom else {
            return None;
        };
        let rounded = number.to_f64();
        if !number.is_short() {
            return Some(ValueMessage::NumberLength);
        }
        let fits = rounded.is_finite() && (rounded != 0.0 || number.is_zero());
        (!fits).then_some(ValueMessage::NumberRange)
    })
}
