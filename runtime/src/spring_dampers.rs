//! Spring-dampers: torsion springs and friction between links that are not parent and child.
//!
//! Each depends on the difference of two links' angles: φ = θ_a − θ_b. The torque on the first link
//! is −κ (φ − ρ) − (c + C/s + q s) φ̇ with the speed s = √(φ̇² + ε²); that on the second link is
//! its opposite. The energy is ½ κ (φ − ρ)². The mass matrix does not contain them.

use alloc::vec::Vec;

use crate::friction::FrictionLaw;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// A torsion spring and friction between two links, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamper<T> {
    /// Indices of the two links.
    pub links: [usize; 2],
    /// Stiffness κ of the torsion spring, in N m.
    pub spring: T,
    /// Difference ρ of the angles at which the spring is at rest, in rad.
    pub rest: T,
    /// Coefficient c of viscous friction, in N m s.
    pub friction: T,
    /// Law of non-viscous friction, if there is any.
    pub law: Option<FrictionLaw<T>>,
}

impl<T: Scalar> SpringDamper<T> {
    /// Converts the spring-damper to another scalar.
    #[must_use]
    pub fn map<S>(&self, convert: impl Fn(T) -> S) -> SpringDamper<S> {
        SpringDamper {
            links: self.links,
            spring: convert(self.spring),
            rest: convert(self.rest),
            friction: convert(self.friction),
            law: self.law.map(|law| law.map(&convert)),
        }
    }

    /// Returns the energy (J) of the spring, given the difference of the two angles (rad).
    #[inline(always)]
    fn energy(&self, difference: T) -> T {
        let strain = difference - self.rest;
        T::from_f64(0.5) * self.spring * strain * strain
    }

    /// Returns the torque (N m) with which the spring opposes the difference of the angles (rad).
    #[inline(always)]
    fn pull(&self, difference: T) -> T {
        self.spring * (difference - self.rest)
    }

    /// Returns one quantity for the first link, a torque or the derivative of the energy, given the
    /// difference of angles or of velocities.
    #[inline(always)]
    fn summand(&self, summand: Summand, difference: T) -> T {
        match summand {
            Summand::SpringSlope => self.pull(difference),
            Summand::SpringTorque => -self.pull(difference),
            Summand::FrictionTorque => -self.braking(difference),
        }
    }

    /// Returns the torque (N m) with which friction opposes the difference `rate` of the angular
    /// velocities (rad/s).
    #[inline(always)]
    fn braking(&self, rate: T) -> T {
        let viscous = self.friction * rate;
        match &self.law {
            Some(law) => viscous + law.torque(rate),
            None => viscous,
        }
    }
}

/// Quantity that is summed over all spring-dampers. This is an enum instead of a closure, because
/// each closure would be compiled as a separate function for vector registers.
#[derive(Clone, Copy, Debug)]
enum Summand {
    /// Derivative of the springs' energy by the angle of the first link.
    SpringSlope,
    /// Torque of the springs on the first link.
    SpringTorque,
    /// Torque of friction on the first link.
    FrictionTorque,
}

/// Run of consecutive spring-dampers with the same constants.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SpringDamperRun<T> {
    first: SpringDamper<T>,
    count: usize,
}

impl<T: Scalar> SpringDamperRun<T> {
    /// Returns true if all links of the run exist in a tree of `links` links, and none occurs
    /// twice.
    fn fits(&self, links: usize) -> bool {
        let [a, b] = self.first.links;
        let ends = a.max(b).checked_add(self.count);
        a.abs_diff(b) >= self.count && ends.is_some_and(|end| end <= links)
    }

    /// Returns the spring-dampers of the run one by one.
    fn each(self) -> impl Iterator<Item = SpringDamper<T>> {
        let [a, b] = self.first.links;
        (0..self.count).map(move |place| SpringDamper {
            links: [a + place, b + place],
            ..self.first
        })
    }

    /// Selects from `numbers` (one per link) those of the first and those of the second links of
    /// all pairs. Both slices are empty if there are too few numbers.
    #[inline(always)]
    fn sides<'a>(&self, numbers: &'a [T]) -> [&'a [T]; 2] {
        let [a, b] = self.first.links;
        let own = numbers.get(a..a + self.count).unwrap_or_default();
        [own, numbers.get(b..b + self.count).unwrap_or_default()]
    }

    /// Returns the differences between the numbers of the first and the second links of the run;
    /// empty if there are too few numbers.
    #[inline(always)]
    fn differences(&self, numbers: &[T]) -> impl Iterator<Item = T> {
        let [a, b] = self.sides(numbers);
        a.iter().zip(b).map(|(&a, &b)| a - b)
    }
}

/// All springs and friction between links of one tree.
///
/// # Examples
///
/// Two links that are connected by a spring and a damper:
///
/// ```
/// use branched_pendulum::spring_dampers::{SpringDamper, SpringDampers};
///
/// let one = SpringDamper { links: [1, 2], spring: 2.0, rest: 0.0, friction: 0.1, law: None };
/// let between = SpringDampers::new(3, vec![one]).unwrap();
/// let mut torques = [0.0; 3];
/// between.add_torques([&[9.0, 0.3, 0.1], &[9.0, 1.0, -1.0]], &mut torques);
/// assert!((torques[1] + 2.0 * 0.2 + 0.1 * 2.0_f64).abs() < 1e-15);
/// assert_eq!([torques[0], torques[2]], [0.0, -torques[1]]);
/// assert!((between.power(&[9.0, 1.0, -1.0]) + 0.1 * 4.0_f64).abs() < 1e-15);
///
/// // Of links that there are not there are none.
/// assert!(SpringDampers::new(2, vec![one]).is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SpringDampers<T> {
    links: usize,
    runs: Vec<SpringDamperRun<T>>,
}

/// No spring-dampers, for zero links.
impl<T> Default for SpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            runs: Vec::new(),
        }
    }
}

impl<T: Scalar> SpringDampers<T> {
    /// Creates the spring-dampers of a tree of `links` links. Returns `None` if a link does not
    /// exist, or if a spring-damper connects a link with itself.
    #[must_use]
    pub fn new(links: usize, list: Vec<SpringDamper<T>>) -> Option<Self> {
        Self::of_runs(links, list.into_iter().map(|own| (own, 1)))
    }

    /// Creates the spring-dampers of a tree with this number of links from runs of identical ones:
    /// the first of each run, and their number. In each spring-damper of a run both link indices
    /// are larger by one than in the one before. The memory is proportional to the number of runs.
    /// Returns `None` for links that do not exist, and if a link occurs twice in a run.
    ///
    /// # Examples
    ///
    /// Two parents with two children each, which are links 2 to 5: first the first children, then
    /// the second ones.
    ///
    /// ```
    /// use branched_pendulum::spring_dampers::{SpringDamper, SpringDampers};
    ///
    /// let first = SpringDamper { links: [2, 4], spring: 0.0, rest: 0.0, friction: 0.1, law: None };
    /// let siblings = SpringDampers::of_runs(6, [(first, 2)]).unwrap();
    /// let pairs: Vec<[usize; 2]> = siblings.iter().map(|own| own.links).collect();
    /// assert_eq!(pairs, [[2, 4], [3, 5]]);
    /// ```
    #[must_use]
    pub fn of_runs(
        links: usize,
        runs: impl IntoIterator<Item = (SpringDamper<T>, usize)>,
    ) -> Option<Self> {
        let runs = runs
            .into_iter()
            .map(|(first, count)| SpringDamperRun { first, count });
        let runs: Vec<SpringDamperRun<T>> = runs.collect();
        let fit = runs.iter().all(|run| run.fits(links));
        fit.then_some(Self { links, runs })
    }

    /// Converts the spring-dampers to another scalar: `convert` should change only the type of
    /// their constants.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SpringDampers<S> {
        let runs = self.runs.iter().map(|run| SpringDamperRun {
            first: run.first.map(&convert),
            count: run.count,
        });
        SpringDampers {
            links: self.links,
            runs: runs.collect(),
        }
    }

    /// Returns true if there are no spring-dampers.
    #[must_use]
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns the number of links of the tree.
    #[must_use]
    pub fn links(&self) -> usize {
        self.links
    }

    /// Returns the spring-dampers one by one.
    pub fn iter(&self) -> impl Iterator<Item = SpringDamper<T>> {
        self.runs.iter().flat_map(|run| run.each())
    }

    /// Returns the runs of spring-dampers with the same constants, each as its spring-dampers one by
    /// one.
    pub(crate) fn runs(&self) -> impl Iterator<Item = impl Iterator<Item = SpringDamper<T>>> {
        self.runs.iter().map(|run| run.each())
    }

    /// Returns the first spring-damper of each run.
    pub(crate) fn first_of_runs(&self) -> impl Iterator<Item = &SpringDamper<T>> {
        self.runs.iter().map(|run| &run.first)
    }

    /// Writes to `torques` all torques (N m) on the links at their angles (rad) and angular
    /// velocities (rad/s): the external torques in `outside`, if given, plus the torques between
    /// links. NaN if a slice does not have one number per link.
    #[inline(always)]
    pub fn write_torques(&self, outside: Option<&[T]>, given: [&[T]; 2], torques: &mut [T]) {
        match outside {
            Some(outside) if outside.len() != torques.len() => {
                torques.fill(T::from_f64(f64::NAN));
            }
            Some(outside) => torques.copy_from_slice(outside),
            None => torques.fill(T::from_f64(0.0)),
        }
        self.add_torques(given, torques);
    }

    /// Adds the torques (N m) on all links at their angles (rad) and angular velocities (rad/s).
    /// NaN if a slice does not have one number per link.
    #[inline(always)]
    pub fn add_torques(&self, [theta, omega]: [&[T]; 2], torques: &mut [T]) {
        self.add(theta, torques, Summand::SpringTorque);
        self.add_friction(omega, torques);
    }

    /// Adds the derivatives (N m) of the springs' energy by the angles; NaN if a slice does not
    /// have one number per link.
    #[inline(always)]
    pub fn add_spring_slopes(&self, theta: &[T], slopes: &mut [T]) {
        self.add(theta, slopes, Summand::SpringSlope);
    }

    /// Adds the torques of friction (N m); NaN if a slice does not have one number per link.
    #[inline(always)]
    pub fn add_friction(&self, omega: &[T], torques: &mut [T]) {
        self.add(omega, torques, Summand::FrictionTorque);
    }

    #[inline(always)]
    fn add(&self, given: &[T], torques: &mut [T], summand: Summand) {
        if [given.len(), torques.len()] != [self.links; 2] {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        for run in &self.runs {
            let sides = run.first.links.map(|first| first..first + run.count);
            let Ok([own, other]) = torques.get_disjoint_mut(sides) else {
                continue;
            };
            let [a, b] = run.sides(given);
            let given = a.iter().zip(b);
            for ((own, other), (&a, &b)) in own.iter_mut().zip(other).zip(given) {
                let torque = run.first.summand(summand, a - b);
                *own = *own + torque;
                *other = *other - torque;
            }
        }
    }

    /// Adds the torques on the links for several states, one in each lane of `V`. The sums have the
    /// same order as in [`add_torques`](Self::add_torques), so that a state gets the same bits as
    /// if it were computed alone.
    #[inline(always)]
    pub(crate) fn add_torques_in_registers<V: Simd<T>>(
        &self,
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        torques: &mut [V],
    ) {
        if torques.len() != self.links {
            torques.fill(V::from_f64(f64::NAN));
            return;
        }
        for summand in [Summand::SpringTorque, Summand::FrictionTorque] {
            for run in &self.runs {
                let (own, [a, b]) = (run.first.map(V::splat), run.first.links);
                for place in 0..run.count {
                    let [a, b] = [a + place, b + place];
                    let difference = match summand {
                        Summand::FrictionTorque => omega(a) - omega(b),
                        Summand::SpringSlope | Summand::SpringTorque => theta(a) - theta(b),
                    };
                    let torque = own.summand(summand, difference);
                    if let Ok([own, other]) = torques.get_disjoint_mut([a, b]) {
                        *own = *own + torque;
                        *other = *other - torque;
                    }
                }
            }
        }
    }

    /// Returns the energy (J) of the springs; NaN if there is not one angle per link.
    #[must_use]
    pub fn energy(&self, theta: &[T]) -> T {
        self.sum(theta, |own, difference| own.energy(difference))
    }

    /// Returns the energies (J) of the springs of each run, with the indices of the first two links
    /// that the run connects; empty if there is not one angle per link.
    pub fn energies(&self, theta: &[T]) -> impl Iterator<Item = ([usize; 2], T)> {
        let fits = theta.len() == self.links;
        let runs = self.runs.iter().filter(move |_| fits);
        runs.map(|run| {
            let energies = run.differences(theta).map(|own| run.first.energy(own));
            let zero = T::from_f64(0.0);
            (
                run.first.links,
                energies.fold(zero, |sum, energy| sum + energy),
            )
        })
    }

    /// Returns the power (W) of friction, which is never positive; NaN if there is not one rate per
    /// link.
    #[must_use]
    pub fn power(&self, omega: &[T]) -> T {
        self.sum(omega, |own, rate| -(own.braking(rate) * rate))
    }

    #[inline(always)]
    fn sum(&self, given: &[T], value: impl Fn(&SpringDamper<T>, T) -> T) -> T {
        if given.len() != self.links {
            return T::from_f64(f64::NAN);
        }
        let zero = T::from_f64(0.0);
        self.runs.iter().fold(zero, |sum, run| {
            let differences = run.differences(given);
            differences.fold(sum, |sum, own| sum + value(&run.first, own))
        })
    }
}
