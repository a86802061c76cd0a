//! Springs and friction between copies that move in phase. Only the small differences between the
//! copies feel them.
//!
//! Let k copies have the angles θ + e_c δ with Σ e_c = 0 and Σ e_c² = k. Springs κ between every
//! two of them have the energy ½ κ Σ (e_a − e_b)² δ² = ½ κ k² δ², and friction dissipates
//! correspondingly. They therefore act as a spring and friction, k² times as strong, between the
//! link that represents the copies and its in-phase motion, once per holder (link that holds such
//! copies).

use super::algebra::Formula;
use super::derivation::Derivation;
use super::differences::SmallMotion;
use super::expression::Role;
use super::force_elements::ElementWords;
use super::frame::DerivedFrame;
use super::laws::{dissipated, stored};
use super::letters;
use super::meaning::JointDifference;
use crate::scene::{FrictionContact, FrictionLaw, LinkId, PassiveTorques};

impl Derivation<'_> {
    /// Returns the frame with the springs and friction between copies in phase. Adds the symbols of
    /// their differences, which are zero in phase, to `small`.
    pub(super) fn with_siblings(
        &mut self,
        frame: &DerivedFrame,
        small: &mut SmallMotion,
    ) -> DerivedFrame {
        let scene = self.scene;
        let (mut energies, mut losses) = (Vec::new(), Vec::new());
        for sector in scene.transverse_sectors() {
            let LinkId(link) = sector.first;
            for index in scene.spring_dampers_in_phase(sector.first) {
                let (words, passive) =
                    (scene.words_of(index), &scene.spring_dampers[index].torques);
                let count = i64::try_from(sector.copies).unwrap_or(i64::MAX);
                let squared = Formula::integer(count).pow(2);
                let [angle, rate] = self.differences_in_phase(frame, link, &words, small);
                if !passive.spring.is_zero() {
                    let meaning = format!("stiffness of the torsion spring {}", words.place);
                    let value = self.quantity(&passive.spring);
                    let constants = &words.constants;
                    let stiffness = self.lettered(letters::SPRING, constants, &meaning, value);
                    energies.push(stored(&(&squared * &stiffness), &angle));
                }
                let friction = self.friction_at_rest(&words, passive);
                if !friction.is_zero() {
                    losses.push(dissipated(&(&squared * &friction), &rate));
                }
            }
        }
        let sum = |terms: Vec<Formula>| terms.into_iter().sum::<Formula>();
        let (energy, loss) = (sum(energies), sum(losses));
        DerivedFrame {
            coordinates: frame.coordinates.clone(),
            velocities: frame.velocities.clone(),
            momenta: frame.momenta.clone(),
            mass: frame.mass.clone(),
            potential: &frame.potential + &energy,
            springs: &frame.springs + &energy,
            dissipation: &frame.dissipation + &loss,
            torques: frame.torques.clone(),
            drive: frame.drive.clone(),
        }
    }

    /// Returns the difference between the copies that a link represents, and its rate.
    fn differences_in_phase(
        &mut self,
        frame: &DerivedFrame,
        link: usize,
        words: &ElementWords,
        small: &mut SmallMotion,
    ) -> [Formula; 2] {
        let differences = [
            (
                ["copies", "χ", "\\chi"],
                frame.coordinates[link],
                small.difference(link),
            ),
            (
                ["copies_rate", "χ̇", "\\dot\\chi"],
                frame.velocities[link],
                small.rate(link),
            ),
        ];
        // Several springs between the same copies are distinguished by a number.
        let numbers = words.constants.iter().skip(2);
        let names: Vec<&String> = std::iter::once(&self.scene.links[link].name)
            .chain(numbers)
            .collect();
        differences.map(|(letters, own, change)| {
            let symbol = self.indexed_by(Role::Joint, letters, &names);
            let difference = JointDifference::of_links(own, None, Formula::zero());
            self.joints.insert(symbol, difference);
            small.copies.insert(symbol, (link, change));
            Formula::symbol(symbol)
        })
    }

    /// Returns the slope c + (C + ΔC)/ε + q ε of the friction torque at zero rate.
    fn friction_at_rest(&mut self, words: &ElementWords, passive: &PassiveTorques) -> Formula {
        let mut slope = Formula::zero();
        if !passive.friction.is_zero() {
            let meaning = format!("viscous friction {}", words.place);
            let value = self.quantity(&passive.friction);
            slope = self.lettered(letters::FRICTION, &words.constants, &meaning, value);
        }
        let law = passive.law(FrictionContact::Joint);
        if !law.is_none() {
            let FrictionLaw {
                coulomb,
                quadratic,
                width,
                excess,
                stribeck: _,
            } = self.name_law(words, FrictionContact::Joint, law);
            slope = &slope + &(&(&(&coulomb + &excess) / &width) + &(&quadratic * &width));
        }
        slope
    }
}
