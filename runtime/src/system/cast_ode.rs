//! Conversion of systems of equations to other scalar types.

use super::Ode;

/// System of equations whose constants can be converted to the scalar type `S`, such as a model in
/// its coordinates.
///
/// # Examples
///
/// This example compares the rates in double-double numbers with those in `f64`, to see the effect
/// of rounding:
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
    /// The type of the system after the conversion.
    type Of: Ode<S>;

    /// Returns the system with each constant converted by `convert`, which must change the type of
    /// a constant but not its value.
    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of;
}
