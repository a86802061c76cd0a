//! Pendulum trees for the browser: what the page asks of WebAssembly.
//!
//! The page draws; every number on it comes from here, and here from `branched-pendulum` and
//! `branched-pendulum-trees`. SI units; angles are absolute, in radians from the downward
//! vertical; errors are texts for the reader.

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
