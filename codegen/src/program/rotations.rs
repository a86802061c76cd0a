//! Rotations by differences of copies, as versine and sine. Both are exactly zero if the difference
//! is zero, and accurate if it is small.

use super::ValueId;
use super::lower::{Environment, Lowering};
use crate::mechanics::expression::SymbolId;

/// Versine (1 − cos) and sine of an angle.
#[derive(Clone, Copy)]
pub(super) struct VersineSine {
    pub(super) versine: ValueId,
    pub(super) sine: ValueId,
}

impl Lowering<'_> {
    /// Returns true if a coordinate occurs in a combination of coordinates, so that its versine is
    /// computed already.
    pub(super) fn is_combined(&self, coordinate: SymbolId) -> bool {
        self.mechanics
            .combinations
            .iter()
            .flatten()
            .any(|(c, _)| *c == coordinate)
    }

    /// Computes versine and sine from sine s and cosine c of half the angle: sin = 2 s c, vers = 2
    /// s².
    pub(super) fn by_half_angle(
        &mut self,
        environment: &mut Environment<'_>,
        coordinate: SymbolId,
    ) -> VersineSine {
        let angle = self.symbol(environment, coordinate);
        let code = &self.mechanics.symbols.get(coordinate).code;
        let name = code.strip_prefix("theta_").unwrap_or(code);
        let builder = &mut self.builder;
        let two = builder.integer(2);
        let half = builder.div(angle, two);
        builder.name(half, &format!("half_theta_{name}"));
        let sin = builder.sin(half);
        builder.name(sin, &format!("sin_half_{name}"));
        let cos = builder.cos(half);
        builder.name(cos, &format!("cos_half_{name}"));
        let product = builder.mul(sin, cos);
        let sine = builder.mul(two, product);
        builder.name(sine, &format!("sin_{name}"));
        let square = builder.mul(sin, sin);
        let versine = builder.mul(two, square);
        builder.name(versine, &format!("vers_{name}"));
        VersineSine { versine, sine }
    }

    /// Computes the rotation by a sum of coordinates with integer weights.
    pub(super) fn combination(
        &mut self,
        environment: &mut Environment<'_>,
        combination: &[(SymbolId, i64)],
    ) -> VersineSine {
        let zero = self.builder.integer(0);
        let mut total = VersineSine {
            versine: zero,
            sine: zero,
        };
        for &(coordinate, weight) in combination {
            let mut turn = self.by_half_angle(environment, coordinate);
            if weight < 0 {
                turn.sine = self.builder.neg(turn.sine);
            }
            for _ in 0..weight.abs() {
                total = self.compose(total, turn);
            }
        }
        total
    }

    /// Composes two rotations:
    /// vers(a + b) = vers a + vers b − vers a vers b + sin a sin b,
    /// sin(a + b) = sin a (1 − vers b) + sin b (1 − vers a).
    fn compose(&mut self, a: VersineSine, b: VersineSine) -> VersineSine {
        let builder = &mut self.builder;
        let one = builder.integer(1);
        let sum = builder.add(a.versine, b.versine);
        let versines = builder.mul(a.versine, b.versine);
        let sines = builder.mul(a.sine, b.sine);
        let less = builder.sub(sum, versines);
        let versine = builder.add(less, sines);
        let cos_a = builder.sub(one, a.versine);
        let cos_b = builder.sub(one, b.versine);
        let first = builder.mul(a.sine, cos_b);
        let second = builder.mul(b.sine, cos_a);
        let sine = builder.add(first, second);
        VersineSine { versine, sine }
    }
}
