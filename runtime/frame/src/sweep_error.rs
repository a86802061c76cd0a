//! Why shards do not make a whole.

/// Why shards do not make a whole.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SweepError {
    /// The folder holds another sweep.
    #[error("the folder holds another sweep: {found}, where {expected} is asked for")]
    Manifest {
        /// Manifest of the sweep that is there.
        found: String,
        /// The manifest of this one.
        expected: String,
    },
    /// Some shards are not there.
    #[error("{} of {count} shards are not finished: {}", missing.len(), list(missing))]
    Gaps {
        /// Their numbers.
        missing: Vec<u32>,
        /// Number of all.
        count: u32,
    },
    /// Shards of another number of shards.
    #[error("{folder} is none of {count} shards: one sweep has one number of shards")]
    Foreign {
        /// Name of a folder.
        folder: String,
        /// Number of shards asked for.
        count: u32,
    },
    /// A part that holds other items than its shard has.
    #[error("{folder} does not hold the items of its shard, once each")]
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
