//! Resolves the clauses of `observe(...)` to observables.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use super::names::{check_observable, irrational};
use super::observed::ObservedAtom::Known;
use super::observed::{Function, Observable, Observed, ObservedAtom};
use super::symbols::{Meaning, ObservableSymbols};
use super::values::{all, message_for, unrepresentable};
use super::{Quantity, Scene};
use crate::description::{self, Expression, ExpressionKind};
use crate::exact::ExactError;
use crate::functions::{ObservableForm, is_method};
use crate::report::{Faults, Message, OutputMessage, TreeMessage, ValueMessage, nearest};

/// Adds the observables to the scene, whose tree is complete. Adds mistakes to `report`. `owners`
/// holds the names of links, orbits (sets of equal copies of one link) and groups.
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
        let gradient = scene.requests.gradient.as_ref();
        let has_gradient = gradient.is_some_and(|all| all.observables.contains(&text));
        let endings: &[&str] = match has_gradient {
            true => &["", "_gradient"],
            false => &[""],
        };
        let named =
            named && !taken && check_functions(name, endings, &symbols, &mut functions, report);
        let value = evaluate(&observable.value, &symbols, report);
        if let (true, Some(value)) = (named, value) {
            scene.requests.symmetric |= value.is_symmetric();
            scene.observables.push(Observable { name: text, value });
        }
    }
}

/// Checks that the names of the observable's functions are not yet used. `endings` are those of its
/// functions of each form.
fn check_functions(
    name: &Ident,
    endings: &[&str],
    symbols: &ObservableSymbols,
    functions: &mut BTreeSet<String>,
    report: &mut Faults,
) -> bool {
    let forms = ObservableForm::ALL.into_iter();
    let all = forms.flat_map(|form| endings.iter().map(move |ending| (form, ending)));
    for (form, ending) in all {
        let function = format!("{name}{}{ending}", form.name());
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

/// Evaluates an expression of an observable; returns `None` after reporting a mistake.
fn evaluate(
    expression: &Expression,
    symbols: &ObservableSymbols,
    report: &mut Faults,
) -> Option<Observed> {
    let mut values =
        |parts: &[Expression]| all(parts.iter().map(|part| evaluate(part, symbols, report)));
    let value = match &expression.kind {
        ExpressionKind::Number(number) => Ok(Observed::known(Quantity::number(number.clone()))),
        ExpressionKind::Name(name) => Ok(symbol(name, symbols, report)?),
        ExpressionKind::Sum(members) => {
            let members = values(members)?;
            Ok(match known(&members) {
                Some(members) => Observed::known(Quantity::sum(members)),
                None => Observed::Sum(members),
            })
        }
        ExpressionKind::Product { factors, divisors } => {
            let (above, below) = (values(factors), values(divisors));
            let (above, below) = (above?, below?);
            if let Some(at) = below.iter().position(Observed::is_zero) {
                let span = divisors.get(at).map_or(expression.span, |zero| zero.span);
                report.error(span, ValueMessage::DivisionByZero);
                return None;
            }
            quotient(above, below)
        }
        ExpressionKind::Power(base, exponent) => {
            let value = evaluate(base, symbols, report)?;
            if *exponent < 0 && value.is_zero() {
                report.error(base.span, ValueMessage::DivisionByZero);
                return None;
            }
            match value {
                Observed::Atom(Known(value)) => value.power(*exponent).map(Observed::known),
                value => Ok(Observed::Power(Box::new(value), *exponent)),
            }
        }
        ExpressionKind::Negative(value) => Ok(match evaluate(value, symbols, report)? {
            Observed::Atom(Known(value)) => Observed::known(value.negative()),
            value => Observed::Negative(Box::new(value)),
        }),
        ExpressionKind::Call { function, argument } => {
            Ok(call(function, argument, symbols, report)?)
        }
    };
    let message = match value {
        Ok(value) => match value.quantity().and_then(unrepresentable) {
            Some(message) => message,
            None if value.is_out_of_range() => ValueMessage::NumberRange,
            None => return Some(value),
        },
        Err(error) => message_for(error),
    };
    report.error(expression.span, message);
    None
}

/// Evaluates a function call.
fn call(
    function: &Ident,
    argument: &Expression,
    symbols: &ObservableSymbols,
    report: &mut Faults,
) -> Option<Observed> {
    let name = function.to_string();
    let value = evaluate(argument, symbols, report);
    let Some(known) = Function::named(&name) else {
        let known = Function::ALL.map(Function::name).to_vec();
        let message = OutputMessage::UnknownFunction { name, known };
        report.error(function.span(), message);
        return None;
    };
    let value = value?;
    if known == Function::Sqrt
        && let Some(number) = value.quantity().and_then(Quantity::exact)
        && number.is_negative()
    {
        let message = ValueMessage::Negative {
            what: "argument of `sqrt`".to_owned(),
            value: number.to_string(),
        };
        report.error(argument.span, message);
        return None;
    }
    Some(Observed::Atom(ObservedAtom::Call(known, Box::new(value))))
}

/// Returns the product of all `above` divided by the product of all `below`.
fn quotient(above: Vec<Observed>, below: Vec<Observed>) -> Result<Observed, ExactError> {
    if let (Some(above), Some(below)) = (known(&above), known(&below)) {
        let quotient = Quantity::product(above).divided_by(Quantity::product(below));
        return quotient.map(Observed::known);
    }
    let product = |mut factors: Vec<Observed>| match (factors.pop(), factors.is_empty()) {
        (Some(only), true) => only,
        (last, _) => {
            factors.extend(last);
            Observed::Product(factors)
        }
    };
    Ok(match below.is_empty() {
        true => product(above),
        false => Observed::Quotient(Box::new(product(above)), Box::new(product(below))),
    })
}

/// Returns the values as quantities; `None` if one of them depends on the motion.
fn known(values: &[Observed]) -> Option<Vec<Quantity>> {
    let quantities = values.iter().map(|value| value.quantity().cloned());
    quantities.collect()
}

fn symbol(name: &Ident, symbols: &ObservableSymbols, report: &mut Faults) -> Option<Observed> {
    let text = name.to_string();
    let message = match symbols.get(&text) {
        Some(Meaning::One(atom)) => return Some(Observed::Atom(atom.clone())),
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
