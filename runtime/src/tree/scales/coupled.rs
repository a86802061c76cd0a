//! Springs and friction between siblings, by scale.
//!
//! Springs κ between all pairs of k copies have the energy ½ κ k Σ (θ_c − mean)². It depends only
//! on the differences between the copies, so it belongs to the scale at which the copies branch.

use super::{ActingOnScales, ScaleEquations, ScaleOutput, by_scale};
use crate::scalar::{Scalar, at};
use crate::sectors::ScaleBudget;
use crate::spring_dampers::SpringDampers;
use crate::system::Workspace;
use crate::tree::Tree;

impl<T: Scalar> SpringDampers<T> {
    /// Writes quantities for an energy budget by scale: at the given angles (rad) and angular
    /// velocities (rad/s), the derivatives (N m) of the springs' energy with respect to the angles,
    /// and the torques (N m) of friction. NaN if a slice does not have one number per link.
    pub fn write_for_scales(&self, [theta, omega]: [&[T]; 2], between: [&mut [T]; 2]) {
        let [slopes, friction] = between;
        slopes.fill(T::from_f64(0.0));
        friction.fill(T::from_f64(0.0));
        self.add_spring_slopes(theta, slopes);
        self.add_friction(omega, friction);
    }

    /// Adds the energies (J) of springs between siblings to their scales. `scale_of` returns the
    /// scale of a run of springs from its first link; runs without a scale are left out. Adds
    /// nothing if the number of angles is not the number of links.
    pub fn add_energies_by_scale(
        &self,
        theta: &[T],
        scale_of: impl Fn(usize) -> Option<usize>,
        budget: &mut ScaleBudget<T>,
    ) {
        for ([link, _], energy) in self.energies(theta) {
            if let Some(scale) = scale_of(link) {
                budget.add_energy(scale, energy);
            }
        }
    }
}

/// Links of one generation of a rule-based tree, grouped as siblings.
#[derive(Clone, Copy)]
struct Siblings {
    /// Index of its first link.
    first: usize,
    /// Number of links in the generation before.
    parents: usize,
    /// Number of copies under each link of the generation before.
    copies: usize,
}

impl<E: ScaleEquations, T: Scalar> Tree<E, T> {
    /// Iterates over the generations below the root.
    fn siblings() -> impl Iterator<Item = Siblings> {
        let copies = E::COPIES.iter().skip(1);
        copies.scan((1, 1), |(first, parents), &copies| {
            let own = Siblings {
                first: *first,
                parents: *parents,
                copies,
            };
            *parents *= copies;
            *first += *parents;
            Some(own)
        })
    }

    /// Computes the whole budget.
    pub(super) fn whole_budget(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<[T; 3]>,
        given: [&[T]; 3],
        budget: &mut ScaleBudget<T>,
    ) {
        let [theta, omega, _] = given;
        if !E::COUPLED {
            let (acting, wanted) = (ActingOnScales::of(drive), ScaleOutput::Budget(budget));
            return by_scale(self.rule(), workspace, acting, given, wanted);
        }
        let links = self.skeleton.plan.links();
        let (numbers, workspace) = workspace.with_inner(2 * links);
        let (slopes, friction) = numbers.split_at_mut(links);
        self.spring_dampers
            .write_for_scales([theta, omega], [&mut *slopes, &mut *friction]);
        let between = [&*slopes, &*friction];
        let (acting, wanted) = (
            ActingOnScales { drive, between },
            ScaleOutput::Budget(&mut *budget),
        );
        by_scale(self.rule(), workspace, acting, given, wanted);
        self.add_energies_between(theta, budget);
    }

    /// Adds the energies of springs between siblings.
    pub(super) fn add_energies_between(&self, theta: &[T], budget: &mut ScaleBudget<T>) {
        if !E::COUPLED {
            return;
        }
        let scale_of = |link: usize| {
            let generation = Self::siblings().position(|own| {
                link.checked_sub(own.first)
                    .is_some_and(|place| place < own.parents * own.copies)
            });
            generation.map(|generation| generation + 1)
        };
        self.spring_dampers
            .add_energies_by_scale(theta, scale_of, budget);
    }

    /// Adds the energies of springs between siblings to the energies of single sectors: ½ κ k d²
    /// for each difference d between k copies, because Helmert's differences are normalised.
    pub(super) fn add_energies_of_sectors(&self, theta: &[T], energies: &mut [T]) {
        if !E::COUPLED || theta.len() != self.skeleton.plan.links() {
            return;
        }
        let zero = T::from_f64(0.0);
        // The first energy is that of the means.
        let mut sectors = energies.iter_mut().skip(1);
        for own in Self::siblings() {
            // The springs between the first two copies under the first parent; those between all
            // other copies are identical.
            let pair = [own.first, own.first + own.parents];
            let springs = self.spring_dampers.first_of_runs();
            let stiffness = springs
                .filter(|spring| own.copies > 1 && spring.links == pair)
                .fold(zero, |sum, spring| sum + spring.spring);
            let half = T::from_f64(0.5 * own.copies as f64) * stiffness;
            for parent in 0..own.parents {
                let angle = |copy: usize| at(theta, own.first + copy * own.parents + parent);
                let mut sum = zero;
                for copy in 1..own.copies {
                    sum = sum + angle(copy - 1);
                    let next = T::from_f64(copy as f64);
                    let difference = sum - next * angle(copy);
                    let norm = next * (next + T::from_f64(1.0));
                    if let Some(energy) = sectors.next() {
                        *energy = *energy + half * (difference * difference / norm);
                    }
                }
            }
        }
    }
}
