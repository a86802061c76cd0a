//! Errors of a batch.

/// Arguments of a batch that do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// An argument has another number of slices than the pendulum has links.
    #[error("`{argument}` needs one slice for each of {expected} links, but has {found}")]
    Links {
        /// Its name.
        argument: &'static str,
        /// Number of links.
        expected: usize,
        /// Number of slices.
        found: usize,
    },
    /// A slice has another length than the first one of the angles.
    #[error(
        "`{argument}[{link}]` holds {found} states, but the first slice of all holds {expected}"
    )]
    States {
        /// Name of the argument.
        argument: &'static str,
        /// Index of the link.
        link: usize,
        /// Length of the first slice of all.
        expected: usize,
        /// Length of this slice.
        found: usize,
    },
    /// There are more or fewer slices than values of the function.
    #[error("the function has {expected} values, which need one slice each, but there are {found}")]
    Values {
        /// Number of values.
        expected: usize,
        /// Number of slices.
        found: usize,
    },
}
