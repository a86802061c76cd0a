//! Errors in merging the shards of a sweep.

use super::input::InputDifference;

/// Reason why the shards of a sweep cannot be merged.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SweepError {
    /// The folder holds another sweep.
    #[error("the folder holds another sweep: expected {expected}, found {found}")]
    Manifest {
        /// Manifest of the sweep in the folder.
        found: String,
        /// The manifest of this one.
        expected: String,
    },
    /// A file that the sweep reads has changed since the sweep began.
    #[error("the folder holds a sweep with other input: {0}")]
    Input(InputDifference),
    /// Some shards are not there.
    #[error("{} of {count} shards are not finished: {}; run them first", missing.len(), list(missing))]
    Gaps {
        /// Their numbers.
        missing: Vec<u32>,
        /// Number of all.
        count: u32,
    },
    /// The shards belong to a sweep with another number of shards.
    #[error(
        "{folder} is not part of a sweep of {count} shards: give the same number of shards to every run of a sweep"
    )]
    Foreign {
        /// Name of a folder.
        folder: String,
        /// Number of shards asked for.
        count: u32,
    },
    /// The results of a shard do not belong to the items of that shard.
    #[error(
        "{folder} does not contain every item of its shard exactly once: delete it and run the shard again"
    )]
    Items {
        /// Name of its folder.
        folder: String,
    },
}

/// Numbers, at most ten.
fn list(numbers: &[u32]) -> String {
    let shown: Vec<String> = numbers.iter().take(10).map(u32::to_string).collect();
    let more = if numbers.len() > 10 { ", …" } else { "" };
    shown.join(", ") + more
}
