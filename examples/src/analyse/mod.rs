//! From measured angles to H_d and W.

pub mod camera;
pub mod estimate;
