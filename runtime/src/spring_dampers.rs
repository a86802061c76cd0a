//! Spring-dampers: torsion springs and friction between links that are not parent and child.
//!
//! Each acts on the difference of two links' angles: φ = θ_a − θ_b. The torque on the first link
//! is −κ (φ − ρ) − (c + C/s + q s) φ̇ with the speed s = √(φ̇² + ε²), and that on the second one
//! its opposite. The energy is ½ κ (φ − ρ)². The mass matrix knows nothing of them.

use alloc::vec::Vec;

use crate::scalar::Scalar;

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

    /// Energy of the spring at angles of all links.
    #[inline(always)]
    fn energy(&self, theta: &[T]) -> T {
        let strain = self.strain(theta);
        T::from_f64(0.5) * self.spring * strain * strain
    }

    /// Strain of the spring.
    #[inline(always)]
    fn strain(&self, theta: &[T]) -> T {
        self.difference(theta) - self.rest
    }

    #[inline(always)]
    fn difference(&self, values: &[T]) -> T {
        let [a, b] = self.links;
        values[a] - values[b]
    }

    /// Torque of friction that opposes the difference of the rates.
    #[inline(always)]
    fn braking(&self, omega: &[T]) -> T {
        let rate = self.difference(omega);
        let viscous = self.friction * rate;
        let Some([coulomb, quadratic, width]) = self.law else {
            return viscous;
        };
        let speed = (rate * rate + width * width).sqrt();
        viscous + (coulomb / speed + quadratic * speed) * rate
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
    list: Vec<SpringDamper<T>>,
}

/// None between no links.
impl<T> Default for SpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            list: Vec::new(),
        }
    }
}

impl<T: Scalar> SpringDampers<T> {
    /// Returns those of a tree of so many links; none for one between links that there are not.
    #[must_use]
    pub fn new(links: usize, list: Vec<SpringDamper<T>>) -> Option<Self> {
        let mut all = list.iter().flat_map(|own| own.links);
        all.all(|link| link < links).then_some(Self { links, list })
    }

    /// Returns them on other scalars: `convert` should change the type of their constants and
    /// not their value.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SpringDampers<S> {
        SpringDampers {
            links: self.links,
            list: self.list.iter().map(|own| own.map(&convert)).collect(),
        }
    }

    /// Returns true if there is none.
    #[must_use]
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of links of the tree.
    #[must_use]
    pub fn links(&self) -> usize {
        self.links
    }

    /// Returns them one by one.
    #[must_use]
    pub fn list(&self) -> &[SpringDamper<T>] {
        &self.list
    }

    /// Adds the torques (N m) on all links at their angles (rad) and angular velocities (rad/s).
    /// NaN for slices of another length than there are links.
    #[inline(always)]
    pub fn add_torques(&self, [theta, omega]: [&[T]; 2], torques: &mut [T]) {
        self.add(theta, torques, |own| -(own.spring * own.strain(theta)));
        self.add_friction(omega, torques);
    }

    /// Adds the derivatives (N m) of the springs' energy by the angles; NaN likewise.
    #[inline(always)]
    pub fn add_spring_slopes(&self, theta: &[T], slopes: &mut [T]) {
        self.add(theta, slopes, |own| own.spring * own.strain(theta));
    }

    /// Adds the torques of friction; NaN likewise.
    #[inline(always)]
    pub fn add_friction(&self, omega: &[T], torques: &mut [T]) {
        self.add(omega, torques, |own| -own.braking(omega));
    }

    #[inline(always)]
    fn add(&self, given: &[T], torques: &mut [T], torque: impl Fn(&SpringDamper<T>) -> T) {
        if [given.len(), torques.len()] != [self.links; 2] {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        for own in &self.list {
            let ([a, b], torque) = (own.links, torque(own));
            torques[a] = torques[a] + torque;
            torques[b] = torques[b] - torque;
        }
    }

    /// Energy (J) of the springs; NaN for another number of angles than there are links.
    #[must_use]
    pub fn energy(&self, theta: &[T]) -> T {
        self.sum(theta, |own| own.energy(theta))
    }

    /// Returns the energy (J) of each by itself, with the numbers of the two links; nothing for
    /// another number of angles than there are links.
    pub fn energies(&self, theta: &[T]) -> impl Iterator<Item = ([usize; 2], T)> {
        let fits = theta.len() == self.links;
        let list = self.list.iter().filter(move |_| fits);
        list.map(|own| (own.links, own.energy(theta)))
    }

    /// Power (W) of the friction, never positive; NaN likewise.
    #[must_use]
    pub fn power(&self, omega: &[T]) -> T {
        self.sum(omega, |own| -(own.braking(omega) * own.difference(omega)))
    }

    fn sum(&self, given: &[T], value: impl Fn(&SpringDamper<T>) -> T) -> T {
        if given.len() != self.links {
            return T::from_f64(f64::NAN);
        }
        let zero = T::from_f64(0.0);
        self.list.iter().fold(zero, |sum, own| sum + value(own))
    }
}
