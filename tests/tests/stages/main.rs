//! What every stage says about the fixture scenes, pinned as snapshots, and
//! that it says the same each time.

mod determinism;
mod ladder;
mod late;
mod lengths;
mod loops;
mod pages;
mod passes;
mod prose;
mod snapshots;
