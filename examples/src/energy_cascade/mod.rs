//! A binary tree of four generations on a driven root: which sectors does the
//! energy go to, and who gives it to whom?
//!
//! - [`arguments`]: the command line,
//! - [`scene`]: the tree, and its sectors by where they branch,
//! - [`run`]: one trajectory with the budgets of all sectors,
//! - [`report`]: tables, [`charts`]: charts.

pub mod arguments;
pub mod charts;
pub mod failure;
pub mod report;
pub mod run;
pub mod scene;

pub use arguments::{ArgumentError, Arguments, Request};
pub use failure::Failure;
pub use run::{Run, Work};
pub use scene::{Level, Tree};
