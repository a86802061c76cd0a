//! Trajectories to integrate in lanes: several starts of one system, or one start of each of
//! several systems.

use crate::system::State;

/// List of trajectories to integrate.
#[derive(Debug)]
pub(crate) enum Cases<'a, O, T> {
    /// Starts of one common system.
    Starts(&'a O, &'a [State<T>]),
    /// Systems, each with its start.
    Pairs(&'a [(O, State<T>)]),
    /// Systems, each with its start and its output times; a trajectory ends at its last output
    /// time.
    Timed(&'a [(O, State<T>)], &'a [&'a [T]]),
}

impl<'a, O, T> Cases<'a, O, T> {
    /// Returns the number of trajectories.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Starts(_, starts) => starts.len(),
            Self::Pairs(pairs) | Self::Timed(pairs, _) => pairs.len(),
        }
    }

    /// Returns the system and the start of trajectory number `index`.
    pub(crate) fn get(&self, index: usize) -> Option<(&'a O, &'a State<T>)> {
        match *self {
            Self::Starts(system, starts) => starts.get(index).map(|start| (system, start)),
            Self::Pairs(pairs) | Self::Timed(pairs, _) => {
                pairs.get(index).map(|(system, start)| (system, start))
            }
        }
    }

    /// Returns true if the trajectories may have different systems.
    pub(super) fn models_differ(&self) -> bool {
        !matches!(self, Self::Starts(..))
    }

    /// Returns the output times of trajectory number `index`, if each trajectory has its own.
    pub(super) fn times(&self, index: usize) -> Option<&'a [T]> {
        match *self {
            Self::Timed(_, times) => Some(times.get(index).copied().unwrap_or_default()),
            Self::Starts(..) | Self::Pairs(_) => None,
        }
    }
}
