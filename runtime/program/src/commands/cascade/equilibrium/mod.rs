//! Thermal equilibrium of a tree, the reference for "equipartition": how a given energy is
//! distributed over the scales without drive and friction. It is computed by three methods.
//!
//! - *Langevin*: between intervals of free motion the momenta are partly redrawn at random, which is
//!   friction −γ M ω with the noise that belongs to it at the temperature kT.
//! - *By the formula*: at the configurations that this motion visits, ½ kT tr K_s M⁻¹ and the
//!   potential energy (T. Konishi and T. Yanagita, arXiv:0811.4637 and 2111.11677).
//! - *At the same energy*: free motion only, from states of that energy.

mod chains;

use branched_pendulum::Positions;
use branched_pendulum::analysis::statistics::Estimate;

use super::arguments::Arguments;
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::Job;
use chains::{Bath, Chain, Isolated, SAMPLES, SETTLING, Stretch};

/// Names of the three methods.
pub const EQUILIBRIUM_METHODS: [&str; 3] = ["Langevin", "by the formula", "at the same energy"];

/// Largest relative deviation of the energy; the distribution changes little over it.
const NEAREST: f64 = 0.2;

/// Energy of each scale in thermal equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// kT, J.
    pub temperature: f64,
    /// Total energy of all scales, in J.
    pub energy: f64,
    /// Energies of the scales (J) by each of the three methods ([`EQUILIBRIUM_METHODS`]).
    pub scales: [Vec<Estimate>; 3],
    /// Number of configurations that were left out because their potential energy alone exceeds the
    /// given energy.
    pub left_out: usize,
}

impl Equilibrium {
    /// Computes the thermal equilibrium of the tree at this energy (J), from as many starts and
    /// over the same time as the driven motion.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn at(
        arguments: &Arguments,
        driven: &DrivenTree,
        energy: f64,
        job: &Job,
    ) -> Result<Self, Failure> {
        let name = &driven.subject.name;
        let lacking = |why: &str| Failure::Lacking {
            what: format!("`{name}` {why}: leave `--equilibrium` out"),
        };
        if driven.subject.tree.stands() {
            return Err(lacking(
                "stands, and its energy has no least value to share from",
            ));
        }
        if energy.is_nan() || energy <= 0.0 {
            return Err(lacking("hangs still, and has no energy to share"));
        }
        let progress = job.progress(1);
        progress.begin("equilibrium");
        let own = Isolated {
            tree: driven
                .subject
                .tree
                .conservative()
                .map_err(|source| Failure::tree(name, source))?,
            arguments,
            scales: driven.generations(),
        };
        let (chains, temperature) = own.settled(energy)?;
        let found = Self::by_all_methods(&own, &chains, Bath::at(temperature), energy)?;
        let factor = found.temperature / temperature;
        if factor.is_nan() || (factor - 1.0).abs() > NEAREST {
            let moved = energy / factor;
            return Err(lacking(&format!(
                "did not reach the requested energy: it has {moved:.3e} J in equilibrium instead \
                 of {energy:.3e} J (use more `--starts` to come nearer)"
            )));
        }
        progress.advance(1.0);
        Ok(found)
    }

    /// Returns the largest difference between two methods, in error bars.
    pub fn discord(&self) -> f64 {
        discord(&self.scales)
    }

    /// Computes the energies of the scales by all three methods, scaled to the given total energy
    /// (J).
    fn by_all_methods(
        own: &Isolated<'_>,
        chains: &[Chain],
        bath: Bath,
        energy: f64,
    ) -> Result<Self, Failure> {
        let windows = own.arguments.windows();
        let counted = Stretch {
            bath: Some(bath),
            counts: true,
        };
        let thermal = own.move_all(chains, counted, windows)?;
        let samples = (windows * SAMPLES as usize) as f64;
        let langevin = means(&thermal, |chain| &chain.energies, samples);
        let found: f64 = langevin.iter().map(|scale| scale.value).sum();
        let formula = windows.div_ceil(own.stretches_between_formulas()) as f64;
        let formula = means(&thermal, |chain| &chain.formula, formula);
        let free = Stretch {
            bath: None,
            counts: false,
        };
        let isolated = own.of_energy(&thermal, found);
        let left_out = thermal.len() - isolated.len();
        let isolated = own.move_all(&isolated, free, SETTLING)?;
        let counted = Stretch {
            counts: true,
            ..free
        };
        let isolated = own.move_all(&isolated, counted, windows)?;
        let isolated = means(&isolated, |chain| &chain.energies, samples);
        let factor = energy / found;
        let ways = [langevin, formula, isolated].map(|scales| {
            let scales = scales.into_iter();
            let taken = scales.map(|scale| Estimate {
                value: factor * scale.value,
                error: factor * scale.error,
            });
            taken.collect()
        });
        Ok(Self {
            temperature: factor * bath.temperature,
            energy,
            scales: ways,
            left_out,
        })
    }
}

/// Returns the largest difference between two methods, in error bars.
fn discord(ways: &[Vec<Estimate>; 3]) -> f64 {
    let [first, second, third] = ways;
    let pairs = [(first, second), (first, third), (second, third)];
    if pairs.iter().any(|(one, other)| one.len() != other.len()) {
        return f64::INFINITY;
    }
    let apart = pairs.into_iter().flat_map(|(one, other)| {
        let scales = one.iter().zip(other);
        scales.map(|(a, b)| (a.value - b.value).abs() / a.error.hypot(b.error))
    });
    // What is not a number agrees with nothing.
    apart.fold(0.0, |most, own| match own.is_nan() {
        true => f64::INFINITY,
        false => most.max(own),
    })
}

/// Returns the mean energies of all scales, with error bars from the spread of the motions.
fn means(chains: &[Chain], sums: impl Fn(&Chain) -> &[f64], samples: f64) -> Vec<Estimate> {
    let scales = chains.first().map_or(0, |chain| sums(chain).len());
    let mean = |scale: usize| {
        let own = chains.iter().filter_map(|chain| sums(chain).get(scale));
        let own: Vec<f64> = own.map(|sum| sum / samples).collect();
        Estimate::of_independent(&own)
    };
    (0..scales).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::chains::{Bath, Isolated};
    use super::{Equilibrium, Estimate};
    use crate::commands::cascade::Arguments;
    use crate::frame::command_line::parse_line;

    fn equilibrium(noise: f64) -> Equilibrium {
        let line = "--generations 3 --starts 16 --duration 30 --threads 2";
        let arguments: Arguments = parse_line(line).unwrap();
        let own = Isolated {
            tree: arguments.read().unwrap().tree.conservative().unwrap(),
            arguments: &arguments,
            scales: 3,
        };
        let (chains, temperature) = own.settled(0.3).unwrap();
        let bath = Bath {
            noise,
            ..Bath::at(temperature)
        };
        Equilibrium::by_all_methods(&own, &chains, bath, 0.3).unwrap()
    }

    #[test]
    fn three_ways_to_equilibrium_agree() {
        let own = equilibrium(1.0);
        assert!(own.discord() < 4.0, "{own:?}");
        let [langevin, ..] = &own.scales;
        assert!(
            langevin
                .iter()
                .all(|scale| scale.error < 0.06 * scale.value)
        );
        let sum: f64 = langevin.iter().map(|scale| scale.value).sum();
        assert!((sum - 0.3).abs() < 1e-12);
        let mut unknown = own.clone();
        unknown.scales[2].clear();
        assert_eq!(unknown.discord(), f64::INFINITY);
        unknown.scales[2] = vec![
            Estimate {
                value: 0.1,
                error: f64::NAN
            };
            3
        ];
        assert_eq!(unknown.discord(), f64::INFINITY);
    }

    #[test]
    fn noise_that_does_not_belong_to_the_friction_is_noticed() {
        let own = equilibrium(1.3);
        assert!(own.discord() > 6.0, "{}", own.discord());
    }
}
