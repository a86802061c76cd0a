//! Names of the optimisation passes.

use crate::named_members::named_members;

named_members! {
    /// A pass that can be left out.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Pass {
        /// Equal operations on equal operands become one value.
        Sharing = "sharing",
        /// Operations on constants become constants of the model, computed exactly.
        Folding = "folding",
        /// Signs move outwards and into sums and differences.
        Signs = "signs",
        /// Sines and cosines of differences are computed from those of single angles.
        AngleAddition = "angle-addition",
        /// A common factor of several terms is multiplied once.
        CommonFactors = "common-factors",
        /// The cheaper of two methods of solving for the accelerations is chosen.
        Choice = "choice",
        /// Products become parts of the sums that use them.
        Fusing = "fusing",
        /// If there are more values than registers, each input is read, each sine computed and each
        /// result written only when it is needed.
        Order = "order",
        /// Long functions are split into parts.
        Splitting = "splitting",
    }
}

impl Pass {
    /// Returns true if the pass changes the operations of a function, not only the form of the
    /// code.
    pub(super) fn is_counted(self) -> bool {
        !matches!(self, Self::Order | Self::Splitting)
    }
}
