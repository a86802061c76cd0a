//! The paper's experiment as a library, so that tests can call it; the short programs of
//! `src/bin` stand alone, one idea each.

pub mod branched_double;
