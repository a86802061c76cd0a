//! Cosine and sine of the angles of the links of an orbit (set of equal copies of one link).

use super::field::{SymmetricField, SymmetricTree};
use super::series::TruncatedSeries;
use super::tree::{Branch, weight};
use crate::exact::Rational;
use crate::program::{Op, ValueId};
use std::collections::BTreeMap;

/// A rotation: versine (1 − cos) and sine of its angle.
struct SeriesRotation {
    versine: TruncatedSeries,
    sine: TruncatedSeries,
}

/// Cosine and sine of the angle of every link of an orbit.
#[derive(Clone)]
pub(in crate::program) struct Direction {
    pub(in crate::program) cos: SymmetricField,
    pub(in crate::program) sin: SymmetricField,
}

impl SymmetricTree<'_> {
    /// Computes e^{iθ} for every link: e^{iθ} of the mean angle, rotated by each copy's deviation
    /// from it. The versines (1 − cos) of the differences are computed by half angles.
    pub(in crate::program) fn direction(&mut self, angle: &SymmetricField) -> Direction {
        let orbit = angle.orbit;
        let Some(mean) = angle.mean.coefficient(0) else {
            unreachable!("a mean angle is an input")
        };
        let name = self.orbits[orbit].name(None);
        let builder = &mut *self.series.builder;
        let (cos, sin) = (builder.cos(mean), builder.sin(mean));
        builder.name(cos, &format!("cos_{name}"));
        builder.name(sin, &format!("sin_{name}"));
        let (cos, sin) = (self.series.value(cos), self.series.value(sin));
        let mut real = SymmetricField::zero(orbit);
        let mut imaginary = SymmetricField::zero(orbit);
        let branch = self.orbits[orbit].branch.as_ref();
        let [less, across] = self.turned(branch, angle, &mut real, &mut imaginary);
        real.mean = less;
        imaginary.mean = across;
        self.hinted(&real, "real");
        self.hinted(&imaginary, "imaginary");
        // (cos + i sin)(1 + real + i imaginary)
        let mut whole = [SymmetricField::zero(orbit), SymmetricField::zero(orbit)];
        let parts = [
            (&cos, &real, &sin, &imaginary, true),
            (&cos, &imaginary, &sin, &real, false),
        ];
        for (result, (c, x, s, y, opposite)) in whole.iter_mut().zip(parts) {
            let first = self.scale(c, x);
            let second = self.scale(s, y);
            *result = if opposite {
                self.sub(&first, &second)
            } else {
                self.add(&first, &second)
            };
        }
        let [mut cosine, mut sine] = whole;
        cosine.mean = self.series.add(&cos, &cosine.mean);
        sine.mean = self.series.add(&sin, &sine.mean);
        Direction {
            cos: cosine,
            sin: sine,
        }
    }

    /// Returns the mean of e^{i(θ − mean)} − 1 within a branching, real and imaginary part; adds
    /// its differences to the two fields.
    fn turned(
        &mut self,
        branch: Option<&Branch>,
        angle: &SymmetricField,
        real: &mut SymmetricField,
        imaginary: &mut SymmetricField,
    ) -> [TruncatedSeries; 2] {
        let Some(branch) = branch else {
            return [TruncatedSeries::default(), TruncatedSeries::default()];
        };
        let mut reals = Vec::new();
        let mut imaginaries = Vec::new();
        for (copy, inner) in branch.copies.iter().enumerate() {
            let offset = self.offset(branch, angle, copy);
            let own: Vec<_> = (1..=branch.differences())
                .map(|index| (branch.group, index))
                .filter(|&id| !angle.at(id).is_zero() && weight(id.1, copy) != 0)
                .collect();
            let orbit = &self.orbits[angle.orbit];
            let label = match own.as_slice() {
                [id] => orbit.name(Some(*id)).to_owned(),
                _ => format!("{}_copy_{}", orbit.name(None), copy + 1),
            };
            let turn = self.rotation(&offset, &label);
            let mut inside = [
                SymmetricField::zero(angle.orbit),
                SymmetricField::zero(angle.orbit),
            ];
            let [inside_real, inside_imaginary] = &mut inside;
            let below = self.turned(inner.as_ref(), angle, inside_real, inside_imaginary);
            // (1 − vers + i sin)(1 + below) − 1
            let [x, y] = self.rotated(&turn, &below);
            let (real_part, imaginary_part) = (
                self.series.sub(&x, &turn.versine),
                self.series.add(&y, &turn.sine),
            );
            let number = copy + 1;
            self.series
                .hint(&real_part, &format!("real_{label}_copy_{number}"));
            self.series
                .hint(&imaginary_part, &format!("imaginary_{label}_copy_{number}"));
            reals.push(real_part);
            imaginaries.push(imaginary_part);
            let ids: BTreeMap<_, ()> = inside
                .iter()
                .flat_map(|field| field.differences.keys().map(|&id| (id, ())))
                .collect();
            for &id in ids.keys() {
                let [x, y] = self.rotated(&turn, &[inside[0].at(id), inside[1].at(id)]);
                real.put(id, x);
                imaginary.put(id, y);
            }
        }
        for (field, values) in [(real, &reals), (imaginary, &imaginaries)] {
            for (index, value) in self.differences(values).into_iter().enumerate() {
                field.put((branch.group, index + 1), value);
            }
        }
        [self.average(&reals), self.average(&imaginaries)]
    }

    /// Computes (1 − vers + i sin)(x + iy).
    fn rotated(
        &mut self,
        turn: &SeriesRotation,
        [x, y]: &[TruncatedSeries; 2],
    ) -> [TruncatedSeries; 2] {
        let series = &mut self.series;
        let one = series.integer(1);
        let cos = series.sub(&one, &turn.versine);
        let products = [
            series.mul(&cos, x),
            series.mul(&turn.sine, y),
            series.mul(&cos, y),
            series.mul(&turn.sine, x),
        ];
        [
            series.sub(&products[0], &products[1]),
            series.add(&products[2], &products[3]),
        ]
    }

    fn rotation(&mut self, angle: &TruncatedSeries, label: &str) -> SeriesRotation {
        if angle.is_zero() {
            return SeriesRotation {
                versine: TruncatedSeries::default(),
                sine: TruncatedSeries::default(),
            };
        }
        let Some(order) = self.series.truncation else {
            return self.turn_by_half_angle(angle, label);
        };
        let leading = self.series.leading(angle);
        let rest = self.series.sub(angle, &leading);
        let small = self.turn_by_powers(&rest, order);
        if leading.is_zero() {
            return small;
        }
        let whole = self.turn_by_half_angle(&leading, label);
        // 1 − vers + i sin of the sum, minus 1.
        let less = self.series.neg(&small.versine);
        let [real, imaginary] = self.rotated(&whole, &[less, small.sine]);
        SeriesRotation {
            versine: self.series.sub(&whole.versine, &real),
            sine: self.series.add(&whole.sine, &imaginary),
        }
    }

    /// Computes the rotation from sine s and cosine c of half the angle: sin = 2 s c, vers = 2 s².
    /// Opposite angles share the values.
    fn turn_by_half_angle(&mut self, angle: &TruncatedSeries, label: &str) -> SeriesRotation {
        let builder = &mut *self.series.builder;
        let Some(angle) = angle.coefficient(0) else {
            unreachable!("an angle that is not zero has a value")
        };
        let (opposite, angle): (bool, ValueId) = match *builder.op(angle) {
            Op::Neg(inner) => (true, inner),
            _ => (false, angle),
        };
        let two = builder.integer(2);
        let half = builder.div(angle, two);
        let (sin, cos) = (builder.sin(half), builder.cos(half));
        builder.name(half, &format!("half_{label}"));
        builder.name(sin, &format!("sin_half_{label}"));
        builder.name(cos, &format!("cos_half_{label}"));
        let product = builder.mul(sin, cos);
        let sine = builder.mul(two, product);
        let square = builder.mul(sin, sin);
        let versine = builder.mul(two, square);
        builder.name(sine, &format!("sin_{label}"));
        builder.name(versine, &format!("vers_{label}"));
        let sine = if opposite { builder.neg(sine) } else { sine };
        SeriesRotation {
            versine: self.series.value(versine),
            sine: self.series.value(sine),
        }
    }

    /// Computes the rotation by Taylor polynomials, up to the highest order that is kept.
    fn turn_by_powers(&mut self, angle: &TruncatedSeries, order: usize) -> SeriesRotation {
        let mut versine = TruncatedSeries::default();
        let mut sine = TruncatedSeries::default();
        let mut term = self.series.integer(1);
        for power in 1..=order {
            term = self.series.mul(&term, angle);
            let share = Rational::from_ratio(1, power as i64).unwrap_or_else(Rational::one);
            term = self.series.scale(&share, &term);
            let target = if power % 2 == 1 {
                &mut sine
            } else {
                &mut versine
            };
            // vers: + − +, from x²/2; sin: + − +, from x.
            *target = if (power - 1) / 2 % 2 == 0 {
                self.series.add(target, &term)
            } else {
                self.series.sub(target, &term)
            };
        }
        SeriesRotation { versine, sine }
    }
}
