//! Letters of the constants of links.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::print::Index;

/// A letter for constants, with its spellings in code, text and LaTeX, and the unit.
#[derive(Clone, Copy)]
pub(super) struct Letter {
    pub(super) code: &'static str,
    pub(super) text: &'static str,
    pub(super) latex: &'static str,
    unit: &'static str,
}

const fn letter(
    code: &'static str,
    text: &'static str,
    latex: &'static str,
    unit: &'static str,
) -> Letter {
    Letter {
        code,
        text,
        latex,
        unit,
    }
}

pub(super) const INERTIA: Letter = letter("inertia", "M", "M", "kg m²");
pub(super) const GRAVITY: Letter = letter("gravity", "G", "G", "J");
pub(super) const LATERAL_GRAVITY: Letter = letter("lateral_gravity", "F", "F", "J");
pub(super) const FRICTION: Letter = letter("friction", "c", "c", "N m s");
pub(super) const DRAG: Letter = letter("drag", "k", "k", "N m s");
pub(super) const SPRING: Letter = letter("spring", "κ", "\\kappa", "N m");
pub(super) const REST: Letter = letter("rest", "ρ", "\\rho", "rad");
pub(super) const MOMENT: Letter = letter("moment", "h", "h", "kg m");
pub(super) const LATERAL_MOMENT: Letter = letter("lateral_moment", "e", "e", "kg m");
pub(super) const COUPLING: Letter = letter("coupling", "μ", "\\mu", "kg m²");
pub(super) const LATERAL_COUPLING: Letter = letter("lateral_coupling", "ν", "\\nu", "kg m²");
pub(super) const ARM: Letter = letter("arm", "r", "r", "m");
pub(super) const LATERAL_ARM: Letter = letter("lateral_arm", "r⊥", "r^{\\perp}", "m");
pub(super) const PEG_X: Letter = letter("peg_x", "X", "X", "m");
pub(super) const PEG_Y: Letter = letter("peg_y", "Y", "Y", "m");
pub(super) const STRAIGHT_SPRING: Letter = letter("straight_spring", "K", "K", "N/m");
pub(super) const CHORD: Letter = letter("chord", "Γ", "\\Gamma", "J");
pub(super) const RESTORING: Letter = letter("restoring", "Λ", "\\Lambda", "J");
pub(super) const REST_LENGTH: Letter = letter("rest_length", "L", "L", "m");
pub(super) const STRAIGHT_FRICTION: Letter = letter("straight_friction", "γ", "\\gamma", "N s/m");

/// Returns the letter for the strength of a repulsion; its unit depends on the exponent.
pub(super) const fn repulsion(unit: &'static str) -> Letter {
    letter("repulsion", "A", "A", unit)
}

impl Derivation<'_> {
    /// Names a constant by a letter and the names of its owners: an orbit (set of equal copies of
    /// one link), an orbit and one above it, or the links that a spring-damper connects.
    pub(super) fn lettered(
        &mut self,
        letter: Letter,
        names: &[impl AsRef<str>],
        meaning: &str,
        value: Formula,
    ) -> Formula {
        let Letter {
            code,
            text,
            latex,
            unit,
        } = letter;
        let index = Index::of(names);
        self.constant(
            &format!("{code}_{}", index.code),
            &format!("{text}_{}", index.text),
            &format!("{latex}_{{\\mathrm{{{}}}}}", index.latex),
            meaning,
            unit,
            value,
        )
    }
}
