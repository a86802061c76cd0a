//! Lines of straight springs, repulsions and dampers (physics §19). The length, its slopes and its
//! rate are separate symbols, so that a small stretch is never a difference of large products.
//!
//! ```text
//! Δ = d₀ + Σ R(θ_i) r_i      N_i = Δ·∂Δ/∂θ_i      ℓ = |Δ|      J_i = ∂ℓ/∂θ_i = N_i/ℓ
//! R = ½ γ ℓ̇², ℓ̇ = Σ J_i ω_i
//! ```

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId};
use super::laws::dissipated;
use super::letters;
use super::line_potentials::square_of_length;
use super::meaning::{DerivedLine, DerivedLineSymbol, LineMeaning};
use crate::scene::{
    DescribedTranslationalSpringDamper, LineEnds, LinkId, Scene, SpringDamperEnds, SpringLine,
};
use std::collections::BTreeMap;

/// Torque of a line's spring and damper on one link.
#[derive(Clone, Debug, PartialEq)]
pub struct LineTorque {
    /// The link on which the torque acts.
    pub link: LinkId,
    /// Torque, in N m, with the opposite sign: the equations subtract it.
    pub torque: Expr,
}

impl Scene {
    /// Returns the names of the connected links, which become part of the names of the constants. A
    /// number follows if an earlier straight spring connects the same links.
    pub(super) fn straight_names(&self, index: usize) -> Vec<String> {
        let name = |LinkId(link): &LinkId| self.links[*link].name.clone();
        let ends = |own: &DescribedTranslationalSpringDamper| match &own.ends {
            LineEnds::Links(SpringDamperEnds::Links(links), _) => links.each_ref().map(name),
            LineEnds::Links(SpringDamperEnds::Siblings(node), _) => [node.clone(), node.clone()],
            LineEnds::Guy(link, ..) => [name(link), GROUND.to_owned()],
        };
        let own = ends(&self.translational[index]);
        let before = self.translational[..index].iter();
        numbered(
            own.to_vec(),
            before.filter(|other| ends(other) == own).count(),
        )
    }
}

/// Word for the ground in names.
const GROUND: &str = "ground";

/// Appends a number to the names if `before` earlier elements have the same ones.
fn numbered(mut names: Vec<String>, before: usize) -> Vec<String> {
    if before > 0 {
        names.push((before + 1).to_string());
    }
    names
}

impl Derivation<'_> {
    /// Creates the symbols of the lines of all straight springs and of the quantities that depend
    /// on them.
    pub(super) fn prepare_lines(&mut self, angles: &[SymbolId], velocities: &[SymbolId]) {
        for line in self.scene.lines() {
            let mut names: Vec<String> = line
                .links
                .iter()
                .map(|LinkId(link)| self.scene.links[*link].name.clone())
                .collect();
            if line.links.len() == 1 {
                names.push(GROUND.to_owned());
            }
            let before = self
                .lines
                .list
                .iter()
                .filter(|own| own.line.links == line.links);
            let names = numbered(names, before.count());
            let mut line = self.line(line, names, angles);
            self.pulls_of_potentials(&mut line);
            self.pull_of_damper(&mut line, velocities);
            self.lines.list.push(line);
        }
    }

    /// Creates a symbol of a line with its definition.
    pub(super) fn line_symbol(
        &mut self,
        letters: [&str; 3],
        names: &[String],
        meaning: LineMeaning<Formula>,
        coordinates: &[SymbolId],
    ) -> SymbolId {
        let symbol = self.indexed_by(Role::Line, letters, names);
        let coordinates = coordinates.to_vec();
        let derived = DerivedLineSymbol {
            meaning,
            coordinates,
        };
        self.lines.symbols.insert(symbol, derived);
        symbol
    }

    /// Creates the vector Δ of a line and its moments N_i = Δ·∂Δ/∂θ_i.
    fn line(&mut self, line: SpringLine, names: Vec<String>, angles: &[SymbolId]) -> DerivedLine {
        let coordinates: Vec<SymbolId> = line.arms.iter().map(|(link, _)| angles[link.0]).collect();
        let what = self.scene.translational[line.spring_damper].what.clone();
        let mut arms = Vec::new();
        for (LinkId(link), arm) in &line.arms {
            let owner = self.scene.links[*link].name.clone();
            let of_link = with(&names, *link, self.scene);
            let mut component = |letter, way: &str, value| {
                let meaning = format!("part of the line of `{what}` {way} `{owner}`");
                let value = self.quantity(value);
                self.lettered(letter, &of_link, &meaning, value)
            };
            let along = component(letters::ARM, "along", &arm.along);
            let lateral = component(letters::LATERAL_ARM, "across", &arm.lateral);
            arms.push(self.point_at(&along, &lateral, angles[*link]));
        }
        let upwards = if self.scene.stands() { "−y" } else { "y" };
        let pegs = [(letters::PEG_X, "x"), (letters::PEG_Y, upwards)];
        let mut place = 0;
        let offset = [
            ("offset_x", "Δx", "\\Delta x"),
            ("offset_y", "Δy", "\\Delta y"),
        ];
        let offset = offset.map(|(code, text, latex)| {
            let (letter, axis) = pegs[place];
            let value = self.quantity(&line.offset[place]);
            let meaning = format!("place {axis} of the peg of `{what}`");
            let peg = self.lettered(letter, &names, &meaning, value);
            let sum = arms.iter().map(|arm| arm[place].clone()).sum::<Formula>();
            place += 1;
            let meaning = LineMeaning::Formula(&peg + &sum);
            self.line_symbol([code, text, latex], &names, meaning, &coordinates)
        });
        let [dx, dy] = offset.map(Formula::symbol);
        let moments = line
            .arms
            .iter()
            .zip(&arms)
            .map(|((LinkId(link), _), [x, y])| {
                // ∂Δ/∂θ_i is the arm rotated by a right angle.
                let moment = LineMeaning::Formula(&(&dy * x) - &(&dx * y));
                let of_link = with(&names, *link, self.scene);
                self.line_symbol(["line_moment", "N", "N"], &of_link, moment, &coordinates)
            });
        let moments = moments.collect();
        DerivedLine {
            line,
            names,
            offset,
            coordinates,
            moments,
            length: None,
            pulls: Vec::new(),
        }
    }

    /// Returns the symbols of the length ℓ and its slopes J_i; creates them at the first call.
    pub(super) fn length(&mut self, line: &mut DerivedLine) -> (SymbolId, Vec<SymbolId>) {
        if let Some(known) = &line.length {
            return known.clone();
        }
        let [dx, dy] = line.offset;
        let spelt = |print: fn(&super::expression::Symbol) -> &str| {
            [dx, dy].map(|id| print(self.symbols.get(id)).to_owned())
        };
        let [x, y] = spelt(|symbol| &symbol.text);
        let [latex_x, latex_y] = spelt(|symbol| &symbol.latex);
        let shown = self.symbols.intern(
            Role::Derived,
            &format!("length_of_{}", line.names.join("_")),
            &format!("√({x}² + {y}²)"),
            &format!("\\sqrt{{{latex_x}^2 + {latex_y}^2}}"),
        );
        let square = square_of_length(line);
        let root = LineMeaning::Root { square, shown };
        let coordinates = line.coordinates.clone();
        let letters = ["length", "ℓ", "\\ell"];
        let length = self.line_symbol(letters, &line.names, root, &coordinates);
        let mut slopes = Vec::new();
        for ((LinkId(link), _), &moment) in line.line.arms.iter().zip(&line.moments) {
            let slope = &Formula::symbol(moment) / &Formula::symbol(length);
            let slope = LineMeaning::Formula(slope);
            let of_link = with(&line.names, *link, self.scene);
            let slope = self.line_symbol(["length_slope", "J", "J"], &of_link, slope, &coordinates);
            slopes.push(slope);
        }
        self.give_slopes(
            length,
            &coordinates,
            slopes.iter().copied().map(Formula::symbol),
        );
        line.length = Some((length, slopes.clone()));
        (length, slopes)
    }

    /// Records the derivatives of a symbol, if they are expressed by other symbols than those in
    /// its definition.
    pub(super) fn give_slopes(
        &mut self,
        symbol: SymbolId,
        variables: &[SymbolId],
        slopes: impl IntoIterator<Item = Formula>,
    ) {
        for (&variable, slope) in variables.iter().zip(slopes) {
            self.given_slopes.insert((symbol, variable), slope);
        }
    }

    fn pull_of_damper(&mut self, line: &mut DerivedLine, velocities: &[SymbolId]) {
        let (scene, index) = (self.scene, line.line.spring_damper);
        let own = &scene.translational[index];
        if own.friction.is_zero() {
            return;
        }
        let meaning = format!("viscous friction of the straight damper of `{}`", own.what);
        let value = self.quantity(&own.friction);
        let constants = scene.straight_names(index);
        let friction = self.lettered(letters::STRAIGHT_FRICTION, &constants, &meaning, value);
        let (_, slopes) = self.length(line);
        let rates: Vec<SymbolId> = (line.line.arms.iter())
            .map(|(link, _)| velocities[link.0])
            .collect();
        let terms = slopes.iter().zip(&rates);
        let rate = terms.map(|(&slope, &rate)| &Formula::symbol(slope) * &Formula::symbol(rate));
        let rate = LineMeaning::Formula(rate.sum());
        let coordinates = line.coordinates.clone();
        let letters = ["length_rate", "ℓ̇", "\\dot\\ell"];
        let rate = self.line_symbol(letters, &line.names, rate, &coordinates);
        self.give_slopes(rate, &rates, slopes.iter().copied().map(Formula::symbol));
        let rate = Formula::symbol(rate);
        self.lines.losses.push(dissipated(&friction, &rate));
        line.pulls.push((&friction * &rate, slopes));
    }

    /// Returns the torques of all lines as plain data.
    pub(super) fn line_torques(&self) -> Vec<LineTorque> {
        let mut torques = Vec::new();
        for DerivedLine { line, pulls, .. } in &self.lines.list {
            for (place, (link, _)) in line.arms.iter().enumerate() {
                let torque = |(pull, slopes): &(Formula, Vec<SymbolId>)| {
                    self.expr(&(pull * &Formula::symbol(slopes[place])))
                };
                torques.extend(pulls.iter().map(|pull| LineTorque {
                    link: *link,
                    torque: torque(pull),
                }));
            }
        }
        torques
    }

    /// Returns the definitions of all symbols of lines as plain data.
    pub(super) fn plain_lines(&self) -> BTreeMap<SymbolId, LineMeaning> {
        let plain = |meaning: &LineMeaning<Formula>| match meaning {
            LineMeaning::Formula(formula) => LineMeaning::Formula(self.expr(formula)),
            LineMeaning::Root { square, shown } => LineMeaning::Root {
                square: self.expr(square),
                shown: *shown,
            },
        };
        let symbols = self.lines.symbols.iter();
        symbols
            .map(|(&symbol, own)| (symbol, plain(&own.meaning)))
            .collect()
    }
}

/// Returns the names, followed by the name of a link.
fn with(names: &[String], link: usize, scene: &Scene) -> Vec<String> {
    let link = std::iter::once(scene.links[link].name.clone());
    names.iter().cloned().chain(link).collect()
}
