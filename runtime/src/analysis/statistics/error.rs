//! Errors in the computation of averages.

use crate::errors::errors;

errors! {
    /// Reason why series have no average with an error.
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum StatisticsError {
        /// There are fewer samples than needed.
        TooFew {
            /// Number of samples in all series.
            found: usize,
            /// Number of samples needed.
            needed: usize,
        } => "got {found} samples: at least {needed} are needed",
        /// A sample is infinite or NaN.
        NotFinite {
            /// Index of the series with the sample.
            series: usize,
            /// Index of the sample in the series.
            index: usize,
        } => "sample {index} of series {series} is not finite",
        /// The series are too short for their correlations: samples are correlated over all lags
        /// that were examined, or the series are shorter than eight correlation times.
        Correlated {
            /// Number of samples in all series.
            samples: usize,
            /// Largest lag that was examined, or the correlation time, in samples.
            lag: usize,
        } => "{samples} samples are too few: they are correlated over {lag} samples",
        /// The transient does not end within the first half of the series.
        Unsettled => "the transient does not end within the first half of the series: sample for \
            a longer time",
    }
}

impl core::error::Error for StatisticsError {}
