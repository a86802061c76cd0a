//! What comparisons with other crates share: our trees as emitted code, the motions of the studies
//! and their references.

#[rustfmt::skip]
#[path = "../expanded.rs"]
pub mod scenes;
#[path = "../../../studies/src/integration_speed/measure.rs"]
pub mod measure;
pub mod work_precision;
