//! Angle addition: sines and cosines of differences are computed from those of single angles, and
//! every sine is computed together with its cosine.
//!
//! # When it is valid
//! cos(a − b) = cos a cos b + sin a sin b has an absolute error of two roundings of terms of size
//! up to one, about 10⁻¹⁶. The same holds for sin(a − b), which is exactly zero for a = b. Where
//! small differences between copies matter, the program computes versines of half angles instead
//! (`rotations.rs`).
//!
//! # Cost
//! One sine and cosine per link instead of one per pair of related links; four products and two
//! sums per pair.

use super::lower::{Environment, Lowering};
use super::{Pass, ValueId};
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{CombinationId, Trigonometric};

impl Lowering<'_> {
    pub(super) fn trigonometric(
        &mut self,
        environment: &mut Environment<'_>,
        symbol: SymbolId,
    ) -> ValueId {
        let mechanics = self.mechanics;
        match mechanics.trigonometry[&symbol] {
            Trigonometric::VersineOf(CombinationId(id)) => {
                self.combination(environment, &mechanics.combinations[id])
                    .versine
            }
            Trigonometric::SineOf(CombinationId(id)) => {
                self.combination(environment, &mechanics.combinations[id])
                    .sine
            }
            Trigonometric::Cos(a) if self.is_combined(a) => {
                let versine = self.by_half_angle(environment, a).versine;
                let one = self.builder.integer(1);
                self.builder.sub(one, versine)
            }
            Trigonometric::Sin(a) if self.is_combined(a) => self.by_half_angle(environment, a).sine,
            Trigonometric::Cos(a) => {
                let angle = self.symbol(environment, a);
                self.builder.cos(angle)
            }
            Trigonometric::Sin(a) => {
                let angle = self.symbol(environment, a);
                self.builder.sin(angle)
            }
            Trigonometric::CosBetween(a, b) if self.builder.off == Some(Pass::AngleAddition) => {
                let difference = self.difference(environment, a, b);
                self.builder.cos(difference)
            }
            Trigonometric::SinBetween(a, b) if self.builder.off == Some(Pass::AngleAddition) => {
                let difference = self.difference(environment, a, b);
                self.builder.sin(difference)
            }
            // cos(a − b) = cos a cos b + sin a sin b
            Trigonometric::CosBetween(a, b) => {
                let [cos_a, sin_a, cos_b, sin_b] = self.sines_and_cosines(environment, a, b);
                let first = self.builder.mul(cos_a, cos_b);
                let second = self.builder.mul(sin_a, sin_b);
                self.builder.add(first, second)
            }
            // sin(a − b) = sin a cos b − cos a sin b
            Trigonometric::SinBetween(a, b) => {
                let [cos_a, sin_a, cos_b, sin_b] = self.sines_and_cosines(environment, a, b);
                let first = self.builder.mul(sin_a, cos_b);
                let second = self.builder.mul(cos_a, sin_b);
                self.builder.sub(first, second)
            }
        }
    }

    fn difference(
        &mut self,
        environment: &mut Environment<'_>,
        a: SymbolId,
        b: SymbolId,
    ) -> ValueId {
        let (a, b) = (self.symbol(environment, a), self.symbol(environment, b));
        self.builder.sub(a, b)
    }

    fn sines_and_cosines(
        &mut self,
        environment: &mut Environment<'_>,
        a: SymbolId,
        b: SymbolId,
    ) -> [ValueId; 4] {
        [
            Trigonometric::Cos(a),
            Trigonometric::Sin(a),
            Trigonometric::Cos(b),
            Trigonometric::Sin(b),
        ]
        .map(|wanted| self.trigonometric_symbol(wanted))
        .map(|symbol| self.symbol(environment, symbol))
    }

    pub(super) fn trigonometric_symbol(&self, wanted: Trigonometric) -> SymbolId {
        let mut table = self.mechanics.trigonometry.iter();
        match table.find(|(_, meaning)| **meaning == wanted) {
            Some((&symbol, _)) => symbol,
            None => unreachable!("every coordinate has a sine and a cosine"),
        }
    }
}
