//! Methods with steps of a given length.

mod driver;
mod gauss;
mod linear;
mod rk4;

pub use self::gauss::{Gauss, GaussOrder, Solver};
pub use self::rk4::Rk4;
