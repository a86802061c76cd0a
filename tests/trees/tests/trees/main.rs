//! Trees that are described at run time: what can be told without the compiler.

// Methods for trees at run time that it has compiled are taken from there.
use branched_pendulum_advice as _;

mod balance;
mod between;
mod canonical;
mod costs;
mod equilibria;
mod forms;
mod growth;
mod in_phase;
mod inverse_dynamics;
mod lineage;
mod magnitudes;
mod mechanics;
mod normal_form;
mod plain;
mod prescribed;
mod scales;
mod straight;
mod text;
mod transfer;
