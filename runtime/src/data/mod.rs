//! Series of data on disk.

pub mod csv;

pub use csv::{Column, CsvError, CsvWriter};
