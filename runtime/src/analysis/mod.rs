//! Physics derived from matrices and trajectories: linear modes, of a whole tree and by sector;
//! averages with their errors ([`statistics`]); the growth of deviations and of differences between
//! copies; and the range of amplitudes in which truncated energy transfers are accurate.

mod eigenvalues;
pub mod equilibrium;
pub mod growth;
pub mod modes;
pub mod normal_form;
mod random;
pub mod sector_modes;
pub mod statistics;
pub mod truncation;
pub mod variational;

pub use equilibrium::{
    AtRest, Equilibrium, EquilibriumError, PotentialEnergy, Stability, Stiffness, equilibria,
    equilibrium, equilibrium_at, equilibrium_of_torques, stable_equilibrium,
};
pub use modes::{Modes, ModesError};
pub use sector_modes::{SectorBlock, SectorModes, SectorModesError};
