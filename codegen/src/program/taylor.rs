//! The program behind the Taylor coefficients of the motion.
//!
//! The recurrences of the runtime know the equation of motion but for its
//! constants: mass matrix A cos(θ_i − θ_j) + B sin(θ_i − θ_j), its centrifugal
//! terms, and gravity. What else stands in it is a program of its own.

use super::entries::EntryList;
use super::lower::Door;
use super::{Argument, Purpose, Shape, ValueId, scale};
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, Role, SymbolId};
use crate::mechanics::{Frame, Mechanics, Trigonometric};

/// Outputs of the entry by their meaning; links in their order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaylorOutputs {
    /// sin θ.
    pub sines: Vec<ValueId>,
    /// cos θ.
    pub cosines: Vec<ValueId>,
    /// Diagonal of the mass matrix.
    pub inertias: Vec<ValueId>,
    /// Torque of gravity by the sine of the angle.
    pub weights: Vec<ValueId>,
    /// Torque of gravity by the cosine of the angle.
    pub lateral_weights: Vec<ValueId>,
    /// Rows and columns of the mass matrix outside its diagonal, with A and B.
    pub couplings: Vec<([usize; 2], [ValueId; 2])>,
    /// The rest of the equation of motion.
    pub bias: Vec<ValueId>,
}

impl TaylorOutputs {
    /// The outputs of the entry taken apart: `links` of each kind, then the
    /// couplings between `pairs`, then the rest.
    pub(crate) fn of_outputs(outputs: &[ValueId], frame: &Frame) -> Self {
        let links = frame.coordinates.len();
        let pairs = couplings(frame);
        let mut outputs = outputs.iter().copied();
        let mut take = |count: usize| outputs.by_ref().take(count).collect::<Vec<_>>();
        let [sines, cosines, inertias, weights, lateral_weights, bias] =
            std::array::from_fn(|_| take(links));
        let values = take(2 * pairs.len());
        let couplings = pairs
            .iter()
            .zip(values.chunks_exact(2))
            .map(|(&(row, column, _), pair)| ([row, column], [pair[0], pair[1]]))
            .collect();
        Self {
            sines,
            cosines,
            inertias,
            weights,
            lateral_weights,
            couplings,
            bias,
        }
    }

    fn outputs(&self) -> Vec<ValueId> {
        let Self {
            sines,
            cosines,
            inertias,
            weights,
            lateral_weights,
            couplings,
            bias,
        } = self;
        let lists = [sines, cosines, inertias, weights, lateral_weights, bias];
        let couplings = couplings.iter().flat_map(|(_, pair)| pair);
        lists
            .into_iter()
            .flatten()
            .chain(couplings)
            .copied()
            .collect()
    }
}

/// Entries of the mass matrix outside its diagonal.
fn couplings(frame: &Frame) -> Vec<(usize, usize, &Expr)> {
    let entries = frame.mass.iter();
    let outside = entries.filter(|entry| entry.row != entry.column);
    outside
        .map(|entry| (entry.row, entry.column, &entry.value))
        .collect()
}

impl EntryList<'_, '_> {
    pub(super) fn taylor(&mut self, mechanics: &Mechanics) {
        let frame = &mechanics.absolute;
        let motion = self
            .entries
            .iter()
            .find(|entry| entry.purpose == Purpose::Accelerations);
        let Some(motion) = motion else {
            unreachable!("accelerations are always there");
        };
        let arguments = motion.arguments.clone();
        let mut door = Door::new(frame, Argument::Theta, Some(Argument::Omega), None);
        let zero = self.lowering.builder.integer(0);
        let links = frame.coordinates.len();
        let (mut sines, mut cosines) = (Vec::new(), Vec::new());
        for (link, name) in self.lowering.coordinate_names(frame).iter().enumerate() {
            let angle = self.lowering.builder.input(Argument::Theta, link);
            let (sine, cosine) = (
                self.lowering.builder.sin(angle),
                self.lowering.builder.cos(angle),
            );
            sines.push(self.lowering.builder.name(sine, &format!("sin_{name}")));
            cosines.push(self.lowering.builder.name(cosine, &format!("cos_{name}")));
        }
        let mut expansion = TaylorOutputs {
            sines,
            cosines,
            inertias: vec![zero; links],
            weights: vec![zero; links],
            lateral_weights: vec![zero; links],
            couplings: Vec::new(),
            bias: Vec::new(),
        };
        for entry in &frame.mass {
            if entry.row == entry.column {
                expansion.inertias[entry.row] = self.lowering.expr(&mut door, &entry.value);
            }
        }
        for (row, column, value) in couplings(frame) {
            let mut pair = [zero; 2];
            for term in value.terms() {
                let (place, constant) = match between(mechanics, frame, term, row, column) {
                    Some((Between::Cosine, constant)) => (0, constant),
                    Some((Between::Sine, constant)) => (1, constant),
                    None => unreachable!("an entry of the mass matrix is derived in this form"),
                };
                let constant = self.lowering.expr(&mut door, &constant);
                pair[place] = self.lowering.builder.add(pair[place], constant);
            }
            expansion.couplings.push(([row, column], pair));
        }
        for (link, bias) in frame.bias.iter().enumerate() {
            let mut rest = Vec::new();
            for term in bias.terms() {
                if is_centrifugal(mechanics, term) {
                    continue;
                }
                match gravity(mechanics, frame, term, link) {
                    Some((function, constant)) => {
                        let constant = self.lowering.expr(&mut door, &constant);
                        let place = match function {
                            Between::Sine => &mut expansion.weights[link],
                            Between::Cosine => &mut expansion.lateral_weights[link],
                        };
                        *place = self.lowering.builder.add(*place, constant);
                    }
                    None => rest.push(term.clone()),
                }
            }
            let rest = match rest.len() {
                0 => Expr::zero(),
                1 => rest.remove(0),
                _ => Expr::Sum(rest),
            };
            let rest = self.lowering.expr(&mut door, &rest);
            expansion.bias.push(rest);
        }
        self.normalize(&mut expansion);
        let mut outputs = expansion.outputs();
        // The recurrence of a sine or cosine needs both.
        let builder = &mut self.lowering.builder;
        for id in builder.needed(&expansion.bias) {
            outputs.extend(builder.partner(id));
        }
        self.push(
            "taylor_coefficients",
            Purpose::TaylorCoefficients,
            &arguments,
            outputs,
            Shape::Vector,
        );
    }
}

impl EntryList<'_, '_> {
    /// Multiplies the equation of motion by a factor, which changes nothing but
    /// rounding. Where its constants are known, by the one with which they round
    /// least; else it is divided by the moment of inertia of the last link: one
    /// rounded constant less is one error less in long motions.
    fn normalize(&mut self, expansion: &mut TaylorOutputs) {
        let factor = self.factor(expansion);
        let builder = &mut self.lowering.builder;
        let TaylorOutputs {
            sines: _,
            cosines: _,
            inertias,
            weights,
            lateral_weights,
            couplings,
            bias,
        } = expansion;
        let Some(&unit) = inertias.last() else {
            unreachable!("a tree has links");
        };
        let factor = factor.map(|factor| {
            // Products with it are called `inertia_parent_scaled`.
            let number = builder.number(factor);
            builder.called(number, "scaled")
        });
        let couplings = couplings.iter_mut().flat_map(|(_, pair)| pair);
        let constants = [inertias, weights, lateral_weights];
        let constants = constants.into_iter().flatten().chain(couplings);
        for value in constants.chain(bias) {
            *value = match factor {
                Some(factor) => builder.mul(*value, factor),
                None => builder.div(*value, unit),
            };
        }
    }

    /// The factor for constants that are all known.
    fn factor(&mut self, expansion: &TaylorOutputs) -> Option<Rational> {
        let builder = &mut self.lowering.builder;
        let couplings = &expansion.couplings;
        let pairs = couplings.iter().flat_map(|(_, pair)| pair);
        let lists = [
            &expansion.inertias,
            &expansion.weights,
            &expansion.lateral_weights,
        ];
        let mut exact = |id: &ValueId| builder.exact(*id);
        let constants = lists.into_iter().flatten().chain(pairs).map(&mut exact);
        let mut constants = constants.collect::<Option<Vec<_>>>()?;
        constants.retain(|constant| !constant.is_zero());
        // The elimination of a link without children divides by its inertia.
        let pairs = couplings.iter().map(|(links, _)| links);
        let parents: Vec<usize> = pairs.map(|[i, j]| *i.min(j)).collect();
        let links = expansion.inertias.iter().enumerate();
        let leaves = links.filter(|(link, _)| !parents.contains(link));
        let divisors = leaves
            .map(|(_, inertia)| exact(inertia))
            .collect::<Option<Vec<_>>>()?;
        scale::factor(&constants, &divisors)
    }
}

/// Function of an angle that multiplies a constant.
#[derive(Clone, Copy)]
enum Between {
    Cosine,
    Sine,
}

/// A term c cos(θ_i − θ_j) or c sin(θ_i − θ_j).
fn between(
    mechanics: &Mechanics,
    frame: &Frame,
    term: &Expr,
    row: usize,
    column: usize,
) -> Option<(Between, Expr)> {
    let (i, j) = (frame.coordinates[row], frame.coordinates[column]);
    constant_times(mechanics, term, |meaning| match meaning {
        Trigonometric::CosBetween(a, b) if [a, b] == [i, j] || [a, b] == [j, i] => {
            Some((Between::Cosine, false))
        }
        Trigonometric::SinBetween(a, b) if [a, b] == [i, j] => Some((Between::Sine, false)),
        Trigonometric::SinBetween(a, b) if [a, b] == [j, i] => Some((Between::Sine, true)),
        _ => None,
    })
}

/// A term c sin θ_i or c cos θ_i of the equation of link i.
fn gravity(
    mechanics: &Mechanics,
    frame: &Frame,
    term: &Expr,
    link: usize,
) -> Option<(Between, Expr)> {
    let angle = frame.coordinates[link];
    constant_times(mechanics, term, |meaning| match meaning {
        Trigonometric::Sin(a) if a == angle => Some((Between::Sine, false)),
        Trigonometric::Cos(a) if a == angle => Some((Between::Cosine, false)),
        _ => None,
    })
}

/// A term that is a constant times one function that `wanted` knows, perhaps
/// with the opposite sign.
fn constant_times(
    mechanics: &Mechanics,
    term: &Expr,
    wanted: impl Fn(Trigonometric) -> Option<(Between, bool)>,
) -> Option<(Between, Expr)> {
    let mut found = None;
    let mut constant = Vec::new();
    for factor in term.factors() {
        match factor {
            Expr::Symbol(symbol)
                if found.is_none() && role(mechanics, *symbol) == Role::Trigonometric =>
            {
                found = Some(wanted(mechanics.trigonometry[symbol])?);
            }
            other => {
                let mut is_constant = true;
                other.for_each_symbol(&mut |symbol| {
                    let role = role(mechanics, symbol);
                    is_constant &= matches!(role, Role::Parameter | Role::Constant);
                });
                if !is_constant {
                    return None;
                }
                constant.push(other.clone());
            }
        }
    }
    let (function, opposite) = found?;
    if opposite {
        constant.insert(0, Expr::Number((-1_i64).into()));
    }
    let constant = match constant.len() {
        0 => Expr::Number(1_i64.into()),
        1 => constant.remove(0),
        _ => Expr::Product(constant),
    };
    Some((function, constant))
}

/// Returns true if a term has the square of a velocity: the recurrences form
/// these with the mass matrix, of whose derivatives they are made.
fn is_centrifugal(mechanics: &Mechanics, term: &Expr) -> bool {
    term.factors().iter().any(|factor| match factor {
        Expr::Power(base, 2) => match base.as_ref() {
            Expr::Symbol(symbol) => role(mechanics, *symbol) == Role::Velocity,
            _ => false,
        },
        _ => false,
    })
}

fn role(mechanics: &Mechanics, symbol: SymbolId) -> Role {
    mechanics.symbols.get(symbol).role
}
