//! Sectors, their energies and the transfers between them, against dense
//! matrices, Cartesian velocities and finite differences.

mod blocks;
mod closure;
mod energies;
mod normalisation;
mod oracle;
mod orders;
mod rates;
