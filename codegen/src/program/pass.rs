//! Names of the passes.

use crate::named_members::named_members;

named_members! {
    /// A step that can be left out.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Pass {
        /// Equal operations on equal operands are one value.
        Sharing = "sharing",
        /// Operations on constants become constants of the model, exactly.
        Folding = "folding",
        /// Signs move outwards and into sums and differences.
        Signs = "signs",
        /// Sines and cosines of differences are formed from those of single angles.
        AngleAddition = "angle-addition",
        /// A common factor of several terms is multiplied once.
        CommonFactors = "common-factors",
        /// The cheaper of two solves is taken.
        Choice = "choice",
        /// Products are part of the sums that they feed.
        Fusing = "fusing",
        /// Where values outnumber registers, inputs are read, sines asked for and results
        /// handed over each where its turn comes.
        Order = "order",
        /// Long functions are written in parts.
        Splitting = "splitting",
    }
}

impl Pass {
    /// Returns true if the pass changes the operations of a function; if not,
    /// it changes only how they are written.
    pub(super) fn is_counted(self) -> bool {
        !matches!(self, Self::Order | Self::Splitting)
    }
}
