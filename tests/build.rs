//! Does nothing: it makes cargo count the build dependencies, see Cargo.toml.

fn main() {}
