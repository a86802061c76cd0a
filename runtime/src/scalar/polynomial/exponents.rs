//! Exponents of the monomials of a polynomial, packed into one integer.

/// Exponents of a monomial, with four bits for each variable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Exponents(u128);

/// Mask of every second group of four bits.
const EVEN: u128 = u128::MAX / 0xff * 0x0f;

impl Exponents {
    /// Largest number of variables.
    pub const MOST_VARIABLES: usize = 32;

    /// Largest total degree.
    pub const MOST_DEGREE: u32 = 15;

    /// Returns the exponents of the monomial that is one variable. Variables beyond
    /// [`MOST_VARIABLES`](Self::MOST_VARIABLES) give the monomial 1.
    pub fn of_variable(variable: usize) -> Self {
        match variable < Self::MOST_VARIABLES {
            true => Self(1 << (4 * variable)),
            false => Self(0),
        }
    }

    /// Returns the exponent of a variable in this monomial.
    pub fn of(self, variable: usize) -> u32 {
        match variable < Self::MOST_VARIABLES {
            true => (self.0 >> (4 * variable)) as u32 & 0xf,
            false => 0,
        }
    }

    /// Returns the total degree.
    pub fn degree(self) -> u32 {
        let pairs = (self.0 & EVEN) + (self.0 >> 4 & EVEN);
        // The sum of all bytes, in the highest byte.
        (pairs.wrapping_mul(u128::MAX / 0xff) >> 120) as u32
    }

    /// Returns the exponents of the variables that `mask` selects; all others are zero.
    pub(super) fn masked(self, mask: u128) -> Self {
        Self(self.0 & mask)
    }

    /// Returns the mask that selects the given variables.
    pub(super) fn mask(variables: impl Iterator<Item = usize>) -> u128 {
        let own = variables.filter(|own| *own < Self::MOST_VARIABLES);
        own.fold(0, |mask, own| mask | 0xf << (4 * own))
    }

    /// Returns the exponents of the product of two monomials, whose degree must not exceed
    /// [`MOST_DEGREE`](Self::MOST_DEGREE).
    pub fn times(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }

    /// Returns the exponents after a division by one variable; `None` if its exponent is zero.
    pub fn without(self, variable: usize) -> Option<Self> {
        (self.of(variable) > 0).then(|| Self(self.0 - Self::of_variable(variable).0))
    }
}

impl core::hash::Hasher for ExponentHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u128(u128::from(*byte));
        }
    }

    fn write_u128(&mut self, value: u128) {
        // Odd multipliers spread the few low bits of each exponent over the whole word.
        let [low, high] = [value as u64, (value >> 64) as u64];
        let mixed = (self.0 ^ low).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mixed = (mixed ^ high.rotate_left(29)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        self.0 = mixed ^ mixed >> 32;
    }
}

/// Hash function of exponents: fast, and with the same result in every run.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ExponentHasher(u64);
