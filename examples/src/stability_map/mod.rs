//! Where does each method fail: step against amplitude, and against friction?
//!
//! - [`verdict`]: what became of a run,
//! - [`output`]: table, CSV file and charts.

pub mod output;
pub mod verdict;

/// The help text.
pub const HELP: &str = "\
Where does each method fail? Runs the paper's branched double pendulum with
every method at many steps (or tolerances), amplitudes and frictions, and maps
what became of each run: accurate, bounded but wrong, drifting, diverged, or
refused with an error.

Usage: stability-map [--output FOLDER]

  --output FOLDER  where tables and charts go; files of the same name there are
                   replaced [stability-map-output]
  --help           this text
";
