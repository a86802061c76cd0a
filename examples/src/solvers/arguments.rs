//! The command line of a program that takes an output folder and no more.

use std::fmt;
use std::path::PathBuf;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// To run, with this output folder.
    Run(PathBuf),
    /// To see the help.
    Help,
}

/// What is wrong with the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArgumentError {
    /// There is no such option.
    Unknown(String),
    /// `--output` stands without a value.
    MissingValue,
    /// `--output` is given twice.
    Repeated,
}

impl fmt::Display for ArgumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(word) => write!(f, "there is no option `{word}`"),
            Self::MissingValue => write!(f, "`--output` needs a value"),
            Self::Repeated => write!(f, "`--output` is given twice"),
        }
    }
}

impl std::error::Error for ArgumentError {}

/// Reads the arguments that follow the program's name; `folder` is the output
/// folder where none is given.
///
/// # Errors
/// [`ArgumentError`], the first one found.
pub fn parse(
    words: impl IntoIterator<Item = String>,
    folder: &str,
) -> Result<Request, ArgumentError> {
    let mut output = None;
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--help" | "-h" => return Ok(Request::Help),
            "--output" => {
                let value = words
                    .next()
                    .filter(|value| !value.is_empty() && !value.starts_with("--"))
                    .ok_or(ArgumentError::MissingValue)?;
                if output.replace(value).is_some() {
                    return Err(ArgumentError::Repeated);
                }
            }
            _ => return Err(ArgumentError::Unknown(word)),
        }
    }
    let folder = output.unwrap_or_else(|| folder.to_owned());
    Ok(Request::Run(PathBuf::from(folder)))
}
