//! The thermal equilibrium of a tree, without which "equipartition" has no measure: how a given
//! energy is shared by the scales where nothing drives and nothing brakes. In three ways.
//!
//! - *Langevin*: between stretches of free motion the momenta are partly drawn anew, which is
//!   friction −γ M ω with the noise that belongs to it at the temperature kT.
//! - *By the formula*: at the configurations that this motion visits, ½ kT tr K_s M⁻¹ and the
//!   potential energy (T. Konishi and T. Yanagita, arXiv:0811.4637 and 2111.11677).
//! - *At the same energy*: the free motion alone, from states of that energy.

use std::num::NonZeroUsize;

use branched_pendulum::ScaleBudget;
use branched_pendulum::analysis::statistics::{Estimate, jackknife};
use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum_trees::PendulumTree;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::arguments::Arguments;
use super::motion::{TOGETHER, diverged};
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::Job;

/// Part of the momenta that outlives a stretch of free motion.
const KEPT: f64 = 0.5;

/// Noise that belongs to friction −γ M ω over a stretch, in parts of √kT: √(1 − kept²).
const NOISE: f64 = 0.866_025_403_784_438_6;

/// Samples in a stretch.
const SAMPLES: u32 = 8;

/// Stretches in which the temperature is found, and those until nothing of the start is left.
const SETTLING: usize = 30;

/// Tolerance of the free motion.
const TOLERANCE: f64 = 1e-9;

/// Ways to the shares, in words.
pub const WAYS: [&str; 3] = ["Langevin", "by the formula", "at the same energy"];

/// The energy of each scale in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// kT, J.
    pub temperature: f64,
    /// Energy of all scales together, J.
    pub energy: f64,
    /// Energies of the scales (J) by each of the [`WAYS`].
    pub scales: [Vec<Estimate>; 3],
}

/// A motion with its random numbers, and sums over it: of the energies of the scales as they
/// are, and by the formula.
#[derive(Clone, Debug)]
struct Chain {
    state: Vec<f64>,
    random: Xoshiro256PlusPlus,
    energies: Vec<f64>,
    formula: Vec<f64>,
}

/// Momenta that are drawn anew: the temperature kT (J), and the noise in parts of what belongs
/// to the friction.
#[derive(Clone, Copy, Debug)]
struct Bath {
    temperature: f64,
    noise: f64,
}

/// What happens in a stretch.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    bath: Option<Bath>,
    counts: bool,
    by_formula: bool,
}

/// A tree that keeps its energy.
struct Isolated<'a> {
    tree: PendulumTree,
    arguments: &'a Arguments,
    scales: usize,
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
        let progress = job.progress(2);
        progress.begin("equilibrium");
        let own = Isolated {
            tree: driven
                .subject
                .tree
                .conservative()
                .map_err(|source| Failure::Tree {
                    name: driven.subject.name.clone(),
                    source,
                })?,
            arguments,
            scales: driven.generations(),
        };
        let mut chains = own.chains();
        let mut temperature = energy / driven.links() as f64;
        for _ in 0..SETTLING {
            let settling = Stretch {
                bath: Some(Bath::at(temperature)),
                counts: false,
                by_formula: false,
            };
            chains = own.move_all(&chains, settling, 1)?;
            let mean = own.energy(&chains);
            temperature *= (energy / mean).clamp(0.5, 2.0).sqrt();
        }
        let bath = Stretch {
            bath: Some(Bath::at(temperature)),
            counts: true,
            by_formula: true,
        };
        let thermal = own.move_all(&chains, bath, arguments.windows())?;
        progress.advance(1.0);
        let free = Stretch {
            bath: None,
            counts: false,
            by_formula: false,
        };
        let isolated = own.of_energy(&thermal, energy);
        let isolated = own.move_all(&isolated, free, SETTLING)?;
        let counted = Stretch {
            counts: true,
            ..free
        };
        let isolated = own.move_all(&isolated, counted, arguments.windows())?;
        progress.advance(1.0);
        Ok(Self {
            temperature,
            energy,
            scales: [
                shares(&thermal, |chain| &chain.energies, energy),
                shares(&thermal, |chain| &chain.formula, energy),
                shares(&isolated, |chain| &chain.energies, energy),
            ],
        })
    }

    /// The largest difference between two ways, in error bars.
    pub fn discord(&self) -> f64 {
        discord(&self.scales)
    }
}

/// The largest difference between two ways, in error bars.
fn discord(ways: &[Vec<Estimate>; 3]) -> f64 {
    let [first, second, third] = ways;
    let pairs = [(first, second), (first, third), (second, third)];
    let apart = pairs.into_iter().flat_map(|(one, other)| {
        let scales = one.iter().zip(other);
        scales.map(|(a, b)| (a.value - b.value).abs() / a.error.hypot(b.error))
    });
    apart.fold(0.0, f64::max)
}

impl Bath {
    fn at(temperature: f64) -> Self {
        let noise = 1.0;
        Self { temperature, noise }
    }
}

impl Isolated<'_> {
    /// Chains at rest, whose angles are normal numbers.
    fn chains(&self) -> Vec<Chain> {
        let chain = |index: usize| {
            let own = self.arguments.seed.wrapping_add(0x5eed) ^ ((index as u64) << 20);
            let mut random = Xoshiro256PlusPlus::seed_from_u64(own);
            let mut state: Vec<f64> = vec![0.0; 2 * self.tree.links()];
            for angle in state.iter_mut().take(self.tree.links()) {
                *angle = StandardNormal.sample(&mut random);
            }
            Chain {
                state,
                random,
                energies: vec![0.0; self.scales],
                formula: vec![0.0; self.scales],
            }
        };
        (0..self.arguments.starts as usize).map(chain).collect()
    }

    /// Moves all chains through so many stretches, in lanes and on all threads.
    fn move_all(
        &self,
        chains: &[Chain],
        stretch: Stretch,
        count: usize,
    ) -> Result<Vec<Chain>, Failure> {
        let threads = NonZeroUsize::new(self.arguments.threads);
        let ensemble =
            threads.map_or_else(Ensemble::new, |threads| Ensemble::new().threads(threads));
        let groups: Vec<&[Chain]> = chains.chunks(TOGETHER).collect();
        let moved = ensemble.map(&groups, |group, chains| {
            let mut chains = chains.to_vec();
            for number in 0..count {
                self.move_on(&mut chains, stretch, number)
                    .map_err(|(chain, error)| diverged(group * TOGETHER + chain, &error))?;
            }
            Ok::<_, Failure>(chains)
        });
        let groups: Result<Vec<Vec<Chain>>, Failure> = moved.into_iter().collect();
        Ok(groups?.concat())
    }

    /// Moves some chains through the stretch of that number.
    fn move_on(
        &self,
        chains: &mut [Chain],
        stretch: Stretch,
        number: usize,
    ) -> Result<(), (usize, IntegrationError<f64>)> {
        if let Some(bath) = stretch.bath {
            for chain in &mut *chains {
                self.draw(chain, bath);
            }
        }
        let interval = 1.0 / self.arguments.frequency;
        let times = (1..=SAMPLES).map(|sample| interval * f64::from(sample) / f64::from(SAMPLES));
        let times: Vec<f64> = times.collect();
        let releases: Vec<_> = chains
            .iter()
            .map(|chain| {
                (
                    AbsoluteAngles(&self.tree),
                    State::new(0.0, chain.state.clone()),
                )
            })
            .collect();
        let method = Dop853::new(Options::with_tolerance(TOLERANCE));
        let alone = Ensemble::new().threads(NonZeroUsize::MIN);
        let moved = alone.sample_models_in_lanes(&method, &releases, &times);
        let (mut workspace, mut budget) = (Workspace::new(), ScaleBudget::new());
        // The formula takes the square of the number of links.
        let is_time = number.is_multiple_of(self.tree.links().div_ceil(31));
        for (index, (chain, samples)) in chains.iter_mut().zip(moved).enumerate() {
            let states = samples.states().filter(|_| stretch.counts);
            for state in states {
                self.add_energies(&mut workspace, state, &mut budget, &mut chain.energies);
            }
            let end = samples.end.map_err(|error| (index, error))?;
            chain.state = end.state.values;
            if let (true, true, Some(bath)) = (stretch.by_formula, is_time, stretch.bath) {
                self.add_formula(&mut workspace, bath.temperature, chain);
            }
        }
        Ok(())
    }

    /// Draws a part of the momenta anew.
    fn draw(&self, chain: &mut Chain, bath: Bath) {
        let links = self.tree.links();
        let normal = (0..3 * links).map(|_| StandardNormal.sample(&mut chain.random));
        let normal: Vec<f64> = normal.collect();
        let (theta, omega) = chain.state.split_at_mut(links);
        let mut drawn = vec![0.0; links];
        self.tree.thermal_velocities(theta, &normal, &mut drawn);
        let size = bath.noise * NOISE * bath.temperature.sqrt();
        for (omega, drawn) in omega.iter_mut().zip(drawn) {
            *omega = KEPT * *omega + size * drawn;
        }
    }

    fn add_energies(
        &self,
        workspace: &mut Workspace<f64>,
        state: &[f64],
        budget: &mut ScaleBudget<f64>,
        sums: &mut [f64],
    ) {
        let (theta, omega) = state.split_at(self.tree.links());
        self.tree
            .energies_by_scale_into(workspace, theta, omega, budget);
        for (scale, sum) in sums.iter_mut().enumerate() {
            *sum += budget.energy(scale);
        }
    }

    fn add_formula(&self, workspace: &mut Workspace<f64>, temperature: f64, chain: &mut Chain) {
        let links = self.tree.links();
        let (theta, _) = chain.state.split_at(links);
        let shares = self.tree.kinetic_shares(theta).unwrap_or_default();
        for (sum, share) in chain.formula.iter_mut().zip(shares) {
            *sum += 0.5 * temperature * share;
        }
        let still = [theta, &vec![0.0; links]].concat();
        let mut budget = ScaleBudget::new();
        self.add_energies(workspace, &still, &mut budget, &mut chain.formula);
    }

    /// Mean energy of chains, J.
    fn energy(&self, chains: &[Chain]) -> f64 {
        let energies = chains.iter().map(|chain| {
            let (theta, omega) = chain.state.split_at(self.tree.links());
            self.tree.energy_of(theta, omega)
        });
        energies.sum::<f64>() / chains.len().max(1) as f64
    }

    /// The same configurations, with as much kinetic energy as this energy leaves; without those
    /// that have more potential energy.
    fn of_energy(&self, chains: &[Chain], energy: f64) -> Vec<Chain> {
        let own = chains.iter().filter_map(|chain| {
            let mut own = chain.clone();
            own.energies.fill(0.0);
            let (theta, omega) = own.state.split_at_mut(self.tree.links());
            let left = energy - self.tree.potential_energy_of(theta);
            let factor = left / self.tree.kinetic_energy_of(theta, omega);
            if !(factor > 0.0 && factor.is_finite()) {
                return None;
            }
            for omega in omega {
                *omega *= factor.sqrt();
            }
            Some(own)
        });
        own.collect()
    }
}

/// Energies of all scales as parts of one, with error bars by leaving out chains.
fn shares(chains: &[Chain], sums: impl Fn(&Chain) -> &[f64], energy: f64) -> Vec<Estimate> {
    let scales = chains.first().map_or(0, |chain| sums(chain).len());
    let share = |scale: usize| {
        let estimate = jackknife(chains.len(), |left_out| {
            let kept = chains.iter().enumerate();
            let kept = kept.filter(|(index, _)| Some(*index) != left_out);
            let (mut own, mut all) = (0.0, 0.0);
            for (_, chain) in kept {
                own += sums(chain)[scale];
                all += sums(chain).iter().sum::<f64>();
            }
            energy * own / all
        });
        estimate.unwrap_or(Estimate {
            value: f64::NAN,
            error: f64::NAN,
        })
    };
    (0..scales).map(share).collect()
}
