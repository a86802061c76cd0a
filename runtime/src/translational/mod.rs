//! Translational spring-dampers: straight springs, power-law forces and viscous dampers between
//! points of links.
//!
//! The line from the first point to the second is d = d₀ + Σ R(θ_i) r_i: a constant part d₀, and an
//! arm r_i of each link on the path between the points, rotated by the link's angle. The energy U
//! is a sum of terms of the length ℓ = |d|: ½ κ (ℓ − L₀)² of a spring, A/ℓⁿ of a power law. The
//! power of the damper is −c ℓ̇², and the torque on link i is −(dU/dℓ + c ℓ̇) ∂ℓ/∂θ_i.
//!
//! If the points meet, ℓ = 0, the line has no direction, and torques are NaN. An exception are
//! springs of zero rest length without a damper, whose energy is ½ κ d·d. The energy A/ℓⁿ is
//! infinite there.

mod line;

use alloc::vec::Vec;

pub(crate) use line::length_to;
pub use line::{LineArm, LinePotential, TranslationalSpringDamper};

use crate::scalar::{Scalar, at};
use crate::simd::Simd;
use line::{Line, Pull};

/// Consecutive lines with the same constants.
#[derive(Clone, Debug, PartialEq)]
struct LineRun<T> {
    first: TranslationalSpringDamper<T>,
    count: usize,
}

impl<T: Scalar> LineRun<T> {
    /// Returns line number `place` of the run.
    fn at(&self, place: usize) -> TranslationalSpringDamper<T> {
        let mut own = self.first.clone();
        for arm in &mut own.arms {
            arm.link += place;
        }
        own
    }

    /// Returns the geometry of all lines of the run at the given angles, with its rates of change
    /// if `omega` is given.
    fn lines<'a>(
        &'a self,
        theta: &'a [T],
        omega: Option<&'a [T]>,
    ) -> impl Iterator<Item = Line<T>> + use<'a, T> {
        (0..self.count).map(move |place| {
            let omega = omega.map(|omega| move |link: usize| at(omega, link + place));
            self.first.line(|link| at(theta, link + place), omega)
        })
    }
}

/// All straight springs and dampers of one tree.
///
/// # Examples
///
/// A guy from the end of a rod of 0.3 m to a peg beside it, at the height of the pivot:
///
/// ```
/// use branched_pendulum::translational::{
///     LineArm, LinePotential, TranslationalSpringDamper, TranslationalSpringDampers,
/// };
///
/// let guy = TranslationalSpringDamper {
///     // From the end to the peg at x = 0.4 m.
///     arms: vec![LineArm { link: 0, along: -0.3, lateral: 0.0 }],
///     offset: [0.4, 0.0],
///     potentials: vec![LinePotential::Spring { stiffness: 10.0, rest: Some(0.2) }],
///     friction: None,
/// };
/// let guys = TranslationalSpringDampers::new(1, vec![guy]).unwrap();
/// // Hanging, the rod is 0.5 m away from the peg: a pull of 3 N at a lever of 0.24 m.
/// let mut torques = [0.0];
/// guys.add_torques([&[0.0], &[0.0]], &mut torques);
/// assert!((torques[0] - 3.0 * 0.24_f64).abs() < 1e-15);
/// assert!((guys.energy(&[0.0]) - 0.5 * 10.0 * 0.3 * 0.3_f64).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TranslationalSpringDampers<T> {
    links: usize,
    runs: Vec<LineRun<T>>,
}

/// No lines, for zero links.
impl<T> Default for TranslationalSpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            runs: Vec::new(),
        }
    }
}

impl<T: Scalar> TranslationalSpringDampers<T> {
    /// Returns the lines of a tree of `links` links. Returns `None` for arms on links that the tree lacks, for two arms
    /// on one link, and for a line without arms, whose length no angle changes.
    #[must_use]
    pub fn new(links: usize, list: Vec<TranslationalSpringDamper<T>>) -> Option<Self> {
        Self::of_runs(links, list.into_iter().map(|own| (own, 1)))
    }

    /// Returns the lines of a tree of `links` links, in which consecutive lines share their
    /// constants, as in [`SpringDampers::of_runs`](crate::spring_dampers::SpringDampers::of_runs).
    /// Each run is given by its first line and the number of its lines; the links of each line have
    /// indices larger by one than the links of the line before. Memory is proportional to the
    /// number of runs. Returns `None` in the same cases as [`new`](Self::new).
    #[must_use]
    pub fn of_runs(
        links: usize,
        runs: impl IntoIterator<Item = (TranslationalSpringDamper<T>, usize)>,
    ) -> Option<Self> {
        let runs = runs.into_iter();
        let runs = runs.map(|(first, count)| LineRun { first, count });
        let runs: Vec<LineRun<T>> = runs.collect();
        let fit = runs.iter().all(|run| run.first.fits(links, run.count));
        fit.then_some(Self { links, runs })
    }

    /// Converts the constants of the lines to another scalar type by `convert`, which should not
    /// change their values.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> TranslationalSpringDampers<S> {
        let runs = self.runs.iter().map(|run| LineRun {
            first: run.first.map(&convert),
            count: run.count,
        });
        TranslationalSpringDampers {
            links: self.links,
            runs: runs.collect(),
        }
    }

    /// Returns true if there are no lines.
    #[must_use]
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns true if there are no lines and the tree has this number of links, so that its
    /// torques do not change. Lines made for another number of links make the torques NaN.
    #[inline(always)]
    pub(crate) fn is_empty_on(&self, links: usize) -> bool {
        self.runs.is_empty() && self.links == links
    }

    /// Returns the number of links of the tree.
    pub(crate) fn links(&self) -> usize {
        self.links
    }

    /// Returns the runs of lines with the same constants: the first line of each, and the number of
    /// its lines. In each line of a run all link indices are larger by one than in the line before.
    pub(crate) fn runs(&self) -> impl Iterator<Item = (&TranslationalSpringDamper<T>, usize)> {
        self.runs.iter().map(|run| (&run.first, run.count))
    }

    /// Returns the lines one by one.
    pub fn iter(&self) -> impl Iterator<Item = TranslationalSpringDamper<T>> {
        let runs = self.runs.iter();
        runs.flat_map(|run| (0..run.count).map(|place| run.at(place)))
    }

    /// Adds the torques (N m) on all links at their angles (rad) and angular velocities (rad/s).
    /// NaN if a slice does not have one number per link, and if points meet, except for springs of
    /// zero rest length alone. O(arms).
    #[inline(always)]
    pub fn add_torques(&self, given: [&[T]; 2], torques: &mut [T]) {
        self.add_slices(given, torques, Pull::Whole);
    }

    /// Adds the derivatives (N m) of the potential energy by the angles to `slopes`; NaN if a slice
    /// does not have one number per link, and if points meet, as in
    /// [`add_torques`](Self::add_torques).
    pub fn add_energy_slopes(&self, theta: &[T], slopes: &mut [T]) {
        let rest = alloc::vec![T::from_f64(0.0); theta.len()];
        let mut torques = alloc::vec![T::from_f64(0.0); slopes.len()];
        self.add_slices([theta, &rest], &mut torques, Pull::OfEnergy);
        for (slope, torque) in slopes.iter_mut().zip(torques) {
            *slope = *slope - torque;
        }
    }

    /// Adds the torques (N m) of the dampers only; NaN in the same cases as
    /// [`add_torques`](Self::add_torques).
    pub fn add_friction(&self, given: [&[T]; 2], torques: &mut [T]) {
        self.add_slices(given, torques, Pull::OfDamper);
    }

    #[inline(always)]
    fn add_slices(&self, [theta, omega]: [&[T]; 2], torques: &mut [T], pull: Pull) {
        if [theta.len(), omega.len()] != [self.links; 2] {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        self.add::<T>(
            |link| at(theta, link),
            |link| at(omega, link),
            torques,
            pull,
        );
    }

    /// Adds the torques on the links for several states, one in each lane of `V`. The sums have the
    /// same order as in [`add_torques`](Self::add_torques).
    #[inline(always)]
    pub(crate) fn add_torques_in_registers<V: Simd<T>>(
        &self,
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        torques: &mut [V],
    ) {
        self.add(theta, omega, torques, Pull::Whole);
    }

    #[inline(always)]
    fn add<V: Simd<T>>(
        &self,
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        torques: &mut [V],
        pull: Pull,
    ) {
        if torques.len() != self.links {
            torques.fill(V::from_f64(f64::NAN));
            return;
        }
        for run in &self.runs {
            let own = &run.first;
            for place in 0..run.count {
                let angle = |link: usize| theta(link + place);
                let rate = |link: usize| omega(link + place);
                let line = own.line(angle, own.friction.is_some().then_some(rate));
                if let Some(pull) = own.pull(&line, pull) {
                    own.subtract(place, angle, &line, pull, torques);
                }
            }
        }
    }

    /// Returns the potential energy (J) of the lines; NaN if there is not one angle per link. If
    /// points meet, A/ℓⁿ is infinite.
    #[must_use]
    pub fn energy(&self, theta: &[T]) -> T {
        if theta.len() != self.links {
            return T::from_f64(f64::NAN);
        }
        let energies = self.runs.iter().flat_map(|run| {
            let lines = run.lines(theta, None);
            lines.map(|line| run.first.energy(&line))
        });
        energies.fold(T::from_f64(0.0), |sum, energy| sum + energy)
    }

    /// Returns the power (W) of the dampers, which is never positive; NaN if a slice does not have
    /// one number per link, or if the points of a damper meet.
    #[must_use]
    pub fn power(&self, theta: &[T], omega: &[T]) -> T {
        if [theta.len(), omega.len()] != [self.links; 2] {
            return T::from_f64(f64::NAN);
        }
        let powers = self.runs.iter().flat_map(|run| {
            let lines = run.lines(theta, Some(omega));
            lines.filter_map(|line| run.first.power(&line))
        });
        powers.fold(T::from_f64(0.0), |sum, power| sum + power)
    }
}

#[cfg(test)]
mod tests {
    use super::{LineArm, LinePotential, TranslationalSpringDamper, TranslationalSpringDampers};
    use alloc::vec;
    use alloc::vec::Vec;

    fn line(arms: &[usize]) -> TranslationalSpringDamper<f64> {
        let arms = arms.iter().map(|&link| LineArm {
            link,
            along: 0.3 + 0.1 * link as f64,
            lateral: 0.05,
        });
        TranslationalSpringDamper {
            arms: arms.collect(),
            offset: [0.4, -0.1],
            potentials: vec![LinePotential::Spring {
                stiffness: 10.0,
                rest: Some(0.2),
            }],
            friction: Some(0.5),
        }
    }

    #[test]
    fn lines_without_arms_or_of_missing_links_are_refused() {
        let of_runs =
            |arms: &[usize], count| TranslationalSpringDampers::of_runs(4, [(line(arms), count)]);
        for (arms, count) in [
            (&[][..], 1),
            (&[], 0),
            (&[], usize::MAX),
            (&[4], 1),
            (&[1], 4),
            (&[3], usize::MAX),
            (&[2, 2], 1),
        ] {
            assert!(of_runs(arms, count).is_none(), "{arms:?} {count}");
        }
        assert!(TranslationalSpringDampers::new(4, vec![line(&[0]), line(&[])]).is_none());
        for (arms, count) in [(&[0][..], 4), (&[3], 1), (&[0, 2], 2), (&[3, 1], 1)] {
            assert!(of_runs(arms, count).is_some(), "{arms:?} {count}");
        }
    }

    /// Compares the derivatives of the energy with difference quotients; dampers do not change
    /// them.
    #[test]
    fn slopes_are_those_of_the_energy() {
        let runs = [(line(&[0, 2]), 2), (line(&[1]), 1)];
        let lines = TranslationalSpringDampers::of_runs(4, runs).unwrap();
        let theta = [0.3, -0.2, 1.1, 0.7];
        let mut slopes = [1.0; 4];
        lines.add_energy_slopes(&theta, &mut slopes);
        for (link, slope) in slopes.iter().enumerate() {
            let energy = |step: f64| {
                let mut moved: Vec<f64> = theta.to_vec();
                moved[link] += step;
                lines.energy(&moved)
            };
            let expected = (energy(1e-5) - energy(-1e-5)) / 2e-5;
            assert!(
                (slope - 1.0 - expected).abs() < 1e-8,
                "{link}: {slope} {expected}"
            );
        }
    }

    #[test]
    fn runs_are_listed_with_all_of_their_links() {
        for (arms, count) in [(&[0, 2][..], 2), (&[1], 3), (&[3, 0], 1)] {
            let lines = TranslationalSpringDampers::of_runs(4, [(line(arms), count)]).unwrap();
            let listed: Vec<Vec<usize>> = lines
                .iter()
                .map(|own| own.arms.iter().map(|arm| arm.link).collect())
                .collect();
            let expected: Vec<Vec<usize>> = (0..count)
                .map(|place| arms.iter().map(|arm| arm + place).collect())
                .collect();
            assert_eq!(listed, expected);
        }
    }
}
