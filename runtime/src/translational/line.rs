//! Line between two points of a tree: its arms (one per link), its potential energy, and the force
//! along it.

use alloc::vec::Vec;

use crate::scalar::Scalar;
use crate::simd::Simd;

/// Arm of a line: its part that rotates with one link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LineArm<T> {
    /// Index of the link.
    pub link: usize,
    /// Component along the link, in m.
    pub along: T,
    /// Component across the link, in m.
    pub lateral: T,
}

/// A term of a line's potential energy, as a function of its length ℓ. In SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LinePotential<T> {
    /// Energy ½ κ (ℓ − L₀)² of a spring.
    Spring {
        /// Stiffness κ, in N/m.
        stiffness: T,
        /// Rest length L₀, in m; `None` if it is zero.
        rest: Option<T>,
    },
    /// Energy A/ℓⁿ of a power law of the distance; the force is repulsive if A is positive.
    InversePower {
        /// Strength A, in J mⁿ.
        strength: T,
        /// Exponent n: 1 for charges, 3 for point dipoles with axes perpendicular to the plane.
        exponent: u32,
    },
}

/// A force along the line between two points: potential energy as a function of the distance, and a
/// viscous damper. In SI units.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TranslationalSpringDamper<T> {
    /// Arms of the line, at most one for each link.
    pub arms: Vec<LineArm<T>>,
    /// Constant part of the line, which does not rotate with any link: x, and y upwards (opposite
    /// to a link at angle 0), in m.
    pub offset: [T; 2],
    /// Terms of the energy, in the order in which they are summed.
    pub potentials: Vec<LinePotential<T>>,
    /// Coefficient c of viscous friction, in N s/m, if there is a damper.
    pub friction: Option<T>,
}

/// A line at one configuration.
#[derive(Clone, Copy)]
pub(super) struct Line<T> {
    /// Vector from the first point of the line to the second, in m.
    offset: [T; 2],
    /// Rate of change of that vector, in m/s; zero at rest.
    rate: [T; 2],
}

/// Selects the forces along a line. This is an enum instead of a closure, because each closure
/// would be compiled as a separate function for vector registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pull {
    /// All forces.
    Whole,
    /// Forces with a potential energy.
    OfEnergy,
    /// Force of the damper.
    OfDamper,
}

#[inline(always)]
fn dot<T: Scalar>([a, b]: [T; 2], [x, y]: [T; 2]) -> T {
    a * x + b * y
}

impl<T: Copy> LineArm<T> {
    /// Converts the arm to another scalar.
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
    /// Returns the arm rotated by the angle of its link.
    #[inline(always)]
    pub(crate) fn rotated(&self, angle: T) -> [T; 2] {
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

/// Returns a power of the length of a line with components `offset`.
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
    /// Converts the energy term to another scalar.
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
    /// Returns the same energy term, multiplied by `factor`.
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

    /// Returns the derivative dU/dℓ of the energy term by the line's length ℓ, divided by ℓ.
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

    /// Returns the part of (dU/dℓ)/ℓ that depends on the length ℓ, a multiple of ℓ⁻ᵐ: its factor
    /// and the exponent m.
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

    /// Returns the energy U.
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
    /// Converts the line to another scalar.
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
    /// Returns the line with its energy and its friction multiplied by `factor`.
    #[must_use]
    pub fn times(&self, factor: T) -> Self {
        let potentials = self.potentials.iter();
        Self {
            potentials: potentials.map(|own| own.times(factor)).collect(),
            friction: self.friction.map(|friction| factor * friction),
            ..self.clone()
        }
    }

    /// Returns true if the line has arms, all of them on different links of a tree of `links`
    /// links, and if this also holds for `places` consecutive copies of the line, each shifted by
    /// one link.
    pub(super) fn fits(&self, links: usize, places: usize) -> bool {
        let mut arms = self.arms.iter().enumerate();
        !self.arms.is_empty()
            && arms.all(|(place, arm)| {
                let end = arm.link.checked_add(places);
                let mut before = self.arms[..place].iter();
                end.is_some_and(|end| end <= links) && before.all(|other| other.link != arm.link)
            })
    }

    /// Computes the line at the given angles, with rates if they are given.
    #[inline(always)]
    pub(super) fn line<V: Simd<T>>(
        &self,
        theta: impl Fn(usize) -> V,
        omega: Option<impl Fn(usize) -> V>,
    ) -> Line<V> {
        let zero = V::from_f64(0.0);
        let (mut offset, mut rate) = (self.offset.map(V::splat), [zero; 2]);
        for arm in &self.arms {
            let [x, y] = arm.map(V::splat).rotated(theta(arm.link));
            offset = [offset[0] + x, offset[1] + y];
            if let Some(omega) = &omega {
                let omega = omega(arm.link);
                rate = [rate[0] - y * omega, rate[1] + x * omega];
            }
        }
        Line { offset, rate }
    }

    /// Returns the selected force along the line, divided by the line's length.
    #[inline(always)]
    pub(super) fn pull<V: Simd<T>>(&self, line: &Line<V>, pull: Pull) -> Option<V> {
        self.pull_in(V::splat, line, pull)
    }

    /// Returns the selected force along the line, divided by the line's length. `convert` converts
    /// the constants to the scalar of the line, in their order.
    #[inline(always)]
    fn pull_in<S: Scalar>(
        &self,
        convert: impl Fn(T) -> S,
        line: &Line<S>,
        pull: Pull,
    ) -> Option<S> {
        let mut sum: Option<S> = None;
        if pull != Pull::OfDamper {
            for own in &self.potentials {
                let own = own.map(&convert).pull(line);
                sum = Some(match sum {
                    Some(sum) => sum + own,
                    None => own,
                });
            }
        }
        match self.friction {
            Some(friction) if pull != Pull::OfEnergy => {
                let stretching = dot(line.offset, line.rate);
                let own = convert(friction) * stretching / line.square();
                Some(match sum {
                    Some(sum) => sum + own,
                    None => own,
                })
            }
            _ => sum,
        }
    }

    /// Returns the force that pulls the two points together (N), divided by the length of the line
    /// (m): `offset` is the vector from the first point to the second (m), `rate` its rate of change
    /// (m/s). `convert` converts the constants of the force to their scalar, in the order of
    /// [`map`](Self::map).
    pub(crate) fn force_over_length<S: Scalar>(
        &self,
        convert: impl Fn(T) -> S,
        offset: [S; 2],
        rate: [S; 2],
    ) -> S {
        let force = self.pull_in(convert, &Line { offset, rate }, Pull::Whole);
        force.unwrap_or(S::from_f64(0.0))
    }

    /// Returns the force that has a potential energy, divided by the length of the line; `offset`
    /// is the vector from the first point to the second.
    #[inline(always)]
    pub(crate) fn pull_of_energy(&self, offset: [T; 2]) -> Option<T> {
        let rate = [T::from_f64(0.0); 2];
        self.pull::<T>(&Line { offset, rate }, Pull::OfEnergy)
    }

    /// Subtracts the torques of a force along the line from `torques`; `pull` is the force divided
    /// by the line's length. The arms belong to links whose indices are larger by `place` than the
    /// indices in this line.
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
                let [x, y] = arm.map(V::splat).rotated(theta(arm.link));
                // d · ∂d/∂θ.
                *torque = *torque - pull * (dy * x - dx * y);
            }
        }
    }

    /// Returns the potential energy of the line.
    #[inline(always)]
    pub(super) fn energy(&self, line: &Line<T>) -> T {
        let energies = self.potentials.iter().map(|own| own.energy(line));
        energies.fold(T::from_f64(0.0), |sum, energy| sum + energy)
    }

    /// Returns the power of the line's damper in W, if it has one.
    #[inline(always)]
    pub(super) fn power(&self, line: &Line<T>) -> Option<T> {
        let pull = self.pull(line, Pull::OfDamper)?;
        Some(-(pull * dot(line.offset, line.rate)))
    }
}
