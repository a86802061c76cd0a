//! Trajectories to integrate: starts of one system, or of one each.

use crate::system::State;

/// Trajectories to integrate.
#[derive(Debug)]
pub(crate) enum Cases<'a, O, T> {
    /// Of one system.
    Starts(&'a O, &'a [State<T>]),
    /// Each of its own.
    Pairs(&'a [(O, State<T>)]),
}

impl<'a, O, T> Cases<'a, O, T> {
    /// Number of trajectories.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Starts(_, starts) => starts.len(),
            Self::Pairs(pairs) => pairs.len(),
        }
    }

    /// System and start of one of them.
    pub(crate) fn get(&self, index: usize) -> Option<(&'a O, &'a State<T>)> {
        match *self {
            Self::Starts(system, starts) => starts.get(index).map(|start| (system, start)),
            Self::Pairs(pairs) => pairs.get(index).map(|(system, start)| (system, start)),
        }
    }

    /// Returns true if their systems may differ.
    pub(super) fn models_differ(&self) -> bool {
        matches!(self, Self::Pairs(_))
    }
}
