//! Parts of the lowering to programs.

#[path = "../../src/program/scale.rs"]
mod scale;
#[path = "../../src/program/symmetric/tree.rs"]
mod tree;
#[path = "../../src/program/wide.rs"]
mod wide;
