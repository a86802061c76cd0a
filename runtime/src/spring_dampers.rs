//! Spring-dampers: torsion springs and friction between links that are not parent and child.
//!
//! Each acts on the difference of two links' angles: φ = θ_a − θ_b. The torque on the first link
//! is −κ (φ − ρ) − (c + C/s + q s) φ̇ with the speed s = √(φ̇² + ε²), and that on the second one
//! its opposite. The energy is ½ κ (φ − ρ)². The mass matrix knows nothing of them.

use alloc::vec::Vec;

use crate::scalar::Scalar;
use crate::simd::Simd;

/// A torsion spring and friction between two links, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamper<T> {
    /// Numbers of the two links.
    pub links: [usize; 2],
    /// Stiffness κ of the spring.
    pub spring: T,
    /// Difference ρ of the angles at which it is at rest.
    pub rest: T,
    /// Viscous friction c.
    pub friction: T,
    /// C, q and ε of friction that is not viscous, where there is some. The width ε is above zero.
    pub law: Option<[T; 3]>,
}

impl<T: Scalar> SpringDamper<T> {
    /// Returns it on other scalars.
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

    /// Energy of the spring at a difference of the angles.
    #[inline(always)]
    fn energy(&self, difference: T) -> T {
        let strain = difference - self.rest;
        T::from_f64(0.5) * self.spring * strain * strain
    }

    /// Torque of the spring that opposes it.
    #[inline(always)]
    fn pull(&self, difference: T) -> T {
        self.spring * (difference - self.rest)
    }

    /// Torque on the first link, or slope of the energy, at a difference of angles or of rates.
    #[inline(always)]
    fn summand(&self, summand: Summand, difference: T) -> T {
        match summand {
            Summand::SpringSlope => self.pull(difference),
            Summand::SpringTorque => -self.pull(difference),
            Summand::FrictionTorque => -self.braking(difference),
        }
    }

    /// Torque of friction that opposes a difference of the rates.
    #[inline(always)]
    fn braking(&self, rate: T) -> T {
        let viscous = self.friction * rate;
        let Some([coulomb, quadratic, width]) = self.law else {
            return viscous;
        };
        let speed = (rate * rate + width * width).sqrt();
        viscous + (coulomb / speed + quadratic * speed) * rate
    }
}

/// What is added up of spring-dampers. Said by name: closures are functions of their own where
/// numbers are vector registers.
#[derive(Clone, Copy, Debug)]
enum Summand {
    /// Derivative of the springs' energy by the first angle.
    SpringSlope,
    /// Torque of the springs on the first link.
    SpringTorque,
    /// Torque of friction on it.
    FrictionTorque,
}

/// Spring-dampers of the same constants side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SpringDamperRun<T> {
    first: SpringDamper<T>,
    count: usize,
}

impl<T: Scalar> SpringDamperRun<T> {
    /// Returns true if all links are among so many, and none is on both sides or there twice.
    fn fits(&self, links: usize) -> bool {
        let [a, b] = self.first.links;
        let ends = a.max(b).checked_add(self.count);
        a.abs_diff(b) >= self.count && ends.is_some_and(|end| end <= links)
    }

    /// Each by itself.
    fn each(self) -> impl Iterator<Item = SpringDamper<T>> {
        let [a, b] = self.first.links;
        (0..self.count).map(move |place| SpringDamper {
            links: [a + place, b + place],
            ..self.first
        })
    }

    /// The numbers of the links on both sides; none of too few numbers.
    #[inline(always)]
    fn sides<'a>(&self, numbers: &'a [T]) -> [&'a [T]; 2] {
        let [a, b] = self.first.links;
        let own = numbers.get(a..a + self.count).unwrap_or_default();
        [own, numbers.get(b..b + self.count).unwrap_or_default()]
    }

    /// The differences of numbers of the links; none of too few numbers.
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
/// Two links that a spring and a damper hold together:
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

/// None between no links.
impl<T> Default for SpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            runs: Vec::new(),
        }
    }
}

impl<T: Scalar> SpringDampers<T> {
    /// Returns those of a tree of so many links; none for one between links that there are not,
    /// and for one between a link and itself.
    #[must_use]
    pub fn new(links: usize, list: Vec<SpringDamper<T>>) -> Option<Self> {
        Self::of_runs(links, list.into_iter().map(|own| (own, 1)))
    }

    /// Returns those of a tree of so many links where spring-dampers of the same constants stand
    /// side by side: of each run the first one and their number, each acting between the links
    /// behind those of the one before. Memory is that of the runs. None for links that there are
    /// not, and where a link is in a run twice.
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

    /// Returns them on other scalars: `convert` should change the type of their constants and
    /// not their value.
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

    /// Returns true if there is none.
    #[must_use]
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Number of links of the tree.
    #[must_use]
    pub fn links(&self) -> usize {
        self.links
    }

    /// Returns them one by one.
    pub fn iter(&self) -> impl Iterator<Item = SpringDamper<T>> {
        self.runs.iter().flat_map(|run| run.each())
    }

    /// Returns the first of each run.
    pub(crate) fn first_of_runs(&self) -> impl Iterator<Item = &SpringDamper<T>> {
        self.runs.iter().map(|run| &run.first)
    }

    /// Writes to `torques` all torques (N m) on the links at their angles (rad) and angular
    /// velocities (rad/s): those from `outside`, where there are any, and those between links. NaN
    /// for slices of another length than there are links.
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
    /// NaN for slices of another length than there are links.
    #[inline(always)]
    pub fn add_torques(&self, [theta, omega]: [&[T]; 2], torques: &mut [T]) {
        self.add(theta, torques, Summand::SpringTorque);
        self.add_friction(omega, torques);
    }

    /// Adds the derivatives (N m) of the springs' energy by the angles; NaN likewise.
    #[inline(always)]
    pub fn add_spring_slopes(&self, theta: &[T], slopes: &mut [T]) {
        self.add(theta, slopes, Summand::SpringSlope);
    }

    /// Adds the torques of friction; NaN likewise.
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

    /// Adds the torques on the links of states in the lanes of `V`, in the order in which
    /// [`add_torques`](Self::add_torques) does: a state has the bits that it has alone.
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
                        _ => theta(a) - theta(b),
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

    /// Energy (J) of the springs; NaN for another number of angles than there are links.
    #[must_use]
    pub fn energy(&self, theta: &[T]) -> T {
        self.sum(theta, |own, difference| own.energy(difference))
    }

    /// Returns the energies (J) of springs whose constants are the same, with the numbers of the
    /// first two links that they act between; nothing for another number of angles than there are
    /// links.
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

    /// Power (W) of the friction, never positive; NaN likewise.
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
