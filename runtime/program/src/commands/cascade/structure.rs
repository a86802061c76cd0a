//! Structure functions: moments of the amplitudes of scales, as turbulence has them of differences
//! of velocities.
//!
//! The amplitude of a scale is its speed u = √(2 E/M), M the mass of the subtrees that differ. Over
//! the scales of a constant flux Π, ⟨u^p⟩ ∝ (Π ℓ/M)^ζ with ζ = p/3 if Kolmogorov's argument holds at
//! each moment. Bursts that grow towards the young scales bend ζ as a function of p.

use std::ops::Range;

use branched_pendulum::ScaleBudget;
use branched_pendulum::analysis::statistics::{Estimate, jackknife};
use serde::{Deserialize, Serialize};

use super::tree::DrivenTree;

/// Orders of the structure functions.
pub const ORDERS: [i32; 5] = [2, 3, 4, 5, 6];

/// The order that follows from the flux alone in turbulence.
const THIRD: usize = 1;

/// Sums over samples of a scale: the number of samples, and E^(p/2) of each order p.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AmplitudeSums {
    samples: f64,
    sums: [f64; ORDERS.len()],
}

impl AmplitudeSums {
    /// Counts the scale's energy of a state, J.
    pub fn count(&mut self, budget: &ScaleBudget<f64>, scale: usize) {
        let amplitude = budget.energy(scale).max(0.0).sqrt();
        self.samples += 1.0;
        for (sum, order) in self.sums.iter_mut().zip(ORDERS) {
            *sum += amplitude.powi(order);
        }
    }

    /// Adds the sums of other samples.
    pub fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        for (sum, more) in self.sums.iter_mut().zip(other.sums) {
            *sum += more;
        }
    }

    /// Mean of an order, by its index in [`ORDERS`].
    fn mean(&self, order: usize) -> f64 {
        self.sums[order] / self.samples
    }

    /// ⟨u⁴⟩/⟨u²⟩², 3 for a normal distribution of u and 2 for one in two dimensions.
    fn flatness(&self) -> f64 {
        self.mean(2) / self.mean(0).powi(2)
    }
}

/// Exponents of one order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureExponent {
    /// The order p.
    pub order: i32,
    /// ζ of ⟨u^p⟩ ∝ (Π ℓ/M)^ζ.
    pub exponent: Estimate,
    /// The exponent of ⟨u^p⟩ as a power of ⟨u³⟩.
    pub of_third: Estimate,
}

/// Structure functions of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// Flatness of the amplitude of each scale from the means on.
    pub flatness: Vec<Option<Estimate>>,
    /// The scales whose flux is constant.
    pub range: Range<usize>,
    /// Exponents over these scales; none over fewer than three.
    pub exponents: Vec<StructureExponent>,
}

impl Structure {
    /// Evaluates the sums of all starts, one of each scale, over a range of scales with these fluxes
    /// (W, from scale 0 on). The error bars are from leaving out one start after the other.
    pub fn new(
        driven: &DrivenTree,
        starts: &[&[AmplitudeSums]],
        range: Range<usize>,
        fluxes: &[f64],
    ) -> Self {
        let all = |scale: usize, left_out: Option<usize>| {
            let mut sums = AmplitudeSums::default();
            for (index, start) in starts.iter().enumerate() {
                if let (Some(own), true) = (start.get(scale), Some(index) != left_out) {
                    sums.add(own);
                }
            }
            sums
        };
        let scales = 0..driven.generations();
        let flatness = scales
            .map(|scale| jackknife(starts.len(), |left_out| all(scale, left_out).flatness()).ok());
        let mass = |scale: usize| driven.subtrees.get(scale).copied().unwrap_or(f64::NAN);
        let speed = |scale: usize, order: usize, left_out| {
            let mean = all(scale, left_out).mean(order).ln();
            mean + 0.5 * f64::from(ORDERS[order]) * (2.0 / mass(scale)).ln()
        };
        let passed: Vec<f64> = range
            .clone()
            .map(|scale| {
                let length = driven.lengths.get(scale).copied().unwrap_or(f64::NAN);
                (fluxes.get(scale).copied().unwrap_or(f64::NAN) * length / mass(scale)).ln()
            })
            .collect();
        let exponents = ORDERS.iter().enumerate().map_while(|(order, &power)| {
            if range.len() < 3 {
                return None;
            }
            let of = |order, left_out| -> Vec<f64> {
                let scales = range.clone();
                scales.map(|scale| speed(scale, order, left_out)).collect()
            };
            let exponent = jackknife(starts.len(), |left_out| {
                slope(&passed, &of(order, left_out))
            });
            let of_third = jackknife(starts.len(), |left_out| {
                slope(&of(THIRD, left_out), &of(order, left_out))
            });
            Some(StructureExponent {
                order: power,
                exponent: exponent.ok()?,
                of_third: of_third.ok()?,
            })
        });
        Self {
            flatness: flatness.collect(),
            exponents: exponents.collect(),
            range,
        }
    }
}

impl Structure {
    /// Returns the moments as Markdown. `level` is the deviation of a flux that counts as constant.
    pub fn table(&self, level: f64) -> String {
        let flatness = self.flatness.iter().map(|own| match own {
            Some(own) => format!("{:.2} ± {:.2}", own.value, own.error),
            None => "–".to_owned(),
        });
        let flatness: Vec<String> = flatness.collect();
        let mut text = format!(
            "\nFlatness of the amplitude u = √(2E/M) of each scale, ⟨u⁴⟩/⟨u²⟩²: {}.\n\n",
            flatness.join(", ")
        );
        if self.exponents.is_empty() {
            text += "Too few scales have a constant flux for exponents of structure functions.\n";
            return text;
        }
        text += &format!(
            "Structure functions ⟨u^p⟩ ∝ (Π ℓ/M)^ζ over scales {} to {}, whose flux is constant \
             within {:.0} %:\n\n\
             | order p | ζ | ζ relative to order 3 | p/3 | She and Lévêque |\n\
             |---:|---:|---:|---:|---:|\n",
            self.range.start,
            self.range.end - 1,
            100.0 * level,
        );
        for own in &self.exponents {
            let StructureExponent {
                order,
                exponent,
                of_third,
            } = *own;
            let row = format!(
                "| {order} | {:.3} ± {:.3} | {:.3} ± {:.3} | {:.3} | {:.3} |\n",
                exponent.value,
                exponent.error,
                of_third.value,
                of_third.error,
                f64::from(order) / 3.0,
                she_leveque(order),
            );
            text += &row.replace('-', "−");
        }
        text
    }
}

/// Exponent of order p by Z.-S. She and E. Lévêque (Phys. Rev. Lett. 72, 336, 1994), for comparison.
pub fn she_leveque(order: i32) -> f64 {
    let order = f64::from(order);
    order / 9.0 + 2.0 * (1.0 - (2.0_f64 / 3.0).powf(order / 3.0))
}

/// Returns the longest range of consecutive scales from 1 on whose fluxes (from scale 0 on) lie
/// within the part `level` of their largest.
pub fn level_range(fluxes: &[f64], level: f64) -> Range<usize> {
    let mut longest = 1..1;
    for first in 1..fluxes.len() {
        for end in first + 1..=fluxes.len() {
            let own = &fluxes[first..end];
            let least = own.iter().copied().fold(f64::INFINITY, f64::min);
            let most = own.iter().copied().fold(0.0, f64::max);
            let is_known = own.iter().all(|flux| flux.is_finite());
            if is_known && most - least <= level * most && own.len() > longest.len() {
                longest = first..end;
            }
        }
    }
    longest
}

/// Slope of the line of least squares.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (middle, height) = (mean(x), mean(y));
    let pairs = || x.iter().zip(y);
    let above: f64 = pairs().map(|(x, y)| (x - middle) * (y - height)).sum();
    above / x.iter().map(|x| (x - middle).powi(2)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::{AmplitudeSums, ORDERS, Structure, level_range, she_leveque};
    use crate::commands::cascade::Arguments;
    use crate::commands::cascade::tree::DrivenTree;
    use crate::frame::command_line::parse_line;

    /// Amplitudes that obey Kolmogorov's argument in each state have the exponents p/3.
    #[test]
    fn exponents_of_self_similar_amplitudes_are_a_third_of_the_order() {
        let arguments: Arguments = parse_line("--generations 8 --open 1").unwrap();
        let driven = DrivenTree::new(arguments.read().unwrap()).unwrap();
        let starts = (0..4).map(|start| {
            let sums = (0..8).map(|scale| {
                let mut sums = AmplitudeSums::default();
                for sample in 0..50 {
                    let flux = 0.1 + (f64::from(50 * start + sample) * 0.37).sin().powi(2);
                    let (mass, length) = (driven.subtrees[scale], driven.lengths[scale]);
                    let energy = 0.7 * mass.cbrt() * (flux * length).powf(2.0 / 3.0);
                    sums.samples += 1.0;
                    for (sum, order) in sums.sums.iter_mut().zip(ORDERS) {
                        *sum += energy.sqrt().powi(order);
                    }
                }
                sums
            });
            sums.collect()
        });
        let starts: Vec<Vec<AmplitudeSums>> = starts.collect();
        let starts: Vec<&[AmplitudeSums]> = starts.iter().map(Vec::as_slice).collect();
        let own = Structure::new(&driven, &starts, 1..7, &[0.2; 8]);
        for exponents in &own.exponents {
            let wanted = f64::from(exponents.order) / 3.0;
            assert!((exponents.exponent.value - wanted).abs() < 1e-12, "{own:?}");
            assert!((exponents.of_third.value - wanted).abs() < 1e-12, "{own:?}");
        }
        assert_eq!(own.exponents.len(), ORDERS.len());
        assert!(
            Structure::new(&driven, &starts, 1..3, &[0.2; 8])
                .exponents
                .is_empty()
        );
        assert!((she_leveque(3) - 1.0).abs() < 1e-15 && she_leveque(6) < 1.8);
    }

    #[test]
    fn the_level_range_is_the_longest() {
        let fluxes = [2.0, 1.0, 0.8, 0.79, 0.78, 0.7, 0.69];
        assert_eq!(level_range(&fluxes, 0.05), 2..5);
        assert_eq!(level_range(&[2.0, 1.0, f64::NAN, 0.99, 0.98], 0.05), 3..5);
        assert!(level_range(&[1.0], 0.05).is_empty());
    }
}
