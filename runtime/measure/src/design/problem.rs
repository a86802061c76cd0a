//! Variables and targets of a design.

use std::fmt;

/// A parameter that may vary.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignVariable {
    /// Name of the parameter.
    pub name: String,
    /// Smallest and largest value, SI units.
    pub range: [f64; 2],
    /// Present value. Of several solutions, the one nearest to it is returned. The middle of the
    /// range by default.
    pub present: f64,
}

impl DesignVariable {
    /// Creates a parameter that may take the values of a range.
    pub fn new(name: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            name: name.into(),
            range,
            present: 0.5 * (range[0] + range[1]),
        }
    }

    /// Sets the present value.
    #[must_use]
    pub fn with_present(self, present: f64) -> Self {
        Self { present, ..self }
    }

    pub(super) fn width(&self) -> f64 {
        self.range[1] - self.range[0]
    }
}

/// A quantity with its goal.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignTarget {
    /// Name of the quantity.
    pub name: String,
    /// Goal of the quantity.
    pub goal: Goal,
}

impl DesignTarget {
    /// Creates a target.
    pub fn new(name: impl Into<String>, goal: Goal) -> Self {
        Self {
            name: name.into(),
            goal,
        }
    }
}

/// Requirement on the value of a quantity, in the unit of the quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The quantity has this value.
    Equal(f64),
    /// The quantity has this value or a larger one.
    AtLeast(f64),
    /// The quantity has this value or a smaller one.
    AtMost(f64),
}

impl Goal {
    /// Returns the value of the goal.
    pub fn value(self) -> f64 {
        match self {
            Self::Equal(value) | Self::AtLeast(value) | Self::AtMost(value) => value,
        }
    }

    /// Returns the difference between a value and the goal, relative to the goal (absolute if the
    /// goal is zero); zero if the requirement holds.
    pub(super) fn miss(self, value: f64) -> f64 {
        let scale = match self.value() {
            0.0 => 1.0,
            goal => goal.abs(),
        };
        let miss = (value - self.value()) / scale;
        match self {
            Self::Equal(_) => miss,
            Self::AtLeast(_) if miss >= 0.0 => 0.0,
            Self::AtMost(_) if miss <= 0.0 => 0.0,
            Self::AtLeast(_) | Self::AtMost(_) => miss,
        }
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Equal(value) => write!(f, "{value}"),
            Self::AtLeast(value) => write!(f, "at least {value}"),
            Self::AtMost(value) => write!(f, "at most {value}"),
        }
    }
}
