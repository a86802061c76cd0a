//! Changes in the interpretation of a table: a single change, or several together.

use std::fmt;

use crate::measured_file::MeasuredFile;

/// Kind of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Unit of angles.
    Unit,
    /// Direction of angle 0: upwards or downwards.
    Vertical,
    /// Direction of angle 0: to the left or right.
    Side,
    /// Direction of y.
    Y,
    /// Order of the links.
    Links,
    /// Which end of a link is the upper one.
    Ends,
    /// Order of the dots.
    Dots,
    /// Angles relative to the parent link, or to the vertical.
    Relative,
    /// A camera or encoder that is not plumb.
    Tilt,
    /// Beginning of the motion.
    Release,
    /// Marks of lost dots.
    Lost,
    /// Pictures at which the motion leaps.
    Pictures,
    /// Friction that the constants lack.
    Friction,
}

impl Kind {
    /// Returns the kind in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::Vertical => "vertical",
            Self::Side => "angles from the horizontal",
            Self::Y => "direction of y",
            Self::Links => "order of links",
            Self::Ends => "ends of links",
            Self::Dots => "order of dots",
            Self::Relative => "relative angles",
            Self::Tilt => "tilt",
            Self::Release => "release",
            Self::Lost => "lost dots",
            Self::Pictures => "wrong pictures",
            Self::Friction => "friction",
        }
    }

    /// Returns true if a change of this kind removes a part of the record. Without that part,
    /// standard deviations may be far larger.
    pub fn leaves_out(self) -> bool {
        match self {
            Self::Release | Self::Lost | Self::Pictures => true,
            Self::Unit
            | Self::Vertical
            | Self::Side
            | Self::Y
            | Self::Links
            | Self::Ends
            | Self::Dots
            | Self::Relative
            | Self::Tilt
            | Self::Friction => false,
        }
    }
}

/// A change in the interpretation of a table, or in the constants of the pendulum.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Kind of the change.
    pub kind: Kind,
    /// Words for the change.
    pub words: String,
    /// Command-line options that cause this interpretation, each with its value.
    pub options: Vec<String>,
    /// The file with them.
    pub file: MeasuredFile,
}

/// Changes that were made together, and how much of the gap in the energy budget they remove.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// Words for the change.
    pub words: String,
    /// Command-line options that cause this interpretation.
    pub option: String,
    /// Fraction of the gap that the changes remove, from 0 to 1.
    pub share: f64,
    /// True if all rows of the record stay in use.
    pub keeps_rows: bool,
}

impl Cause {
    /// Returns the cause that consists of these changes, and of the equations of motion if it needs
    /// them. If several changes set the same option, the last value is used.
    pub fn of(changes: &[Change], needs_model: bool, share: f64) -> Self {
        let mut words: Vec<&str> = changes.iter().map(|own| own.words.as_str()).collect();
        let mut options: Vec<&String> = Vec::new();
        for option in changes.iter().flat_map(|own| &own.options) {
            let name = |option: &str| option.split(' ').next().unwrap_or_default().to_owned();
            // Several parameters are set one after the other.
            options.retain(|other| name(other) != name(option) || option.starts_with("--set"));
            options.push(option);
        }
        let mut options: Vec<&str> = options.into_iter().map(String::as_str).collect();
        if needs_model {
            words.push("the equations of motion bridge the rows that are left out");
            options.push("--model");
        }
        Self {
            words: words.join(", and "),
            option: options.join(" "),
            share,
            keeps_rows: !changes.iter().any(|own| own.kind.leaves_out()),
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.words, self.option)
    }
}
