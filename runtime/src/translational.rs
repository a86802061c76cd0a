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

use alloc::vec::Vec;

use crate::scalar::Scalar;

/// The part of a line that turns with a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LineArm<T> {
    /// Number of the link.
    pub link: usize,
    /// Component along the link, m.
    pub along: T,
    /// Component across the link, m.
    pub lateral: T,
}

/// A term of the energy that a line stores, by its length ℓ. In SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LinePotential<T> {
    /// The energy ½ κ (ℓ − L₀)² of a spring.
    Spring {
        /// Stiffness κ, N/m.
        stiffness: T,
        /// Length L₀ at rest, m; none for a spring whose length at rest is zero.
        rest: Option<T>,
    },
    /// The energy A/ℓⁿ of a force by a power of the distance, which repels where A is positive.
    InversePower {
        /// Strength A, J mⁿ.
        strength: T,
        /// Exponent n: 1 of charges, 3 of point dipoles whose axes stand perpendicular to the plane.
        exponent: u32,
    },
}

/// What stores energy by the length of the line between two points, and a viscous damper along it,
/// in SI units.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TranslationalSpringDamper<T> {
    /// Arms of the line, of each link one at most.
    pub arms: Vec<LineArm<T>>,
    /// The part of the line that no angle turns: x, and y against the direction of links of
    /// angle 0.
    pub offset: [T; 2],
    /// Terms of the energy, in the order in which they are added.
    pub potentials: Vec<LinePotential<T>>,
    /// Viscous friction c, N s/m, where there is a damper.
    pub friction: Option<T>,
}

/// A line at one configuration.
#[derive(Clone, Copy)]
struct Line<T> {
    /// From the first point to the second one.
    offset: [T; 2],
    /// Rate of that; zero at rest.
    rate: [T; 2],
}

fn dot<T: Scalar>([a, b]: [T; 2], [x, y]: [T; 2]) -> T {
    a * x + b * y
}

impl<T: Scalar> LineArm<T> {
    /// The arm at an angle of its link.
    #[inline(always)]
    pub(crate) fn turned(&self, angle: T) -> [T; 2] {
        let (sin, cos) = angle.sin_cos();
        [
            self.along * sin + self.lateral * cos,
            self.lateral * sin - self.along * cos,
        ]
    }
}

impl<T: Scalar> Line<T> {
    fn square(&self) -> T {
        dot(self.offset, self.offset)
    }

    fn length(&self) -> T {
        self.square().sqrt()
    }
}

/// A power of the length of a line.
pub(crate) fn length_to<T: Scalar>(offset: [T; 2], exponent: u32) -> T {
    let square = dot(offset, offset);
    let root = match exponent % 2 {
        0 => T::from_f64(1.0),
        _ => square.sqrt(),
    };
    (0..exponent / 2).fold(root, |power, _| power * square)
}

impl<T: Copy> LinePotential<T> {
    /// Returns it on other scalars.
    #[must_use]
    pub fn map<S>(&self, convert: impl Fn(T) -> S) -> LinePotential<S> {
        match *self {
            Self::Spring { stiffness, rest } => LinePotential::Spring {
                stiffness: convert(stiffness),
                rest: rest.map(convert),
            },
            Self::InversePower { strength, exponent } => LinePotential::InversePower {
                strength: convert(strength),
                exponent,
            },
        }
    }
}

impl<T: Scalar> LinePotential<T> {
    /// Returns so many times the energy.
    fn times(&self, factor: T) -> Self {
        match *self {
            Self::Spring { stiffness, rest } => Self::Spring {
                stiffness: factor * stiffness,
                rest,
            },
            Self::InversePower { strength, exponent } => Self::InversePower {
                strength: factor * strength,
                exponent,
            },
        }
    }

    /// dU/dℓ over the length of the line.
    #[inline(always)]
    fn pull(&self, line: &Line<T>) -> T {
        match *self {
            Self::Spring {
                stiffness,
                rest: None,
            } => stiffness,
            Self::Spring {
                stiffness,
                rest: Some(rest),
            } => {
                let length = line.length();
                stiffness * (length - rest) / length
            }
            Self::InversePower { strength, exponent } => {
                let slope = T::from_f64(-f64::from(exponent)) * strength;
                slope / length_to(line.offset, exponent.saturating_add(2))
            }
        }
    }

    /// The part of that which changes with the length: a factor, and m of the power ℓ⁻ᵐ.
    #[inline(always)]
    pub(crate) fn power_of_length(&self) -> Option<(T, u32)> {
        match *self {
            Self::Spring { stiffness, rest } => Some((-(stiffness * rest?), 1)),
            Self::InversePower { strength, exponent } => {
                let slope = T::from_f64(-f64::from(exponent)) * strength;
                Some((slope, exponent.saturating_add(2)))
            }
        }
    }

    /// U.
    #[inline(always)]
    fn energy(&self, line: &Line<T>) -> T {
        let half = T::from_f64(0.5);
        match *self {
            Self::Spring {
                stiffness,
                rest: None,
            } => half * stiffness * line.square(),
            Self::Spring {
                stiffness,
                rest: Some(rest),
            } => {
                let stretch = line.length() - rest;
                half * stiffness * stretch * stretch
            }
            Self::InversePower { strength, exponent } => {
                strength / length_to(line.offset, exponent)
            }
        }
    }
}

impl<T: Copy> TranslationalSpringDamper<T> {
    /// Returns it on other scalars.
    #[must_use]
    pub fn map<S>(&self, convert: impl Fn(T) -> S) -> TranslationalSpringDamper<S> {
        let potentials = self.potentials.iter();
        let arms = self.arms.iter().map(|arm| LineArm {
            link: arm.link,
            along: convert(arm.along),
            lateral: convert(arm.lateral),
        });
        TranslationalSpringDamper {
            arms: arms.collect(),
            offset: self.offset.map(&convert),
            potentials: potentials.map(|own| own.map(&convert)).collect(),
            friction: self.friction.map(&convert),
        }
    }
}

impl<T: Scalar> TranslationalSpringDamper<T> {
    /// Returns the same line with so many times the energy, and as many times the friction.
    #[must_use]
    pub fn times(&self, factor: T) -> Self {
        let potentials = self.potentials.iter();
        Self {
            potentials: potentials.map(|own| own.times(factor)).collect(),
            friction: self.friction.map(|friction| factor * friction),
            ..self.clone()
        }
    }

    /// Returns true if all links are among so many, and none has two arms.
    fn fits(&self, links: usize) -> bool {
        let mut arms = self.arms.iter().enumerate();
        arms.all(|(place, arm)| {
            let mut before = self.arms[..place].iter();
            arm.link < links && before.all(|other| other.link != arm.link)
        })
    }

    #[inline(always)]
    fn line(&self, theta: &[T], omega: Option<&[T]>) -> Line<T> {
        let zero = T::from_f64(0.0);
        let (mut offset, mut rate) = (self.offset, [zero; 2]);
        for arm in &self.arms {
            let Some(&angle) = theta.get(arm.link) else {
                continue;
            };
            let [x, y] = arm.turned(angle);
            offset = [offset[0] + x, offset[1] + y];
            if let Some(&omega) = omega.and_then(|omega| omega.get(arm.link)) {
                rate = [rate[0] - y * omega, rate[1] + x * omega];
            }
        }
        Line { offset, rate }
    }

    /// Pull of what stores energy over the length of the line.
    #[inline(always)]
    fn stored_pull(&self, line: &Line<T>) -> Option<T> {
        let pulls = self.potentials.iter().map(|own| own.pull(line));
        pulls.reduce(|sum, own| sum + own)
    }

    /// Pull of what stores energy over the length of a line from the first point to the second.
    #[inline(always)]
    pub(crate) fn pull_of_energy(&self, offset: [T; 2]) -> Option<T> {
        let rate = [T::from_f64(0.0); 2];
        self.stored_pull(&Line { offset, rate })
    }

    /// Pull of the damper over the length of the line.
    #[inline(always)]
    fn damper_pull(&self, line: &Line<T>) -> Option<T> {
        let stretching = dot(line.offset, line.rate);
        self.friction
            .map(|friction| friction * stretching / line.square())
    }

    /// Subtracts the torques of a pull, given over the length of the line.
    #[inline(always)]
    fn subtract(&self, theta: &[T], line: &Line<T>, pull: T, torques: &mut [T]) {
        let [dx, dy] = line.offset;
        for arm in &self.arms {
            let (Some(&angle), Some(torque)) = (theta.get(arm.link), torques.get_mut(arm.link))
            else {
                continue;
            };
            let [x, y] = arm.turned(angle);
            // d · ∂d/∂θ.
            *torque = *torque - pull * (dy * x - dx * y);
        }
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
    list: Vec<TranslationalSpringDamper<T>>,
}

/// None between no links.
impl<T> Default for TranslationalSpringDampers<T> {
    fn default() -> Self {
        Self {
            links: 0,
            list: Vec::new(),
        }
    }
}

impl<T: Scalar> TranslationalSpringDampers<T> {
    /// Returns those of a tree of so many links; none for arms of links that there are not, and
    /// for two arms of one link.
    #[must_use]
    pub fn new(links: usize, list: Vec<TranslationalSpringDamper<T>>) -> Option<Self> {
        let fit = list.iter().all(|own| own.fits(links));
        fit.then_some(Self { links, list })
    }

    /// Returns them on other scalars: `convert` should change the type of their constants and
    /// not their value.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> TranslationalSpringDampers<S> {
        TranslationalSpringDampers {
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

    /// Returns them one by one.
    pub fn iter(&self) -> impl Iterator<Item = &TranslationalSpringDamper<T>> {
        self.list.iter()
    }

    /// Adds the torques (N m) on all links at their angles (rad) and angular velocities (rad/s).
    /// NaN for slices of another length than there are links, and where points meet, but for a
    /// spring alone without a length at rest. O(arms).
    #[inline(always)]
    pub fn add_torques(&self, given: [&[T]; 2], torques: &mut [T]) {
        self.add(given, torques, |own, line| {
            let pulls = own.stored_pull(line).into_iter();
            pulls
                .chain(own.damper_pull(line))
                .reduce(|sum, own| sum + own)
        });
    }

    /// Adds the torques of the dampers alone, likewise.
    pub fn add_friction(&self, given: [&[T]; 2], torques: &mut [T]) {
        self.add(given, torques, TranslationalSpringDamper::damper_pull);
    }

    #[inline(always)]
    fn add(
        &self,
        [theta, omega]: [&[T]; 2],
        torques: &mut [T],
        pull: impl Fn(&TranslationalSpringDamper<T>, &Line<T>) -> Option<T>,
    ) {
        if [theta.len(), omega.len(), torques.len()] != [self.links; 3] {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        for own in &self.list {
            let line = own.line(theta, own.friction.is_some().then_some(omega));
            if let Some(pull) = pull(own, &line) {
                own.subtract(theta, &line, pull, torques);
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
        let energies = self.list.iter().flat_map(|own| {
            let line = own.line(theta, None);
            own.potentials
                .iter()
                .map(move |potential| potential.energy(&line))
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
        self.list.iter().fold(T::from_f64(0.0), |sum, own| {
            let line = own.line(theta, Some(omega));
            match own.damper_pull(&line) {
                Some(pull) => sum - pull * dot(line.offset, line.rate),
                None => sum,
            }
        })
    }
}
