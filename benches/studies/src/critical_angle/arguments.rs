//! The command line.

use clap::Parser;

use branched_pendulum_frame::command_line::{number, numbers};

/// From which release on does the antiphase mode of the paper's pendulum grow? The
/// growth factor G(T) is the largest |θ_d| within T over that at the start, for a
/// difference so small that it stays small: by its linear equations beside the in-phase
/// motion from rest with vertical children. Prints the windows of release angles in
/// which G is large, without friction and with, and writes table, charts and run.json.
///
/// Every value is computed at two tolerances; where they differ by more than 1 % it
/// counts as not determined. Nothing is said about angles between those of the scan.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "critical-angle", version, verbatim_doc_comment)]
pub struct Arguments {
    /// angles θ_1(0) of the parent, degrees from 0 to 180; FROM:TO:STEP for a range
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "5:90:0.05",
        value_parser = numbers(0.0..=180.0, "degrees")
    )]
    // By its full path, clap takes it for one value.
    pub angles_deg: ::std::vec::Vec<f64>,
    /// times T after the release, s from 0.1 to 1000
    #[arg(
        long,
        value_name = "S[,S]...",
        default_value = "4,10,30",
        value_parser = numbers(0.1..=1000.0, "s")
    )]
    pub horizons: ::std::vec::Vec<f64>,
    /// growth factors whose windows are listed, 1.1 to 1e12
    #[arg(
        long,
        value_name = "G[,G]...",
        default_value = "10,100",
        value_parser = numbers(1.1..=1e12, "")
    )]
    pub levels: ::std::vec::Vec<f64>,
    /// quality factors of the antiphase mode, from 1 to 1e6, by friction in the
    /// children's pivots; without friction is computed in any case
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "Q[,Q]...",
        default_value = "50,100,150,200",
        value_parser = numbers(1.0..=1e6, "")
    )]
    pub quality: ::std::vec::Vec<f64>,
    /// looks at trees by rule instead: the smallest of the angles from which
    /// differences of their first branching grow by the first of the levels within
    /// 12.58 periods, for 2 to 6 generations, two and three copies, and some ratios
    /// of masses and lengths
    #[arg(verbatim_doc_comment, long)]
    pub trees: bool,
    /// relative error of one integration step, 1e-12 to 1e-3; all is repeated with a
    /// hundredth of it, whose values are told
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
    const FOLDER: Option<&'static str> = Some("critical-angle-output");
}
