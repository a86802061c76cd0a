//! The command line.

use clap::Parser;

use crate::program::Results;
use crate::program::command_line::number;

/// A motor turns the root of a binary tree of fifteen rods. Only motions in phase
/// take energy from it: which of the differences between branches does it reach,
/// and by which way?
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "energy-cascade", version, verbatim_doc_comment)]
pub struct Arguments {
    /// time followed, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "20", value_parser = number(0.1..=1e3, "s"))]
    pub duration: f64,
    /// amplitude of the torque on the root, N m from 0 to 100
    #[arg(long, value_name = "NM", default_value = "0.2", value_parser = number(0.0..=1e2, "N m"))]
    pub torque: f64,
    /// frequency of the torque, Hz from 0 to 100
    #[arg(long, value_name = "HZ", default_value = "0.6", value_parser = number(0.0..=1e2, "Hz"))]
    pub frequency: f64,
    /// every difference at the release from rest, rad from 0 to 1
    #[arg(long, value_name = "RAD", default_value = "0.001", value_parser = number(0.0..=1.0, "rad"))]
    pub difference: f64,
    /// relative tolerance of the integrator, 1e-14 to 1e-3
    #[arg(long, value_name = "TOL", default_value = "1e-12", value_parser = number(1e-14..=1e-3, ""))]
    pub tolerance: f64,
    /// Folder of results.
    #[command(flatten)]
    pub results: Results,
}

impl Default for Arguments {
    fn default() -> Self {
        Self::parse_from(["energy-cascade"])
    }
}

impl crate::program::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("energy-cascade-output");

    fn results(&self) -> &Results {
        &self.results
    }
}
