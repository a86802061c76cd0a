//! Translational spring-dampers: straight springs, forces by a power of the distance and viscous
//! dampers between points of links.
//!
//! The line from the first point to the second one is d = d₀ + Σ R(θ_i) r_i: a part d₀ that no
//! angle turns, and an arm r_i of each link on the way between the points. The energy U is a sum of
//! terms of the length ℓ = |d|: ½ κ (ℓ − L₀)² of a spring, A/ℓⁿ of a force by a power of the
//! distance. The power of the damper is −c ℓ̇², and the torque on link i is
//! −(dU/dℓ + c ℓ̇) ∂ℓ/∂θ_i.
//!
//! Where the points meet, ℓ = 0, a line has no direction: torques are NaN there, but for those of
//! a spring without length at rest, whose energy is ½ κ d·d, and which has no damper. The energy
//! A/ℓⁿ is infinite there.

mod line;

use alloc::vec::Vec;

pub(crate) use line::length_to;
pub use line::{LineArm, LinePotential, TranslationalSpringDamper};

use crate::scalar::{Scalar, at};
use crate::simd::Simd;
use line::{Line, Pull};

/// Lines of the same constants side by side.
#[derive(Clone, Debug, PartialEq)]
struct LineRun<T> {
    first: TranslationalSpringDamper<T>,
    count: usize,
}

impl<T: Scalar> LineRun<T> {
    /// The line in a place.
    fn at(&self, place: usize) -> TranslationalSpringDamper<T> {
        let mut own = self.first.clone();
        for arm in &mut own.arms {
            arm.link += place;
        }
        own
    }

    /// The lines at angles, and with rates where there are any.
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

/// None between no links.
impl<T> Default for TranslationalSpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            runs: Vec::new(),
        }
    }
}

impl<T: Scalar> TranslationalSpringDampers<T> {
    /// Returns those of a tree of so many links; none for arms of links that there are not, and
    /// for two arms of one link.
    #[must_use]
    pub fn new(links: usize, list: Vec<TranslationalSpringDamper<T>>) -> Option<Self> {
        Self::of_runs(links, list.into_iter().map(|own| (own, 1)))
    }

    /// Returns those of a tree of so many links where lines of the same constants stand side by
    /// side, as [`SpringDampers::of_runs`](crate::spring_dampers::SpringDampers::of_runs): of each
    /// run the first one and their number, the arms of each being those of the links behind those
    /// of the one before. Memory is that of the runs.
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

    /// Returns them on other scalars: `convert` should change the type of their constants and
    /// not their value.
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

    /// Returns true if there is none.
    #[must_use]
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns true if there is none in a tree of so many links, whose torques stay as they are.
    /// Lines of a tree of another number of links make them NaN.
    #[inline(always)]
    pub(crate) fn is_empty_on(&self, links: usize) -> bool {
        self.runs.is_empty() && self.links == links
    }

    /// Returns them one by one.
    pub fn iter(&self) -> impl Iterator<Item = TranslationalSpringDamper<T>> {
        let runs = self.runs.iter();
        runs.flat_map(|run| (0..run.count).map(|place| run.at(place)))
    }

    /// Adds the torques (N m) on all links at their angles (rad) and angular velocities (rad/s).
    /// NaN for slices of another length than there are links, and where points meet, but for a
    /// spring alone without a length at rest. O(arms).
    #[inline(always)]
    pub fn add_torques(&self, given: [&[T]; 2], torques: &mut [T]) {
        self.add_slices(given, torques, Pull::Whole);
    }

    /// Adds the torques of the dampers alone, likewise.
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

    /// Adds the torques on the links of states in the lanes of `V`, in the order in which
    /// [`add_torques`](Self::add_torques) does.
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

    /// Energy (J) that the lines store; NaN for another number of angles than there are links.
    /// Where points meet, A/ℓⁿ is infinite.
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

    /// Power (W) of the dampers, never positive; NaN likewise, and where the points of a damper
    /// meet.
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
