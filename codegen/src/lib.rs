//! Compiler of the attribute `#[branched_pendulum(...)]` to specialised Rust code.
//!
//! It is an ordinary library on token streams, so that every stage can be tested without a
//! procedural macro:
//!
//! ```text
//! tokens -> Description -> Scene -> Mechanics -> Program -> tokens
//! ```
//!
//! `expand` runs the whole pipeline, `stages` returns all intermediate results, `ExpansionCache`
//! keeps expansions between builds, and `layout` formats the tokens as source text. The derivation
//! uses [Symbolica](https://symbolica.io), which only the module `mechanics::algebra` names; the
//! emitted code does not depend on it.
//!
//! # Features
//!
//! - `symbolica` (default): the whole compiler. Without it, the crate only reads and checks
//!   descriptions ([`description`], [`scene`] and the modules that they use) and does not depend on
//!   Symbolica.

#[cfg(feature = "symbolica")]
mod cache;
pub mod description;
#[cfg(feature = "symbolica")]
pub mod emit;
pub mod exact;
pub mod functions;
#[cfg(feature = "symbolica")]
mod invocation;
#[cfg(feature = "symbolica")]
mod layout;
#[cfg(feature = "symbolica")]
pub mod mechanics;
mod named_members;
#[cfg(feature = "symbolica")]
mod owned;
#[cfg(feature = "symbolica")]
mod pipeline;
#[cfg(feature = "symbolica")]
pub mod program;
pub mod report;
pub mod scene;
#[cfg(feature = "symbolica")]
mod translate;
#[cfg(feature = "symbolica")]
mod user_folder;

#[cfg(feature = "symbolica")]
pub use cache::ExpansionCache;
#[cfg(feature = "symbolica")]
pub use layout::layout;
#[cfg(feature = "symbolica")]
pub use pipeline::{Stages, expand, stages, stages_without};
#[cfg(feature = "symbolica")]
pub use translate::{Language, translate};
