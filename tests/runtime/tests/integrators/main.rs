//! Integrators with systems of many types, each of which has its own copy of their code.

mod backwards;
mod continuation;
mod events;
#[allow(dead_code, reason = "the optimised tests follow the others")]
#[path = "../../../../runtime/tests/runtime/problems.rs"]
mod problems;
mod requests;
mod stepper;
mod taylor;
mod workspace;
