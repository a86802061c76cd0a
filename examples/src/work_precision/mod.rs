//! What does a given error cost, with which method?
//!
//! The apparatus is that of [`branched_double`](crate::branched_double), beside
//! seven rods; the equations are those that the macro writes, in absolute angles.
//! Errors are against the reference trajectories, which come from arbitrary
//! precision; those of the rods from the same equations in twice the digits.
//!
//! - [`mod@reference`]: the trajectories,
//! - [`measure`]: error, time and evaluations of one run; energy over 1,000 s,
//! - [`output`]: tables, CSV files and charts.

pub mod measure;
pub mod output;
pub mod reference;

/// The help text.
pub const HELP: &str = "\
What does a given error cost, with which method? Runs the paper's branched
double pendulum and seven rods with every method at many tolerances or steps,
against reference trajectories, and follows the energy over 1,000 s.

Usage: work-precision [--output FOLDER]

  --output FOLDER  where tables and charts go; files of the same name there are
                   replaced [work-precision-output]
  --help           this text
";
