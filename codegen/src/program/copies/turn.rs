//! Cosine and sine of an angle that every link of an orbit has.

use super::field::{Copies, Field};
use super::series::Series;
use super::tree::{Branch, weight};
use crate::exact::Rational;
use crate::program::{Op, ValueId};
use std::collections::BTreeMap;

/// 1 − cos and sin of an angle.
struct Turn {
    versine: Series,
    sine: Series,
}

/// cos and sin of the angle of every link.
#[derive(Clone)]
pub(in crate::program) struct Direction {
    pub(in crate::program) cos: Field,
    pub(in crate::program) sin: Field,
}

impl Copies<'_> {
    /// e^{iθ}: the mean angle's, turned by what each copy has beyond it, with
    /// 1 − cos of the differences by half angles.
    pub(in crate::program) fn direction(&mut self, angle: &Field) -> Direction {
        let orbit = angle.orbit;
        let Some(mean) = angle.mean.coefficient(0) else {
            unreachable!("a mean angle is an input")
        };
        let name = self.orbits[orbit].name(None);
        let builder = &mut *self.graded.builder;
        let (cos, sin) = (builder.cos(mean), builder.sin(mean));
        builder.name(cos, &format!("cos_{name}"));
        builder.name(sin, &format!("sin_{name}"));
        let (cos, sin) = (self.graded.value(cos), self.graded.value(sin));
        let mut real = Field::zero(orbit);
        let mut imaginary = Field::zero(orbit);
        let branch = self.orbits[orbit].branch.as_ref();
        let [less, across] = self.turned(branch, angle, &mut real, &mut imaginary);
        real.mean = less;
        imaginary.mean = across;
        self.hinted(&real, "real");
        self.hinted(&imaginary, "imaginary");
        // (cos + i sin)(1 + real + i imaginary)
        let mut whole = [Field::zero(orbit), Field::zero(orbit)];
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
        cosine.mean = self.graded.add(&cos, &cosine.mean);
        sine.mean = self.graded.add(&sin, &sine.mean);
        Direction {
            cos: cosine,
            sin: sine,
        }
    }

    /// Mean of e^{i(θ − mean)} − 1 within a branching, real and imaginary
    /// part; the differences of it go to the two fields.
    fn turned(
        &mut self,
        branch: Option<&Branch>,
        angle: &Field,
        real: &mut Field,
        imaginary: &mut Field,
    ) -> [Series; 2] {
        let Some(branch) = branch else {
            return [Series::default(), Series::default()];
        };
        let mut reals = Vec::new();
        let mut imaginaries = Vec::new();
        for (copy, inner) in branch.copies.iter().enumerate() {
            let offset = self.offset(branch, angle, copy);
            let own: Vec<_> = (1..=branch.differences())
                .map(|index| (branch.group, index))
                .filter(|&place| !angle.at(place).is_zero() && weight(place.1, copy) != 0)
                .collect();
            let orbit = &self.orbits[angle.orbit];
            let label = match own.as_slice() {
                [place] => orbit.name(Some(*place)).to_owned(),
                _ => format!("{}_copy_{}", orbit.name(None), copy + 1),
            };
            let turn = self.turn(&offset, &label);
            let mut inside = [Field::zero(angle.orbit), Field::zero(angle.orbit)];
            let [inside_real, inside_imaginary] = &mut inside;
            let below = self.turned(inner.as_ref(), angle, inside_real, inside_imaginary);
            // (1 − vers + i sin)(1 + below) − 1
            let [x, y] = self.rotated(&turn, &below);
            let (real_part, imaginary_part) = (
                self.graded.sub(&x, &turn.versine),
                self.graded.add(&y, &turn.sine),
            );
            let number = copy + 1;
            self.graded
                .hint(&real_part, &format!("real_{label}_copy_{number}"));
            self.graded
                .hint(&imaginary_part, &format!("imaginary_{label}_copy_{number}"));
            reals.push(real_part);
            imaginaries.push(imaginary_part);
            let places: BTreeMap<_, ()> = inside
                .iter()
                .flat_map(|field| field.differences.keys().map(|&place| (place, ())))
                .collect();
            for &place in places.keys() {
                let [x, y] = self.rotated(&turn, &[inside[0].at(place), inside[1].at(place)]);
                real.put(place, x);
                imaginary.put(place, y);
            }
        }
        for (field, values) in [(real, &reals), (imaginary, &imaginaries)] {
            for (index, value) in self.differences(values).into_iter().enumerate() {
                field.put((branch.group, index + 1), value);
            }
        }
        [self.average(&reals), self.average(&imaginaries)]
    }

    /// (1 − vers + i sin)(x + iy)
    fn rotated(&mut self, turn: &Turn, [x, y]: &[Series; 2]) -> [Series; 2] {
        let graded = &mut self.graded;
        let one = graded.integer(1);
        let cos = graded.sub(&one, &turn.versine);
        let products = [
            graded.mul(&cos, x),
            graded.mul(&turn.sine, y),
            graded.mul(&cos, y),
            graded.mul(&turn.sine, x),
        ];
        [
            graded.sub(&products[0], &products[1]),
            graded.add(&products[2], &products[3]),
        ]
    }

    fn turn(&mut self, angle: &Series, label: &str) -> Turn {
        if angle.is_zero() {
            return Turn {
                versine: Series::default(),
                sine: Series::default(),
            };
        }
        let Some(order) = self.graded.truncation else {
            return self.turn_by_half_angle(angle, label);
        };
        let leading = self.graded.leading(angle);
        let rest = self.graded.sub(angle, &leading);
        let small = self.turn_by_powers(&rest, order);
        if leading.is_zero() {
            return small;
        }
        let whole = self.turn_by_half_angle(&leading, label);
        // 1 − vers + i sin of the sum, less 1.
        let less = self.graded.neg(&small.versine);
        let [real, imaginary] = self.rotated(&whole, &[less, small.sine]);
        Turn {
            versine: self.graded.sub(&whole.versine, &real),
            sine: self.graded.add(&whole.sine, &imaginary),
        }
    }

    /// With s, c of half the angle: sin = 2 s c, vers = 2 s². Opposite angles
    /// share them.
    fn turn_by_half_angle(&mut self, angle: &Series, label: &str) -> Turn {
        let builder = &mut *self.graded.builder;
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
        Turn {
            versine: self.graded.value(versine),
            sine: self.graded.value(sine),
        }
    }

    /// Taylor polynomials as far as the orders kept.
    fn turn_by_powers(&mut self, angle: &Series, order: usize) -> Turn {
        let mut versine = Series::default();
        let mut sine = Series::default();
        let mut term = self.graded.integer(1);
        for power in 1..=order {
            term = self.graded.mul(&term, angle);
            let share = Rational::from_ratio(1, power as i64).unwrap_or_else(Rational::one);
            term = self.graded.scale(&share, &term);
            let target = if power % 2 == 1 {
                &mut sine
            } else {
                &mut versine
            };
            // vers: + − +, from x²/2; sin: + − +, from x.
            *target = if (power - 1) / 2 % 2 == 0 {
                self.graded.add(target, &term)
            } else {
                self.graded.sub(target, &term)
            };
        }
        Turn { versine, sine }
    }
}
