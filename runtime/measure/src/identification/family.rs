//! Families of equations of motion: one system for each set of parameters.

use core::fmt;
use core::marker::PhantomData;

use branched_pendulum::emitted::shown;
use branched_pendulum::model::ParameterError;
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::system::{AbsoluteAngles, Model, Ode, Parametric};

/// Error: a value is not physical for any model of the family.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpossibleValue {
    /// Name of the quantity, such as "mass of `child`".
    pub what: String,
    /// Value of the quantity, in SI units.
    pub value: f64,
    /// Condition that the value violates, such as "positive".
    pub requirement: &'static str,
}

impl fmt::Display for ImpossibleValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            what,
            value,
            requirement,
        } = self;
        write!(f, "{what} is {}, must be {requirement}", shown(*value))
    }
}

impl core::error::Error for ImpossibleValue {}

impl From<ParameterError> for ImpossibleValue {
    fn from(error: ParameterError) -> Self {
        Self {
            what: error.what.to_owned(),
            value: error.value,
            requirement: error.requirement,
        }
    }
}

/// Equations of motion with named parameters. Models of the attribute implement it by [`FamilyOf`];
/// users can implement it for other equations, such as ones with external torques.
pub trait Family: Sync {
    /// The equations for one set of parameters. The state is the angles of the links, followed by
    /// their velocities.
    type Equations<T: Scalar>: Ode<T>;

    /// Names of the parameters, in the order of their values.
    fn parameters(&self) -> Vec<String>;

    /// Names of the links, in the order of their angles.
    fn links(&self) -> Vec<String>;

    /// Creates the equations of motion for the given parameter values, without checking them.
    fn equations<T: Scalar>(&self, values: &[T]) -> Self::Equations<T>;

    /// Returns true if the parameter with this index is a coefficient of friction and nothing else.
    /// A fit with a negative friction coefficient shows that the real friction law is different; a
    /// fit with another unphysical value is invalid.
    fn is_friction(&self, parameter: usize) -> bool {
        let _ = parameter;
        false
    }

    /// Checks that the values are physical.
    ///
    /// # Errors
    ///
    /// The first value that is not physical.
    fn check(&self, values: &[f64]) -> Result<(), ImpossibleValue>;
}

/// Family of all models of one description, in absolute angles.
#[derive(Debug)]
pub struct FamilyOf<M>(PhantomData<fn() -> M>);

impl<M> FamilyOf<M> {
    /// Creates the family of the models of type `M`.
    #[must_use]
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M> Default for FamilyOf<M> {
    fn default() -> Self {
        Self::new()
    }
}

impl<M> Clone for FamilyOf<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for FamilyOf<M> {}

impl<M: Parametric<f64>> Family for FamilyOf<M> {
    type Equations<T: Scalar> = AbsoluteAngles<M::Of<T>>;

    fn parameters(&self) -> Vec<String> {
        M::PARAMETERS
            .iter()
            .map(|name| (*name).to_owned())
            .collect()
    }

    fn links(&self) -> Vec<String> {
        // Names do not depend on the values.
        let model = M::with_parameters(|_| f64::NAN);
        model.link_names()
    }

    fn equations<T: Scalar>(&self, values: &[T]) -> Self::Equations<T> {
        AbsoluteAngles(M::with_parameters(|index| value_at(values, index)))
    }

    fn check(&self, values: &[f64]) -> Result<(), ImpossibleValue> {
        Ok(M::check_parameters(|index| value_at(values, index))?)
    }
}

/// Number of derivatives that one evaluation carries.
pub(super) const WIDTH: usize = 8;

/// A number with [`WIDTH`] derivatives.
pub(super) type Wide = Dual<f64, WIDTH>;

/// A [`Family`] of any type, in the two kinds of numbers that fitting needs. Code that uses it is
/// compiled once and not for every family.
pub(super) trait AnyFamily: Sync {
    fn plain(&self, values: &[f64]) -> Box<dyn Ode<f64> + '_>;
    fn wide(&self, values: &[Wide]) -> Box<dyn Ode<Wide> + '_>;
}

impl<F: Family> AnyFamily for F {
    fn plain(&self, values: &[f64]) -> Box<dyn Ode<f64> + '_> {
        Box::new(self.equations(values))
    }

    fn wide(&self, values: &[Wide]) -> Box<dyn Ode<Wide> + '_> {
        Box::new(self.equations(values))
    }
}

/// Returns a value by its index; NaN if the index is out of range.
fn value_at<T: Scalar>(values: &[T], index: usize) -> T {
    let value = values.get(index).copied();
    value.unwrap_or(T::from_f64(f64::NAN))
}
