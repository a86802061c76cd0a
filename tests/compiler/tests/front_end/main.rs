//! The front end: tokens to description to scene, and every message about what
//! is wrong on the way.

mod errors;
mod fuzz;
mod rules;
mod scenes;
mod singular;
mod stubs;
