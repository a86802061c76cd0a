//! Motions of a tree without motor and friction, whose momenta are randomly redrawn or not.

use std::num::NonZeroUsize;

use branched_pendulum::ScaleBudget;
use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum_trees::PendulumTree;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::Failure;
use crate::commands::cascade::arguments::Arguments;
use crate::commands::cascade::motion::{TOGETHER, diverged};

/// Fraction of the momenta that is kept after an interval of free motion.
const KEPT: f64 = 0.5;

/// Strength of the noise that balances friction −γ M ω over an interval, in units of √kT: √(1 −
/// kept²).
const NOISE: f64 = 0.866_025_403_784_438_6;

/// Samples in a stretch.
pub(super) const SAMPLES: u32 = 8;

/// Number of intervals in which the temperature is adjusted, and number of those after which the
/// start is forgotten.
pub(super) const SETTLING: usize = 30;

/// Tolerance of the free motion.
const TOLERANCE: f64 = 1e-9;

/// A motion with its random number generator, and sums over it of the energies of the scales:
/// actual energies, and energies by the formula.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    state: Vec<f64>,
    random: Xoshiro256PlusPlus,
    pub(super) energies: Vec<f64>,
    pub(super) formula: Vec<f64>,
}

/// Heat bath by which momenta are redrawn: the temperature kT (J), and the strength of the noise
/// relative to that which balances the friction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bath {
    pub(super) temperature: f64,
    pub(super) noise: f64,
}

/// Moves of a stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) bath: Option<Bath>,
    pub(super) counts: bool,
}

/// A tree without motor and friction, which conserves its energy.
pub(super) struct Isolated<'a> {
    pub(super) tree: PendulumTree,
    pub(super) arguments: &'a Arguments,
    pub(super) scales: usize,
}

impl Bath {
    pub(super) fn at(temperature: f64) -> Self {
        let noise = 1.0;
        Self { temperature, noise }
    }
}

impl Isolated<'_> {
    /// Returns motions that have forgotten their starts, and the temperature kT (J) at which they
    /// have approximately the given energy (J).
    pub(super) fn settled(&self, energy: f64) -> Result<(Vec<Chain>, f64), Failure> {
        let mut chains = self.chains();
        let mut temperature = energy / self.tree.links() as f64;
        for number in 0..SETTLING {
            let settling = Stretch {
                bath: Some(Bath::at(temperature)),
                counts: false,
            };
            chains = self.move_all(&chains, settling, 1)?;
            let mean = self.energy(&chains);
            // Steps become shorter, so that the noise of single energies averages out (H. Robbins
            // and S. Monro, Ann. Math. Stat. 22, 400, 1951).
            let step = 1.0 / (2.0 + number as f64 / 4.0);
            temperature *= (energy / mean).clamp(0.5, 2.0).powf(step);
        }
        Ok((chains, temperature))
    }

    /// Returns the number of intervals between two evaluations of the formula, whose cost grows
    /// with the square of the number of links.
    pub(super) fn stretches_between_formulas(&self) -> usize {
        self.tree.links().div_ceil(31)
    }

    /// Creates motions at rest with normally distributed random angles.
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

    /// Advances all motions through this many intervals, in lanes and on all threads.
    pub(super) fn move_all(
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
                self.move_on((group * TOGETHER, &mut chains), stretch, number)?;
            }
            Ok::<_, Failure>(chains)
        });
        let groups: Result<Vec<Vec<Chain>>, Failure> = moved.into_iter().collect();
        Ok(groups?.concat())
    }

    /// Advances some motions through one interval; `first` is the index of the first motion,
    /// `number` that of the interval.
    fn move_on(
        &self,
        (first, chains): (usize, &mut [Chain]),
        stretch: Stretch,
        number: usize,
    ) -> Result<(), Failure> {
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
        let is_time = number.is_multiple_of(self.stretches_between_formulas());
        for (index, (chain, samples)) in chains.iter_mut().zip(moved).enumerate() {
            let states = samples.states().filter(|_| stretch.counts);
            for state in states {
                self.add_energies(&mut workspace, state, &mut budget, &mut chain.energies);
            }
            let end = samples
                .end
                .map_err(|error| diverged(first + index, &error))?;
            chain.state = end.state.values;
            if let (true, true, Some(bath)) = (stretch.counts, is_time, stretch.bath) {
                self.add_formula(&mut workspace, bath.temperature, chain);
            }
        }
        Ok(())
    }

    /// Replaces a part of the momenta of a motion by random ones, as a heat bath does.
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

    /// Returns the configurations with the kinetic energy that gives them this total energy (J),
    /// without those whose potential energy alone exceeds it.
    pub(super) fn of_energy(&self, chains: &[Chain], energy: f64) -> Vec<Chain> {
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
