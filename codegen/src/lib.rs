//! Compiler of the attribute `#[branched_pendulum(...)]` to specialised Rust
//! code.
//!
//! It is an ordinary library on token streams, so that every stage can be
//! tested without a compiler around it:
//!
//! ```text
//! tokens -> Description -> Scene -> Mechanics -> Program -> tokens
//! ```
//!
//! `expand` is the whole pipeline, `stages` gives what it passes through,
//! `ExpansionCache` keeps its results between builds, and `layout` writes the
//! tokens as text. The derivation uses
//! [Symbolica](https://symbolica.io) behind one door, `mechanics::algebra`;
//! what is emitted is free of it.
//!
//! # Features
//!
//! - `symbolica` (default): the whole compiler. Without it, the crate reads and checks
//!   descriptions ([`description`], [`scene`] and what they stand on) and depends on no
//!   Symbolica.

#[cfg(feature = "symbolica")]
mod cache;
pub mod description;
#[cfg(feature = "symbolica")]
pub mod emit;
pub mod exact;
pub mod functions;
#[cfg(feature = "symbolica")]
mod layout;
#[cfg(feature = "symbolica")]
pub mod mechanics;
mod named_members;
#[cfg(feature = "symbolica")]
mod pipeline;
#[cfg(feature = "symbolica")]
pub mod program;
pub mod report;
pub mod scene;
#[cfg(feature = "symbolica")]
mod translate;

#[cfg(feature = "symbolica")]
pub use cache::ExpansionCache;
#[cfg(feature = "symbolica")]
pub use layout::layout;
#[cfg(feature = "symbolica")]
pub use pipeline::{Stages, expand, stages, stages_without};
#[cfg(feature = "symbolica")]
pub use translate::{Language, translate};
