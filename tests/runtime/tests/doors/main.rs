//! Safe code cannot make the runtime read or write beyond its memory, nor run instructions that
//! the machine has not: not by lengths, not by equations, numbers or models of its own. What
//! does not fit is refused by the compiler ([`refused`]), or gives NaN or other numbers, and
//! nothing else. `memory.sh` beside this file runs all of it optimised and under valgrind.

#![forbid(unsafe_code)]

mod marked;
mod numbers;
mod refused;
mod trees;
