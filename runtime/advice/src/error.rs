//! Why there is no advice.

use std::error::Error as StdError;

use thiserror::Error;

/// Why there is no advice.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AdviceError {
    /// The request makes no sense.
    #[error("advice needs {0}")]
    Request(&'static str),
    /// There is no reference: the equations were not integrated to the end.
    #[error("there is no reference to measure errors against")]
    Reference(#[source] Box<dyn StdError + Send + Sync>),
    /// The tree has not what is asked of it.
    #[cfg(feature = "trees")]
    #[error("the tree has not what is asked of it")]
    Tree(#[from] branched_pendulum_trees::TreeError),
}
