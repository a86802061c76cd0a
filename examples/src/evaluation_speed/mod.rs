//! What one evaluation of the accelerations costs, against what else one could
//! write.

pub mod accuracy;
pub mod articulated;
pub mod by_hand;
pub mod dense;
pub mod large;
pub mod measure;
pub mod output;
mod random;
pub mod scenes;
pub mod states;
pub mod table;
