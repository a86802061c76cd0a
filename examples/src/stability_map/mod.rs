//! Where does each method fail: step against amplitude, and against friction?
//! And where does each truncation of W?
//!
//! - [`verdict`]: what became of a run,
//! - [`output`]: table, CSV file and charts,
//! - [`truncation`]: forms of W against amplitude.

pub mod output;
pub mod truncation;
pub mod verdict;

/// The help text.
pub const HELP: &str = "\
Where does each method fail? Runs the paper's branched double pendulum with
every method at many steps (or tolerances), amplitudes and frictions, and maps
what became of each run: accurate, bounded but wrong, drifting, diverged, or
refused with an error. Maps the truncated forms of the energy transfer W likewise:
accurate, bounded but wrong, or useless.

Usage: stability-map [--output FOLDER]

  --output FOLDER  where tables and charts go; files of the same name there are
                   replaced [stability-map-output]
  --help           this text
";
