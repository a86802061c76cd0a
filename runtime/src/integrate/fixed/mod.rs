//! Integration methods with steps of constant length.

mod gauss;
mod grid;
mod grid_position;
#[cfg(feature = "std")]
mod lanes;
mod linear;
mod projected;
mod rk4;

pub use self::gauss::{Gauss, Solver};
pub(crate) use self::linear::Factored;
pub use self::projected::Projected;
pub use self::rk4::Rk4;
pub(super) use self::rk4::Rk4Step;
