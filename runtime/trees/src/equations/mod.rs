//! The equations of one link, as the compiler derived and wrote them for links whose
//! every property is a parameter (`equations/` beside `src/`): SI units, a row of
//! constants for each link.
//!
//! `cargo branched-pendulum emit equations equations/general.rs --output
//! src/equations/general.rs` writes them anew, and a test tells when that is due.

#[rustfmt::skip]
mod by_rule;
#[rustfmt::skip]
mod general;
#[cfg(feature = "strips")]
#[rustfmt::skip]
mod held;
#[rustfmt::skip]
mod rough;
#[rustfmt::skip]
mod straight;

pub(crate) use by_rule::{ByRuleEquations, ByRuleRow};
pub(crate) use general::{GeneralBodyRow, GeneralEquations, GeneralRow};
#[cfg(feature = "strips")]
pub(crate) use held::{HeldEquations, HeldRow};
pub(crate) use rough::{RoughBodyRow, RoughEquations, RoughRow};
pub(crate) use straight::{StraightBodyRow, StraightEquations, StraightRow};

/// Forms of the equations, by what the links of a tree have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Form {
    /// No torques in joints and no lateral offsets, and children share a pivot.
    Straight,
    /// All but friction that is not viscous.
    General,
    /// All.
    Rough,
}
