//! Trees at run time: what takes long.

mod exponents;
mod series;
mod truncation;
