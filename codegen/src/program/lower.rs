//! Expressions become program values.
//!
//! A [`Door`] says what the caller hands over (angles and velocities, or
//! coordinates and momenta); a symbol that is not handed over is formed from
//! what is, when it is first needed.

use super::builder::Builder;
use super::constants::ConstantId;
use super::solve::Matrix;
use super::{Argument, ValueId};
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, Role, SymbolId};
use crate::mechanics::{
    CombinationId, Entry as MatrixEntry, Expansion, Frame, Mechanics, ObservableFrame,
    Trigonometric,
};
use std::collections::BTreeMap;

/// Lowering in progress.
#[derive(Clone)]
pub(super) struct Lowering<'a> {
    pub(super) mechanics: &'a Mechanics,
    pub(super) builder: Builder,
    pub(super) constants: BTreeMap<SymbolId, ConstantId>,
}

/// How symbols of one frame are supplied: handed over by the caller, or formed
/// on demand.
#[derive(Clone)]
pub(super) struct Door<'a> {
    pub(super) frame: &'a Frame,
    /// Argument that holds the coordinates.
    pub(super) coordinates: Argument,
    /// Argument that holds the velocities; solved from the momenta if none.
    pub(super) velocities: Option<Argument>,
    /// Argument that holds the momenta; formed from the velocities if none.
    pub(super) momenta: Option<Argument>,
    /// What observables refer to beside the frame.
    pub(super) observed: Option<&'a ObservableFrame>,
    values: BTreeMap<SymbolId, ValueId>,
}

impl<'a> Door<'a> {
    pub(super) fn new(
        frame: &'a Frame,
        coordinates: Argument,
        velocities: Option<Argument>,
        momenta: Option<Argument>,
    ) -> Self {
        Self {
            frame,
            coordinates,
            velocities,
            momenta,
            observed: None,
            values: BTreeMap::new(),
        }
    }

    /// Hands over the value of a symbol.
    pub(super) fn supply(&mut self, symbol: SymbolId, value: ValueId) {
        self.values.insert(symbol, value);
    }
}

fn position(symbols: &[SymbolId], symbol: SymbolId) -> usize {
    match symbols.iter().position(|&s| s == symbol) {
        Some(index) => index,
        None => unreachable!("a symbol of another frame reached this door"),
    }
}

impl<'a> Lowering<'a> {
    pub(super) fn new(mechanics: &'a Mechanics) -> Self {
        Self {
            mechanics,
            builder: Builder::default(),
            constants: BTreeMap::new(),
        }
    }

    /// The value of a symbol behind a door.
    pub(super) fn symbol(&mut self, door: &mut Door<'_>, symbol: SymbolId) -> ValueId {
        if let Some(&value) = door.values.get(&symbol) {
            return value;
        }
        let entry = self.mechanics.symbols.get(symbol).clone();
        let value = match entry.role {
            Role::Parameter | Role::Constant => {
                let constant = self.constant(symbol);
                self.builder.constant(constant)
            }
            Role::Temporal => self.temporal(door, symbol),
            Role::Trigonometric => {
                let value = self.trigonometric(door, symbol);
                self.builder.name(value, &entry.code)
            }
            Role::Coordinate => {
                let index = position(&door.frame.coordinates, symbol);
                self.builder.input(door.coordinates, index)
            }
            Role::Velocity => {
                let index = position(&door.frame.velocities, symbol);
                match door.velocities {
                    Some(argument) => self.builder.input(argument, index),
                    None => self.velocities(door)[index],
                }
            }
            Role::Momentum => {
                let index = position(&door.frame.momenta, symbol);
                match door.momenta {
                    Some(argument) => self.builder.input(argument, index),
                    None => {
                        let observed = door.observed.map(|observed| &observed.momentum);
                        let Some(momentum) = door.frame.momentum.as_ref().or(observed) else {
                            unreachable!("{} is formed where momenta are asked for", entry.code)
                        };
                        let value = self.expr(door, &momentum[index]);
                        self.builder.name(value, &entry.code)
                    }
                }
            }
            Role::Derived => match self.observed(door, symbol) {
                Some(value) => self.builder.name(value, &entry.code),
                None => self.derived(door, symbol),
            },
            Role::Acceleration | Role::Bookkeeping => {
                unreachable!("{} never leaves the derivation", entry.code)
            }
        };
        door.values.insert(symbol, value);
        value
    }

    fn trigonometric(&mut self, door: &mut Door<'_>, symbol: SymbolId) -> ValueId {
        let mechanics = self.mechanics;
        match mechanics.trigonometry[&symbol] {
            Trigonometric::VersineOf(CombinationId(id)) => {
                self.combination(door, &mechanics.combinations[id]).versine
            }
            Trigonometric::SineOf(CombinationId(id)) => {
                self.combination(door, &mechanics.combinations[id]).sine
            }
            Trigonometric::Cos(a) if self.is_combined(a) => {
                let versine = self.by_half_angle(door, a).versine;
                let one = self.builder.integer(1);
                self.builder.sub(one, versine)
            }
            Trigonometric::Sin(a) if self.is_combined(a) => self.by_half_angle(door, a).sine,
            Trigonometric::Cos(a) => {
                let angle = self.symbol(door, a);
                self.builder.cos(angle)
            }
            Trigonometric::Sin(a) => {
                let angle = self.symbol(door, a);
                self.builder.sin(angle)
            }
            // cos(a − b) = cos a cos b + sin a sin b
            Trigonometric::CosBetween(a, b) => {
                let [cos_a, sin_a, cos_b, sin_b] = self.sines_and_cosines(door, a, b);
                let first = self.builder.mul(cos_a, cos_b);
                let second = self.builder.mul(sin_a, sin_b);
                self.builder.add(first, second)
            }
            // sin(a − b) = sin a cos b − cos a sin b
            Trigonometric::SinBetween(a, b) => {
                let [cos_a, sin_a, cos_b, sin_b] = self.sines_and_cosines(door, a, b);
                let first = self.builder.mul(sin_a, cos_b);
                let second = self.builder.mul(cos_a, sin_b);
                self.builder.sub(first, second)
            }
        }
    }

    fn sines_and_cosines(&mut self, door: &mut Door<'_>, a: SymbolId, b: SymbolId) -> [ValueId; 4] {
        [
            Trigonometric::Cos(a),
            Trigonometric::Sin(a),
            Trigonometric::Cos(b),
            Trigonometric::Sin(b),
        ]
        .map(|wanted| self.trigonometric_symbol(wanted))
        .map(|symbol| self.symbol(door, symbol))
    }

    pub(super) fn trigonometric_symbol(&self, wanted: Trigonometric) -> SymbolId {
        let mut table = self.mechanics.trigonometry.iter();
        match table.find(|(_, meaning)| **meaning == wanted) {
            Some((&symbol, _)) => symbol,
            None => unreachable!("every coordinate has a sine and a cosine"),
        }
    }

    /// q̇ with M q̇ = p.
    fn velocities(&mut self, door: &mut Door<'_>) -> Vec<ValueId> {
        let frame = door.frame;
        let mass = self.mass_matrix(door);
        let momenta = frame.momenta.clone();
        let right = momenta.iter().map(|&p| self.symbol(door, p)).collect();
        let names = self.coordinate_names(frame);
        let solution = self.builder.solve(mass, right, &names);
        for (&symbol, &value) in frame.velocities.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(symbol).code;
            self.builder.name(value, code);
            door.values.insert(symbol, value);
        }
        solution
    }

    /// A velocity of the expansion: w with M⁽⁰⁾ w = p, or a correction to it.
    fn derived(&mut self, door: &mut Door<'_>, symbol: SymbolId) -> ValueId {
        let mechanics = self.mechanics;
        let Some(expansion) = &mechanics.expansion else {
            unreachable!("derived velocities come with the expansion");
        };
        if let Some(place) = expansion.velocities.iter().position(|&s| s == symbol) {
            let right = expansion
                .in_phase
                .iter()
                .map(|&i| self.symbol(door, door.frame.momenta[i]))
                .collect();
            return self.solve_in_phase(door, expansion, &expansion.velocities, right)[place];
        }
        for correction in &expansion.corrections {
            if let Some(place) = correction.in_phase.iter().position(|&s| s == symbol) {
                let right = correction
                    .right
                    .iter()
                    .map(|r| self.expr(door, r))
                    .collect();
                return self.solve_in_phase(door, expansion, &correction.in_phase, right)[place];
            }
            if let Some((_, value)) = correction.differences.iter().find(|(s, _)| *s == symbol) {
                let value = self.expr(door, value);
                let code = &mechanics.symbols.get(symbol).code;
                return self.builder.name(value, code);
            }
        }
        unreachable!("{} is defined nowhere", mechanics.symbols.get(symbol).code)
    }

    fn solve_in_phase(
        &mut self,
        door: &mut Door<'_>,
        expansion: &Expansion,
        symbols: &[SymbolId],
        right: Vec<ValueId>,
    ) -> Vec<ValueId> {
        let matrix = self.matrix(door, &expansion.leading);
        let all = self.coordinate_names(door.frame);
        let names: Vec<String> = expansion
            .in_phase
            .iter()
            .map(|&i| format!("in_phase_{}", all[i]))
            .collect();
        let solution = self.builder.solve(matrix, right, &names);
        for (&velocity, &value) in symbols.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(velocity).code;
            self.builder.name(value, code);
            door.values.insert(velocity, value);
        }
        solution
    }

    /// What stands after `theta_` in the names of a frame's coordinates.
    pub(super) fn coordinate_names(&self, frame: &Frame) -> Vec<String> {
        frame
            .coordinates
            .iter()
            .map(|&c| {
                let code = &self.mechanics.symbols.get(c).code;
                code.strip_prefix("theta_").unwrap_or(code).to_owned()
            })
            .collect()
    }

    /// The entries of the frame's mass matrix as values, named.
    pub(super) fn mass_matrix(&mut self, door: &mut Door<'_>) -> Matrix {
        let names = self.coordinate_names(door.frame);
        let matrix = self.matrix(door, &door.frame.mass);
        for (&(row, column), &value) in &matrix {
            let name = format!("mass_{}_{}", names[row], names[column]);
            self.builder.name(value, &name);
        }
        matrix
    }

    /// A matrix's entries as values.
    pub(super) fn matrix(&mut self, door: &mut Door<'_>, entries: &[MatrixEntry]) -> Matrix {
        entries
            .iter()
            .map(|entry| {
                let value = self.expr(door, &entry.value);
                ((entry.row, entry.column), value)
            })
            .collect()
    }

    /// An expression as a value. Sums start with a positive term if they have
    /// one, so that no operation is spent on a sign.
    pub(super) fn expr(&mut self, door: &mut Door<'_>, expr: &Expr) -> ValueId {
        match expr {
            Expr::Number(number) => self.builder.number(number.clone()),
            Expr::Symbol(symbol) => self.symbol(door, *symbol),
            Expr::Sum(terms) => {
                let terms: Vec<(bool, ValueId)> =
                    terms.iter().map(|term| self.term(door, term)).collect();
                let first = terms.iter().position(|&(negative, _)| !negative);
                let (negative, mut sum) = terms[first.unwrap_or(0)];
                for (index, &(minus, value)) in terms.iter().enumerate() {
                    if index == first.unwrap_or(0) {
                        continue;
                    }
                    sum = if minus == negative {
                        self.builder.add(sum, value)
                    } else {
                        self.builder.sub(sum, value)
                    };
                }
                if negative { self.builder.neg(sum) } else { sum }
            }
            term => {
                let (negative, value) = self.term(door, term);
                if negative {
                    self.builder.neg(value)
                } else {
                    value
                }
            }
        }
    }

    /// A term's sign and size: constants first, then what is multiplied, then
    /// one quotient.
    fn term(&mut self, door: &mut Door<'_>, term: &Expr) -> (bool, ValueId) {
        if let Some(value) = self.centrifugal(door, term) {
            return value;
        }
        let mut negative = false;
        let mut constant = self.builder.integer(1);
        let mut above: Option<ValueId> = None;
        let mut below: Option<ValueId> = None;
        for factor in term.factors() {
            let (base, exponent) = match factor {
                Expr::Power(base, exponent) => (base.as_ref(), *exponent),
                Expr::Number(number) if number.is_negative() => {
                    negative = !negative;
                    let size: Rational = -number;
                    let size = self.builder.number(size);
                    constant = self.builder.mul(constant, size);
                    continue;
                }
                other => (other, 1),
            };
            let value = match base {
                Expr::Product(_) | Expr::Power(..) => self.expr(door, base),
                Expr::Sum(_) => self.expr(door, base),
                Expr::Number(number) => self.builder.number(number.clone()),
                Expr::Symbol(symbol) => self.symbol(door, *symbol),
            };
            let is_constant = self.is_constant(value);
            for _ in 0..exponent.unsigned_abs() {
                match (is_constant, exponent > 0) {
                    (true, true) => constant = self.builder.mul(constant, value),
                    (true, false) => constant = self.builder.div(constant, value),
                    (false, up) => {
                        let side = if up { &mut above } else { &mut below };
                        *side = Some(match *side {
                            Some(product) => self.builder.mul(product, value),
                            None => value,
                        });
                    }
                }
            }
        }
        let one = self.builder.integer(1);
        let mut value = match above {
            Some(product) => self.builder.mul(constant, product),
            None => constant,
        };
        if let Some(divisor) = below {
            let value_or_one = if above.is_some() || !self.builder.is(constant, 1) {
                value
            } else {
                one
            };
            value = self.builder.div(value_or_one, divisor);
        }
        (negative, value)
    }

    /// ±μ sin ω² as (μ sin) · ω²: a pair of links shares the first factor, all
    /// pairs of a link the second.
    fn centrifugal(&mut self, door: &mut Door<'_>, term: &Expr) -> Option<(bool, ValueId)> {
        let mechanics = self.mechanics;
        let role = |symbol: &SymbolId| mechanics.symbols.get(*symbol).role;
        let mut negative = false;
        let (mut constants, mut sine, mut velocity) = (Vec::new(), None, None);
        for factor in term.factors() {
            match factor {
                Expr::Number(number) => {
                    negative ^= number.is_negative();
                    let size = if number.is_negative() {
                        -number
                    } else {
                        number.clone()
                    };
                    constants.push(self.builder.number(size));
                }
                Expr::Symbol(symbol) if role(symbol) == Role::Constant => {
                    constants.push(self.symbol(door, *symbol));
                }
                Expr::Symbol(symbol) if role(symbol) == Role::Trigonometric && sine.is_none() => {
                    sine = Some(*symbol);
                }
                Expr::Power(base, 2) => match base.as_ref() {
                    Expr::Symbol(symbol)
                        if role(symbol) == Role::Velocity && velocity.is_none() =>
                    {
                        velocity = Some(*symbol);
                    }
                    _ => return None,
                },
                _ => return None,
            }
        }
        let (sine, velocity) = (sine?, velocity?);
        let mut scaled = self.symbol(door, sine);
        for constant in constants {
            scaled = self.builder.mul(constant, scaled);
        }
        let code = &mechanics.symbols.get(sine).code;
        self.builder.name(scaled, &format!("coupled_{code}"));
        let velocity = self.symbol(door, velocity);
        let square = self.builder.mul(velocity, velocity);
        Some((negative, self.builder.mul(scaled, square)))
    }

    fn is_constant(&self, value: ValueId) -> bool {
        matches!(
            self.builder.op(value),
            super::Op::Constant(_) | super::Op::Number(_)
        )
    }
}
