//! Observables: quantities of the user's own in the symbols of the scene.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use super::names::{check_observable, irrational};
use super::symbols::{Meaning, ObservableSymbols};
use super::values::{message_for, unrepresentable};
use super::{Quantity, Scene};
use crate::description::{self, Expression, ExpressionKind};
use crate::functions::is_method;
use crate::named_members::named_members;
use crate::report::{Faults, Message, OutputMessage, TreeMessage, ValueMessage, nearest};

/// A quantity that the description defines by an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Snake-case name; its functions are called after it.
    pub name: String,
    /// Its definition.
    pub value: Observed,
}

/// An expression in the symbols of the scene. No divisor is identically zero.
#[derive(Debug, Clone, PartialEq)]
pub enum Observed {
    /// Numbers, parameters, gravity, and what is formed of them.
    Known(Quantity),
    /// A quantity that moves.
    Variable(Variable),
    /// A constant of the model, by its name there; one that the model does not
    /// have is zero.
    Constant(String),
    /// Kinetic energy, J.
    KineticEnergy,
    /// Potential energy, J.
    PotentialEnergy,
    /// A sum.
    Sum(Vec<Observed>),
    /// A product.
    Product(Vec<Observed>),
    /// Dividend and divisor.
    Quotient(Box<Observed>, Box<Observed>),
    /// An integer power.
    Power(Box<Observed>, i32),
    /// The opposite.
    Negative(Box<Observed>),
    /// A function of a value.
    Call(Function, Box<Observed>),
}

/// A coordinate, or its velocity or momentum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Name as the user writes it: `theta_child_1`, `p_d`.
    pub name: String,
    /// Angle, velocity or momentum of the coordinate.
    pub kind: VariableKind,
    /// The coordinate.
    pub coordinate: CoordinateIndex,
}

/// Kind of a [`Variable`] of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableKind {
    /// The coordinate itself, rad.
    Angle,
    /// Its velocity, rad/s.
    Velocity,
    /// The momentum that belongs to it, kg m²/s.
    Momentum,
}

/// A generalized coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateIndex {
    /// The absolute angle of the link with that index.
    Absolute(usize),
    /// The symmetric coordinate with that index.
    Symmetric(usize),
}

named_members! {
    /// Functions of observables.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Function {
        /// Sine.
        Sin = "sin",
        /// Cosine.
        Cos = "cos",
        /// Square root.
        Sqrt = "sqrt",
    }
}

impl Observed {
    /// Returns true if a variable that only the symmetric coordinates have
    /// occurs.
    pub fn is_symmetric(&self) -> bool {
        match self {
            Self::Variable(variable) => {
                matches!(variable.coordinate, CoordinateIndex::Symmetric(_))
            }
            Self::Known(_) | Self::Constant(_) | Self::KineticEnergy | Self::PotentialEnergy => {
                false
            }
            Self::Sum(parts) | Self::Product(parts) => parts.iter().any(Self::is_symmetric),
            Self::Quotient(a, b) => a.is_symmetric() || b.is_symmetric(),
            Self::Power(inner, _) | Self::Negative(inner) | Self::Call(_, inner) => {
                inner.is_symmetric()
            }
        }
    }
}

named_members! {
    /// Quantity that a function gives of an observable. Names are ends of the names of
    /// functions.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ObservableForm {
        /// F from coordinates and velocities.
        Value = "",
        /// dF/dt from coordinates and velocities.
        Rate = "_rate",
        /// The part of dF/dt that is friction and drag.
        FrictionRate = "_friction_rate",
        /// F from coordinates and momenta.
        FromMomenta = "_from_momenta",
        /// dF/dt from coordinates and momenta.
        RateFromMomenta = "_rate_from_momenta",
    }
}

impl ObservableForm {
    /// Returns true if it is a rate by all forces.
    pub fn is_rate(self) -> bool {
        matches!(self, Self::Rate | Self::RateFromMomenta)
    }

    /// Returns true if momenta are handed over.
    pub fn is_from_momenta(self) -> bool {
        matches!(self, Self::FromMomenta | Self::RateFromMomenta)
    }
}

/// Adds the observables to the scene, whose tree is complete; what is wrong
/// goes to `report`. `owners` holds the names of links, orbits and groups.
pub(super) fn resolve_observables(
    observables: &[description::ObservableClause],
    scene: &mut Scene,
    owners: &BTreeMap<String, usize>,
    report: &mut Faults,
) {
    if observables.is_empty() {
        return;
    }
    let symbols = ObservableSymbols::of(scene);
    let mut names = BTreeSet::new();
    let mut functions = BTreeSet::new();
    for observable in observables {
        let name = &observable.name;
        let text = name.to_string();
        let taken = owners.contains_key(&text)
            || scene.parameters.iter().any(|known| known.name == text)
            || symbols.is_variable(&text)
            || !names.insert(text.clone());
        let named = check_observable(name, report).is_some();
        if taken {
            let name = text.clone();
            report.error(observable.name.span(), TreeMessage::DuplicateName { name });
        }
        let named = named && !taken && check_functions(name, &symbols, &mut functions, report);
        let value = evaluate(&observable.value, &symbols, report);
        if let (true, Some(value)) = (named, value) {
            scene.requests.symmetric |= value.is_symmetric();
            scene.observables.push(Observable { name: text, value });
        }
    }
}

/// Checks that none of the observable's functions exists already.
fn check_functions(
    name: &Ident,
    symbols: &ObservableSymbols,
    functions: &mut BTreeSet<String>,
    report: &mut Faults,
) -> bool {
    for form in ObservableForm::ALL {
        let function = format!("{name}{}", form.name());
        let taken = is_method(&function)
            || symbols.is_constant(&function)
            || !functions.insert(function.clone());
        if taken {
            let message = OutputMessage::FunctionTaken {
                name: name.to_string(),
                function,
            };
            report.error(name.span(), message);
            return false;
        }
    }
    true
}

/// The value of an expression; `None` after reporting what is wrong.
fn evaluate(
    expression: &Expression,
    symbols: &ObservableSymbols,
    report: &mut Faults,
) -> Option<Observed> {
    let value = match &expression.kind {
        ExpressionKind::Number(number) => Observed::Known(Quantity::Exact(number.clone())),
        ExpressionKind::Name(name) => symbol(name, symbols, report)?,
        ExpressionKind::Sum(members) => {
            let members = all(members, symbols, report)?;
            match known(&members) {
                Some(members) => Observed::Known(Quantity::sum(members)),
                None => Observed::Sum(members),
            }
        }
        ExpressionKind::Product { factors, divisors } => {
            let above = all(factors, symbols, report);
            let below = all(divisors, symbols, report);
            quotient(expression, divisors, above?, below?, report)?
        }
        ExpressionKind::Power(base, exponent) => {
            let value = evaluate(base, symbols, report)?;
            if *exponent < 0 && value.is_zero() {
                report.error(base.span, ValueMessage::DivisionByZero);
                return None;
            }
            match value {
                Observed::Known(value) => match value.power(*exponent) {
                    Ok(value) => Observed::Known(value),
                    Err(error) => {
                        report.error(expression.span, message_for(error));
                        return None;
                    }
                },
                value => Observed::Power(Box::new(value), *exponent),
            }
        }
        ExpressionKind::Negative(value) => match evaluate(value, symbols, report)? {
            Observed::Known(value) => Observed::Known(value.negative()),
            value => Observed::Negative(Box::new(value)),
        },
        ExpressionKind::Call { function, argument } => {
            let name = function.to_string();
            let mut functions = Function::ALL.into_iter();
            let known = functions.find(|known| known.name() == name);
            let value = evaluate(argument, symbols, report);
            let Some(known) = known else {
                let known = Function::ALL.map(Function::name).to_vec();
                report.error(
                    function.span(),
                    OutputMessage::UnknownFunction { name, known },
                );
                return None;
            };
            let value = value?;
            if let (Function::Sqrt, Observed::Known(Quantity::Exact(number))) = (known, &value)
                && number.is_negative()
            {
                let message = ValueMessage::Negative {
                    what: "argument of `sqrt`".to_owned(),
                    value: number.to_string(),
                };
                report.error(argument.span, message);
                return None;
            }
            Observed::Call(known, Box::new(value))
        }
    };
    if let Observed::Known(quantity) = &value
        && let Some(message) = unrepresentable(quantity)
    {
        report.error(expression.span, message);
        return None;
    }
    if value.is_out_of_range() {
        report.error(expression.span, ValueMessage::NumberRange);
        return None;
    }
    Some(value)
}

/// The product of `above` divided by that of `below`.
fn quotient(
    expression: &Expression,
    divisors: &[Expression],
    above: Vec<Observed>,
    below: Vec<Observed>,
    report: &mut Faults,
) -> Option<Observed> {
    if let Some(at) = below.iter().position(Observed::is_zero) {
        let span = divisors.get(at).map_or(expression.span, |zero| zero.span);
        report.error(span, ValueMessage::DivisionByZero);
        return None;
    }
    if let (Some(above), Some(below)) = (known(&above), known(&below)) {
        return match Quantity::product(above).divided_by(Quantity::product(below)) {
            Ok(value) => Some(Observed::Known(value)),
            Err(error) => {
                report.error(expression.span, message_for(error));
                None
            }
        };
    }
    let product = |mut factors: Vec<Observed>| match (factors.pop(), factors.is_empty()) {
        (Some(only), true) => only,
        (last, _) => {
            factors.extend(last);
            Observed::Product(factors)
        }
    };
    let empty = below.is_empty();
    let (above, below) = (product(above), product(below));
    Some(match empty {
        true => above,
        false => Observed::Quotient(Box::new(above), Box::new(below)),
    })
}

/// Values of several expressions, all of them looked at even if one is wrong.
fn all(
    expressions: &[Expression],
    symbols: &ObservableSymbols,
    report: &mut Faults,
) -> Option<Vec<Observed>> {
    let values: Vec<Option<Observed>> = expressions
        .iter()
        .map(|expression| evaluate(expression, symbols, report))
        .collect();
    values.into_iter().collect()
}

/// The values as quantities, if none of them moves.
fn known(values: &[Observed]) -> Option<Vec<Quantity>> {
    let quantity = |value: &Observed| match value {
        Observed::Known(quantity) => Some(quantity.clone()),
        _ => None,
    };
    values.iter().map(quantity).collect()
}

fn symbol(name: &Ident, symbols: &ObservableSymbols, report: &mut Faults) -> Option<Observed> {
    let text = name.to_string();
    let message = match symbols.get(&text) {
        Some(Meaning::One(value)) => return Some(value.clone()),
        Some(Meaning::Several) => OutputMessage::AmbiguousSymbol { name: text }.into(),
        None => irrational(&text).map_or_else(
            || {
                Message::from(OutputMessage::UnknownSymbol {
                    nearest: nearest(&text, &symbols.names()).map(str::to_owned),
                    name: text.clone(),
                    example: symbols.example().to_owned(),
                })
            },
            Message::from,
        ),
    };
    report.error(name.span(), message);
    None
}
