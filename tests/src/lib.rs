//! Fixtures and oracles that the test binaries share; `README.md` says which
//! kind of test lives where.

// Emitted code must not cause a warning or need a missing doc in its user's
// crate: this one compiles all fixture scenes.
#![deny(warnings, missing_docs)]

pub mod bodies;
pub mod oracle;
pub mod promised;
pub mod reference;
pub mod samples;
pub mod scenes;

/// The front page compiles and holds.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct FrontPage;

/// The way out of what cannot be described works.
#[cfg(doctest)]
#[doc = include_str!("../../docs/limits.md")]
pub struct Limits;

/// Parameters of a tree of one's own come back from its motion.
#[cfg(doctest)]
#[doc = include_str!("../../docs/identification.md")]
pub struct IdentificationPage;

/// The tutorials' listings compile, and what they assert holds.
#[cfg(doctest)]
mod tutorials {
    #[doc = include_str!("../../docs/tutorials/paper.md")]
    pub struct Paper;

    #[doc = include_str!("../../docs/tutorials/sectors.md")]
    pub struct Sectors;

    #[doc = include_str!("../../docs/tutorials/games.md")]
    pub struct Games;

    #[doc = include_str!("../../docs/tutorials/large-trees.md")]
    pub struct LargeTrees;
}
