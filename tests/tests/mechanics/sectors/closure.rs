//! Budgets along trajectories.
