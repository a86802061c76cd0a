//! What one evaluation of the accelerations costs, against what else one could
//! write.

pub mod articulated;
pub mod by_hand;
pub mod dense;
pub mod large;
pub mod measure;
pub mod output;
pub mod scenes;
pub mod states;
pub mod table;
