//! The thermal equilibrium of a tree, without which "equipartition" has no measure: how a given
//! energy is shared by the scales where nothing drives and nothing brakes. In three ways.
//!
//! - *Langevin*: between stretches of free motion the momenta are partly drawn anew, which is
//!   friction −γ M ω with the noise that belongs to it at the temperature kT.
//! - *By the formula*: at the configurations that this motion visits, ½ kT tr K_s M⁻¹ and the
//!   potential energy (T. Konishi and T. Yanagita, arXiv:0811.4637 and 2111.11677).
//! - *At the same energy*: the free motion alone, from states of that energy.

mod chains;

use branched_pendulum::Positions;
use branched_pendulum::analysis::statistics::Estimate;

use super::arguments::Arguments;
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::Job;
use chains::{Bath, Chain, Isolated, SAMPLES, SETTLING, Stretch};

/// Ways to the shares, in words.
pub const WAYS: [&str; 3] = ["Langevin", "by the formula", "at the same energy"];

/// Largest part by which the energy may be missed; shares change little over it.
const NEAREST: f64 = 0.2;

/// The energy of each scale in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// kT, J.
    pub temperature: f64,
    /// Energy of all scales together, J.
    pub energy: f64,
    /// Energies of the scales (J) by each of the [`WAYS`].
    pub scales: [Vec<Estimate>; 3],
    /// Configurations whose potential energy alone is more than this energy, which the free motion
    /// at that energy has to do without.
    pub left_out: usize,
}

impl Equilibrium {
    /// Returns the equilibrium of the tree at this energy (J), from as many starts and over the
    /// same time as the driven motion.
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
        let found = Self::by_all_ways(&own, &chains, Bath::at(temperature), energy)?;
        let factor = found.temperature / temperature;
        if factor.is_nan() || (factor - 1.0).abs() > NEAREST {
            let moved = energy / factor;
            return Err(lacking(&format!(
                "missed its temperature: it has {moved:.3e} J in equilibrium where {energy:.3e} J were \
                 asked for (more `--starts` come nearer)"
            )));
        }
        progress.advance(1.0);
        Ok(found)
    }

    /// The largest difference between two ways, in error bars.
    pub fn discord(&self) -> f64 {
        discord(&self.scales)
    }

    /// The energies of the scales by all ways, taken to this energy (J) of all.
    fn by_all_ways(
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

/// The largest difference between two ways, in error bars.
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
    // What is no number agrees with nothing.
    apart.fold(0.0, |most, own| match own.is_nan() {
        true => f64::INFINITY,
        false => most.max(own),
    })
}

/// Mean energies of all scales, with error bars from chain to chain.
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
        Equilibrium::by_all_ways(&own, &chains, bath, 0.3).unwrap()
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
