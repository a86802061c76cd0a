//! Random numbers that do not depend on a crate.

/// Normal numbers by sums of twelve (Irwin and Hall), from a xorshift generator.
pub(crate) struct Normal(pub(crate) u64);

impl Normal {
    pub(crate) fn next(&mut self) -> f64 {
        let mut uniform = || {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}
