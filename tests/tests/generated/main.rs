//! Emitted code as its users meet it: compiled, called, built in parallel.

mod any_number;
mod bits;
mod example;
mod fused;
mod generations;
mod hints;
mod hygiene;
mod loop_states;
mod loops;
mod positions;
mod rounding;
mod scalars;
mod sectors;
mod standing;
mod table;
mod toolchain;
mod transfer_forms;
