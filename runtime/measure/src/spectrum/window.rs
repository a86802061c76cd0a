//! Weights of samples.

use core::f64::consts::PI;

/// Weights of the samples of a record, symmetric about its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Window {
    /// All samples alike: the narrowest peaks, with wide side lobes.
    Rectangular,
    /// sin²(π (n + ½)/N): peaks twice as wide, side lobes that fall off as the third power
    /// of the distance.
    #[default]
    Hann,
    /// Hann's window to a power p, as J. Laskar weights series: peaks p + 1 times as wide as the
    /// narrowest, side lobes that fall off as the power 2p + 1 of the distance.
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

    /// Weights of `count` samples.
    pub(super) fn weights(self, count: usize) -> Vec<f64> {
        let power = i32::from(self.power());
        let weight = |index: usize| {
            let sine = (PI * (index as f64 + 0.5) / count as f64).sin();
            (sine * sine).powi(power)
        };
        (0..count).map(weight).collect()
    }
}
