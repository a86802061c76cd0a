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
    /// Random states for each amplitude.
    pub states: usize,
    /// Folder for tables and charts.
    pub output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            states: 20_000,
            output: PathBuf::from("transfer-orders-output"),
        }
    }
}

/// The help text.
pub const HELP: &str = "\
How wrong is each form of the energy transfer W into each sector of a tree, at
which amplitude of its differences, and what does it cost? For the paper's
branched double pendulum and for two jointed arms on a body; another tree is one
more description in examples/src/transfer_orders/scenes.rs.

Usage: transfer-orders [OPTION VALUE]...

  --states N       random states for each amplitude, 10 to 1000000 [20000]
  --output FOLDER  where tables and charts go; files of the same name there are
                   replaced [transfer-orders-output]
  --help           this text
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
    /// Not a whole number from 10 to a million.
    States(String),
}

impl fmt::Display for ArgumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(word) => write!(f, "there is no option `{word}`"),
            Self::MissingValue(option) => write!(f, "`{option}` needs a value"),
            Self::Repeated(option) => write!(f, "`{option}` is given twice"),
            Self::States(value) => write!(
                f,
                "`{STATES}` must be a whole number from 10 to 1000000, but got `{value}`"
            ),
        }
    }
}

impl std::error::Error for ArgumentError {}

const STATES: &str = "--states";
const OUTPUT: &str = "--output";

impl Arguments {
    /// Reads the arguments that follow the program's name.
    ///
    /// # Errors
    /// [`ArgumentError`], the first one found.
    pub fn parse(words: impl IntoIterator<Item = String>) -> Result<Request, ArgumentError> {
        let (mut states, mut output) = (None, None);
        let mut words = words.into_iter();
        while let Some(word) = words.next() {
            let (option, place) = match word.as_str() {
                "--help" | "-h" => return Ok(Request::Help),
                STATES => (STATES, &mut states),
                OUTPUT => (OUTPUT, &mut output),
                _ => return Err(ArgumentError::Unknown(word)),
            };
            let value = words
                .next()
                .filter(|value| !value.is_empty() && !value.starts_with("--"))
                .ok_or(ArgumentError::MissingValue(option))?;
            if place.replace(value).is_some() {
                return Err(ArgumentError::Repeated(option));
            }
        }
        let mut arguments = Self::default();
        if let Some(value) = states {
            arguments.states = match value.parse() {
                Ok(number @ 10..=1_000_000) => number,
                _ => return Err(ArgumentError::States(value)),
            };
        }
        if let Some(value) = output {
            arguments.output = PathBuf::from(value);
        }
        Ok(Request::Run(arguments))
    }
}
