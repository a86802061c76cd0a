//! Units of angles, times and other quantities.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::num::NonZeroU32;

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Radians.
    Radians,
    /// Thousandths of a radian.
    Milliradians,
    /// Degrees, 360 a turn.
    Degrees,
    /// Sixtieths of a degree.
    ArcMinutes,
    /// Sixtieths of an arc minute.
    ArcSeconds,
    /// Gradians, 400 a turn.
    Gradians,
    /// Whole turns.
    Turns,
    /// Counts of an encoder, with this many per turn.
    Counts(NonZeroU32),
}

impl AngleUnit {
    /// Units of fixed size, each with its usual short name.
    pub const ALL: [(&'static str, Self); 7] = [
        ("rad", Self::Radians),
        ("deg", Self::Degrees),
        ("mrad", Self::Milliradians),
        ("arcmin", Self::ArcMinutes),
        ("arcsec", Self::ArcSeconds),
        ("gon", Self::Gradians),
        ("turn", Self::Turns),
    ];

    /// Returns the unit with this short name; `counts:N` is an encoder with N counts per turn.
    pub fn named(name: &str) -> Option<Self> {
        if let Some(counts) = name.strip_prefix("counts:") {
            return counts.parse().ok().map(Self::Counts);
        }
        let found = Self::ALL.iter().find(|(own, _)| *own == name);
        found.map(|(_, unit)| *unit)
    }

    /// Returns the size of the unit in rad.
    pub fn radians(self) -> f64 {
        match self {
            Self::Radians => 1.0,
            Self::Milliradians => 1e-3,
            Self::Degrees => PI / 180.0,
            Self::ArcMinutes => PI / 10_800.0,
            Self::ArcSeconds => PI / 648_000.0,
            Self::Gradians => PI / 200.0,
            Self::Turns => TAU,
            Self::Counts(counts) => TAU / f64::from(counts.get()),
        }
    }

    /// Returns the name of the unit for sentences.
    pub(crate) fn word(self) -> Cow<'static, str> {
        let word = match self {
            Self::Radians => "radians",
            Self::Milliradians => "milliradians",
            Self::Degrees => "degrees",
            Self::ArcMinutes => "arc minutes",
            Self::ArcSeconds => "arc seconds",
            Self::Gradians => "gradians",
            Self::Turns => "turns",
            Self::Counts(counts) => return format!("counts, {counts} a turn").into(),
        };
        word.into()
    }
}

/// Quantity that a unit measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unit {
    /// Unit of time, with its size in seconds.
    Time(f64),
    /// Of an angle.
    Angle(AngleUnit),
    /// Unit of length, in a picture or in space.
    Length,
    /// Unit of another quantity that occurs in tables of motions.
    Other,
}

/// Word that stands for the unit in columns of frame numbers.
pub(crate) const FRAME: &str = "frame";

const UNITS: [(&[&str], Unit); 14] = [
    (
        &["s", "sec", "second", "seconds", "Sekunden", "secondes"],
        Unit::Time(1.0),
    ),
    (
        &["ms", "msec", "millisecond", "milliseconds"],
        Unit::Time(1e-3),
    ),
    (&["µs", "us", "microseconds"], Unit::Time(1e-6)),
    (&["ns", "nanoseconds"], Unit::Time(1e-9)),
    (&["min", "minutes"], Unit::Time(60.0)),
    (
        &["rad", "radian", "radians"],
        Unit::Angle(AngleUnit::Radians),
    ),
    (
        &["mrad", "milliradians"],
        Unit::Angle(AngleUnit::Milliradians),
    ),
    // Grad is German for degrees; in lower case it may be a gradian.
    (
        &[
            "deg", "degree", "degrees", "°", "º", "Grad", "degrés", "grados", "gradi",
        ],
        Unit::Angle(AngleUnit::Degrees),
    ),
    (
        &["arcmin", "′", "arc minutes"],
        Unit::Angle(AngleUnit::ArcMinutes),
    ),
    (
        &["arcsec", "″", "arc seconds"],
        Unit::Angle(AngleUnit::ArcSeconds),
    ),
    (
        &["gon", "gradian", "gradians"],
        Unit::Angle(AngleUnit::Gradians),
    ),
    (
        &["turn", "turns", "rev", "revs", "revolutions"],
        Unit::Angle(AngleUnit::Turns),
    ),
    (&["m", "mm", "cm", "px", "pixel", "pixels"], Unit::Length),
    (
        &[
            "rad/s", "rad/sec", "deg/s", "°/s", "mrad/s", "rad/s²", "rad/s^2", "rad/s2", "deg/s²",
            "deg/s^2", "°/s²", "°/s^2", "rpm", "Hz", "m/s", "mm/s", "cm/s", "px/s", "m/s²",
            "m/s^2", "m/s2", "g", "kg", "N", "Nm", "N m", "N·m", "N*m", "mNm", "A", "mA", "V",
            "mV", "J", "mJ", "W", "mW",
        ],
        Unit::Other,
    ),
];

impl Unit {
    /// Returns the unit with this name; for words, upper and lower case are the same.
    pub(crate) fn named(text: &str) -> Option<Self> {
        let text = &bare(text);
        let exact = |text: &str| {
            let found = UNITS.iter().find(|(names, _)| names.contains(&text));
            found.map(|(_, unit)| *unit)
        };
        let is_word = text.chars().count() >= 3;
        exact(text.as_str()).or_else(|| is_word.then(|| exact(&text.to_lowercase()))?)
    }
}

/// A unit without its brackets.
pub(crate) fn bare(unit: &str) -> String {
    let unit = unit.trim().trim_matches(['[', ']', '(', ')', '{', '}']);
    // The sign of micro and the Greek letter look alike.
    unit.trim().replace('μ', "µ")
}
