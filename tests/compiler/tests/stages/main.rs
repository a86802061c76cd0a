//! The text of every stage for the fixture scenes, pinned as snapshots, and
//! equal each time.

mod architecture;
mod book;
mod constants;
mod determinism;
mod gradients;
mod ladder;
mod languages;
mod lengths;
mod loops;
mod owned_files;
mod pages;
mod passes;
mod prose;
mod sink;
mod snapshots;
