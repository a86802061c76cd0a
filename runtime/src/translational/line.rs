//! One line between two points: its arms, what it stores energy by, and its pull.

use alloc::vec::Vec;

use crate::scalar::Scalar;
use crate::simd::Simd;

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
pub(super) struct Line<T> {
    /// From the first point to the second one.
    offset: [T; 2],
    /// Rate of that; zero at rest.
    rate: [T; 2],
}

/// What pulls along a line. Said by name, as with spring-dampers: closures are functions of their
/// own where numbers are vector registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pull {
    /// All that there is.
    Whole,
    /// What stores energy.
    OfEnergy,
    /// The damper.
    OfDamper,
}

#[inline(always)]
fn dot<T: Scalar>([a, b]: [T; 2], [x, y]: [T; 2]) -> T {
    a * x + b * y
}

impl<T: Copy> LineArm<T> {
    /// Returns it on other scalars.
    #[must_use]
    pub fn map<S>(&self, convert: impl Fn(T) -> S) -> LineArm<S> {
        LineArm {
            link: self.link,
            along: convert(self.along),
            lateral: convert(self.lateral),
        }
    }
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
    #[inline(always)]
    fn square(&self) -> T {
        dot(self.offset, self.offset)
    }

    #[inline(always)]
    fn length(&self) -> T {
        self.square().sqrt()
    }
}

/// A power of the length of a line.
#[inline(always)]
pub(crate) fn length_to<T: Scalar>(offset: [T; 2], exponent: u32) -> T {
    let square = dot(offset, offset);
    let mut power = match exponent % 2 {
        0 => T::from_f64(1.0),
        _ => square.sqrt(),
    };
    for _ in 0..exponent / 2 {
        power = power * square;
    }
    power
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
        let arms = self.arms.iter().map(|arm| arm.map(&convert));
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

    /// Returns true if all links are among so many, and none has two arms, here and in so many
    /// places behind.
    pub(super) fn fits(&self, links: usize, places: usize) -> bool {
        let mut arms = self.arms.iter().enumerate();
        arms.all(|(place, arm)| {
            let end = arm.link.checked_add(places);
            let mut before = self.arms[..place].iter();
            end.is_some_and(|end| end <= links) && before.all(|other| other.link != arm.link)
        })
    }

    /// The line at angles, and with rates where there are any.
    #[inline(always)]
    pub(super) fn line<V: Simd<T>>(
        &self,
        theta: impl Fn(usize) -> V,
        omega: Option<impl Fn(usize) -> V>,
    ) -> Line<V> {
        let zero = V::from_f64(0.0);
        let (mut offset, mut rate) = (self.offset.map(V::splat), [zero; 2]);
        for arm in &self.arms {
            let [x, y] = arm.map(V::splat).turned(theta(arm.link));
            offset = [offset[0] + x, offset[1] + y];
            if let Some(omega) = &omega {
                let omega = omega(arm.link);
                rate = [rate[0] - y * omega, rate[1] + x * omega];
            }
        }
        Line { offset, rate }
    }

    /// A pull over the length of the line.
    #[inline(always)]
    pub(super) fn pull<V: Simd<T>>(&self, line: &Line<V>, pull: Pull) -> Option<V> {
        let mut sum: Option<V> = None;
        if pull != Pull::OfDamper {
            for own in &self.potentials {
                let own = own.map(V::splat).pull(line);
                sum = Some(match sum {
                    Some(sum) => sum + own,
                    None => own,
                });
            }
        }
        match self.friction {
            Some(friction) if pull != Pull::OfEnergy => {
                let stretching = dot(line.offset, line.rate);
                let own = V::splat(friction) * stretching / line.square();
                Some(match sum {
                    Some(sum) => sum + own,
                    None => own,
                })
            }
            _ => sum,
        }
    }

    /// Pull of what stores energy over the length of a line from the first point to the second.
    #[inline(always)]
    pub(crate) fn pull_of_energy(&self, offset: [T; 2]) -> Option<T> {
        let rate = [T::from_f64(0.0); 2];
        self.pull::<T>(&Line { offset, rate }, Pull::OfEnergy)
    }

    /// Subtracts the torques of a pull, given over the length of the line. The arms are `place`
    /// links behind those that are said.
    #[inline(always)]
    pub(super) fn subtract<V: Simd<T>>(
        &self,
        place: usize,
        theta: impl Fn(usize) -> V,
        line: &Line<V>,
        pull: V,
        torques: &mut [V],
    ) {
        let [dx, dy] = line.offset;
        for arm in &self.arms {
            if let Some(torque) = torques.get_mut(arm.link + place) {
                let [x, y] = arm.map(V::splat).turned(theta(arm.link));
                // d · ∂d/∂θ.
                *torque = *torque - pull * (dy * x - dx * y);
            }
        }
    }

    /// The energy that the line stores.
    #[inline(always)]
    pub(super) fn energy(&self, line: &Line<T>) -> T {
        let energies = self.potentials.iter().map(|own| own.energy(line));
        energies.fold(T::from_f64(0.0), |sum, energy| sum + energy)
    }

    /// The power of the damper, where there is one.
    #[inline(always)]
    pub(super) fn power(&self, line: &Line<T>) -> Option<T> {
        let pull = self.pull(line, Pull::OfDamper)?;
        Some(-(pull * dot(line.offset, line.rate)))
    }
}
