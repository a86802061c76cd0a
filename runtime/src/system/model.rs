//! Trees of links, whatever is asked of them.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{LinkName, Pendulum};
use crate::scalar::Scalar;

/// A tree of links whose constants are numbers `T`: a model that is written by the attribute,
/// a tree that is read while a program runs, or one written by hand.
///
/// # Examples
///
/// A rod, written by hand. All that it says of its motion is [`Pendulum::evaluate`]:
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
    message = "`{Self}` is no model in `{T}`",
    note = "a model of the attribute is one in its own numbers: the model itself or `&model`, not one in coordinates like `AbsoluteAngles(&model)`, which is a `CastOde`"
)]
pub trait Model<T: Scalar>: Sized {
    /// This model on other scalars.
    type Of<S: Scalar>: Pendulum<S>;

    /// Number of links, where the type tells it: code for a known number is shorter.
    const KNOWN_LINKS: Option<usize>;

    /// Returns the number of links, each with one angle.
    fn links(&self) -> usize;

    /// Returns the name of the link with that index, if there is one.
    #[must_use]
    fn link_name(&self, index: usize) -> Option<LinkName<'_>>;

    /// Returns the names of all links, in the order of the angles. Allocates.
    #[must_use]
    fn link_names(&self) -> Vec<String> {
        let names = (0..self.links()).filter_map(|index| self.link_name(index));
        names.map(|name| name.to_string()).collect()
    }

    /// Takes every constant through `convert`, which should change their type
    /// and not their value.
    ///
    /// All models of a type and a [`shape`](Self::shape) must convert as many constants in the
    /// same order, and differ in nothing else: this is how
    /// [`Ensemble::integrate_models_in_lanes`](crate::ensemble::Ensemble::integrate_models_in_lanes)
    /// puts several models into the lanes of one.
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

    /// Returns a number by which models of one type differ that cannot stand in the lanes of
    /// one, whatever their constants.
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

/// Returns the number of links that a type tells, 0 where it tells none. Choices by it are ones of
/// the compiler: what is not chosen is not compiled.
pub(crate) const fn known(links: Option<usize>) -> usize {
    match links {
        Some(links) => links,
        None => 0,
    }
}

/// Returns twice a number that may be known.
pub(super) const fn twice(links: Option<usize>) -> Option<usize> {
    match links {
        Some(links) => Some(2 * links),
        None => None,
    }
}
