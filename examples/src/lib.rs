//! The paper's experiment as a library, so that tests can call it. The short programs in `src/bin`
//! do not use it; each shows one idea.

pub mod branched_double;
