//! Files of time series of pendulums: writing of computed series, reading of measured ones.
//!
//! A [`CsvWriter`] writes rows of [`Cell`]s under [`Column`]s with units.
//!
//! A file of measurements is converted to angles in two steps; each reports what it detected and
//! what it assumed ([`Finding`]):
//!
//! 1. [`Table::read`] makes out how the file is written: delimiter, decimal mark, header,
//!    units, whether Tracker or DeepLabCut wrote it. A cell that is not a number is reported where
//!    its column is used. With the feature `spreadsheets` it reads a sheet of a workbook, too.
//! 2. [`AngleColumns`] or [`Markers`] take the angles out of it, as a [`Recording`]: in
//!    radians from the vertical, over seconds, without jumps of a turn, outliers marked;
//!    [`read_angles`] chooses between them.
//!
//! ```
//! use branched_pendulum_data::{AngleColumns, Table, TableOptions};
//!
//! let text = "\
//! time [s];upper [deg];lower [deg]
//! 0,00;10,0;-5,0
//! 0,01;10,1;
//! 0,02;10,2;-4,8
//! ";
//! let table = Table::parse("swing.csv", text, &TableOptions::default())?;
//! let recording = AngleColumns::default().read(&table)?;
//! assert_eq!(recording.times, [0.0, 0.01, 0.02]);
//! let lower = &recording.links[1];
//! assert_eq!(lower.angle(0), Some((-5.0_f64).to_radians()));
//! assert_eq!(lower.angle(1), None);
//! let told: Vec<String> = recording.findings.iter().map(ToString::to_string).collect();
//! assert!(told.contains(&"detected: semicolons between cells, decimal commas".to_owned()));
//! assert!(told.contains(&"assumed: angles from the downward vertical".to_owned()));
//! # Ok::<(), branched_pendulum_data::ReadError>(())
//! ```

mod angle_source;
mod angle_unit;
mod angles;
mod cell;
mod circle;
mod clock;
mod error;
mod exchange;
mod finding;
mod format;
mod header;
mod leaps;
mod markers;
mod names;
mod outliers;
mod place;
mod points;
mod recording;
mod rows;
mod sample;
mod spreadsheet;
mod succession;
mod table;
mod text;
mod timing;
mod track;
mod turns;
mod units;
mod write;

pub use angle_source::read_angles;
pub use angles::{AngleColumns, AngleZero};
pub use cell::DecimalMark;
pub use clock::Clock;
pub use error::{ReadError, ReadErrorKind};
pub use finding::{Basis, Finding};
pub use format::Delimiter;
pub use header::FileKind;
pub use markers::{Gravity, LinkMarkers, Markers};
pub use place::{Place, Sheet};
pub use recording::{LinkSeries, Recording};
pub use sample::Sample;
pub use succession::Repeated;
pub use table::{Table, TableOptions};
pub use timing::{Gap, Timing};
pub use track::Track;
pub use units::AngleUnit;
pub use write::{Cell, Column, CsvError, CsvWriter};
