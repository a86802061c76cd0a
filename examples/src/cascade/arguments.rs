//! The command line.

use clap::Parser;

use super::scene::{Shape, TREES};
use branched_pendulum_program::frame::Sharding;
use branched_pendulum_program::frame::command_line::number;
use branched_pendulum_program::frame::sweep::Shard;

/// A motor turns the root of a tree of rods, friction brakes the youngest. Does the
/// energy go down the generations, and what is there of it at each scale?
///
/// Many independent starts are followed at once, until the tree forgets where it
/// began; all averages have error bars. A run that is interrupted goes on from its
/// checkpoint when the same command is given again.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "cascade", version, verbatim_doc_comment)]
pub struct Arguments {
    /// generations of the tree, 3 to 8; of a ternary tree 3 to 5
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(3..=8))]
    pub generations: u32,
    /// rods that hang from each one, 2 or 3
    #[arg(long, value_name = "K", default_value = "2", value_parser = clap::value_parser!(u32).range(2..=3))]
    pub branching: u32,
    /// mass of a rod over that of its parent, 0.05 to 1
    #[arg(long, value_name = "R", default_value = "0.5", value_parser = number(0.05..=1.0, ""))]
    pub mass_ratio: f64,
    /// length of a rod over that of its parent, 0.2 to 1
    #[arg(long, value_name = "R", default_value = "0.7", value_parser = number(0.2..=1.0, ""))]
    pub length_ratio: f64,
    /// amplitude of the torque on the root, N m from 0 to 100
    #[arg(long, value_name = "NM", default_value = "0.2", value_parser = number(0.0..=1e2, "N m"))]
    pub torque: f64,
    /// frequency of the torque, Hz from 0.01 to 100
    #[arg(long, value_name = "HZ", default_value = "0.6", value_parser = number(0.01..=1e2, "Hz"))]
    pub frequency: f64,
    /// half the width of a flat spectrum about the frequency, Hz from 0 to 100, in which
    /// 16 lines of random frequency and phase have the power of the torque; 0: one line
    #[arg(long, value_name = "HZ", default_value = "0", value_parser = number(0.0..=1e2, "Hz"), verbatim_doc_comment)]
    pub bandwidth: f64,
    /// friction in the pivots of the youngest rods, N m s from 0 to 1
    #[arg(long, value_name = "NMS", default_value = "1e-5", value_parser = number(0.0..=1.0, "N m s"))]
    pub friction: f64,
    /// friction of a generation over that of the one above, 0.01 to 1e9; from 1e6 on
    /// nothing but the youngest generation brakes
    #[arg(long, value_name = "R", default_value = "1e6", value_parser = number(1e-2..=1e9, ""), verbatim_doc_comment)]
    pub friction_ratio: f64,
    /// independent starts, 4 to 100000
    #[arg(long, value_name = "N", default_value = "32", value_parser = clap::value_parser!(u32).range(4..=100_000))]
    pub starts: u32,
    /// time that each start is followed, s from 1 to 1e6
    #[arg(long, value_name = "S", default_value = "400", value_parser = number(1.0..=1e6, "s"))]
    pub duration: f64,
    /// every angle of a start, at random on both sides of the vertical, rad from 0 to 3
    #[arg(long, value_name = "RAD", default_value = "0.5", value_parser = number(0.0..=3.0, "rad"))]
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
    /// in place of all this, the onset in fifteen rods released almost in phase, sector by
    /// sector, for so many s from 0.1 to 1000
    #[arg(long, value_name = "S", value_parser = number(0.1..=1e3, "s"), conflicts_with_all = ["shard", "merge"], verbatim_doc_comment)]
    pub onset: Option<f64>,
    /// Which part of the starts.
    #[command(flatten)]
    pub sharding: Sharding,
}

impl Arguments {
    /// The tree.
    pub fn shape(&self) -> Shape {
        Shape {
            generations: self.generations as usize,
            branching: self.branching as usize,
            mass_ratio: self.mass_ratio,
            length_ratio: self.length_ratio,
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

impl branched_pendulum_program::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("cascade-output");

    fn shard(&self) -> Option<Shard> {
        self.sharding.shard
    }

    fn check(&self) -> Result<(), String> {
        let (branching, generations) = (self.branching, self.generations);
        if !TREES.contains(&(self.branching as usize, self.generations as usize)) {
            return Err(format!(
                "there is no tree of {generations} generations by {branching}"
            ));
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
