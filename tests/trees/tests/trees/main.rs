//! Trees that are described at run time: what can be told without the compiler.

// Methods for trees at run time that it has compiled are taken from there.
use branched_pendulum_advice as _;

mod between;
mod costs;
mod forms;
mod growth;
mod in_phase;
mod magnitudes;
mod mechanics;
mod plain;
mod prescribed;
mod scales;
mod straight;
mod text;
mod transfer;
