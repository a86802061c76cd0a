//! Large trees: equations of motion in loops.

mod equations;

pub use equations::{LinkEquations, LinkMotion, Row};
