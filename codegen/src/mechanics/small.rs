//! Small differences that act back on the in-phase motion.
//!
//! With copies at θ + e δ, Σ e = 0 and Σ e² = their number, the Lagrangian of the whole tree is
//! L₀(θ, ω) + L₂(θ, ω; δ, δ̇) to second order. Here L₂ is half the second derivative of L₀ along
//! (δ, δ̇), for one holder (link that holds such copies). All equations follow from this sum, so
//! that the model has a conserved energy. The Euler–Lagrange operator is linear: the equations of θ
//! get half the second derivative of their own terms, and the equations of δ are the transverse
//! ones at the resulting accelerations.

use super::MatrixEntry;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::differences::{SmallFormulas, SmallMechanics, SmallMotion, TransverseFormulas};
use super::frame::DerivedFrame;

impl Derivation<'_> {
    pub(super) fn small(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        transverse: &[TransverseFormulas],
    ) -> Option<SmallMechanics> {
        let wanted = &self.scene.requests.small;
        if wanted.is_empty() {
            return None;
        }
        let kinetic: Formula = frame.kinetic_terms().map(|(_, _, term)| term).sum();
        let energy = (&kinetic + &frame.potential).expand();
        let bias = frame.bias(self);
        let sectors = wanted.iter().map(|&number| {
            self.small_sector(
                frame,
                small,
                (number, &transverse[number]),
                (&energy, &bias),
            )
        });
        Some(SmallMechanics {
            sectors: sectors.collect(),
            energy: self.expr(&small.in_phase(&energy)),
        })
    }

    fn small_sector(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        (number, TransverseFormulas { sector, .. }): (usize, &TransverseFormulas),
        (energy, bias): (&Formula, &[Formula]),
    ) -> SmallFormulas {
        let block = sector.first.0..sector.first.0 + sector.links;
        let holders = Formula::integer(i64::try_from(sector.holders).unwrap_or(i64::MAX));
        let of_one = |formula: &Formula| self.expr(&(&holders.pow(-1) * formula).expand());
        let along = |formula: &Formula| self.linearised(frame, small, formula, block.clone());
        let first = |formula: &Formula| of_one(&along(formula));
        let half = Formula::integer(2).pow(-1);
        let second = |formula: &Formula| of_one(&(&half * &along(&along(formula))));
        let entry = |(row, column, value)| MatrixEntry { row, column, value };
        let nonzero = |entry: &MatrixEntry| !entry.value.is_zero();
        let mass = frame.mass.iter();
        let mass = mass.map(|(row, column, value)| entry((row, column, second(value))));
        let rows = block.clone().enumerate();
        let coupling = rows.flat_map(|(row, link)| {
            (0..bias.len()).map(move |column| (row, column, frame.mass.get(link, column)))
        });
        let coupling = coupling.map(|(row, column, value)| entry((row, column, first(&value))));
        SmallFormulas {
            sector: number,
            mass: mass.filter(nonzero).collect(),
            coupling: coupling.filter(nonzero).collect(),
            bias: bias.iter().map(second).collect(),
            difference_bias: bias[block.clone()].iter().map(first).collect(),
            energy: second(energy),
        }
    }
}
