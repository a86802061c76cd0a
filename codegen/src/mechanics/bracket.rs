//! Poisson brackets.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};

impl Derivation<'_> {
    /// Computes the Poisson bracket {F, G} = Σ_i ∂F/∂q_i ∂G/∂p_i − ∂F/∂p_i ∂G/∂q_i.
    ///
    /// `pairs` are the canonical pairs (q_i, p_i) that F depends on; all other terms vanish. G may
    /// contain derived symbols (in-phase velocities), because they depend only on pairs outside
    /// this sum.
    pub(super) fn poisson_bracket(
        &self,
        pairs: &[(SymbolId, SymbolId)],
        f: &Formula,
        g: &Formula,
    ) -> Formula {
        let foreign = |symbol: SymbolId| {
            self.symbols.get(symbol).role == Role::Momentum
                && pairs.iter().all(|&(_, p)| p != symbol)
        };
        assert!(
            self.coordinates_of(f)
                .iter()
                .all(|c| pairs.iter().any(|(q, _)| q == c))
                && !f.symbols().into_iter().any(foreign),
            "a bracket was asked for over too few canonical pairs: {f:?}"
        );
        pairs
            .iter()
            .flat_map(|&(q, p)| {
                let forward = &self.partial(f, q) * &g.derivative(p);
                let backward = &f.derivative(p) * &self.partial(g, q);
                [forward, -backward]
            })
            .sum::<Formula>()
            .expand()
    }
}
