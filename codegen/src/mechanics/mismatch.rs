//! Copies that differ (physics §14). The constants of the copies are split into means and
//! mismatches, and W into the contribution of the mean tree and that of the mismatches.
//!
//! A constant of the copies is transformed like their angles: to its mean and its Helmert
//! differences, the *mismatches*. The tree without mismatches is the *mean tree*. It is a tree of
//! equal copies with the same coordinates and momenta, and defines the energies H_d of the
//! differences.

use super::EnergyParts;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::{DerivedFrame, MassMatrix};
use super::letters::{self, Letter};
use super::print::latex_name;
use super::transfer::SubHamiltonian;
use super::{LinearSystem, MeanTree};
use crate::scene::{Coordinate, LinkId, UnequalNode};

/// Letters of the constants of one link.
const LETTERS: [Letter; 9] = [
    letters::INERTIA,
    letters::GRAVITY,
    letters::LATERAL_GRAVITY,
    letters::FRICTION,
    letters::DRAG,
    letters::SPRING,
    letters::REST,
    letters::MOMENT,
    letters::LATERAL_MOMENT,
];

/// Letters of the constants of a link and one of its ancestors.
const COUPLINGS: [Letter; 2] = [letters::COUPLING, letters::LATERAL_COUPLING];

/// Constants of copies that differ, expressed by means and mismatches.
#[derive(Default)]
pub(super) struct CopyConstants {
    /// Constants of the copies with the expressions that replace them.
    pub(super) replacements: Vec<(SymbolId, Formula)>,
    /// Symbols of the mismatches.
    mismatches: Vec<SymbolId>,
}

impl CopyConstants {
    /// Adds the replacement of a constant, once: the links of one orbit (set of equal copies of one
    /// link) share it.
    fn replace(&mut self, symbol: SymbolId, value: Formula) {
        let mut known = self.replacements.iter();
        if known.all(|(known, _)| *known != symbol) {
            self.replacements.push((symbol, value));
        }
    }
}

/// A tree whose copies differ, together with its mean tree.
pub(super) struct Mismatch<'f> {
    /// The tree with its actual constants.
    pub(super) frame: &'f DerivedFrame,
    /// The mean tree.
    pub(super) mean: &'f DerivedFrame,
    /// Velocities u that the mismatches add.
    added: Vec<SymbolId>,
    /// Difference M̃ − M̃₀ of the mass matrices of the tree and of the mean tree.
    mass: MassMatrix,
}

/// Family of constants that all copies of a node have: its letter and, for couplings, the ancestor
/// node to which they couple the copies.
struct CopyLetter<'a> {
    node: &'a UnequalNode,
    letter: Letter,
    above: Option<&'a str>,
    unit: &'static str,
}

impl CopyLetter<'_> {
    /// Names the mean, or the mismatch in the difference with this name.
    fn constant(
        &self,
        derivation: &mut Derivation<'_>,
        difference: Option<&str>,
        value: Formula,
    ) -> Formula {
        let Letter {
            code: word,
            text: letter,
            latex,
            ..
        } = self.letter;
        let node = &self.node.name;
        let (label, prefix, sign, tex, kind) = match difference {
            None => (node.as_str(), "", "", "", "mean".to_owned()),
            Some(name) => {
                let kind = format!("mismatch `{name}`");
                (name, "mismatch_", "Δ", "\\Delta ", kind)
            }
        };
        let [code, text, index, with] = match self.above {
            Some(above) => [
                format!("_{above}"),
                format!(",{above}"),
                format!(",{}", latex_name(above)),
                format!(" to `{above}`"),
            ],
            None => [const { String::new() }; 4],
        };
        derivation.constant(
            &format!("{prefix}{word}_{label}{code}"),
            &format!("{sign}{letter}_{label}{text}"),
            &format!("{tex}{latex}_{{\\mathrm{{{}{index}}}}}", latex_name(label)),
            &format!(
                "{} of the copies of `{node}`{with}: {kind}",
                word.replace('_', " ")
            ),
            self.unit,
            value,
        )
    }
}

impl Derivation<'_> {
    /// Names the means and mismatches of the constants of all copies that differ.
    pub(super) fn copy_constants(&mut self, coordinates: &[Coordinate]) -> CopyConstants {
        let mut constants = CopyConstants::default();
        for node in self.scene.unequal_nodes(coordinates) {
            let mut above = vec![(node.links.clone(), LETTERS.as_slice())];
            while let Some((ancestors, letters)) = above.pop() {
                for &letter in letters {
                    self.split_constants(&node, coordinates, letter, &ancestors, &mut constants);
                }
                let next = |link: &LinkId| self.scene.links[link.0].parent;
                let next: Option<Vec<LinkId>> = ancestors.iter().map(next).collect();
                above.extend(next.map(|next| (next, COUPLINGS.as_slice())));
            }
        }
        constants
    }

    /// Splits the constants of one letter into mean and mismatches. `others` are the ancestors that
    /// the constants couple the node's links to, or the links themselves.
    fn split_constants(
        &mut self,
        node: &UnequalNode,
        coordinates: &[Coordinate],
        letter: Letter,
        others: &[LinkId],
        constants: &mut CopyConstants,
    ) {
        let scene = self.scene;
        let orbit = |link: LinkId| &scene.orbits[scene.links[link.0].orbit.0];
        let coupled = node.links != others;
        let symbols = self.copy_symbols(node, letter, others);
        let Some(known) = symbols.iter().flatten().next() else {
            return;
        };
        let copies = CopyLetter {
            node,
            letter,
            above: coupled.then(|| orbit(others[0]).node.as_str()),
            unit: self.constants[known].unit,
        };
        let value = |symbol: &Option<SymbolId>| match symbol {
            Some(id) => self.constants[id].value.clone(),
            None => Formula::zero(),
        };
        let values: Vec<Formula> = symbols.iter().map(value).collect();
        let mut sums = vec![Formula::zero(); values.len()];
        for (number, &index) in node.coordinates.iter().enumerate() {
            let coordinate = &coordinates[index];
            let own = |link: &LinkId| node.links.iter().position(|known| known == link);
            let weights: Vec<(usize, i64)> = (coordinate.weights.iter())
                .filter_map(|(link, weight)| Some((own(link)?, *weight)))
                .collect();
            let total: Formula = (weights.iter())
                .map(|&(place, weight)| &Formula::integer(weight) * &values[place])
                .sum();
            let share = (&total / &Formula::integer(coordinate.norm())).expand();
            let difference = (number > 0).then_some(coordinate.name.as_str());
            let constant = copies.constant(self, difference, share);
            if difference.is_some() {
                constants.mismatches.extend(constant.symbols());
            }
            for (place, weight) in weights {
                sums[place] = &sums[place] + &(&Formula::integer(weight) * &constant);
            }
        }
        for (symbol, sum) in symbols.into_iter().zip(sums) {
            if let Some(symbol) = symbol {
                constants.replace(symbol, sum);
            }
        }
    }

    /// Returns the symbols of one letter for a node's links; `None` for links that do not have this
    /// constant.
    fn copy_symbols(
        &self,
        node: &UnequalNode,
        letter: Letter,
        others: &[LinkId],
    ) -> Vec<Option<SymbolId>> {
        let scene = self.scene;
        let orbit = |link: LinkId| &scene.orbits[scene.links[link.0].orbit.0].name;
        let links = node.links.iter().zip(others);
        let symbols = links.map(|(&link, &other)| {
            let other = match node.links != others {
                true => format!(",{}", orbit(other)),
                false => String::new(),
            };
            let name = format!("{}_{}{other}", letter.text, orbit(link));
            self.symbols.find(&name)
        });
        symbols.collect()
    }

    /// Derives the Lagrangian of the mean tree.
    pub(super) fn mean_frame(
        &self,
        frame: &DerivedFrame,
        constants: &CopyConstants,
    ) -> DerivedFrame {
        let zero: Vec<(SymbolId, Formula)> = (constants.mismatches.iter())
            .map(|&symbol| (symbol, Formula::zero()))
            .collect();
        let zero = [self.joints_without(&zero), zero].concat();
        let mean = |formula: &Formula| formula.substitute(&zero);
        DerivedFrame {
            coordinates: frame.coordinates.clone(),
            velocities: frame.velocities.clone(),
            momenta: frame.momenta.clone(),
            mass: frame.mass.clone().map(|_, _, entry| mean(&entry).expand()),
            potential: mean(&frame.potential),
            springs: mean(&frame.springs),
            dissipation: mean(&frame.dissipation),
            torques: frame.torques.clone(),
            drive: mean(&frame.drive),
        }
    }

    /// Derives the mismatch between a tree and its mean tree.
    pub(super) fn mismatch<'f>(
        &mut self,
        frame: &'f DerivedFrame,
        mean: &'f DerivedFrame,
        coordinates: &[Coordinate],
    ) -> Mismatch<'f> {
        let symbol = |coordinate: &Coordinate| {
            let name = &coordinate.name;
            self.symbols.intern(
                Role::Derived,
                &format!("added_omega_{name}"),
                &format!("u_{name}"),
                &format!("u_{{\\mathrm{{{}}}}}", latex_name(name)),
            )
        };
        let difference =
            |row, column, entry: Formula| (&entry - &mean.mass.get(row, column)).expand();
        Mismatch {
            added: coordinates.iter().map(symbol).collect(),
            mass: frame.mass.clone().map(difference),
            frame,
            mean,
        }
    }

    /// Returns the mean tree as plain data, and the velocities u that the mismatches add: M̃₀ u =
    /// −(M̃ − M̃₀) q̇.
    pub(super) fn mean_tree(&mut self, mismatch: &Mismatch<'_>) -> MeanTree {
        let frame = self.frame(mismatch.mean);
        let velocities = &mismatch.frame.velocities;
        let rows = 0..velocities.len();
        let right = rows.map(|row| {
            let terms = velocities.iter().enumerate();
            let terms =
                terms.map(|(column, &v)| &mismatch.mass.get(row, column) * &Formula::symbol(v));
            self.expr(&-terms.sum::<Formula>())
        });
        MeanTree {
            frame,
            added: LinearSystem {
                unknowns: mismatch.added.clone(),
                right: right.collect(),
            },
        }
    }

    /// Returns the terms that the mismatches add to W = {H_d, H}; each contains a mismatch. With
    /// q̇ = q̇₀ + u, where q̇₀ belongs to the same momenta in the mean tree,
    /// kinetic: Σ ∂V/∂q_s u_s + ∂T/∂p_s (½ q̇ᵀ ∂_s(M̃ − M̃₀) q̇ + ½ uᵀ ∂_s M̃₀ (2 q̇ − u)),
    /// potential: −Σ ∂T/∂p_s ∂(U − U₀)/∂q_s.
    pub(super) fn forcing(
        &mut self,
        mismatch: &Mismatch<'_>,
        differences: &[usize],
        energy: &SubHamiltonian,
    ) -> EnergyParts<Formula> {
        let Mismatch {
            frame,
            mean,
            added,
            mass,
        } = mismatch;
        let velocity = |index: usize| Formula::symbol(frame.velocities[index]);
        let added = |index: usize| Formula::symbol(added[index]);
        let half = Formula::integer(2).pow(-1);
        // Computes ½ Σ (x_i y_j + x_j y_i) ∂_s M_ij over the lower triangle and the diagonal.
        let form = |matrix: &MassMatrix,
                    s: SymbolId,
                    x: &dyn Fn(usize) -> Formula,
                    y: &dyn Fn(usize) -> Formula| {
            let terms = matrix.iter().map(|(i, j, entry)| {
                let mixed = &x(i) * &y(j);
                let pair = match i == j {
                    true => mixed,
                    false => &mixed + &(&x(j) * &y(i)),
                };
                &(&half * &self.partial(entry, s)) * &pair
            });
            terms.sum::<Formula>()
        };
        let both = |index: usize| &(&Formula::integer(2) * &velocity(index)) - &added(index);
        let excess = (&frame.potential - &mean.potential).expand();
        let (mut kinetic, mut potential) = (Vec::new(), Vec::new());
        for &s in differences {
            let (q, p) = (frame.coordinates[s], frame.momenta[s]);
            kinetic.push(&self.partial(&energy.potential, q) * &added(s));
            let rate = energy.kinetic.derivative(p);
            if rate.is_zero() {
                continue;
            }
            let slope = &form(mass, q, &velocity, &velocity) + &form(&mean.mass, q, &added, &both);
            kinetic.push(&rate * &slope);
            potential.push(-(&rate * &self.partial(&excess, q)));
        }
        let short = |terms: Vec<Formula>| {
            let sum = terms.into_iter().sum::<Formula>();
            self.reduce(&sum, frame, differences)
        };
        EnergyParts {
            kinetic: short(kinetic),
            potential: short(potential),
        }
    }
}
