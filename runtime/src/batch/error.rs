//! Errors of a batch.

use crate::errors::errors;

errors! {
    /// Arguments of a batch that do not fit together.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum BatchError {
        /// An argument has another number of slices than the pendulum has links.
        Links {
            /// Name of the argument.
            argument: &'static str,
            /// Number of links.
            expected: usize,
            /// Number of slices.
            found: usize,
        } => "`{argument}` needs one slice for each of {expected} links, but has {found}",
        /// A slice has another length than the first one of the angles.
        States {
            /// Name of the argument.
            argument: &'static str,
            /// Index of the link.
            link: usize,
            /// Length of the first slice of all.
            expected: usize,
            /// Length of this slice.
            found: usize,
        } => "`{argument}[{link}]` holds {found} states, but the first slice of all holds \
            {expected}",
        /// There are more or fewer slices than values of the function.
        Values {
            /// Number of values.
            expected: usize,
            /// Number of slices.
            found: usize,
        } => "the function has {expected} values, which need one slice each, but there are \
            {found}",
    }
}

impl core::error::Error for BatchError {}
