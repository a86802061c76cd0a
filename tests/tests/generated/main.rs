//! Emitted code as its users meet it: compiled, called, built in parallel.

mod bits;
mod hygiene;
mod sectors;
mod toolchain;
