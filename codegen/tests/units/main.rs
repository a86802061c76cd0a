//! Parts of the compiler, each on its own.
//!
//! The modules behind `#[path]` have unit tests that need private items. They are compiled here, with
//! the parts of the compiler that they use, so that the tests do not compile the whole compiler again.

#![allow(dead_code, unreachable_pub)]

#[path = "../../src/cache/mod.rs"]
mod cache;
#[path = "../../src/invocation.rs"]
mod invocation;
mod layout_of_code;
mod lineage;
#[path = "../../src/owned.rs"]
mod owned;
mod passes;
mod program;
mod rules;
#[path = "../../src/user_folder.rs"]
mod user_folder;

use branched_pendulum_codegen::{exact, expand, layout, scene, stages};
