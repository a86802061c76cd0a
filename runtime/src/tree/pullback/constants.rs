//! Constants of links on which their virtual power depends, and the derivatives of all constants of
//! a tree by its parameters.

use alloc::vec::Vec;

use crate::friction::{FrictionLaw, LAW_CONSTANTS};
use crate::scalar::Scalar;
use crate::spring_dampers::SpringDamper;

/// Index of the first constant of the laws of friction in the row of a link.
pub(super) const LAWS: usize = 10;

/// Number of constants in the row of a link.
const COLUMNS: usize = LAWS + 2 * LAW_CONSTANTS;

/// Torque of a spring and of friction, as a function of an angle and of its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PassiveTorque<T> {
    pub(super) spring: T,
    pub(super) rest: T,
    pub(super) friction: T,
    pub(super) law: Option<FrictionLaw<T>>,
}

impl<T: Copy> PassiveTorque<T> {
    pub(super) fn of(spring_damper: &SpringDamper<T>) -> Self {
        let SpringDamper {
            links: _,
            spring,
            rest,
            friction,
            law,
        } = *spring_damper;
        Self {
            spring,
            rest,
            friction,
            law,
        }
    }

    fn map<S>(self, convert: impl Fn(T) -> S) -> PassiveTorque<S> {
        PassiveTorque {
            spring: convert(self.spring),
            rest: convert(self.rest),
            friction: convert(self.friction),
            law: self.law.map(|law| law.map(convert)),
        }
    }
}

/// A link as a rigid body, with the springs and the friction that act on it in its pivot and
/// against the ground. In SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassiveLink<T> {
    pub(super) mass: T,
    /// Moment of inertia about the centre of mass.
    pub(super) inertia: T,
    /// Centre of mass, by its components along the link and across it.
    pub(super) com: [T; 2],
    /// Pivot, by its components along the parent and across it. The root's is not used.
    pub(super) pivot: [T; 2],
    pub(super) joint: PassiveTorque<T>,
    pub(super) ground: PassiveTorque<T>,
}

impl<T: Scalar> PassiveLink<T> {
    /// Creates the link from its constants in SI units: mass; moment of inertia about the centre of
    /// mass; components along and across of the centre of mass and of the pivot on the parent;
    /// friction in the pivot; drag; stiffness and rest angle of the torsion spring; then the
    /// constants of the laws of friction in the pivot and against the ground, in the order of
    /// [`FrictionLaw::of_constants`]. `laws` is true for each of the two contacts that has such a law;
    /// without a law its constants are not used.
    #[must_use]
    pub fn from_row(row: &[T; COLUMNS], laws: [bool; 2]) -> Self {
        let [
            mass,
            inertia,
            along,
            across,
            pivot_along,
            pivot_across,
            friction,
            drag,
            spring,
            rest,
            law @ ..,
        ] = *row;
        let zero = T::from_f64(0.0);
        let [joint, ground] = [0, 1].map(|contact| {
            let constant = |index| law[contact * LAW_CONSTANTS + index];
            let law = FrictionLaw::of_constants(core::array::from_fn(constant));
            laws[contact].then_some(law)
        });
        Self {
            mass,
            inertia,
            com: [along, across],
            pivot: [pivot_along, pivot_across],
            joint: PassiveTorque {
                spring,
                rest,
                friction,
                law: joint,
            },
            ground: PassiveTorque {
                spring: zero,
                rest: zero,
                friction: drag,
                law: ground,
            },
        }
    }

    /// Creates links from rows of constants, one after the other, as [`from_row`](Self::from_row).
    #[must_use]
    pub fn of_rows(rows: &[T], laws: [bool; 2]) -> Vec<Self> {
        let (rows, _) = rows.as_chunks();
        rows.iter().map(|row| Self::from_row(row, laws)).collect()
    }

    pub(super) fn cast<S>(self, convert: impl Fn(T) -> S) -> PassiveLink<S> {
        PassiveLink {
            mass: convert(self.mass),
            inertia: convert(self.inertia),
            com: self.com.map(&convert),
            pivot: self.pivot.map(&convert),
            joint: self.joint.map(&convert),
            ground: self.ground.map(convert),
        }
    }
}

/// Derivative of a constant by a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slope<T> {
    group: usize,
    /// Index of the constant in its group.
    pub(super) constant: usize,
    parameter: usize,
    slope: T,
}

/// Derivatives of the constants of a tree by its parameters, without those that are zero.
///
/// The constants form groups. Group 0 is gravity. The rows of links follow, with their constants in
/// the order of [`PassiveLink::from_row`]; then the runs of springs and friction between links, each
/// with stiffness, rest angle, friction and the constants of the law of friction; then the runs of
/// forces along lines, each with the components of its arms and of its fixed part, the constants of
/// each term of its energy, and its friction.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSlopes<T> {
    parameters: usize,
    slopes: Vec<Slope<T>>,
    /// Index of the first derivative of each group.
    starts: Vec<usize>,
}

impl<T: Scalar> ParameterSlopes<T> {
    /// Creates the derivatives by this number of parameters. Each has its place: the index of the
    /// group, of the constant in it, and of the parameter.
    #[must_use]
    pub fn new(parameters: usize, places: &[[usize; 3]], slopes: &[T]) -> Self {
        let slopes = places.iter().zip(slopes);
        let slopes = slopes.map(|(&[group, constant, parameter], &slope)| Slope {
            group,
            constant,
            parameter,
            slope,
        });
        let mut slopes: Vec<Slope<T>> = slopes.collect();
        slopes.sort_by_key(|own| own.group);
        let groups = slopes.last().map_or(0, |own| own.group + 1);
        let start = |group| slopes.partition_point(|own| own.group < group);
        Self {
            starts: (0..groups).map(start).collect(),
            parameters,
            slopes,
        }
    }

    /// Returns the number of parameters.
    pub(super) fn parameters(&self) -> usize {
        self.parameters
    }

    /// Returns the derivatives of the constants of a group.
    pub(super) fn of(&self, group: usize) -> &[Slope<T>] {
        let at = |group: usize| self.starts.get(group).copied();
        let Some(start) = at(group) else {
            return &[];
        };
        let end = at(group + 1).unwrap_or(self.slopes.len());
        self.slopes.get(start..end).unwrap_or_default()
    }

    /// Returns the same derivatives in another scalar type.
    pub(super) fn cast<S>(&self, convert: impl Fn(T) -> S) -> ParameterSlopes<S> {
        let slopes = self.slopes.iter().map(|own| Slope {
            group: own.group,
            constant: own.constant,
            parameter: own.parameter,
            slope: convert(own.slope),
        });
        ParameterSlopes {
            parameters: self.parameters,
            slopes: slopes.collect(),
            starts: self.starts.clone(),
        }
    }
}

/// Adds to the derivatives by parameters those that go through consecutive constants of a group,
/// given the derivatives `by_constants`. `first` is the index of the first of these constants.
pub(super) fn add_through<T: Scalar>(
    slopes: &[Slope<T>],
    first: usize,
    by_constants: &[T],
    by_parameters: &mut [T],
) {
    for own in slopes {
        let by = own.constant.checked_sub(first);
        let by = by.and_then(|index| by_constants.get(index));
        if let (Some(&by), Some(sum)) = (by, by_parameters.get_mut(own.parameter)) {
            *sum = *sum + by * own.slope;
        }
    }
}
