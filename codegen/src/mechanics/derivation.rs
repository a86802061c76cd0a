//! State of one derivation: symbols, their definitions and the chain rule.

use super::algebra::Formula;
use super::expression::{Role, SymbolId, Symbols};
use super::meaning::{
    CompositeObservable, DerivedDrive, DerivedLines, JointDifference, LineMeaning, PairDifferences,
};
use super::observables::EnergySymbols;
use super::print::{Index, latex_name};
use crate::scene::{DescribedChordSpring, Scene};
use std::collections::BTreeMap;

/// Index of an [`AngleCombination`] in the list of all combinations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CombinationId(pub usize);

/// A sum of coordinates with integer weights; the first weight is positive.
pub type AngleCombination = Vec<(SymbolId, i64)>;

/// Definition of a symbol that abbreviates a sine or a cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trigonometric {
    /// Cosine of a coordinate.
    Cos(SymbolId),
    /// Sine of a coordinate.
    Sin(SymbolId),
    /// 1 − cos of a combination of differences, which is accurate for small arguments.
    VersineOf(CombinationId),
    /// Sine of a combination of differences.
    SineOf(CombinationId),
    /// Cosine of the difference of two coordinates.
    CosBetween(SymbolId, SymbolId),
    /// Sine of the difference of two coordinates.
    SinBetween(SymbolId, SymbolId),
}

/// A constant of the model during the derivation.
pub(super) struct ConstantEntry {
    pub(super) value: Formula,
    pub(super) meaning: String,
    pub(super) unit: &'static str,
}

/// Symbols and definitions of a derivation in progress.
pub(super) struct Derivation<'s> {
    pub(super) scene: &'s Scene,
    pub(super) symbols: Symbols,
    pub(super) parameters: Vec<SymbolId>,
    pub(super) constants: BTreeMap<SymbolId, ConstantEntry>,
    pub(super) trigonometry: BTreeMap<SymbolId, Trigonometric>,
    names: BTreeMap<SymbolId, String>,
    of_one: BTreeMap<SymbolId, (SymbolId, SymbolId)>,
    pub(super) of_two: BTreeMap<(SymbolId, SymbolId), (SymbolId, SymbolId)>,
    pub(super) combinations: Vec<AngleCombination>,
    pub(super) drive: DerivedDrive,
    pub(super) joints: BTreeMap<SymbolId, JointDifference<Formula>>,
    /// Relative angles and rates of pairs of links that are not parent and child, by the index of
    /// the pair.
    pub(super) pairs: Vec<PairDifferences>,
    pub(super) lines: DerivedLines,
    /// Straight springs between copies, for symmetric coordinates. Empty if the scene has other
    /// lines, which symmetric coordinates do not support.
    pub(super) chords: Vec<DescribedChordSpring>,
    pub(super) groups_of: BTreeMap<SymbolId, usize>,
    of_combination: Vec<(SymbolId, SymbolId)>,
    /// Functions of whole expressions, which occur in observables only.
    pub(super) composites: BTreeMap<SymbolId, CompositeObservable>,
    /// Symbols of K and U, if only the symbols of the frame are derived.
    pub(super) energies: Option<EnergySymbols>,
    /// Derivatives that are expressed by other symbols than the function's definition, by function
    /// and variable.
    pub(super) given_slopes: BTreeMap<(SymbolId, SymbolId), Formula>,
}

impl<'s> Derivation<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        let mut symbols = Symbols::default();
        let parameters = scene
            .parameters
            .iter()
            .map(|p| {
                let latex = format!("\\mathrm{{{}}}", latex_name(&p.name));
                symbols.parameter(&p.name, &latex)
            })
            .collect();
        Self {
            scene,
            symbols,
            parameters,
            constants: BTreeMap::new(),
            trigonometry: BTreeMap::new(),
            names: BTreeMap::new(),
            of_one: BTreeMap::new(),
            of_two: BTreeMap::new(),
            combinations: Vec::new(),
            drive: DerivedDrive::default(),
            joints: BTreeMap::new(),
            pairs: Vec::new(),
            lines: DerivedLines::default(),
            chords: scene.chord_springs(&scene.groups).unwrap_or_default(),
            groups_of: BTreeMap::new(),
            of_combination: Vec::new(),
            composites: BTreeMap::new(),
            energies: None,
            given_slopes: BTreeMap::new(),
        }
    }

    pub(super) fn record_constant(
        &mut self,
        id: SymbolId,
        value: Formula,
        meaning: &str,
        unit: &'static str,
    ) {
        let meaning = meaning.to_owned();
        self.constants.insert(
            id,
            ConstantEntry {
                value,
                meaning,
                unit,
            },
        );
    }

    pub(super) fn indexed(
        &mut self,
        role: Role,
        code: &str,
        text: &str,
        latex: &str,
        name: &str,
    ) -> SymbolId {
        self.indexed_by(role, [code, text, latex], &[name])
    }

    /// Creates a symbol with names as indices. The three letters are its spellings in code, in text
    /// and in LaTeX.
    pub(super) fn indexed_by(
        &mut self,
        role: Role,
        [code, text, latex]: [&str; 3],
        names: &[impl AsRef<str>],
    ) -> SymbolId {
        let Index {
            code: code_index,
            text: text_index,
            latex: latex_index,
        } = Index::of(names);
        self.symbols.intern(
            role,
            &format!("{code}_{code_index}"),
            &format!("{text}_{text_index}"),
            &format!("{latex}_{{\\mathrm{{{latex_index}}}}}"),
        )
    }

    /// Creates the generalized coordinate with this name, and its cosine and sine.
    pub(super) fn coordinate(&mut self, name: &str) -> SymbolId {
        let id = self.indexed(Role::Coordinate, "theta", "θ", "\\theta", name);
        self.names.insert(id, name.to_owned());
        let tex = latex_name(name);
        let mut make = |function: &str, meaning| {
            let symbol = self.symbols.intern(
                Role::Trigonometric,
                &format!("{function}_{name}"),
                &format!("{function} θ_{name}"),
                &format!("\\{function}\\theta_{{\\mathrm{{{tex}}}}}"),
            );
            self.trigonometry.insert(symbol, meaning);
            symbol
        };
        let cos = make("cos", Trigonometric::Cos(id));
        let sin = make("sin", Trigonometric::Sin(id));
        self.of_one.insert(id, (cos, sin));
        id
    }

    pub(super) fn velocity(&mut self, name: &str) -> SymbolId {
        self.indexed(Role::Velocity, "omega", "ω", "\\omega", name)
    }

    pub(super) fn momentum(&mut self, name: &str) -> SymbolId {
        self.indexed(Role::Momentum, "p", "p", "p", name)
    }

    pub(super) fn cos(&self, coordinate: SymbolId) -> SymbolId {
        self.of_one[&coordinate].0
    }

    pub(super) fn sin(&self, coordinate: SymbolId) -> SymbolId {
        self.of_one[&coordinate].1
    }

    /// Creates symbols for 1 − cos and sin of a combination. Expanded in sines and cosines of
    /// single coordinates, nested differences would fill pages.
    pub(super) fn combination(&mut self, combination: &AngleCombination) -> (SymbolId, SymbolId) {
        if let Some(known) = self.combinations.iter().position(|c| c == combination) {
            return self.of_combination[known];
        }
        let id = CombinationId(self.combinations.len());
        let (mut code, mut text, mut latex) = (String::new(), String::new(), String::new());
        for (place, &(coordinate, weight)) in combination.iter().enumerate() {
            let symbol = self.symbols.get(coordinate);
            let (word, sign) = match (place, weight < 0) {
                (0, false) => ("", ""),
                (_, false) => ("_plus_", " + "),
                (_, true) => ("_minus_", " − "),
            };
            let size = weight.abs();
            let (number, factor) = match size {
                1 => (String::new(), String::new()),
                _ => (format!("{size}_"), format!("{size} ")),
            };
            code.push_str(&format!("{word}{number}{}", self.names[&coordinate]));
            text.push_str(&format!("{sign}{factor}{}", symbol.text));
            latex.push_str(&format!("{sign}{factor}{}", symbol.latex).replace('−', "-"));
        }
        if combination.len() > 1 || text.contains(' ') {
            text = format!("({text})");
            latex = format!("({latex})");
        } else {
            text = format!(" {text}");
        }
        let mut make = |function: &str, command: &str, meaning| {
            let symbol = self.symbols.intern(
                Role::Trigonometric,
                &format!("{function}_{code}"),
                &format!("{function}{text}"),
                &format!("{command}{latex}"),
            );
            // The sine of a single coordinate exists already.
            self.trigonometry.entry(symbol).or_insert(meaning);
            symbol
        };
        let versine = make("vers", "\\operatorname{vers}", Trigonometric::VersineOf(id));
        let sine = make("sin", "\\sin", Trigonometric::SineOf(id));
        self.combinations.push(combination.clone());
        self.of_combination.push((versine, sine));
        (versine, sine)
    }

    /// Creates symbols for cos(a − b) and sin(a − b). The mass matrix depends only on such
    /// differences, and written in them it is as short as by hand.
    pub(super) fn between(&mut self, a: SymbolId, b: SymbolId) -> (SymbolId, SymbolId) {
        if let Some(&known) = self.of_two.get(&(a, b)) {
            return known;
        }
        let (name_a, name_b) = (self.names[&a].clone(), self.names[&b].clone());
        let tex = format!(
            "(\\theta_{{\\mathrm{{{}}}}}-\\theta_{{\\mathrm{{{}}}}})",
            latex_name(&name_a),
            latex_name(&name_b)
        );
        let mut make = |function: &str, meaning| {
            let symbol = self.symbols.intern(
                Role::Trigonometric,
                &format!("{function}_{name_a}_from_{name_b}"),
                &format!("{function}(θ_{name_a} − θ_{name_b})"),
                &format!("\\{function}{tex}"),
            );
            self.trigonometry.insert(symbol, meaning);
            symbol
        };
        let cos = make("cos", Trigonometric::CosBetween(a, b));
        let sin = make("sin", Trigonometric::SinBetween(a, b));
        self.of_two.insert((a, b), (cos, sin));
        (cos, sin)
    }

    /// Returns the existing symbols for cos and sin of θ_a − θ_b.
    pub(super) fn known_between(&self, a: SymbolId, b: SymbolId) -> (SymbolId, SymbolId) {
        self.of_two[&(a, b)]
    }

    /// Returns the derivative of a symbol by a coordinate or velocity; `None` if the symbol does
    /// not depend on it.
    pub(super) fn slope(&self, symbol: SymbolId, coordinate: SymbolId) -> Option<Formula> {
        if let Some(slope) = self.given_slopes.get(&(symbol, coordinate)) {
            return Some(slope.clone());
        }
        if let Some(joint) = self.joints.get(&symbol) {
            return joint.slope(coordinate);
        }
        if let Some(line) = self.lines.symbols.get(&symbol) {
            return match &line.meaning {
                LineMeaning::Formula(formula) => Some(self.partial(formula, coordinate)),
                // Derivatives of lengths are in `given_slopes`.
                LineMeaning::Root { .. } => None,
            };
        }
        if let Some(composite) = self.composites.get(&symbol) {
            return Some(self.composite_slope(symbol, composite, coordinate));
        }
        let signed = |value: Formula, positive: bool| if positive { value } else { -value };
        match *self.trigonometry.get(&symbol)? {
            Trigonometric::Cos(a) => (a == coordinate).then(|| -Formula::symbol(self.sin(a))),
            Trigonometric::Sin(a) => (a == coordinate).then(|| self.cosine(a)),
            Trigonometric::VersineOf(id) => {
                let weight = self.weight(id, coordinate)?;
                let sine = Formula::symbol(self.of_combination[id.0].1);
                Some(&Formula::integer(weight) * &sine)
            }
            Trigonometric::SineOf(id) => {
                let weight = self.weight(id, coordinate)?;
                let versine = Formula::symbol(self.of_combination[id.0].0);
                Some(&Formula::integer(weight) * &(&Formula::integer(1) - &versine))
            }
            Trigonometric::CosBetween(a, b) if a == coordinate || b == coordinate => Some(signed(
                Formula::symbol(self.of_two[&(a, b)].1),
                b == coordinate,
            )),
            Trigonometric::SinBetween(a, b) if a == coordinate || b == coordinate => Some(signed(
                Formula::symbol(self.of_two[&(a, b)].0),
                a == coordinate,
            )),
            _ => None,
        }
    }

    fn weight(&self, id: CombinationId, coordinate: SymbolId) -> Option<i64> {
        let found = self.combinations[id.0]
            .iter()
            .find(|(c, _)| *c == coordinate);
        found.map(|(_, weight)| *weight)
    }

    /// Returns the cosine of a coordinate, expressed by the symbols of this derivation: 1 − vers if
    /// the versine is in use.
    pub(super) fn cosine(&self, coordinate: SymbolId) -> Formula {
        let alone = vec![(coordinate, 1)];
        match self.combinations.iter().position(|c| *c == alone) {
            Some(known) => {
                let versine = Formula::symbol(self.of_combination[known].0);
                &Formula::integer(1) - &versine
            }
            None => Formula::symbol(self.cos(coordinate)),
        }
    }

    /// Returns the partial derivative with respect to a coordinate or a velocity. The chain rule
    /// covers all sines and cosines, and relative angles and rates of joints.
    pub(super) fn partial(&self, formula: &Formula, coordinate: SymbolId) -> Formula {
        let mut terms = vec![];
        for symbol in formula.symbols() {
            if symbol == coordinate {
                terms.push(formula.derivative(symbol));
            } else if let Some(slope) = self.slope(symbol, coordinate) {
                terms.push(&formula.derivative(symbol) * &slope);
            }
        }
        terms.into_iter().sum()
    }

    /// Returns the coordinates that a formula depends on.
    pub(super) fn coordinates_of(&self, formula: &Formula) -> Vec<SymbolId> {
        let mut found = Vec::new();
        for symbol in formula.symbols() {
            if let Some(line) = self.lines.symbols.get(&symbol) {
                found.extend(&line.coordinates);
                continue;
            }
            match self.trigonometry.get(&symbol) {
                Some(Trigonometric::Cos(a) | Trigonometric::Sin(a)) => found.push(*a),
                Some(Trigonometric::VersineOf(id) | Trigonometric::SineOf(id)) => {
                    found.extend(self.combinations[id.0].iter().map(|(c, _)| *c));
                }
                Some(Trigonometric::CosBetween(a, b) | Trigonometric::SinBetween(a, b)) => {
                    found.extend([*a, *b]);
                }
                None => {
                    let joint = self.joints.get(&symbol);
                    let of_joint = joint.map(|joint| joint.terms.as_slice());
                    let alone = [(symbol, 1)];
                    let members = of_joint.unwrap_or(&alone).iter();
                    found.extend(
                        members
                            .map(|(member, _)| *member)
                            .filter(|&member| self.symbols.get(member).role == Role::Coordinate),
                    );
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}
