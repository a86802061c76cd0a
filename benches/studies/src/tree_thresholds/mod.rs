//! Thresholds of growth in trees by rule, by the derived equations of small differences.
//!
//! - [`arguments`]: the command line,
//! - [`trees`]: the trees and their thresholds, in words and as a table,
//! - [`chart`]: the chart.

pub mod arguments;
pub mod chart;
pub mod trees;

pub use arguments::Arguments;
pub use trees::run;
