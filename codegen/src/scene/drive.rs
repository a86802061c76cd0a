//! The drive: external torque and prescribed motion of the root's pivot, as functions of time.

use super::values::{Usage, Values, all};
use super::{Quantity, RationalExpression, Sign};
use crate::description::{self, Expression, ExpressionKind, Property, TIME, Value};
use crate::named_members::named_members;
use crate::report::{Faults, SyntaxMessage, TreeMessage, ValueMessage, nearest};

/// Torque on the root and motion of its pivot; at least one of them is given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drive<V = Quantity> {
    /// Torque of the ground on the root, in N m.
    pub torque: Option<Signal<V>>,
    /// Horizontal position of the root's pivot, in m, positive in the direction in which positive
    /// angles move a link's end.
    pub x: Option<Signal<V>>,
    /// Vertical position of the root's pivot, in m, positive upwards.
    pub y: Option<Signal<V>>,
}

/// A smooth function of time. No divisor depends on time. Code that reads the drive can rely on it:
/// there are no quotients and no powers with negative exponents.
pub type Signal<V = Quantity> = RationalExpression<SignalAtom<V>>;

/// Operands of functions of time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SignalAtom<V = Quantity> {
    /// A constant.
    Constant(V),
    /// Time, in s.
    Time,
    /// A function of an angle in rad.
    Function(TimeFunction, Box<Signal<V>>),
}

named_members! {
    /// The functions that a drive may use.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum TimeFunction {
        /// Sine.
        Sin = "sin",
        /// Cosine.
        Cos = "cos",
    }
}

/// Names of the parts of a drive.
const PARTS: &[&str] = &["torque", "x", "y"];

/// Resolves the drive. Adds mistakes to `report`.
pub(super) fn resolve_drive(
    drive: Option<&description::DriveClause>,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Drive> {
    let description::DriveClause {
        name,
        parts,
        damaged,
    } = drive?;
    if parts.is_empty() && !damaged {
        report.error(name.span(), ValueMessage::EmptyDrive);
    }
    let mut resolved = Drive {
        torque: None,
        x: None,
        y: None,
    };
    let mut seen: Vec<String> = Vec::new();
    for Property { name, value, .. } in parts {
        let (text, span) = (name.to_string(), name.span());
        if seen.contains(&text) {
            report.error(span, SyntaxMessage::duplicate_property(name));
            continue;
        }
        let (part, what, unit) = match text.as_str() {
            "torque" => (&mut resolved.torque, "torque on the root", "N m"),
            "x" => (&mut resolved.x, "position x of the root's pivot", "m"),
            "y" => (&mut resolved.y, "position y of the root's pivot", "m"),
            _ => {
                let nearest = nearest(&text, PARTS);
                report.error(
                    span,
                    ValueMessage::UnknownDrive {
                        name: text,
                        nearest,
                    },
                );
                continue;
            }
        };
        seen.push(text.clone());
        let usage = Usage {
            what: what.to_owned(),
            unit,
            sign: Sign::Any,
        };
        match value {
            Value::Single(value) => *part = signal(value, &usage, values, report),
            Value::Pair(..) => report.error(span, TreeMessage::NotAPoint { name: text }),
            Value::Each { span, .. } => report.error(*span, ValueMessage::EachWithoutCopies),
        }
    }
    Some(resolved)
}

/// Converts an expression to a function of time.
fn signal(
    expression: &Expression,
    usage: &Usage<'_>,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Signal> {
    if is_plain(expression) {
        let value = values.evaluate(expression, usage, report)?;
        return Some(Signal::Atom(SignalAtom::Constant(value)));
    }
    part(expression, usage, values, report)
}

/// Returns the usage (name, unit, sign) of an operand within a function of time.
fn part_of(usage: &Usage<'_>) -> Usage<'static> {
    Usage {
        what: format!("part of the {}", usage.what),
        unit: "",
        sign: Sign::Any,
    }
}

/// Returns true if the expression contains neither the time nor a function, as the value of a
/// property does.
fn is_plain(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Number(_) => true,
        ExpressionKind::Name(name) => name != TIME,
        ExpressionKind::Sum(members) => members.iter().all(is_plain),
        ExpressionKind::Product { factors, divisors } => {
            factors.iter().chain(divisors).all(is_plain)
        }
        ExpressionKind::Power(base, _) | ExpressionKind::Negative(base) => is_plain(base),
        ExpressionKind::Call { .. } => false,
    }
}

/// Converts an operand of a larger expression.
fn part(
    expression: &Expression,
    usage: &Usage<'_>,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Signal> {
    let mut inner = |value: &Expression| part(value, usage, values, report);
    Some(match &expression.kind {
        _ if is_plain(expression) => {
            let value = values.operand(expression, usage, report)?;
            let value = values.accept(value, &part_of(usage), expression.span, report)?;
            Signal::Atom(SignalAtom::Constant(value))
        }
        ExpressionKind::Number(_) | ExpressionKind::Name(_) => Signal::Atom(SignalAtom::Time),
        ExpressionKind::Sum(members) => Signal::Sum(all(members.iter().map(inner))?),
        ExpressionKind::Product { factors, divisors } => {
            let factors = all(factors.iter().map(inner));
            let divisor = divisor(divisors, usage, values, report);
            let mut factors = factors?;
            factors.extend(divisor?);
            match factors.pop() {
                Some(only) if factors.is_empty() => only,
                last => {
                    factors.extend(last);
                    Signal::Product(factors)
                }
            }
        }
        ExpressionKind::Power(base, exponent) => {
            if *exponent < 0 {
                report.error(expression.span, ValueMessage::TimeDivisor);
                return None;
            }
            Signal::Power(Box::new(inner(base)?), *exponent)
        }
        ExpressionKind::Negative(value) => {
            let minus = Signal::Atom(SignalAtom::Constant(Quantity::integer(-1)));
            Signal::Product(vec![minus, inner(value)?])
        }
        ExpressionKind::Call { function, argument } => {
            let argument = inner(argument);
            let name = function.to_string();
            let Some(known) = TimeFunction::named(&name) else {
                let nearest = nearest(&name, &TimeFunction::ALL.map(TimeFunction::name));
                let span = function.span();
                report.error(span, ValueMessage::DriveFunction { name, nearest });
                return None;
            };
            Signal::Atom(SignalAtom::Function(known, Box::new(argument?)))
        }
    })
}

/// Returns the reciprocal of the product of all divisors, or an empty list without divisors.
/// Divisors do not depend on time, so that the drive is finite at all times.
fn divisor(
    divisors: &[Expression],
    usage: &Usage<'_>,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Option<Signal>> {
    let mut product = Quantity::integer(1);
    for divisor in divisors {
        if !is_plain(divisor) {
            report.error(divisor.span, ValueMessage::TimeDivisor);
            return None;
        }
        let value = values.operand(divisor, usage, report)?;
        let Ok(quotient) = product.divided_by(value) else {
            report.error(divisor.span, ValueMessage::DivisionByZero);
            return None;
        };
        product = values.accept(quotient, &part_of(usage), divisor.span, report)?;
    }
    Some((!divisors.is_empty()).then_some(Signal::Atom(SignalAtom::Constant(product))))
}

impl<V> Drive<V> {
    /// Returns the drive with `formed` applied to every constant.
    pub fn map<W>(&self, formed: &impl Fn(&V) -> W) -> Drive<W> {
        let map = |part: &Option<Signal<V>>| part.as_ref().map(|signal| signal.map(formed));
        Drive {
            torque: map(&self.torque),
            x: map(&self.x),
            y: map(&self.y),
        }
    }
}

impl<V> Signal<V> {
    /// Returns the function with `formed` applied to every constant.
    pub fn map<W>(&self, formed: &impl Fn(&V) -> W) -> Signal<W> {
        self.substitute(&|atom| {
            Signal::Atom(match atom {
                SignalAtom::Constant(value) => SignalAtom::Constant(formed(value)),
                SignalAtom::Time => SignalAtom::Time,
                SignalAtom::Function(function, angle) => {
                    SignalAtom::Function(*function, Box::new(angle.map(formed)))
                }
            })
        })
    }
}

impl Drive {
    /// Returns the parts that the drive has, each with its name and unit.
    pub fn parts(&self) -> impl Iterator<Item = (&'static str, &Signal, &'static str)> {
        let parts = [
            ("torque", &self.torque, "N m"),
            ("x", &self.x, "m"),
            ("y", &self.y, "m"),
        ];
        parts
            .into_iter()
            .filter_map(|(name, signal, unit)| Some((name, signal.as_ref()?, unit)))
    }
}
