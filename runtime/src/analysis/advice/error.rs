//! Why there is no advice.

use std::error::Error;

use crate::errors::errors;

errors! {
    /// Why there is no advice.
    #[derive(Debug)]
    #[non_exhaustive]
    pub enum AdviceError {
        /// The request makes no sense.
        Request(what: &'static str) => "advice needs {what}",
        /// There is no reference: the equations were not integrated to the end.
        Reference(error: Box<dyn Error + Send + Sync>) => "there is no reference to measure \
            errors against",
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
