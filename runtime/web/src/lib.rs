//! Pendulum trees for the browser: the WebAssembly functions that the web page calls.
//!
//! The page only draws; all its numbers are computed by this crate, with `branched-pendulum` and
//! `branched-pendulum-trees`. SI units; angles are absolute, in radians from the downward vertical;
//! errors are texts for the user.

mod branches;
mod budget;
mod description;
mod differences;
mod hand;
mod methods;
mod outline;
mod path;
mod pendulum;
mod release_map;
mod swing;

pub use branches::{with_branch, without_branch};
pub use budget::Budget;
pub use description::{Parameter, parameters};
pub use methods::{MethodChoice, methods};
pub use pendulum::Pendulum;
pub use release_map::ReleaseMap;
