//! Window functions: weights of the samples of a record.

use core::f64::consts::PI;

/// Weights of the samples of a record, symmetric about its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Window {
    /// Equal weights: the narrowest peaks, with large side lobes.
    Rectangular,
    /// sin²(π (n + ½)/N): peaks twice as wide, with side lobes that decay as the third power of the
    /// distance.
    #[default]
    Hann,
    /// Hann's window to a power p, after J. Laskar: peaks p + 1 times as wide as the narrowest
    /// ones, with side lobes that decay as the power 2p + 1 of the distance.
    HannPower(u8),
}

impl Window {
    pub(super) fn power(self) -> u8 {
        match self {
            Self::Rectangular => 0,
            Self::Hann => 1,
            Self::HannPower(power) => power,
        }
    }

    /// Returns the weights of `count` samples.
    pub(super) fn weights(self, count: usize) -> Vec<f64> {
        let power = i32::from(self.power());
        let weight = |index: usize| {
            let sine = (PI * (index as f64 + 0.5) / count as f64).sin();
            (sine * sine).powi(power)
        };
        (0..count).map(weight).collect()
    }
}
