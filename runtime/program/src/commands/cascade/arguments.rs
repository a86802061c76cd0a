//! The command line.

use std::path::PathBuf;

use branched_pendulum::prelude::State;
use clap::Parser;

use super::tree;
use crate::Failure;
use crate::frame::command_line::number;
use crate::frame::sweep::Shard;
use crate::frame::{Charts, Sharding};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// A motor turns the root of a tree, friction brakes its links. Does the energy go down
/// the generations, and what is there of it at each scale?
///
/// Many independent starts are followed at once, until the tree forgets where it
/// began; all averages have error bars. A run that is interrupted goes on from its
/// checkpoint when the same command is given again.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum cascade", version, verbatim_doc_comment)]
#[command(mut_arg("tree", |tree| tree.default_value("cascade")))]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    /// generations of a tree by rule in place of `--tree`, 2 to 16: rods with the parameters
    /// mass_ratio, length_ratio, friction (of the youngest pivots) and friction_ratio (of a
    /// generation over the one above; from 1e6 on nothing but the youngest brakes)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=16), verbatim_doc_comment)]
    generations: Option<u32>,
    /// rods that hang from each one of a tree by rule, 2 to 5
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(2..=5))]
    branching: Option<u32>,
    #[command(flatten)]
    release: ReleaseArguments,
    /// amplitude of the torque on the root, N m from 0 to 100, 0.2 unless it is given; a tree
    /// with a drive of its own has no other
    #[arg(long, value_name = "NM", value_parser = number(0.0..=1e2, "N m"), verbatim_doc_comment)]
    torque: Option<f64>,
    /// frequency of the torque, Hz from 0.01 to 100
    #[arg(long, value_name = "HZ", default_value = "0.6", value_parser = number(0.01..=1e2, "Hz"))]
    pub frequency: f64,
    /// half the width of a flat spectrum about the frequency, Hz from 0 to 100, in which
    /// 16 lines of random frequency and phase have the power of the torque; 0: one line
    #[arg(long, value_name = "HZ", default_value = "0", value_parser = number(0.0..=1e2, "Hz"), verbatim_doc_comment)]
    pub bandwidth: f64,
    /// independent starts, 4 to 100000
    #[arg(long, value_name = "N", default_value = "32", value_parser = clap::value_parser!(u32).range(4..=100_000))]
    pub starts: u32,
    /// time that each start is followed, s from 1 to 1e6
    #[arg(long, value_name = "S", default_value = "400", value_parser = number(1.0..=1e6, "s"))]
    pub duration: f64,
    /// how far each angle lies from that of `--start`, at random on both sides, degrees from 0
    /// to 170
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = number(0.0..=170.0, "degrees"), verbatim_doc_comment)]
    pub spread: f64,
    /// samples of the budgets in a period of the torque, 4 to 1000
    #[arg(long, value_name = "N", default_value = "128", value_parser = clap::value_parser!(u32).range(4..=1000))]
    pub samples: u32,
    /// steps of the integrator in a period of the torque, a multiple of the samples, 16 to
    /// 100000
    #[arg(long, value_name = "N", default_value = "512", value_parser = clap::value_parser!(u32).range(16..=100_000), verbatim_doc_comment)]
    pub steps: u32,
    /// seed of the starts and of a random torque
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
    /// threads, 0 for as many as the machine offers
    #[arg(long, value_name = "N", default_value = "0")]
    pub threads: usize,
    /// seconds between two checkpoints, 0 to 1e6
    #[arg(long, value_name = "S", default_value = "5", value_parser = number(0.0..=1e6, "s"))]
    pub checkpoint: f64,
    /// besides, the energies that the scales have in thermal equilibrium at the same energy of
    /// all, from as many starts over the same time, in three ways
    #[arg(long, verbatim_doc_comment)]
    pub equilibrium: bool,
    /// in place of all this, the onset in the tree released almost in phase, sector by sector,
    /// for so many s from 0.1 to 1000
    #[arg(long, value_name = "S", value_parser = number(0.1..=1e3, "s"), conflicts_with_all = ["shard", "merge", "equilibrium"], verbatim_doc_comment)]
    pub onset: Option<f64>,
    /// in place of all this, the spectra of finished runs beside each other, from their folders
    #[arg(long, value_name = "FOLDER[,..]", value_delimiter = ',', conflicts_with_all = [
        "tree", "set", "parameters", "generations", "branching", "start", "rates", "torque", "frequency",
        "bandwidth", "starts", "duration", "spread", "samples", "steps", "seed", "threads", "checkpoint",
        "onset", "equilibrium", "shard", "merge",
    ])]
    pub compare: Vec<PathBuf>,
    /// Which part of the starts.
    #[command(flatten)]
    pub sharding: Sharding,
}

impl Arguments {
    /// Returns the state about which starts lie.
    ///
    /// # Errors
    /// As [`ReleaseArguments::state`].
    pub fn start(&self, subject: &Subject) -> Result<State<f64>, Failure> {
        self.release.state(subject)
    }

    fn is_by_rule(&self) -> bool {
        self.generations.is_some() || self.branching.is_some()
    }

    /// Reads the tree that is driven.
    ///
    /// # Errors
    /// As [`TreeArguments::read`].
    pub fn read(&self) -> Result<Subject, Failure> {
        let subject = match self.is_by_rule() {
            true => {
                let (generations, branching) = (self.generations, self.branching);
                let text = tree::by_rule(generations.unwrap_or(5), branching.unwrap_or(2));
                self.tree.described_as(text)?.read()?
            }
            false => self.tree.read()?,
        };
        let asks = self.torque.is_some() || self.bandwidth > 0.0;
        if asks && subject.tree.drive(0.0).is_some() {
            return Err(Failure::Lacking {
                what: format!(
                    "`{}` has a drive of its own: leave `--torque` and `--bandwidth` out",
                    subject.name
                ),
            });
        }
        Ok(subject)
    }

    /// Amplitude of the torque on the root of a tree, N m.
    pub fn torque(&self, subject: &Subject) -> f64 {
        match subject.tree.drive(0.0) {
            Some(_) => 0.0,
            None => self.torque.unwrap_or(0.2),
        }
    }

    /// Length of a step, s.
    pub fn step(&self) -> f64 {
        1.0 / (self.frequency * f64::from(self.steps))
    }

    /// Time at a step's start, s.
    pub fn time(&self, step: u64) -> f64 {
        step as f64 * self.step()
    }

    /// So many times behind the start of the step `first`, `stride` steps apart: the ends of
    /// steps of a grid from there on, to the last bit.
    pub fn times(&self, first: u64, stride: u32, count: u32) -> Vec<f64> {
        let (start, step) = (self.time(first), self.step());
        let places = (1..=count).map(|number| f64::from(number) * f64::from(stride));
        places.map(|place| start + place * step).collect()
    }

    /// Periods of the torque that are followed.
    pub fn windows(&self) -> usize {
        ((self.duration * self.frequency).ceil() as usize).max(1)
    }
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("cascade-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        Some(self.onset.unwrap_or(self.duration))
    }

    fn shard(&self) -> Option<Shard> {
        self.sharding.shard
    }

    fn check(&self) -> Result<(), String> {
        if self.is_by_rule() && self.tree.tree != "cascade" {
            return Err(
                "`--generations` and `--branching` make a tree by rule: leave them or `--tree` out"
                    .to_owned(),
            );
        }
        if !self.steps.is_multiple_of(self.samples) {
            return Err("`--steps` must be a multiple of `--samples`".to_owned());
        }
        if self.bandwidth > 0.9 * self.frequency {
            return Err("`--bandwidth` must be at most 0.9 of the frequency".to_owned());
        }
        Ok(())
    }
}
