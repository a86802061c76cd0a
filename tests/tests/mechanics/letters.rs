//! The paper's letters for the symbols of its scene.

use branched_pendulum_codegen::mechanics::algebra::Formula;

use crate::fixtures::NAMED;
use crate::formulas::{Algebra, inside, product};
use crate::support::{compile_item, compile_paper};

/// The paper's letters.
pub(crate) struct Letters {
    pub(crate) m_1: Formula,
    pub(crate) m_2: Formula,
    pub(crate) mu: Formula,
    pub(crate) g_1: Formula,
    pub(crate) g_2: Formula,
    pub(crate) p_1: Formula,
    pub(crate) p_m: Formula,
    pub(crate) p_d: Formula,
    pub(crate) theta_d: Formula,
    /// cos Δ_m, Δ_m = θ_m − θ_1.
    pub(crate) c: Formula,
    /// sin Δ_m.
    pub(crate) s: Formula,
    /// D as a symbol.
    pub(crate) d: Formula,
}

impl Letters {
    fn new(algebra: &Algebra<'_>) -> Self {
        let s = |text: &str| algebra.s(text);
        Self {
            m_1: s("M_parent"),
            m_2: s("M_child"),
            mu: s("μ_child,parent"),
            g_1: s("G_parent"),
            g_2: s("G_child"),
            p_1: s("p_parent"),
            p_m: s("p_m"),
            p_d: s("p_d"),
            theta_d: s("θ_d"),
            c: s("cos(θ_m − θ_parent)"),
            s: s("sin(θ_m − θ_parent)"),
            d: s("D"),
        }
    }

    /// M_2 p_1 − μ c p_m.
    pub(crate) fn x(&self) -> Formula {
        &(&self.m_2 * &self.p_1) - &product([&self.mu, &self.c, &self.p_m])
    }
}

/// Runs the test with literals and with a name for every number: the formulas
/// are the same.
pub(crate) fn in_both_scenes(test: impl Fn(&Algebra<'_>, &Letters) + Sync) {
    for compiled in [compile_paper(), compile_item(NAMED)] {
        inside(&compiled, |algebra| test(algebra, &Letters::new(algebra)));
    }
}
