//! Trait that every model of a tree of links implements.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{LinkName, Pendulum};
use crate::scalar::Scalar;

/// A tree of links whose constants are numbers `T`: a model written by the attribute, a tree read
/// at run time, or a model written by hand.
///
/// # Examples
///
/// This model of a rod is written by hand. Its only equation of motion is in
/// [`Pendulum::evaluate`]:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::LinkName;
///
/// struct Rod<T>(T);
///
/// impl<T: Scalar> Model<T> for Rod<T> {
///     type Of<S: Scalar> = Rod<S>;
///     const KNOWN_LINKS: Option<usize> = Some(1);
///
///     fn links(&self) -> usize {
///         1
///     }
///
///     fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
///         (index == 0).then(|| LinkName::listed("rod"))
///     }
///
///     #[inline(always)]
///     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
///         Rod(convert(self.0))
///     }
/// }
///
/// impl<T: Scalar> Pendulum<T> for Rod<T> {
///     #[inline(always)]
///     fn evaluate(
///         &self,
///         _time: T,
///         theta: impl Fn(usize) -> T,
///         _omega: impl Fn(usize) -> T,
///         mut alpha: impl FnMut(usize, T),
///     ) {
///         alpha(0, -(self.0 * theta(0).sin_cos().0));
///     }
/// }
///
/// // Many states at once, and one alone.
/// let model = Rod(9.80665);
/// let theta = [vec![0.1; 1001]];
/// let omega = [vec![0.0; 1001]];
/// let mut alpha = [vec![0.0; 1001]];
/// Batch::new(&model).accelerations(0.0, &theta, &omega, &mut alpha)?;
/// let mut alone = [0.0];
/// model.accelerations_into(0.0, &[0.1], &[0.0], &mut alone);
/// assert_eq!(alpha[0][1000], alone[0]);
/// # Ok::<(), branched_pendulum::batch::BatchError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a model in `{T}`",
    note = "a model of the attribute is one in its own numbers: the model itself or `&model`, not one in coordinates like `AbsoluteAngles(&model)`, which is a `CastOde`"
)]
pub trait Model<T: Scalar>: Sized {
    /// The type of this model with constants of the scalar type `S`.
    type Of<S: Scalar>: Pendulum<S>;

    /// Number of links, if the type determines it; code for a known number of links is shorter.
    const KNOWN_LINKS: Option<usize>;

    /// Returns the number of links, each with one angle.
    fn links(&self) -> usize;

    /// Returns the name of the link with that index; `None` if there is no such link.
    #[must_use]
    fn link_name(&self, index: usize) -> Option<LinkName<'_>>;

    /// Returns the names of all links, in the order of the angles. Allocates.
    #[must_use]
    fn link_names(&self) -> Vec<String> {
        let names = (0..self.links()).filter_map(|index| self.link_name(index));
        names.map(|name| name.to_string()).collect()
    }

    /// Returns the model with each constant converted by `convert`, which must change the type of a
    /// constant but not its value.
    ///
    /// All models of one type and one [`shape`](Self::shape) must convert the same number of
    /// constants in the same order, and differ in nothing else:
    /// [`Ensemble::integrate_models_in_lanes`](crate::ensemble::Ensemble::integrate_models_in_lanes)
    /// relies on it to put several models into the lanes of one.
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

    /// Returns a number that differs between models of one type that cannot be computed together in
    /// the lanes of one register, as trees of different topology. Constants may differ between
    /// models with the same number.
    fn shape(&self) -> usize {
        0
    }
}

impl<T: Scalar, M: Model<T>> Model<T> for &M {
    type Of<S: Scalar> = M::Of<S>;

    const KNOWN_LINKS: Option<usize> = M::KNOWN_LINKS;

    #[inline(always)]
    fn links(&self) -> usize {
        (**self).links()
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        (**self).link_name(index)
    }

    #[inline(always)]
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        (**self).cast(convert)
    }

    fn shape(&self) -> usize {
        (**self).shape()
    }
}

/// Returns the number of links that a type determines, or 0 if it does not. It is a constant, so
/// that the compiler drops the code of branches that are not taken.
pub(crate) const fn known(links: Option<usize>) -> usize {
    match links {
        Some(links) => links,
        None => 0,
    }
}

/// Returns twice the number of links; `None` if it is unknown.
pub(super) const fn twice(links: Option<usize>) -> Option<usize> {
    match links {
        Some(links) => Some(2 * links),
        None => None,
    }
}
