//! Definitions of symbols in a derivation, except constants, sines and cosines: functions of time,
//! relative angles and rates, lines of straight springs, functions of whole expressions, and
//! friction torques.

use super::algebra::Formula;
use super::expression::{Expr, SymbolId};
use crate::scene::{FrictionContact, Function, LinkId, LinkPair, SpringLine};
use std::collections::BTreeMap;

/// Definition of a symbol that depends only on time.
#[derive(Clone, Debug, PartialEq)]
pub enum Temporal<F = Expr> {
    /// Time, in s.
    Time,
    /// Sine of a function of time.
    Sin(F),
    /// Cosine of a function of time.
    Cos(F),
    /// A named function of time.
    Given(F),
}

/// Symbols that depend only on time, during the derivation.
pub(super) struct DerivedDrive {
    pub(super) temporal: BTreeMap<SymbolId, Temporal<Formula>>,
    /// Sine and cosine of each argument.
    pub(super) rotations: Vec<(Formula, SymbolId, SymbolId)>,
    pub(super) torque: Option<SymbolId>,
    pub(super) pivot: Vec<DerivedMotion>,
    pub(super) friction: Formula,
}

/// A [`PivotMotion`] during the derivation.
pub(super) struct DerivedMotion {
    pub(super) name: &'static str,
    pub(super) position: Formula,
    pub(super) acceleration: Option<SymbolId>,
    pub(super) inner_acceleration: Formula,
}

impl Default for DerivedDrive {
    fn default() -> Self {
        Self {
            temporal: BTreeMap::new(),
            rotations: Vec::new(),
            torque: None,
            pivot: Vec::new(),
            friction: Formula::zero(),
        }
    }
}

impl DerivedDrive {
    /// Records the power −2 R − Σ D w of friction, given the terms of Rayleigh's function R and the
    /// products D w of torques and rates. The squares are not multiplied out, so that rounding
    /// cannot change the sign of the power.
    pub(super) fn note_friction(&mut self, dissipation: &[Formula], work: &[Formula]) {
        let minus_two = Formula::integer(-2);
        let viscous = dissipation.iter().map(|term| &minus_two * term);
        self.friction = viscous.chain(work.iter().map(|work| -work.clone())).sum();
    }
}

/// A relative quantity: the difference of two links' angles minus their spring's rest angle, or the
/// difference of two rates. The links are a link and its parent, or two links that a spring-damper
/// connects. In other coordinates it is a sum of these.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDifference<F = Expr> {
    /// Angles or rates with their weights. In a joint the link's own symbol comes first.
    pub terms: Vec<(SymbolId, i64)>,
    /// Rest angle of the spring; zero for rates.
    pub rest: F,
}

impl<F> JointDifference<F> {
    /// Creates the difference between the link's own symbol and that of the other link; `other` is
    /// `None` for the ground.
    pub(super) fn of_links(own: SymbolId, other: Option<SymbolId>, rest: F) -> Self {
        let other = other.map(|other| (other, -1));
        Self {
            terms: std::iter::once((own, 1)).chain(other).collect(),
            rest,
        }
    }

    /// Returns the symbol of the link itself.
    pub(super) fn own(&self) -> Option<SymbolId> {
        self.terms.first().map(|(own, _)| *own)
    }
}

impl JointDifference<Formula> {
    /// Returns the derivative of the difference by an angle or a rate.
    pub(super) fn slope(&self, symbol: SymbolId) -> Option<Formula> {
        let found = self.terms.iter().find(|(known, _)| *known == symbol);
        found.map(|(_, weight)| Formula::integer(*weight))
    }

    /// Returns the difference as a formula in the symbols of angles or rates.
    pub(super) fn written_out(&self) -> Formula {
        let terms = self.terms.iter();
        let terms = terms.map(|&(id, weight)| &Formula::integer(weight) * &Formula::symbol(id));
        &terms.sum::<Formula>() - &self.rest
    }
}

impl JointDifference {
    /// Returns the difference as a formula, in the order in which it is computed.
    pub fn formula(&self) -> Expr {
        let times = |weight: i64, expr: Expr| match weight {
            1 => expr,
            _ => Expr::Product(vec![Expr::Number(weight.into()), expr]),
        };
        let terms = self.terms.iter();
        let terms = terms.map(|&(id, weight)| times(weight, Expr::Symbol(id)));
        let rest = (!self.rest.is_zero()).then(|| times(-1, self.rest.clone()));
        Expr::Sum(terms.chain(rest).collect())
    }
}

/// Relative angle and rate of two links, if other quantities depend on them.
pub(super) struct PairDifferences {
    pub(super) pair: LinkPair,
    /// Relative angle minus rest angle, θ_a − θ_b − ρ.
    pub(super) angle: Option<Formula>,
    /// Relative rate, ω_a − ω_b.
    pub(super) rate: Option<Formula>,
}

impl PairDifferences {
    pub(super) fn of(pair: LinkPair) -> Self {
        Self {
            pair,
            angle: None,
            rate: None,
        }
    }
}

/// Definition of a symbol of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum LineMeaning<F = Expr> {
    /// A formula in other symbols.
    Formula(F),
    /// The square root of a formula.
    Root {
        /// The formula under the square root.
        square: F,
        /// A symbol that is spelled as the root, for printed formulas.
        shown: SymbolId,
    },
}

/// A symbol of a line during the derivation.
pub(super) struct DerivedLineSymbol {
    pub(super) meaning: LineMeaning<Formula>,
    /// Coordinates that the symbol depends on.
    pub(super) coordinates: Vec<SymbolId>,
}

/// A line during the derivation.
pub(super) struct DerivedLine {
    pub(super) line: SpringLine,
    pub(super) names: Vec<String>,
    pub(super) offset: [SymbolId; 2],
    /// Angles of the links that have arms. (An arm is a vector fixed to a link; the line is the sum
    /// of all arms.)
    pub(super) coordinates: Vec<SymbolId>,
    /// Moments N_i = Δ·∂Δ/∂θ_i, one per arm.
    pub(super) moments: Vec<SymbolId>,
    /// Length ℓ, and its slopes J_i = ∂ℓ/∂θ_i, one per arm.
    pub(super) length: Option<(SymbolId, Vec<SymbolId>)>,
    /// Pulls and slopes of the terms of the potential energy and of the damper.
    pub(super) pulls: Vec<(Formula, Vec<SymbolId>)>,
}

/// Lines of straight springs during the derivation.
pub(super) struct DerivedLines {
    pub(super) list: Vec<DerivedLine>,
    pub(super) symbols: BTreeMap<SymbolId, DerivedLineSymbol>,
    /// Potential energy of all lines.
    pub(super) energy: Formula,
    /// Terms of Rayleigh's function from straight dampers.
    pub(super) losses: Vec<Formula>,
}

/// Creates a derivation without lines.
impl Default for DerivedLines {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            symbols: BTreeMap::new(),
            energy: Formula::zero(),
            losses: Vec::new(),
        }
    }
}

impl LineMeaning {
    /// Returns the definition as a formula for printing.
    pub fn formula(&self) -> Expr {
        match self {
            Self::Formula(formula) => formula.clone(),
            Self::Root { shown, .. } => Expr::Symbol(*shown),
        }
    }
}

/// Definition of a symbol that is a function of an expression.
pub(super) struct CompositeObservable {
    pub(super) function: Function,
    pub(super) argument: Formula,
    /// The cosine that has the same argument as a sine, or the sine that has the same argument as a
    /// cosine; for a root, the symbol itself.
    pub(super) partner: SymbolId,
}

/// A friction torque during the derivation.
#[derive(Clone)]
pub(super) struct DerivedTorque {
    pub(super) symbol: SymbolId,
    pub(super) slopes: [SymbolId; 2],
    pub(super) place: FrictionContact,
    pub(super) source: DerivedSource,
}

#[derive(Clone)]
pub(super) enum DerivedSource {
    Link {
        link: LinkId,
        rate: Formula,
    },
    /// Between two links that are not parent and child, with the index of their pair.
    Pair {
        number: usize,
        rate: Formula,
    },
    Coordinate(usize),
}

impl DerivedTorque {
    /// Returns the product D w of the torque and the rate of a link.
    pub(super) fn work(&self) -> Option<Formula> {
        match &self.source {
            DerivedSource::Link { rate, .. } | DerivedSource::Pair { rate, .. } => {
                Some(&Formula::symbol(self.symbol) * rate)
            }
            DerivedSource::Coordinate(_) => None,
        }
    }

    /// Returns the torque with its rate expressed by other symbols.
    pub(super) fn substitute(&self, replacements: &[(SymbolId, Formula)]) -> Self {
        let mut torque = self.clone();
        if let DerivedSource::Link { rate, .. } | DerivedSource::Pair { rate, .. } =
            &mut torque.source
        {
            *rate = rate.substitute(replacements).expand();
        }
        torque
    }
}
