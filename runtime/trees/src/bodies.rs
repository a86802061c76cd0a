//! Links of a tree as rigid bodies, for the energies of each form of its equations.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{Bodies, LinkSlopes, Shape};

use crate::equations::{Form, GeneralEquations, NonViscousEquations, PlainEquations};

/// Rigid bodies of a tree in one of the forms of its equations.
#[derive(Clone, Debug)]
pub(crate) enum FormBodies<T> {
    Plain(Bodies<PlainEquations, T>),
    General(Bodies<GeneralEquations, T>),
    NonViscous(Bodies<NonViscousEquations, T>),
}

/// Calls a function of the bodies of any form.
macro_rules! ask {
    ($form:expr, $bodies:ident => $answer:expr) => {
        match $form {
            FormBodies::Plain($bodies) => $answer,
            FormBodies::General($bodies) => $answer,
            FormBodies::NonViscous($bodies) => $answer,
        }
    };
}

impl<T: Scalar> FormBodies<T> {
    pub(crate) fn new(form: Form, shape: Shape, rows: Vec<T>) -> Self {
        match form {
            Form::Plain => Self::Plain(Bodies::new(shape, rows)),
            Form::General => Self::General(Bodies::new(shape, rows)),
            Form::NonViscous => Self::NonViscous(Bodies::new(shape, rows)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> FormBodies<S> {
        match self {
            Self::Plain(bodies) => FormBodies::Plain(bodies.cast(convert)),
            Self::General(bodies) => FormBodies::General(bodies.cast(convert)),
            Self::NonViscous(bodies) => FormBodies::NonViscous(bodies.cast(convert)),
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

    pub(crate) fn potential_energy_slopes(
        &self,
        theta: &[T],
        visit: impl FnMut(LinkSlopes<T>),
    ) -> bool {
        ask!(self, bodies => bodies.potential_energy_slopes(theta, visit))
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
