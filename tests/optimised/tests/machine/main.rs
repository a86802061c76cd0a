//! What only optimised code shows: the machine code itself, and trees too large without.

mod machine_code;
mod million;
