//! The symbolic derivation: from a scene to its mechanics.
//!
//! Everything here is derived from the positions of the links; the closed
//! forms of the literature are what tests compare with. Inside, formulas are
//! Symbolica's (behind [`algebra`]); what leaves is plain data.

pub mod algebra;
mod bracket;
pub mod coordinates;
mod derivation;
pub mod expression;
mod inverse_mass;
mod lagrangian;
mod print;
mod show;
mod symmetric;
mod transfer;

pub use algebra::AlgebraError;
pub use coordinates::Coordinate;
pub use derivation::{Combination, CombinationId, Trigonometric};
pub use print::{latex, text};

use crate::exact::Rational;
use crate::scene::{Scene, TransferRequest};
use algebra::Formula;
use derivation::{Derivation, Frame as DerivedFrame, MassMatrix};
use expression::{Expr, Role, SymbolId, Symbols};
use inverse_mass::Expansion as DerivedExpansion;
use std::collections::BTreeMap;

/// A constant of the model: a combination of masses, lengths and gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Its symbol.
    pub symbol: SymbolId,
    /// Its value in terms of the scene's parameters.
    pub value: Expr,
    /// What it means, in words.
    pub meaning: String,
    /// Its unit.
    pub unit: &'static str,
}

/// One entry of the lower triangle of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Row, at least `column`.
    pub row: usize,
    /// Column.
    pub column: usize,
    /// Value, never zero.
    pub value: Expr,
}

/// Kinetic and potential energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Energies {
    /// K in coordinates and velocities.
    pub kinetic: Expr,
    /// U in coordinates.
    pub potential: Expr,
}

/// The Lagrangian in one set of generalized coordinates and what follows from
/// it. Equations of motion: Σ_j M_ij q̈_j + bias_i = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Generalized coordinates.
    pub coordinates: Vec<SymbolId>,
    /// Generalized velocities.
    pub velocities: Vec<SymbolId>,
    /// Generalized momenta.
    pub momenta: Vec<SymbolId>,
    /// Mass matrix, lower triangle without zeros, by row.
    pub mass: Vec<Entry>,
    /// Second derivatives of the potential energy, likewise, if modes are asked
    /// for.
    pub stiffness: Option<Vec<Entry>>,
    /// Kinetic energy in coordinates and velocities and potential energy, zero
    /// where all coordinates are zero; if energies are asked for.
    pub energies: Option<Energies>,
    /// p_i = ∂L/∂v_i in coordinates and velocities, if momenta are asked for.
    pub momentum: Option<Vec<Expr>>,
    /// Centrifugal, gravity and friction terms of the Euler–Lagrange equations.
    pub bias: Vec<Expr>,
}

/// W split into the parts that the kinetic and the potential energy of the
/// rest of the tree contribute.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    /// {H_d, K − T}.
    pub kinetic: Expr,
    /// {H_d, U − V}.
    pub potential: Expr,
}

/// The energy of one difference and the transfer into it. Symbols: symmetric
/// coordinates and their momenta; in-phase velocities w in the truncated
/// forms, generalized velocities in the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer {
    /// Index of the difference among the symmetric coordinates.
    pub coordinate: usize,
    /// H_d, its kinetic and its potential part.
    pub energy: Parts,
    /// W to first order in the difference angles (the paper's W_K, W_P).
    pub angle: Option<Parts>,
    /// W to second order in the amplitude.
    pub amplitude: Option<Parts>,
    /// The coefficients of p_d², p_d θ_d, θ_d² in `amplitude`, if it is a
    /// quadratic form in this difference alone.
    pub quadratic_form: Option<[Expr; 3]>,
    /// W without truncation.
    pub exact: Option<Parts>,
    /// The power of joint friction on H_d; zero without friction.
    pub friction: Expr,
}

/// The inverse mass matrix about the in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Expansion {
    /// Indices of the in-phase coordinates (means).
    pub in_phase: Vec<usize>,
    /// Symbols of w = M⁽⁰⁾⁻¹ p for the in-phase coordinates.
    pub velocities: Vec<SymbolId>,
    /// In-phase block of M⁽⁰⁾; rows and columns count in `in_phase`.
    pub leading: Vec<Entry>,
    /// The same solved and written out, for small blocks.
    pub written_out: Option<WrittenOut>,
}

/// Formulas for people: what the code solves, written out.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenOut {
    /// The symbol D.
    pub determinant: SymbolId,
    /// D, the determinant of the in-phase block.
    pub determinant_value: Expr,
    /// w for each in-phase coordinate.
    pub velocities: Vec<Expr>,
    /// M̃⁻¹ at the in-phase motion, dense.
    pub inverse: Vec<Vec<Expr>>,
    /// Its first-order correction in the difference angles, dense.
    pub inverse_first_order: Vec<Vec<Expr>>,
}

/// Everything derived for a scene. Invariants: mass matrices symmetric and
/// zero between unrelated branches; K = ½ vᵀ M v.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanics {
    /// All symbols.
    pub symbols: Symbols,
    /// Symbols of the scene's parameters, in their order.
    pub parameters: Vec<SymbolId>,
    /// Meaning of every trigonometric symbol.
    pub trigonometry: BTreeMap<SymbolId, Trigonometric>,
    /// Combinations of differences whose sine and versine appear.
    pub combinations: Vec<Combination>,
    /// Constants of the model, in the order of their symbols.
    pub constants: Vec<Constant>,
    /// The mechanics in absolute angles.
    pub absolute: Frame,
    /// The symmetric coordinates, if asked for.
    pub coordinates: Vec<Coordinate>,
    /// The mechanics in symmetric coordinates, if asked for.
    pub symmetric: Option<Frame>,
    /// Expansion about the in-phase motion, if a transfer is asked for.
    pub expansion: Option<Expansion>,
    /// Energy transfers, one for each difference, if asked for.
    pub transfers: Vec<Transfer>,
}

impl Mechanics {
    /// The constant behind a symbol, if it is one.
    pub fn constant(&self, symbol: SymbolId) -> Option<&Constant> {
        self.constants.iter().find(|c| c.symbol == symbol)
    }
}

/// Derives what the scene asks for, and nothing else.
///
/// # Errors
/// [`AlgebraError`] if the algebra cannot be used.
pub fn derive(scene: &Scene) -> Result<Mechanics, AlgebraError> {
    algebra::run(|| Derivation::new(scene).finish())
}

impl Derivation<'_> {
    fn finish(mut self) -> Mechanics {
        let absolute = self.absolute_frame();
        let mut mechanics = Mechanics {
            symbols: Symbols::default(),
            parameters: self.parameters.clone(),
            trigonometry: BTreeMap::new(),
            combinations: Vec::new(),
            constants: Vec::new(),
            absolute: self.frame(&absolute),
            coordinates: Vec::new(),
            symmetric: None,
            expansion: None,
            transfers: Vec::new(),
        };
        if self.scene.requests.symmetric {
            let coordinates = coordinates::symmetric_coordinates(self.scene);
            let symmetric = self.symmetric_frame(&absolute, &coordinates);
            mechanics.symmetric = Some(self.frame(&symmetric));
            if let Some(request) = self.scene.requests.transfer.clone() {
                let expansion = self.expand_mass(&symmetric, &coordinates);
                mechanics.expansion = Some(self.expansion(&symmetric, &expansion));
                mechanics.transfers =
                    self.transfers(&symmetric, &coordinates, &expansion, &request);
            }
            mechanics.coordinates = coordinates;
        }
        mechanics.constants = self
            .constants
            .iter()
            .map(|(&symbol, entry)| Constant {
                symbol,
                value: entry.value.expand().to_expr(&self.symbols),
                meaning: entry.meaning.clone(),
                unit: entry.unit,
            })
            .collect();
        mechanics.trigonometry = self.trigonometry;
        mechanics.combinations = self.combinations;
        mechanics.symbols = self.symbols;
        mechanics
    }

    fn expr(&self, formula: &Formula) -> Expr {
        formula.to_expr(&self.symbols)
    }

    fn exprs(&self, formulas: &[Formula]) -> Vec<Expr> {
        formulas.iter().map(|f| self.expr(f)).collect()
    }

    fn entries(&self, matrix: &MassMatrix) -> Vec<Entry> {
        matrix
            .iter()
            .filter(|(_, _, value)| !value.is_zero())
            .map(|(row, column, value)| Entry {
                row,
                column,
                value: self.expr(value),
            })
            .collect()
    }

    fn frame(&self, frame: &DerivedFrame) -> Frame {
        let requests = &self.scene.requests;
        Frame {
            coordinates: frame.coordinates.clone(),
            velocities: frame.velocities.clone(),
            momenta: frame.momenta.clone(),
            mass: self.entries(&frame.mass),
            stiffness: requests.modes.then(|| self.entries(&self.stiffness(frame))),
            energies: requests.energies.then(|| {
                let kinetic: Formula = frame.kinetic_terms().map(|(_, _, term)| term).sum();
                Energies {
                    kinetic: self.expr(&kinetic.expand()),
                    potential: self.expr(&frame.potential),
                }
            }),
            momentum: requests.momenta.then(|| self.exprs(&frame.momentum())),
            bias: self.exprs(&frame.bias(self)),
        }
    }

    fn stiffness(&self, frame: &DerivedFrame) -> MassMatrix {
        let mut matrix = MassMatrix::default();
        for (row, slope) in frame.potential_gradient(self).iter().enumerate() {
            for coordinate in self.coordinates_of(slope) {
                let column = frame.index(coordinate);
                if column <= row {
                    matrix.add(row, column, self.partial(slope, coordinate).expand());
                }
            }
        }
        matrix
    }

    fn expansion(&self, frame: &DerivedFrame, expansion: &DerivedExpansion) -> Expansion {
        let mut leading = MassMatrix::default();
        for (row, &i) in expansion.in_phase.iter().enumerate() {
            for (column, &j) in expansion.in_phase[..=row].iter().enumerate() {
                leading.add(row, column, expansion.orders[0].get(i, j));
            }
        }
        let dense =
            |rows: Vec<Vec<Formula>>| rows.iter().map(|row| self.exprs(row)).collect::<Vec<_>>();
        let written_out = match (
            &expansion.written_out,
            expansion.inverse(),
            expansion.written_velocities(frame),
        ) {
            (Some(written), Some([inverse, first]), Some(velocities)) => Some(WrittenOut {
                determinant: written.determinant,
                determinant_value: self.expr(&written.determinant_value),
                velocities: velocities.iter().map(|(_, f)| self.expr(f)).collect(),
                inverse: dense(inverse),
                inverse_first_order: dense(first),
            }),
            _ => None,
        };
        Expansion {
            in_phase: expansion.in_phase.clone(),
            velocities: expansion.velocity_symbols.clone(),
            leading: self.entries(&leading),
            written_out,
        }
    }

    fn transfers(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        request: &TransferRequest,
    ) -> Vec<Transfer> {
        let mut transfers = Vec::new();
        for &coordinate in &expansion.differences {
            let energy = self.sub_hamiltonian(frame, coordinates, expansion, coordinate);
            let angle = request
                .angle_order
                .map(|order| self.angle_transfer(frame, expansion, &energy, order));
            let amplitude = request
                .amplitude_order
                .map(|_| self.amplitude_transfer(frame, expansion, &energy));
            let exact = request
                .exact
                .then(|| self.exact_transfer(frame, expansion, &energy));
            let friction = self.friction_power(frame, &energy);
            let quadratic_form = amplitude
                .as_ref()
                .and_then(|parts| self.quadratic_form(frame, expansion, coordinate, parts));
            let convert = |parts: transfer::Parts| Parts {
                kinetic: self.expr(&parts.kinetic),
                potential: self.expr(&parts.potential),
            };
            transfers.push(Transfer {
                coordinate,
                energy: Parts {
                    kinetic: self.expr(&energy.kinetic),
                    potential: self.expr(&energy.potential),
                },
                angle: angle.map(convert),
                amplitude: amplitude.map(convert),
                quadratic_form,
                exact: exact.map(convert),
                friction: self.expr(&friction),
            });
        }
        transfers
    }

    fn quadratic_form(
        &self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        coordinate: usize,
        parts: &transfer::Parts,
    ) -> Option<[Expr; 3]> {
        let (q, p) = (frame.coordinates[coordinate], frame.momenta[coordinate]);
        let whole = &parts.kinetic + &parts.potential;
        let others = Self::difference_pairs(frame, expansion);
        let foreign = others.iter().any(|&(other, momentum)| {
            other != q && whole.symbols().iter().any(|&s| s == other || s == momentum)
        });
        if foreign {
            return None;
        }
        let table = whole.coefficients(&[p, q]);
        let coefficient = |p: u32, q: u32| match table.get(&vec![p, q]) {
            Some(formula) => self.expr(formula),
            None => Expr::zero(),
        };
        Some([coefficient(2, 0), coefficient(1, 1), coefficient(0, 2)])
    }

    /// The constant G of an orbit; zero where nothing hangs off its pivot.
    fn gravity_of(&self, orbit: crate::scene::OrbitId) -> Formula {
        let name = &self.scene.orbits[orbit.0].name;
        match self.symbols.find(&format!("G_{name}")) {
            Some(id) if self.symbols.get(id).role == Role::Constant => Formula::symbol(id),
            _ => Formula::zero(),
        }
    }
}

/// The exact value of an expression without symbols.
pub fn exact_value(expr: &Expr) -> Option<Rational> {
    match expr {
        Expr::Number(number) => Some(number.clone()),
        Expr::Symbol(_) => None,
        Expr::Sum(parts) => parts
            .iter()
            .map(exact_value)
            .try_fold(Rational::from(0), |sum, part| Some(sum + part?)),
        Expr::Product(parts) => parts
            .iter()
            .map(exact_value)
            .try_fold(Rational::from(1), |product, part| Some(product * part?)),
        Expr::Power(base, exponent) => exact_value(base)?.checked_pow(*exponent).ok(),
    }
}
