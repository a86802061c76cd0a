//! Whether the energy budget closes.

use super::estimate::{Estimate, quantity};
use super::report::Trust;

/// Largest chance that a closure which is nothing but noise is called a gap anywhere in a record. It
/// is far smaller, since the closure of one time is nearly that of the next.
const CHANCE: f64 = 0.01;

/// Whether the integral of the power is the change of the energy, as far as can be told.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The first time at which the closure is not zero, s; none where the budget closes.
    pub fails_from: Option<f64>,
    /// Largest closure in its deviations at the same time.
    pub bars: f64,
    /// Deviations beyond which a closure is not zero.
    pub allowed: f64,
    /// The closure and its deviation at all times, of the largest energy.
    pub closure: Vec<[f64; 2]>,
    /// How far the estimate is to be trusted.
    pub trust: Trust,
}

impl Verdict {
    /// Judges an estimate whose deviations are those of so many draws.
    pub fn of(times: &[f64], estimate: &Estimate, draws: usize) -> Self {
        let trust = Trust::of(estimate);
        let bands = &estimate.energies;
        let rows = bands.means.iter().zip(&bands.deviations);
        let closure = rows.map(|(mean, deviation)| {
            [mean, deviation].map(|row| row[quantity::CLOSURE] / trust.energy)
        });
        let closure: Vec<[f64; 2]> = closure.collect();
        // The closure begins with zero, and zero for its deviation.
        let bars = closure.iter().skip(1);
        let bars = bars.map(|[closure, deviation]| closure.abs() / deviation);
        // What polynomials do not follow is not in their deviations, and about as much as is: their
        // widths balance the two. They foretell nothing, and have no whiteness.
        let of_noise = if estimate.whiteness.is_nan() {
            2.0
        } else {
            1.0
        };
        let allowed = of_noise * allowed(times.len(), draws);
        let mut fails = times.iter().skip(1).zip(bars.clone());
        Self {
            fails_from: fails
                .find(|(_, bars)| *bars > allowed)
                .map(|(time, _)| *time),
            bars: bars.fold(0.0, f64::max),
            allowed,
            closure,
            trust,
        }
    }

    /// Returns true where the budget closes.
    pub fn closes(&self) -> bool {
        self.fails_from.is_none()
    }
}

/// Deviations that noise alone exceeds anywhere in a record with a chance of at most [`CHANCE`]: of
/// a normal distribution, looked at so many times (the tail of one side is below exp(−z²/2)/2), and
/// from there of Student's t, since deviations are known from draws (Wallace's approximation).
fn allowed(times: usize, draws: usize) -> f64 {
    let normal = (2.0 * (times.max(1) as f64 / CHANCE).ln()).sqrt();
    let freedom = draws.max(2) as f64 - 1.0;
    let scaled = normal * (8.0 * freedom + 3.0) / (8.0 * freedom + 1.0);
    (freedom * (scaled * scaled / freedom).exp_m1()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::allowed;

    /// The tail of the normal distribution that is allowed for is 1e-5 on either side: its quantile is
    /// 4.265, and the bound lies a tenth above. With few draws Student's t has far longer tails
    /// (with 20 degrees of freedom 5.53).
    #[test]
    fn few_draws_allow_more() {
        let many = allowed(500, 1_000_000);
        assert!((1.0..1.1).contains(&(many / 4.265)), "{many}");
        let few = allowed(500, 21);
        assert!((1.0..1.2).contains(&(few / 5.53)), "{few}");
        assert!(allowed(100_000, 200) > allowed(1000, 200));
    }
}
