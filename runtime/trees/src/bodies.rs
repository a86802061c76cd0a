//! The links of a tree as bodies, with the equations of the tree's form.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{Bodies, Shape};

use crate::equations::{Form, GeneralEquations, RoughEquations, StraightEquations};

/// Bodies in one of the forms.
#[derive(Clone, Debug)]
pub(crate) enum FormBodies<T> {
    Straight(Bodies<StraightEquations, T>),
    General(Bodies<GeneralEquations, T>),
    Rough(Bodies<RoughEquations, T>),
}

/// Asks the bodies, whatever their form.
macro_rules! ask {
    ($form:expr, $bodies:ident => $answer:expr) => {
        match $form {
            FormBodies::Straight($bodies) => $answer,
            FormBodies::General($bodies) => $answer,
            FormBodies::Rough($bodies) => $answer,
        }
    };
}

impl<T: Scalar> FormBodies<T> {
    pub(crate) fn new(form: Form, shape: Shape, rows: Vec<T>) -> Self {
        match form {
            Form::Straight => Self::Straight(Bodies::new(shape, rows)),
            Form::General => Self::General(Bodies::new(shape, rows)),
            Form::Rough => Self::Rough(Bodies::new(shape, rows)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> FormBodies<S> {
        match self {
            Self::Straight(bodies) => FormBodies::Straight(bodies.cast(convert)),
            Self::General(bodies) => FormBodies::General(bodies.cast(convert)),
            Self::Rough(bodies) => FormBodies::Rough(bodies.cast(convert)),
        }
    }

    pub(crate) fn kinetic_energy(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
    ) -> T {
        ask!(self, bodies => bodies.kinetic_energy(workspace, theta, omega))
    }

    pub(crate) fn potential_energy(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        ask!(self, bodies => bodies.potential_energy(workspace, theta))
    }

    pub(crate) fn drive_power(
        &self,
        workspace: &mut Workspace<T>,
        drive: [T; 3],
        theta: &[T],
        omega: &[T],
    ) -> T {
        ask!(self, bodies => bodies.drive_power(workspace, drive, theta, omega))
    }

    pub(crate) fn friction_power(&self, omega: &[T]) -> T {
        ask!(self, bodies => bodies.friction_power(omega))
    }

    pub(crate) fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
        ask!(self, bodies => bodies.outside_power(omega, torques))
    }
}
