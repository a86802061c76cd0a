//! Trajectories to integrate: starts of one system, or of one each.

use crate::system::State;

/// Trajectories to integrate.
#[derive(Debug)]
pub(crate) enum Cases<'a, O, T> {
    /// Of one system.
    Starts(&'a O, &'a [State<T>]),
    /// Each of its own.
    Pairs(&'a [(O, State<T>)]),
    /// Each of its own, with times of its own at which states are wanted, the last its end.
    Timed(&'a [(O, State<T>)], &'a [&'a [T]]),
}

impl<'a, O, T> Cases<'a, O, T> {
    /// Number of trajectories.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Starts(_, starts) => starts.len(),
            Self::Pairs(pairs) | Self::Timed(pairs, _) => pairs.len(),
        }
    }

    /// System and start of one of them.
    pub(crate) fn get(&self, index: usize) -> Option<(&'a O, &'a State<T>)> {
        match *self {
            Self::Starts(system, starts) => starts.get(index).map(|start| (system, start)),
            Self::Pairs(pairs) | Self::Timed(pairs, _) => {
                pairs.get(index).map(|(system, start)| (system, start))
            }
        }
    }

    /// Returns true if their systems may differ.
    pub(super) fn models_differ(&self) -> bool {
        !matches!(self, Self::Starts(..))
    }

    /// The times of one of them, if they have their own.
    pub(super) fn times(&self, index: usize) -> Option<&'a [T]> {
        match *self {
            Self::Timed(_, times) => Some(times.get(index).copied().unwrap_or_default()),
            Self::Starts(..) | Self::Pairs(_) => None,
        }
    }
}
