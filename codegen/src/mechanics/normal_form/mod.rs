//! Resonant normal form of degree 4 in closed form (physics §20): frequencies as functions of the
//! actions, and the growth of a difference between copies.
//!
//! The Hamiltonian has even degrees only, so its normal form of degree 4 is the average of its
//! terms H₄ over the phases of the linear modes. With the terms U₄ and K₄ of fourth degree of both
//! energies, H₄ = U₄ − K₄ at the velocities of the linear modes, since ½ pᵀ M⁻¹ p changes by
//! −½ q̇ᵀ ΔM q̇ if the mass matrix changes by ΔM.

mod averages;
mod definitions;
mod formulas;
mod modes;

pub use formulas::{DefinitionKind, NormalFormDefinition, NormalFormFormulas, ResonantGrowth};

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::frame::{DerivedFrame, MassMatrix};
use crate::scene::LinkId;
use averages::Averages;
use definitions::Definitions;
use modes::{DIFFERENCE, Mode, SINGLE, product};
use std::collections::BTreeMap;

impl Derivation<'_> {
    /// Derives the normal form of a tree with at most two orbits, whose first one is the root.
    pub(super) fn normal_form(&mut self, frame: &DerivedFrame) -> NormalFormFormulas {
        let orbits = self.scene.orbits.iter().map(|own| own.links.clone());
        let orbits: Vec<Vec<LinkId>> = orbits.collect();
        let matrices = [
            self.at_rest(frame, &frame.mass),
            self.at_rest(frame, &self.stiffness(frame)),
        ];
        let matrices = matrices.each_ref();
        let mut define = Definitions {
            derivation: self,
            list: Vec::new(),
        };
        let mut modes = define.in_phase_modes(&orbits, matrices);
        let count = modes.len();
        modes.extend(define.difference_mode(&orbits, matrices));
        let averages = Averages::of(define.derivation.fourth_degree(frame, &modes), &modes);
        let actions: Vec<Formula> = modes[..count]
            .iter()
            .map(|mode| define.action(mode, &orbits, &frame.coordinates, matrices[0]))
            .collect();
        let frequencies = define.frequencies(&modes, &averages, &actions);
        let growth = match modes.as_slice() {
            [slow, fast, difference] => {
                let modes = [slow, fast, difference];
                Some(define.growth(modes, &averages, &actions, &frequencies))
            }
            _ => None,
        };
        let symbols = |all: &[Formula]| all.iter().flat_map(Formula::symbols).collect();
        NormalFormFormulas {
            definitions: define.list,
            actions: symbols(&actions),
            frequencies: symbols(&frequencies),
            growth,
        }
    }

    /// Returns a matrix with all angles zero.
    fn at_rest(&self, frame: &DerivedFrame, matrix: &MassMatrix) -> MassMatrix {
        let mut zero: Vec<(SymbolId, Formula)> = Vec::new();
        for (a, &angle) in frame.coordinates.iter().enumerate() {
            zero.push((self.cos(angle), Formula::integer(1)));
            zero.push((self.sin(angle), Formula::zero()));
            for &other in &frame.coordinates[..a] {
                if let Some(&(cos, sin)) = self.of_two.get(&(angle, other)) {
                    zero.extend([(cos, Formula::integer(1)), (sin, Formula::zero())]);
                }
            }
        }
        let matrix = matrix.clone();
        matrix.map(|_, _, entry| entry.substitute(&zero).expand())
    }
}

/// Returns a vector with one entry for each link: 1 for the `chosen` ones, 0 for others.
fn unit(links: usize, chosen: impl Fn(usize) -> bool) -> Vec<Formula> {
    let weights = (0..links).map(|link| i64::from(chosen(link)));
    weights.map(Formula::integer).collect()
}

impl Definitions<'_, '_> {
    /// Derives the modes in which all copies move in phase, the slow one first.
    fn in_phase_modes(&mut self, orbits: &[Vec<LinkId>], matrices: [&MassMatrix; 2]) -> Vec<Mode> {
        let [_, second, ..] = orbits else {
            let shape = [(); 2].map(|()| vec![Formula::integer(1)]);
            return vec![self.mode(SINGLE, shape, matrices)];
        };
        let links = 0..self.derivation.scene.links.len();
        let is_second = links.map(|link| second.iter().any(|own| own.0 == link));
        self.two_modes(&is_second.collect::<Vec<_>>(), matrices)
    }

    /// Derives the mode in which the first two copies move against each other; `None` without copies.
    fn difference_mode(
        &mut self,
        orbits: &[Vec<LinkId>],
        matrices: [&MassMatrix; 2],
    ) -> Option<Mode> {
        let copies = orbits.iter().find(|links| links.len() > 1)?;
        let weight = |link: usize| i64::from(link == copies[0].0) - i64::from(link == copies[1].0);
        let links = 0..self.derivation.scene.links.len();
        let shape: Vec<Formula> = links.map(|link| Formula::integer(weight(link))).collect();
        Some(self.mode(DIFFERENCE, [shape.clone(), shape], matrices))
    }

    /// Derives the action of a mode after a release from rest, from the amplitude of the first link.
    fn action(
        &mut self,
        mode: &Mode,
        orbits: &[Vec<LinkId>],
        angles: &[SymbolId],
        mass: &MassMatrix,
    ) -> Formula {
        let parts = orbits.iter().map(|orbit| {
            let first = unit(mode.shape.len(), |link| link == orbit[0].0);
            let angles = orbit.iter().map(|link| Formula::symbol(angles[link.0]));
            &product(mass, &first, &mode.shape) * &angles.sum::<Formula>()
        });
        let amplitude = &parts.sum::<Formula>() / &mode.inertia;
        let amplitude = self.define(["amplitude", "a", "a"], &[mode.name], &amplitude);
        let half = Formula::integer(2).pow(-1);
        let action = &half * &(&mode.scale * &amplitude.pow(2));
        self.define(["action", "I", "I"], &[mode.name], &action)
    }

    /// Derives the frequencies ω_j(I) = Ω_j + Σ_k A_jk I_k of all modes at the actions of the in-phase
    /// ones (20.9).
    fn frequencies(
        &mut self,
        modes: &[Mode],
        averages: &Averages,
        actions: &[Formula],
    ) -> Vec<Formula> {
        let mut shifts: BTreeMap<[usize; 2], Formula> = BTreeMap::new();
        let mut frequencies = Vec::with_capacity(modes.len());
        for (j, mode) in modes.iter().enumerate() {
            let mut frequency = mode.frequency.clone();
            for (k, (other, action)) in modes.iter().zip(actions).enumerate() {
                // The table is symmetric: each entry is defined once.
                let shift = match shifts.get(&[k, j]) {
                    Some(known) => known.clone(),
                    None => {
                        let scales = (&mode.scale * &other.scale).pow(-1);
                        let shift = &averages.shift(j, k) * &scales;
                        self.define(["shift", "A", "A"], &[mode.name, other.name], &shift)
                    }
                };
                frequency = &frequency + &(&shift * action);
                shifts.insert([j, k], shift);
            }
            frequencies.push(frequency);
        }
        let modes = modes.iter().zip(&frequencies);
        modes
            .map(|(mode, frequency)| {
                let [code, text, latex] = mode.name;
                let spelled = [
                    format!("frequency_at_actions_{code}"),
                    format!("ω_{text}(I)"),
                    format!("\\omega_{{{latex}}}(I)"),
                ];
                self.push(spelled, DefinitionKind::Value, frequency)
            })
            .collect()
    }

    /// Derives coupling, detuning and thresholds of the resonance of two modes with a difference.
    fn growth(
        &mut self,
        [slow, fast, difference]: [&Mode; 3],
        averages: &Averages,
        actions: &[Formula],
        frequencies: &[Formula],
    ) -> ResonantGrowth {
        let half = Formula::integer(2).pow(-1);
        let detuning = |all: [&Formula; 3]| all[2] - &(&half * &(all[0] + all[1]));
        let scale = self.mean("mean_action_scale", "J", [&slow.scale, &fast.scale]);
        let scale = (&scale * &difference.scale).pow(-1);
        let coefficient = &averages.resonant() * &scale;
        let coefficient = self.define(["resonant_coefficient", "C", "C"], &[], &coefficient);
        let mean = self.mean("mean_action", "I", [&actions[0], &actions[1]]);
        let coupling = &coefficient * &mean;
        let coupling = self.define(["resonant_coupling", "κ", "\\kappa"], &[], &coupling);
        self.last_is(DefinitionKind::Result);
        let shifted = detuning([&frequencies[0], &frequencies[1], &frequencies[2]]);
        let shifted = self.define(["detuning", "δ", "\\delta"], &[], &shifted);
        let square = &coupling.pow(2) - &shifted.pow(2);
        let rate = self.define(["growth_rate_squared", "λ²", "\\lambda^{2}"], &[], &square);
        self.last_is(DefinitionKind::Result);
        let linear = detuning([slow, fast, difference].map(|mode| &mode.frequency));
        let linear = self.define(["linear_detuning", "δ_0", "\\delta_0"], &[], &linear);
        let shift = &linear - &shifted;
        let mut threshold =
            |spelled, below: Formula| self.define(spelled, &[], &(&linear / &below));
        let thresholds = [
            threshold(["threshold_1", "s_1²", "s_1^{2}"], &shift + &coupling),
            threshold(["threshold_2", "s_2²", "s_2^{2}"], &shift - &coupling),
        ];
        let symbol = |formula: &Formula| formula.symbols()[0];
        ResonantGrowth {
            coupling: symbol(&coupling),
            rate_squared: symbol(&rate),
            thresholds: thresholds.each_ref().map(symbol),
        }
    }
}
