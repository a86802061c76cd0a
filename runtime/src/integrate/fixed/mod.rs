//! Methods with steps of a given length.

mod gauss;
mod grid;
mod linear;
mod projected;
mod rk4;

pub use self::gauss::{Gauss, GaussOrder, Solver};
pub(crate) use self::linear::Factored;
pub use self::projected::Projected;
pub use self::rk4::Rk4;
