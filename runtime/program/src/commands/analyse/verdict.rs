//! Verdict on the energy budget.

use super::estimate::{Estimate, quantity};
use super::report::Trust;

/// Largest probability that noise alone causes a gap anywhere in a record. The actual probability
/// is far smaller, because closures at neighbouring times are nearly equal.
const CHANCE: f64 = 0.01;

/// Verdict on the energy budget: the integral of the power and the change of the energy are equal
/// within the errors, or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// First time (s) at which the closure is not zero within its error; `None` if the budget
    /// closes.
    pub fails_from: Option<f64>,
    /// Largest closure error, in units of its standard deviation at the same time.
    pub bars: f64,
    /// Number of standard deviations above which a closure is not zero.
    pub allowed: f64,
    /// The closure error and its standard deviation at all times, relative to the largest energy.
    pub closure: Vec<[f64; 2]>,
    /// How far the estimate can be trusted.
    pub trust: Trust,
}

impl Verdict {
    /// Judges an estimate whose standard deviations come from this many draws.
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

    /// Returns true if the energy budget closes within the errors.
    pub fn closes(&self) -> bool {
        self.fails_from.is_none()
    }
}

/// Returns the number of standard deviations that noise alone exceeds anywhere in a record with a
/// probability of at most [`CHANCE`]: first for a normal distribution, tested at this many times
/// (the tail of one side is below exp(−z²/2)/2), and from there of Student's t, since deviations
/// are known from draws (Wallace's approximation).
fn allowed(times: usize, draws: usize) -> f64 {
    let normal = (2.0 * (times.max(1) as f64 / CHANCE).ln()).sqrt();
    let freedom = draws.max(2) as f64 - 1.0;
    let scaled = normal * (8.0 * freedom + 3.0) / (8.0 * freedom + 1.0);
    (freedom * (scaled * scaled / freedom).exp_m1()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::allowed;

    /// Checks the number of allowed standard deviations. The tail probability is 1e-5 on either
    /// side, whose normal quantile is 4.265; the bound is 0.1 above. With few draws, Student's t
    /// distribution has far longer tails (5.53 for 20 degrees of freedom).
    #[test]
    fn few_draws_allow_more() {
        let many = allowed(500, 1_000_000);
        assert!((1.0..1.1).contains(&(many / 4.265)), "{many}");
        let few = allowed(500, 21);
        assert!((1.0..1.2).contains(&(few / 5.53)), "{few}");
        assert!(allowed(100_000, 200) > allowed(1000, 200));
    }
}
