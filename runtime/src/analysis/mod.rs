//! From matrices and trajectories to physics: linear modes, of a whole tree and
//! sector by sector, averages with their errors ([`statistics`]), the growth
//! of deviations and of differences between copies, and how far truncated transfers reach.

pub mod equilibrium;
pub mod growth;
pub mod modes;
mod random;
pub mod sector_modes;
pub mod statistics;
pub mod truncation;
pub mod variational;

pub use equilibrium::{AtRest, EquilibriumError, equilibrium, equilibrium_of_torques};
pub use modes::{Modes, ModesError};
pub use sector_modes::{SectorBlock, SectorModes, SectorModesError};
