//! The command line.

use std::fmt;
use std::path::PathBuf;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// To run the program.
    Run(Arguments),
    /// To see the help.
    Help,
}

/// All options of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    /// Time followed, s.
    pub duration: f64,
    /// Amplitude of the torque on the root, N m.
    pub torque: f64,
    /// Frequency of the torque, Hz.
    pub frequency: f64,
    /// Every difference at the release, rad.
    pub difference: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
    /// Folder for table and charts.
    pub output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            duration: 20.0,
            torque: 0.2,
            frequency: 0.6,
            difference: 1e-3,
            tolerance: 1e-12,
            output: PathBuf::from("energy-cascade-output"),
        }
    }
}

/// The help text.
pub const HELP: &str = "\
A motor turns the root of a binary tree of fifteen rods. Only motions in phase
take energy from it: which of the differences between branches does it reach,
and by which way?

Usage: energy-cascade [OPTION VALUE]...

  --duration S      time followed, s [20]
  --torque NM       amplitude of the torque on the root, N m [0.2]
  --frequency HZ    its frequency, Hz [0.6]
  --difference RAD  every difference at the release from rest, rad [0.001]
  --tolerance TOL   relative tolerance of the integrator [1e-12]
  --output FOLDER   where table and charts go; files of the same name there are
                    replaced [energy-cascade-output]
  --help            this text
";

/// What is wrong with the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArgumentError {
    /// There is no such option.
    Unknown(String),
    /// An option stands without a value.
    MissingValue(&'static str),
    /// An option is given twice.
    Repeated(&'static str),
    /// Not a number that the option takes.
    Number {
        /// The option.
        option: &'static str,
        /// What it takes.
        expected: &'static str,
        /// What was given.
        value: String,
    },
}

impl fmt::Display for ArgumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(word) => write!(f, "there is no option `{word}`"),
            Self::MissingValue(option) => write!(f, "`{option}` needs a value"),
            Self::Repeated(option) => write!(f, "`{option}` is given twice"),
            Self::Number {
                option,
                expected,
                value,
            } => write!(f, "`{option}` must be {expected}, but got `{value}`"),
        }
    }
}

impl std::error::Error for ArgumentError {}

/// Options with a number: name, what they take, whether a value is that.
type NumberOption = (&'static str, &'static str, fn(f64) -> bool);

const NUMBERS: [NumberOption; 5] = [
    ("--duration", "from 0.1 to 1000 s", |x| {
        (0.1..=1e3).contains(&x)
    }),
    ("--torque", "from 0 to 100 N m", |x| {
        (0.0..=1e2).contains(&x)
    }),
    ("--frequency", "from 0 to 100 Hz", |x| {
        (0.0..=1e2).contains(&x)
    }),
    ("--difference", "from 0 to 1 rad", |x| {
        (0.0..=1.0).contains(&x)
    }),
    ("--tolerance", "from 1e-14 to 1e-3", |x| {
        (1e-14..=1e-3).contains(&x)
    }),
];

const OUTPUT: &str = "--output";

impl Arguments {
    /// Reads the arguments that follow the program's name.
    ///
    /// # Errors
    /// [`ArgumentError`], the first one found.
    pub fn parse(words: impl IntoIterator<Item = String>) -> Result<Request, ArgumentError> {
        let mut arguments = Self::default();
        let mut seen = Vec::new();
        let mut words = words.into_iter();
        while let Some(word) = words.next() {
            if word == "--help" || word == "-h" {
                return Ok(Request::Help);
            }
            let number = NUMBERS.iter().find(|(option, ..)| *option == word);
            let option = match number {
                Some((option, ..)) => *option,
                None if word == OUTPUT => OUTPUT,
                None => return Err(ArgumentError::Unknown(word)),
            };
            let value = words
                .next()
                .filter(|value| !value.is_empty() && !value.starts_with("--"))
                .ok_or(ArgumentError::MissingValue(option))?;
            if seen.contains(&option) {
                return Err(ArgumentError::Repeated(option));
            }
            seen.push(option);
            let Some(&(_, expected, possible)) = number else {
                arguments.output = PathBuf::from(value);
                continue;
            };
            let Some(number) = value.parse().ok().filter(|&number| possible(number)) else {
                return Err(ArgumentError::Number {
                    option,
                    expected,
                    value,
                });
            };
            match option {
                "--duration" => arguments.duration = number,
                "--torque" => arguments.torque = number,
                "--frequency" => arguments.frequency = number,
                "--difference" => arguments.difference = number,
                _ => arguments.tolerance = number,
            }
        }
        Ok(Request::Run(arguments))
    }
}
