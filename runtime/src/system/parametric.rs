//! Models with named parameters.

use super::Model;
use crate::model::ParameterError;
use crate::scalar::Scalar;

/// A pendulum with named parameters. Emitted code implements this trait if a description has
/// parameters; `branched_pendulum_measure::identification` fits these parameters to measurements.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::Parametric;
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(gravity = 9.80665, rod: rod(mass = 0.1, length = length, friction = friction))]
/// struct Swing;
///
/// // Both numbers are f64 here; a dual number gives derivatives with respect to it.
/// let values = [0.3, 1e-4];
/// assert_eq!(<Swing as Parametric<f64>>::PARAMETERS, ["length", "friction"]);
/// Swing::<f64>::check_parameters(|index| values[index])?;
/// let swing = Swing::<f64>::with_parameters(|index| values[index]);
/// assert_eq!(swing, Swing::new(SwingParameters { length: 0.3, friction: 1e-4 })?);
/// # Ok::<(), branched_pendulum::ParameterError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no named parameters",
    note = "write a name in place of a number in its attribute: `mass = bob_mass`"
)]
pub trait Parametric<T: Scalar>: Model<T> {
    /// Names of the parameters, in the order of their indices.
    const PARAMETERS: &'static [&'static str];

    /// Creates the model in which the parameter with each `index` has the value `values(index)`,
    /// without checks. Works in any scalar type, with or without derivatives.
    fn with_parameters<S: Scalar>(values: impl Fn(usize) -> S) -> Self::Of<S>;

    /// Checks parameters like the constructor of the model.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] for a value that the constructor rejects.
    fn check_parameters(values: impl Fn(usize) -> f64) -> Result<(), ParameterError>;
}
