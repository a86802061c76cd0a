//! Trajectories to integrate: starts of one pendulum, or of one each.

use crate::system::State;

/// Trajectories to integrate.
#[derive(Debug)]
pub(crate) enum Cases<'a, P, T> {
    /// Of one pendulum.
    Starts(&'a P, &'a [State<T>]),
    /// Each of its own.
    Pairs(&'a [(P, State<T>)]),
}

impl<'a, P, T> Cases<'a, P, T> {
    /// Number of trajectories.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Starts(_, starts) => starts.len(),
            Self::Pairs(pairs) => pairs.len(),
        }
    }

    /// Pendulum and start of one of them.
    pub(super) fn get(&self, index: usize) -> Option<(&'a P, &'a State<T>)> {
        match *self {
            Self::Starts(pendulum, starts) => starts.get(index).map(|start| (pendulum, start)),
            Self::Pairs(pairs) => pairs.get(index).map(|(pendulum, start)| (pendulum, start)),
        }
    }

    /// Returns true if their pendulums may differ.
    pub(super) fn models_differ(&self) -> bool {
        matches!(self, Self::Pairs(_))
    }
}
