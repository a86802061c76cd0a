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

/// A motor drives the root of a tree, friction brakes its links. Does energy flow down the
/// generations, and how much energy does each scale have?
///
/// Many independent starts are integrated at once, until the tree forgets its initial state; all
/// averages have error bars. An interrupted run continues from its checkpoint when the same command
/// is given again.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum cascade", version, verbatim_doc_comment)]
#[command(mut_arg("tree", |tree| tree.default_value("cascade")))]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    /// generations of a rule-based tree that is used instead of `--tree`, 2 to 16, or to 32 with `--open`: rods with the
    /// parameters mass_ratio, length_ratio, friction (of the youngest pivots) and friction_ratio
    /// (ratio of successive generations; from 1e6 on, only the youngest generation has friction)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=32), verbatim_doc_comment)]
    generations: Option<u32>,
    /// rods that hang from each rod of a rule-based tree, 2 to 5
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(2..=5))]
    branching: Option<u32>,
    /// branchings of each generation of a binary tree by rule that are open, 1: all other copies move
    /// in phase, and N generations have N (N + 1)/2 links
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1), verbatim_doc_comment)]
    open: Option<u32>,
    #[command(flatten)]
    release: ReleaseArguments,
    /// amplitude of the torque on the root, N m from 0 to 100, by default 0.2; a tree that has a
    /// drive has no other torque
    #[arg(long, value_name = "NM", value_parser = number(0.0..=1e2, "N m"), verbatim_doc_comment)]
    torque: Option<f64>,
    /// frequency of the torque on the root, Hz from 0.01 to 100
    #[arg(long, value_name = "HZ", default_value = "0.6", value_parser = number(0.01..=1e2, "Hz"))]
    pub frequency: f64,
    /// half width of a flat spectrum about the frequency, Hz from 0 to 100: the torque is a sum of
    /// 16 cosines with random frequencies in it and random phases, with the same power; 0 for a
    /// single cosine
    #[arg(long, value_name = "HZ", default_value = "0", value_parser = number(0.0..=1e2, "Hz"), verbatim_doc_comment)]
    pub bandwidth: f64,
    /// white-noise torque on the root in place of the motor, N² m² s from 0 to 1e6: at each sample the
    /// momentum of the root gets a normal random kick, whose square has the mean of this value times
    /// the interval between samples
    #[arg(long, value_name = "D", value_parser = number(0.0..=1e6, "N² m² s"), conflicts_with_all = ["torque", "bandwidth"], verbatim_doc_comment)]
    pub noise: Option<f64>,
    /// independent starts, 4 to 100000
    #[arg(long, value_name = "N", default_value = "32", value_parser = clap::value_parser!(u32).range(4..=100_000))]
    pub starts: u32,
    /// duration of the motion from each start, s from 1 to 1e6
    #[arg(long, value_name = "S", default_value = "400", value_parser = number(1.0..=1e6, "s"))]
    pub duration: f64,
    /// largest random deviation of each initial angle from that of `--start`, degrees from 0 to 170
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = number(0.0..=170.0, "degrees"), verbatim_doc_comment)]
    pub spread: f64,
    /// samples of the energy budgets per period of the torque, 4 to 1000
    #[arg(long, value_name = "N", default_value = "128", value_parser = clap::value_parser!(u32).range(4..=1000))]
    pub samples: u32,
    /// integration steps per period of the torque, a multiple of the samples, 16 to 100000
    #[arg(long, value_name = "N", default_value = "512", value_parser = clap::value_parser!(u32).range(16..=100_000), verbatim_doc_comment)]
    pub steps: u32,
    /// seed of the random starts and of a random torque
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
    /// number of threads, 0 for as many as the machine offers
    #[arg(long, value_name = "N", default_value = "0")]
    pub threads: usize,
    /// seconds between two checkpoints, 0 to 1e6
    #[arg(long, value_name = "S", default_value = "5", value_parser = number(0.0..=1e6, "s"))]
    pub checkpoint: f64,
    /// also computes the energies that the scales have in thermal equilibrium at the same total
    /// energy, from as many starts over the same time, by three methods
    #[arg(long, verbatim_doc_comment)]
    pub equilibrium: bool,
    /// instead of all this, computes the onset of differences in the tree, sector by sector, after
    /// a release almost in phase, for this many s from 0.1 to 1000
    #[arg(long, value_name = "S", value_parser = number(0.1..=1e3, "s"), conflicts_with_all = ["shard", "merge", "equilibrium"], verbatim_doc_comment)]
    pub onset: Option<f64>,
    /// in place of all this, the spectra of finished runs in one chart, from their folders
    #[arg(long, value_name = "FOLDER[,..]", value_delimiter = ',', conflicts_with_all = [
        "tree", "set", "parameters", "generations", "branching", "open", "start", "rates", "torque", "frequency",
        "bandwidth", "noise", "starts", "duration", "spread", "samples", "steps", "seed", "threads", "checkpoint",
        "onset", "equilibrium", "shard", "merge",
    ])]
    pub compare: Vec<PathBuf>,
    /// Which part of the starts.
    #[command(flatten)]
    pub sharding: Sharding,
}

impl Arguments {
    /// Returns the state about which random starts are distributed.
    ///
    /// # Errors
    /// As [`ReleaseArguments::state`].
    pub fn start(&self, subject: &Subject) -> Result<State<f64>, Failure> {
        self.release.state(subject)
    }

    /// Returns the name of the energy's source.
    pub fn source(&self) -> &'static str {
        match self.noise {
            Some(_) => "white noise",
            None => "motor",
        }
    }

    fn is_by_rule(&self) -> bool {
        self.generations.is_some() || self.branching.is_some() || self.open.is_some()
    }

    /// Reads the driven tree.
    ///
    /// # Errors
    /// As [`TreeArguments::read`].
    pub fn read(&self) -> Result<Subject, Failure> {
        let subject = match self.is_by_rule() {
            true => {
                let (generations, branching) = (self.generations, self.branching);
                let (generations, branching) = (generations.unwrap_or(5), branching.unwrap_or(2));
                let text = tree::by_rule(generations, branching, self.open.is_some());
                self.tree.described_as(text)?.read()?
            }
            false => self.tree.read()?,
        };
        let asks = self.torque.is_some() || self.bandwidth > 0.0 || self.noise.is_some();
        if asks && subject.tree.drive(0.0).is_some() {
            return Err(Failure::Lacking {
                what: format!(
                    "`{}` already has a drive: leave out `--torque`, `--bandwidth` and `--noise`",
                    subject.name
                ),
            });
        }
        Ok(subject)
    }

    /// Returns the amplitude of the torque on the root of a tree, in N m.
    pub fn torque(&self, subject: &Subject) -> f64 {
        match subject.tree.drive(0.0) {
            Some(_) => 0.0,
            None if self.noise.is_some() => 0.0,
            None => self.torque.unwrap_or(0.2),
        }
    }

    /// Length of a step, s.
    pub fn step(&self) -> f64 {
        1.0 / (self.frequency * f64::from(self.steps))
    }

    /// Returns the time at the start of a step, in s.
    pub fn time(&self, step: u64) -> f64 {
        step as f64 * self.step()
    }

    /// Returns `count` times, `stride` steps apart, after the start of step `first`. They are
    /// exactly the ends of steps on a grid that starts there.
    pub fn times(&self, first: u64, stride: u32, count: u32) -> Vec<f64> {
        let (start, step) = (self.time(first), self.step());
        let places = (1..=count).map(|number| f64::from(number) * f64::from(stride));
        places.map(|place| start + place * step).collect()
    }

    /// Returns the duration of the motion, in periods of the torque.
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
                "`--generations`, `--branching` and `--open` describe a rule-based tree: leave out \
                 either them or `--tree`"
                    .to_owned(),
            );
        }
        if self.open.is_none() && self.generations.is_some_and(|count| count > 16) {
            return Err("`--generations` must be at most 16 without `--open`".to_owned());
        }
        if self.onset.is_some() && (self.open.is_some() || self.noise.is_some()) {
            return Err("`--onset` cannot be combined with `--open` and `--noise`".to_owned());
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
