//! Rules that simplify operations while a program is built.

mod folding;
mod neutral;
mod sharing;
mod signs;
