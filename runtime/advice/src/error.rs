//! Errors of the advisor.

use std::error::Error as StdError;

use thiserror::Error;

/// Reason why no advice can be given.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AdviceError {
    /// An argument is invalid.
    #[error("advice needs {0}")]
    Request(&'static str),
    /// The reference could not be computed: the equations could not be integrated to the end.
    #[error("the reference motion, against which errors are measured, could not be computed")]
    Reference(#[source] Box<dyn StdError + Send + Sync>),
    /// The tree does not support the request.
    #[cfg(feature = "trees")]
    #[error("the tree does not support the requested comparison of methods")]
    Tree(#[from] branched_pendulum_trees::TreeError),
}
