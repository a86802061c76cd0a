//! Several forms of the same energy transfers W, for comparison.

use core::fmt;

use crate::model::Transfer;
use crate::scalar::Scalar;
use crate::system::SymmetricPendulum;

/// A form of W: the quantities that it takes as small, and the highest order that it keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferForm {
    /// Truncated at an order in the difference angles, exact in the momenta. Order 1 is the form
    /// that was published.
    Angle(u32),
    /// Truncated at an order in the amplitude: in the angles and momenta of the differences
    /// together.
    Amplitude(u32),
    /// Without truncation.
    Exact,
}

impl TransferForm {
    /// Returns the order that is kept; `None` without truncation.
    #[must_use]
    pub fn order(self) -> Option<u32> {
        match self {
            Self::Angle(order) | Self::Amplitude(order) => Some(order),
            Self::Exact => None,
        }
    }
}

impl fmt::Display for TransferForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Angle(order) => write!(f, "angle order {order}"),
            Self::Amplitude(order) => write!(f, "amplitude order {order}"),
            Self::Exact => f.write_str("exact"),
        }
    }
}

/// A sector whose coordinates truncated forms of W take as small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SmallSector {
    /// Name of the sector, which is the name of its uppermost difference coordinate.
    pub name: &'static str,
    /// Indices of the sector's symmetric coordinates, from the root outwards.
    pub coordinates: &'static [usize],
}

/// A model that has W in several forms, including the exact one.
///
/// It is emitted if a description requests truncated forms and the exact one: `transfer(amplitude =
/// 2, exact)`, or `budget(canonical, amplitude = 2)`. If it requests both, these are the forms of
/// the budget. `analysis::truncation` computes the error of each form as a function of the
/// amplitude.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::{SymmetricPendulum, TransferForm, TransferForms, prelude::*};
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     emit(transfer(angle = 1, amplitude = 4, exact)),
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::new();
/// let forms = <BranchedDouble as TransferForms<f64>>::TRANSFER_FORMS;
/// let names: Vec<String> = forms.iter().map(|form| form.to_string()).collect();
/// assert_eq!(names, ["angle order 1", "amplitude order 4", "exact"]);
/// assert_eq!(<BranchedDouble as TransferForms<f64>>::RECEIVERS, ["d"]);
///
/// let coordinates = [0.4, 0.3, 0.01];
/// let mut momenta = [0.0; 3];
/// model.symmetric_momenta_into(&coordinates, &[1.0, -2.0, 0.05], &mut momenta);
/// let mut exact = [Transfer::default()];
/// model.transfers_into(2, &coordinates, &momenta, &mut exact);
/// assert_eq!(exact[0], model.transfer_exact(&coordinates, &momenta));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no truncated forms of W beside the exact one",
    note = "a model has them with `emit(transfer(amplitude = 2, exact))` and its like, or `emit(budget(canonical, amplitude = 2))`"
)]
pub trait TransferForms<T: Scalar>: SymmetricPendulum<T> {
    /// Forms: angle orders, then amplitude orders, both in increasing order, and
    /// [`TransferForm::Exact`] last.
    const TRANSFER_FORMS: &'static [TransferForm];

    /// Names of the sectors that receive W.
    const RECEIVERS: &'static [&'static str];

    /// Sectors that the truncated forms take as small.
    const SMALL_SECTORS: &'static [SmallSector];

    /// Writes W (in W) into each of [`RECEIVERS`](Self::RECEIVERS) by the form with the index
    /// `form` in [`TRANSFER_FORMS`](Self::TRANSFER_FORMS), at symmetric coordinates (rad) and their
    /// momenta (kg m²/s).
    ///
    /// The results are NaN for a form that does not exist, and for slices whose lengths are not the
    /// number of links and that of the receivers.
    fn transfers_into(
        &self,
        form: usize,
        coordinates: &[T],
        momenta: &[T],
        transfers: &mut [Transfer<T>],
    );

    /// Writes the momenta (kg m²/s) that belong to symmetric coordinates (rad) with the velocities
    /// `rates` (rad/s); NaN if a slice does not have one number per link.
    fn symmetric_momenta_into(&self, coordinates: &[T], rates: &[T], momenta: &mut [T]);
}
