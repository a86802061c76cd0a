//! Systems of equations on other scalars.

use super::Ode;

/// A system of equations that can be taken to the scalar `S`: a model in its
/// coordinates.
///
/// # Examples
///
/// One motion in double-double numbers beside that in `f64`, and what rounding did to
/// the latter:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::scalar::Double;
/// use branched_pendulum::system::CastOde;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = upper_mass, length = 0.5) [lower: rod(mass = 0.25, length = 0.5)],
/// )]
/// struct Pair;
///
/// let model = Pair::new(PairParameters { upper_mass: 0.75 })?;
/// let plain = AbsoluteAngles(&model);
/// let precise = plain.cast(Double::from_f64);
///
/// let state = [0.4, -0.7, 1.5, 0.2];
/// let (mut rates, mut more) = ([0.0; 4], [Double::from_f64(0.0); 4]);
/// plain.rates(0.0, &state, &mut rates);
/// precise.rates(Double::from_f64(0.0), &state.map(Double::from_f64), &mut more);
/// for (rate, more) in rates.into_iter().zip(more) {
///     assert!((Double::from_f64(rate) - more).to_f64().abs() < 1e-13);
/// }
/// # Ok::<(), ParameterError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be taken from `{T}` to `{S}`",
    note = "`AbsoluteAngles(&model)`, `SymmetricCoordinates(&model)` and `CanonicalVariables(&model)` can; equations that are generic over the scalar need not be"
)]
pub trait CastOde<T, S>: Ode<T> {
    /// The system on that scalar.
    type Of: Ode<S>;

    /// Takes every constant through `convert`, which should change their type and not
    /// their value.
    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of;
}
