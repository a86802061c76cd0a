//! Numbers that are computed with two tolerances, to estimate their error.

/// A number that was computed at two tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// The number computed at the tighter tolerance.
    pub value: f64,
    /// Relative difference between the value and that computed with the looser tolerance. For rates
    /// and frequencies below 1/(time span), it is relative to 1/(time span).
    pub difference: f64,
}

impl Checked {
    /// Largest relative difference up to which a number counts as determined.
    pub const DETERMINED: f64 = 0.01;

    /// Returns true if the results at the two tolerances agree to 1 %.
    pub fn is_determined(&self) -> bool {
        self.difference <= Self::DETERMINED
    }

    /// Returns the positive number whose logarithm is `coarse` at the looser tolerance and `fine`
    /// at the tighter one.
    pub(super) fn of_logarithms(coarse: f64, fine: f64) -> Self {
        Self {
            value: fine.exp(),
            difference: (coarse - fine).abs().exp_m1(),
        }
    }

    /// Returns a rate or frequency (1/s) measured over `span` seconds: `coarse` at the looser
    /// tolerance, `fine` at the tighter one.
    pub(super) fn of_rates(coarse: f64, fine: f64, span: f64) -> Self {
        Self {
            value: fine,
            difference: (coarse - fine).abs() / fine.abs().max(1.0 / span),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Checked;

    #[test]
    fn differences_are_relative() {
        let factor = Checked::of_logarithms(1.02_f64.ln(), 0.0);
        assert!((factor.value - 1.0).abs() < 1e-15 && (factor.difference - 0.02).abs() < 1e-15);
        let smaller = Checked::of_logarithms(0.0, 1.02_f64.ln());
        assert!((smaller.value - 1.02).abs() < 1e-15 && (smaller.difference - 0.02).abs() < 1e-15);
        // Differences are relative to the rate, or to one per span if that is larger.
        let fast = Checked::of_rates(-0.202, -0.2, 100.0);
        assert!((fast.difference - 0.01).abs() < 1e-12 && fast.value == -0.2);
        let slow = Checked::of_rates(0.003, 0.001, 50.0);
        assert!((slow.difference - 0.1).abs() < 1e-12);
        assert!(!factor.is_determined() && !slow.is_determined());
        assert!(Checked::of_rates(0.2001, 0.2, 100.0).is_determined());
    }
}
