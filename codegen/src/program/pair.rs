//! Vectors in the plane, or complex numbers, as pairs of values.

use super::ValueId;
use super::builder::Builder;

/// A vector (horizontal, upwards), or a complex number (real, imaginary).
pub(super) type Pair = [ValueId; 2];

impl Builder {
    pub(super) fn zero_pair(&mut self) -> Pair {
        [self.integer(0); 2]
    }

    pub(super) fn add_pairs(&mut self, a: Pair, b: Pair) -> Pair {
        [self.add(a[0], b[0]), self.add(a[1], b[1])]
    }

    pub(super) fn sub_pairs(&mut self, a: Pair, b: Pair) -> Pair {
        [self.sub(a[0], b[0]), self.sub(a[1], b[1])]
    }

    pub(super) fn scale_pair(&mut self, factor: ValueId, a: Pair) -> Pair {
        a.map(|component| self.mul(factor, component))
    }

    /// Returns the scalar product a·b.
    pub(super) fn dot(&mut self, a: Pair, b: Pair) -> ValueId {
        let (first, second) = (self.mul(a[0], b[0]), self.mul(a[1], b[1]));
        self.add(first, second)
    }

    /// Returns the cross product a × b, the component perpendicular to the plane.
    pub(super) fn cross(&mut self, a: Pair, b: Pair) -> ValueId {
        let (first, second) = (self.mul(a[0], b[1]), self.mul(a[1], b[0]));
        self.sub(first, second)
    }

    /// Returns the product a b of complex numbers.
    pub(super) fn complex_product(&mut self, a: Pair, b: Pair) -> Pair {
        let real = [self.mul(a[0], b[0]), self.mul(a[1], b[1])];
        let imaginary = [self.mul(a[0], b[1]), self.mul(a[1], b[0])];
        [
            self.sub(real[0], real[1]),
            self.add(imaginary[0], imaginary[1]),
        ]
    }

    /// Names both components; `_x` or `_y` replaces the `@` in the name.
    pub(super) fn name_pair(&mut self, a: Pair, name: &str) -> Pair {
        for (component, axis) in a.into_iter().zip(["_x", "_y"]) {
            self.name(component, &name.replacen('@', axis, 1));
        }
        a
    }
}
