//! Series of data on disk.

pub mod csv;

pub use csv::{Cell, Column, CsvError, CsvWriter};
