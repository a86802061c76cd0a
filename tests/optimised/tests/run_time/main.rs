//! Trees at run time, and one that is written out: what takes long.

mod exponents;
mod series;
mod truncation;
mod written_out;
