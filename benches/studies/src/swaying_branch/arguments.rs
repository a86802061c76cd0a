//! The command line.

use clap::Parser;

use branched_pendulum_frame::command_line::number;

/// A branch of 31 rods sways in the wind, and a hand pulls it and lets go, frame by
/// frame as in a game. What does a frame cost in the full model, in the linear model, in
/// its slow modes only, and in a model that switches, and how large are their errors?
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "swaying-branch", version, verbatim_doc_comment)]
pub struct Arguments {
    /// duration of the motion, s from 1 to 60
    #[arg(long, value_name = "S", default_value = "12", value_parser = number(1.0..=60.0, "s"))]
    pub duration: f64,
    /// frames per second, 20 to 1000
    #[arg(long, value_name = "HZ", default_value = "60", value_parser = number(20.0..=1e3, "Hz"))]
    pub frame_rate: f64,
    /// mean speed of the wind, m/s from 0 to 40
    #[arg(long, value_name = "M/S", default_value = "5", value_parser = number(0.0..=40.0, "m/s"))]
    pub wind: f64,
    /// force of the hand, N from 0 to 100
    #[arg(long, value_name = "N", default_value = "6", value_parser = number(0.0..=1e2, "N"))]
    pub pull: f64,
    /// seed of the gusts, 0 to 1e9
    #[arg(long, value_name = "N", default_value = "1", value_parser = number(0.0..=1e9, ""))]
    pub seed: f64,
    /// duration of a storm with random blows of a million newtons on the branch,
    /// s from 0 to 100000
    #[arg(long, value_name = "S", default_value = "60", verbatim_doc_comment,
        value_parser = number(0.0..=1e5, "s"))]
    pub storm: f64,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("swaying-branch-output");
}
