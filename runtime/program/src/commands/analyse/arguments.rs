//! The command line.

use clap::Parser;

use crate::frame::command_line::number;
use crate::frame::{Charts, RecordOptions};
use crate::measured_file::MeasuredFile;
use crate::motion::MethodArguments;
use crate::release::{APART, ReleaseArguments};
use crate::subject::{TreeArguments, assignments};

/// Computes energy and power of a tree, with their errors, from its measured angles: for a
/// difference between copies its energy H_d and the energy transfer W, for a tree without copies
/// the energy H and the power of friction and drive. The file is a table of angles against time, or
/// of two dots per link as Tracker or DeepLabCut write them; without a file, a camera that records
/// the tree is simulated, so that the true values are known.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(
    name = "branched-pendulum analyse",
    version,
    verbatim_doc_comment,
    mut_arg("start", |start| start.default_value(APART))
)]
pub struct Arguments {
    /// The file.
    #[command(flatten)]
    pub measured: MeasuredFile,
    /// The tree that was measured.
    #[command(flatten)]
    pub tree: TreeArguments,
    /// name of the sector whose energy is reported, or `whole` for the energy of the whole tree; by
    /// default the first difference between copies, or the whole tree if there are none
    #[arg(verbatim_doc_comment, long, value_name = "NAME")]
    pub sector: Option<String>,
    /// uses every Nth row of the file only
    #[arg(long, value_name = "N", default_value = "1", value_parser = rows)]
    pub every: usize,
    /// uses the equations of motion: errors are smaller if the equations are correct
    #[arg(long)]
    pub model: bool,
    /// uses polynomials near each time, as a check of the estimate by smoothness
    #[arg(long, conflicts_with = "model")]
    pub polynomials: bool,
    /// number of random draws of motions that agree with the data, 20 to 10000
    #[arg(long, value_name = "N", default_value = "200", value_parser = clap::value_parser!(u32).range(20..=10_000))]
    pub draws: u32,
    /// How a simulated tree starts.
    #[command(flatten)]
    pub release: ReleaseArguments,
    /// How the motion is integrated if it is simulated.
    #[command(flatten)]
    pub method: MethodArguments,
    /// simulation: initial difference between copies, rad from 0 to 1; the coordinate of the
    /// reported sector is increased by this difference
    #[arg(long, value_name = "RAD", default_value = "0.01", value_parser = number(0.0..=1.0, "rad"))]
    pub difference: f64,
    /// simulation: length of the record, s from 0.5 to 100
    #[arg(long, value_name = "S", default_value = "4", value_parser = number(0.5..=1e2, "s"))]
    pub duration: f64,
    /// simulation: pictures per second, 10 to 1e4
    #[arg(long, value_name = "HZ", default_value = "240", value_parser = number(1e1..=1e4, "Hz"))]
    pub rate: f64,
    /// simulation: standard deviation of a dot's position, m from 1e-6 to 0.01
    #[arg(long, value_name = "M", default_value = "2e-4", value_parser = number(1e-6..=1e-2, "m"))]
    pub noise: f64,
    /// simulation: values of parameters of the simulated tree that differ from those assumed in the
    /// equations
    #[arg(long, value_name = "NAME=VALUE[,..]", value_parser = assignments)]
    // By its full path, clap takes each for one value.
    pub real: Vec<::std::vec::Vec<(String, f64)>>,
    /// simulation: angle by which the second link's dots are rotated from its axis, degrees
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = number(-10.0..=10.0, "°"), allow_hyphen_values = true)]
    pub turned: f64,
    /// seed of all random numbers
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("analyse-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        self.measured.file.is_none().then_some(self.duration)
    }

    fn of_records() -> RecordOptions {
        let own = ["difference", "duration", "rate", "noise", "real", "turned"];
        RecordOptions {
            measured: [&MeasuredFile::OPTIONS[..], &["every"]].concat(),
            simulated: [
                &own[..],
                &ReleaseArguments::OPTIONS,
                &MethodArguments::OPTIONS,
            ]
            .concat(),
            ..RecordOptions::default()
        }
    }

    fn check(&self) -> Result<(), String> {
        self.measured.check()
    }
}

fn rows(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rows @ 1..=100_000) => Ok(rows),
        _ => Err("a whole number from 1 to 100000".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::Arguments;
    use crate::frame::command_line as program;

    #[test]
    fn lists_are_one_option() {
        assert!(Arguments::try_parse_from(["analyse", "swing.csv", "--every", "0"]).is_err());
        // The record of a run holds all of a list.
        let words = ["analyse", "swing.csv", "--columns", "a,b,c"].map(Into::into);
        let read = program::parse::<Arguments>(words).unwrap();
        assert_eq!(read.arguments.measured.columns, ["a", "b", "c"]);
        assert_eq!(read.values["columns"], "a,b,c");
    }
}
