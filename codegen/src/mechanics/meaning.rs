//! Meanings of symbols in a derivation, beside constants and sines and cosines: functions of
//! time, differences in joints, lines of straight springs, functions of whole expressions, braking torques.

use super::algebra::Formula;
use super::expression::{Expr, SymbolId};
use crate::scene::{FrictionPlace, Function, LinkId, LinkPair, SpringLine};
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

/// The difference of two links' angles, less the one at which their spring is at rest, or of
/// their rates: of a link and its parent in a joint, of others between which something acts. Also
/// the same in other coordinates, a sum of these.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDifference<F = Expr> {
    /// Angles or rates with their weights. Of a joint the link's own comes first.
    pub terms: Vec<(SymbolId, i64)>,
    /// The angle at which the spring is at rest, zero of rates.
    pub rest: F,
}

impl<F> JointDifference<F> {
    /// A link's own less that of another one, if it is not the ground.
    pub(super) fn of_links(own: SymbolId, other: Option<SymbolId>, rest: F) -> Self {
        let other = other.map(|other| (other, -1));
        Self {
            terms: std::iter::once((own, 1)).chain(other).collect(),
            rest,
        }
    }

    /// The link's own.
    pub(super) fn own(&self) -> Option<SymbolId> {
        self.terms.first().map(|(own, _)| *own)
    }
}

impl JointDifference<Formula> {
    /// The derivative by an angle or a rate.
    pub(super) fn slope(&self, symbol: SymbolId) -> Option<Formula> {
        let found = self.terms.iter().find(|(known, _)| *known == symbol);
        found.map(|(_, weight)| Formula::integer(*weight))
    }

    /// The difference written out.
    pub(super) fn written_out(&self) -> Formula {
        let terms = self.terms.iter();
        let terms = terms.map(|&(id, weight)| &Formula::integer(weight) * &Formula::symbol(id));
        &terms.sum::<Formula>() - &self.rest
    }
}

impl JointDifference {
    /// The difference as a formula, in the order in which it is computed.
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

/// Differences of the angles and the rates of two links, as far as anything depends on them.
pub(super) struct PairDifferences {
    pub(super) pair: LinkPair,
    /// θ_a − θ_b − ρ.
    pub(super) angle: Option<Formula>,
    /// ω_a − ω_b.
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

/// Meaning of a symbol of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum LineMeaning<F = Expr> {
    /// A formula in other symbols.
    Formula(F),
    /// The root of a formula.
    Root {
        /// The formula.
        square: F,
        /// A symbol that is spelt as the root, for formulas alone.
        shown: SymbolId,
    },
}

/// A symbol of a line while it is derived.
pub(super) struct DerivedLineSymbol {
    pub(super) meaning: LineMeaning<Formula>,
    /// The coordinates that it depends on.
    pub(super) coordinates: Vec<SymbolId>,
}

/// A line while it is derived.
pub(super) struct DerivedLine {
    pub(super) line: SpringLine,
    pub(super) names: Vec<String>,
    pub(super) offset: [SymbolId; 2],
    /// The coordinates of the links that have arms.
    pub(super) coordinates: Vec<SymbolId>,
    /// N_i of the arms.
    pub(super) moments: Vec<SymbolId>,
    /// ℓ, and J_i of the arms.
    pub(super) length: Option<(SymbolId, Vec<SymbolId>)>,
    /// Pulls and slopes of what stores energy, and of the damper.
    pub(super) pulls: Vec<(Formula, Vec<SymbolId>)>,
}

/// Lines of straight springs while they are derived.
pub(super) struct DerivedLines {
    pub(super) list: Vec<DerivedLine>,
    pub(super) symbols: BTreeMap<SymbolId, DerivedLineSymbol>,
    /// Energy that all lines store.
    pub(super) energy: Formula,
    /// Terms of Rayleigh's function of straight dampers.
    pub(super) losses: Vec<Formula>,
}

/// None.
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
    /// The meaning as a formula for people.
    pub fn formula(&self) -> Expr {
        match self {
            Self::Formula(formula) => formula.clone(),
            Self::Root { shown, .. } => Expr::Symbol(*shown),
        }
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
    Link {
        link: LinkId,
        rate: Formula,
    },
    /// Of two links that are not parent and child, by the number of their pair.
    Pair {
        number: usize,
        rate: Formula,
    },
    Coordinate(usize),
}

impl DerivedTorque {
    /// D w of a link.
    pub(super) fn work(&self) -> Option<Formula> {
        match &self.source {
            DerivedSource::Link { rate, .. } | DerivedSource::Pair { rate, .. } => {
                Some(&Formula::symbol(self.symbol) * rate)
            }
            DerivedSource::Coordinate(_) => None,
        }
    }

    /// The torque with its rate in other symbols.
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
