//! Meanings of symbols in a derivation, beside constants and sines and cosines: functions of
//! time, differences in joints, functions of whole expressions, braking torques.

use super::algebra::Formula;
use super::expression::{Expr, SymbolId};
use crate::scene::{FrictionPlace, Function, LinkId};
use std::collections::BTreeMap;

/// Meaning of a symbol that depends on time alone.
#[derive(Clone, Debug, PartialEq)]
pub enum Temporal<F = Expr> {
    /// Time itself, s.
    Time,
    /// Sine of a function of time.
    Sin(F),
    /// Cosine of a function of time.
    Cos(F),
    /// A function of time with a name.
    Given(F),
}

/// Symbols that depend on time alone, while they are derived.
pub(super) struct DerivedDrive {
    pub(super) temporal: BTreeMap<SymbolId, Temporal<Formula>>,
    /// Sine and cosine of each argument.
    pub(super) rotations: Vec<(Formula, SymbolId, SymbolId)>,
    pub(super) torque: Option<SymbolId>,
    pub(super) pivot: Vec<DerivedMotion>,
    pub(super) friction: Formula,
}

/// A [`PivotMotion`] while it is derived.
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
    /// Notes −2 R − Σ D w, given the terms of R and the products D w: left as squares, so
    /// that no rounding turns its sign.
    pub(super) fn note_friction(&mut self, dissipation: &[Formula], work: &[Formula]) {
        let minus_two = Formula::integer(-2);
        let viscous = dissipation.iter().map(|term| &minus_two * term);
        self.friction = viscous.chain(work.iter().map(|work| -work.clone())).sum();
    }
}

/// A link's angle less its parent's, and less the one at which the spring is at rest; or the
/// rate of the joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDifference<F = Expr> {
    /// The link's own angle or rate.
    pub own: SymbolId,
    /// The parent's.
    pub parent: Option<SymbolId>,
    /// The angle at which the spring is at rest, zero of rates.
    pub rest: F,
}

impl JointDifference<Formula> {
    /// The derivative by an angle or a rate.
    pub(super) fn slope(&self, symbol: SymbolId) -> Option<Formula> {
        match symbol {
            own if own == self.own => Some(Formula::integer(1)),
            parent if Some(parent) == self.parent => Some(Formula::integer(-1)),
            _ => None,
        }
    }

    /// The difference written out.
    pub(super) fn written_out(&self) -> Formula {
        let parent = self.parent.map_or_else(Formula::zero, Formula::symbol);
        &(&Formula::symbol(self.own) - &parent) - &self.rest
    }
}

impl JointDifference {
    /// The difference as a formula, in the order in which it is computed.
    pub fn formula(&self) -> Expr {
        let minus = |expr: Expr| {
            let number = Expr::Number((-1_i64).into());
            Expr::Product(vec![number, expr])
        };
        let parent = self.parent.map(|parent| minus(Expr::Symbol(parent)));
        let rest = (!self.rest.is_zero()).then(|| minus(self.rest.clone()));
        let own = std::iter::once(Expr::Symbol(self.own));
        Expr::Sum(own.chain(parent).chain(rest).collect())
    }
}

/// Meaning of a symbol that stands for a function of an expression.
pub(super) struct CompositeObservable {
    pub(super) function: Function,
    pub(super) argument: Formula,
    /// The cosine that belongs to a sine, and the other way round; the symbol
    /// itself for a root.
    pub(super) partner: SymbolId,
}

/// A braking torque while it is derived.
#[derive(Clone)]
pub(super) struct DerivedTorque {
    pub(super) symbol: SymbolId,
    pub(super) slopes: [SymbolId; 2],
    pub(super) place: FrictionPlace,
    pub(super) source: DerivedSource,
}

#[derive(Clone)]
pub(super) enum DerivedSource {
    Link { link: LinkId, rate: Formula },
    Coordinate(usize),
}

impl DerivedTorque {
    /// D w of a link.
    pub(super) fn work(&self) -> Option<Formula> {
        match &self.source {
            DerivedSource::Link { rate, .. } => Some(&Formula::symbol(self.symbol) * rate),
            DerivedSource::Coordinate(_) => None,
        }
    }

    /// The torque with its rate in other symbols.
    pub(super) fn substitute(&self, replacements: &[(SymbolId, Formula)]) -> Self {
        let mut torque = self.clone();
        if let DerivedSource::Link { rate, .. } = &mut torque.source {
            *rate = rate.substitute(replacements).expand();
        }
        torque
    }
}
