//! The fixture scenes, compiled. Their files under `fixtures/scenes` are
//! what snapshots show, so that what is read is what is run.

#[path = "../fixtures/scenes/blades.rs"]
pub mod blades;
#[path = "../fixtures/scenes/branch.rs"]
pub mod branch;
#[path = "../fixtures/scenes/chain.rs"]
pub mod chain;
#[path = "../fixtures/scenes/damped_series.rs"]
pub mod damped_series;
#[path = "../fixtures/scenes/driven.rs"]
pub mod driven;
#[path = "../fixtures/scenes/driven_loops.rs"]
pub mod driven_loops;
#[path = "../fixtures/scenes/driven_series.rs"]
pub mod driven_series;
#[path = "../fixtures/scenes/free_series.rs"]
pub mod free_series;
#[path = "../fixtures/scenes/generations.rs"]
pub mod generations;
#[path = "../fixtures/scenes/nested.rs"]
pub mod nested;
#[path = "../fixtures/scenes/observed.rs"]
pub mod observed;
#[path = "../fixtures/scenes/offset.rs"]
pub mod offset;
#[path = "../fixtures/scenes/paper.rs"]
pub mod paper;
#[path = "../fixtures/scenes/series.rs"]
pub mod series;
#[path = "../fixtures/scenes/simple.rs"]
pub mod simple;
#[path = "../fixtures/scenes/sweep.rs"]
pub mod sweep;
#[path = "../fixtures/scenes/triplet.rs"]
pub mod triplet;
#[path = "../fixtures/scenes/unequal.rs"]
pub mod unequal;

/// The paper's scene as `branched-pendulum` commits it: built without the macro.
#[rustfmt::skip]
#[path = "../fixtures/expanded/paper.rs"]
pub mod paper_expanded;
