//! The command line.

use clap::Parser;

use branched_pendulum_frame::command_line::{number, numbers};

/// From which angle on do small differences grow in trees given by a rule? Finds the
/// smallest angle of the root (all other rods are vertical) from which differences of the
/// first branching grow by a given factor within 12.58 of their periods at rest: for 2 to
/// 6 generations, two or three rods on each rod, and several ratios of masses and lengths.
///
/// The trees have up to 364 rods, but their equations with all copies in phase have only
/// one link per generation. For your own tree, use `branched-pendulum growth`, and
/// `branched-pendulum theory` for a prediction.
///
/// Every value is computed with two tolerances; if the results differ by more than 1 %,
/// it counts as not determined. Angles between those of the scan are not examined.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "tree-thresholds", version, verbatim_doc_comment)]
pub struct Arguments {
    /// angles of the root, degrees from 0 to 180; FROM:TO:STEP for a range
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "5:90:0.05",
        value_parser = numbers(0.0..=180.0, "degrees")
    )]
    // By its full path, clap takes them for one value.
    pub angles_deg: ::std::vec::Vec<f64>,
    /// growth factor that defines the threshold, 1.1 to 1e12
    #[arg(long, value_name = "G", default_value = "10", value_parser = number(1.1..=1e12, ""))]
    pub level: f64,
    /// relative error of one integration step, 1e-12 to 1e-3; everything is repeated with
    /// a hundredth of it, and the results of the repetition are reported
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "TOL",
        default_value = "1e-10",
        value_parser = number(1e-12..=1e-3, "")
    )]
    pub tolerance: f64,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("tree-thresholds-output");
}
