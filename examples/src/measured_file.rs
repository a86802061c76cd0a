//! Files of measured angles, as programs that analyse them take them.

use std::path::PathBuf;

use branched_pendulum_data::{AngleColumns, AngleUnit, AngleZero, Clock, Recording, Table};
use clap::{Args, ValueEnum};

use crate::failure::Failure;
use crate::program::command_line::{number, parts};

/// A file of angles against time, and what is known of it.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MeasuredFile {
    /// file of measurements; without it they are simulated
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// columns of the angles of the links, parent first; all but the time without it
    #[arg(long, value_name = "A,B,...", value_parser = names, default_value = "")]
    // By its full path, clap takes it for one value.
    pub columns: ::std::vec::Vec<String>,
    /// unit of angles whose columns do not name it
    #[arg(long, value_enum, value_name = "UNIT")]
    pub unit: Option<Unit>,
    /// direction of angle 0; detected without it
    #[arg(long, value_enum, value_name = "WAY")]
    pub zero: Option<Zero>,
    /// pictures a second, 1 to 1e5; needed for files that number them
    #[arg(long, value_name = "HZ", value_parser = number(1.0..=1e5, "Hz"))]
    pub frame_rate: Option<f64>,
}

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Unit {
    /// Radians.
    Rad,
    /// Degrees.
    Deg,
}

/// Direction of angle 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Zero {
    /// Hanging.
    Down,
    /// Standing.
    Up,
}

impl MeasuredFile {
    /// Where the times of the file come from.
    pub fn clock(&self) -> Clock {
        self.frame_rate.map_or(Clock::Detect, Clock::FrameRate)
    }

    /// How the angles stand in the columns of the file.
    pub fn angle_columns(&self) -> AngleColumns {
        AngleColumns {
            clock: self.clock(),
            columns: self.columns.clone(),
            unit: self.unit.map(|unit| match unit {
                Unit::Rad => AngleUnit::Radians,
                Unit::Deg => AngleUnit::Degrees,
            }),
            zero: self.zero.map(|zero| match zero {
                Zero::Down => AngleZero::Down,
                Zero::Up => AngleZero::Up,
            }),
            ..AngleColumns::default()
        }
    }
}

/// Refuses a recording of another number of links.
///
/// # Errors
/// [`Failure::Links`].
pub fn check_links(table: &Table, recording: &Recording, needed: usize) -> Result<(), Failure> {
    let found = recording.links.len();
    if found == needed {
        return Ok(());
    }
    Err(Failure::Links {
        path: table.path().to_path_buf(),
        found,
        needed,
    })
}

fn names(text: &str) -> Result<Vec<String>, String> {
    Ok(parts(text).map(str::to_owned).collect())
}
