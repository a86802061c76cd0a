//! Methods with steps of a given length.

mod gauss;
mod grid;
#[cfg(feature = "std")]
mod lanes;
mod linear;
mod place;
mod projected;
mod rk4;

pub use self::gauss::{Gauss, Solver};
pub(crate) use self::linear::Factored;
pub use self::projected::Projected;
pub use self::rk4::Rk4;
pub(super) use self::rk4::Rk4Step;
