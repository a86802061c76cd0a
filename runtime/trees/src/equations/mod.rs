//! The equations of one link, derived and written by the compiler for links whose properties are
//! all parameters (`equations/` next to `src/`): in SI units, with a row of constants for each
//! link.
//!
//! `cargo branched-pendulum emit equations equations/general.rs --output src/equations/general.rs`
//! regenerates them, and a test fails if that is necessary.

#[rustfmt::skip]
mod by_rule;
#[rustfmt::skip]
mod general;
#[cfg(feature = "strips")]
#[rustfmt::skip]
mod prescribed;
#[rustfmt::skip]
mod non_viscous;
#[rustfmt::skip]
mod plain;

pub(crate) use by_rule::{ByRuleEquations, ByRuleRow};
pub(crate) use general::{GeneralEquations, GeneralRow};
pub(crate) use non_viscous::{NonViscousBodyRow, NonViscousEquations, NonViscousRow};
pub(crate) use plain::{PlainEquations, PlainRow};
#[cfg(feature = "strips")]
pub(crate) use prescribed::{PrescribedEquations, PrescribedRow};

/// Forms of the equations, by the properties that links of a tree have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Form {
    /// Links without torques in joints and without lateral offsets, whose children share a pivot.
    Plain,
    /// Links with all properties except friction that is not viscous.
    General,
    /// Links with all properties.
    NonViscous,
}
