//! Errors of batches.

use crate::errors::errors;

errors! {
    /// Error: the arguments of a batch have inconsistent lengths.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum BatchError {
        /// The number of slices of an argument is not the number of links.
        Links {
            /// Name of the argument.
            argument: &'static str,
            /// Number of links.
            expected: usize,
            /// Number of slices.
            found: usize,
        } => "`{argument}` needs one slice for each of {expected} links, but has {found}",
        /// The length of a slice differs from that of the first slice of angles.
        States {
            /// Name of the argument.
            argument: &'static str,
            /// Index of the link.
            link: usize,
            /// Length of the first slice.
            expected: usize,
            /// Length of this slice.
            found: usize,
        } => "`{argument}[{link}]` holds {found} states, but the first slice of all holds \
            {expected}",
        /// The number of result slices is not the number of values of the function.
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
