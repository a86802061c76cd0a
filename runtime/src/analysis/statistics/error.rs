//! Why there is no average.

use crate::errors::errors;

errors! {
    /// Why series have no average with an error.
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum StatisticsError {
        /// Fewer samples than are needed.
        TooFew {
            /// Number of samples in all series.
            found: usize,
            /// Number of samples needed.
            needed: usize,
        } => "{found} samples, where {needed} are needed",
        /// A sample that is infinite or NaN.
        NotFinite {
            /// Number of its series.
            series: usize,
            /// Place of the sample in the series.
            index: usize,
        } => "sample {index} of series {series} is not finite",
        /// The series are too short for their correlations: their samples are alike over
        /// all lags that could be looked at, or less than eight times the correlation time
        /// is there.
        Correlated {
            /// Number of samples in all series.
            samples: usize,
            /// Largest lag that was looked at, or the correlation time, in samples.
            lag: usize,
        } => "{samples} samples that are correlated over {lag} of them: the series are too short",
        /// No transient that ends within the first half of the series.
        Unsettled => "no transient ends within the first half of the series: it has not settled",
    }
}

impl core::error::Error for StatisticsError {}
