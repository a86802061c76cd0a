//! Estimates from measured series: smoothing and spectra against dense algebra and known
//! motions, parameters against those of simulated and measured pendulums.

mod dense_regression;
mod design;
mod drift;
mod equations;
mod identification;
mod lacking_friction;
mod leaps;
mod lines;
#[path = "../../../tests/runtime/normal.rs"]
mod normal;
mod smoothing;
mod spectrum;
mod units;
