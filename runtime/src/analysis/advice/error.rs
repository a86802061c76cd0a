//! Why there is no advice.

use std::error::Error;
use std::fmt;

/// Why there is no advice.
#[derive(Debug)]
#[non_exhaustive]
pub enum AdviceError {
    /// The request makes no sense.
    Request(&'static str),
    /// There is no reference: the equations were not integrated to the end.
    Reference(Box<dyn Error + Send + Sync>),
}

impl fmt::Display for AdviceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Request(what) => write!(f, "advice needs {what}"),
            Self::Reference(_) => write!(f, "there is no reference to measure errors against"),
        }
    }
}

impl Error for AdviceError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Request(_) => None,
            Self::Reference(error) => Some(error.as_ref()),
        }
    }
}
