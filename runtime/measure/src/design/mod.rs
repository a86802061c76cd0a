//! Parameters at which quantities of a model have given values.
//!
//! [`DesignSearch`] varies parameters within bounds until quantities such as frequencies reach their
//! targets. It minimises the sum of squared misses by a trust-region method that keeps to the bounds
//! (crate `basin`), from several starts that are spread over the bounds in the same way in each run.
//!
//! # Example
//!
//! Length of a rod that swings with a given frequency, and gravity that is known:
//!
//! ```
//! use branched_pendulum_measure::design::{DesignSearch, DesignTarget, DesignVariable, Goal};
//!
//! let frequency = |length: f64| (1.5 * 9.81 / length).sqrt() / std::f64::consts::TAU;
//! let search = DesignSearch::new(
//!     vec![DesignVariable::new("length", [0.2, 2.0])],
//!     vec![DesignTarget::new("frequency", Goal::Equal(1.0))],
//! )?;
//! let design = search.run(&|values| Ok(vec![frequency(values[0])]))?;
//! assert!(design.is_reached && design.is_isolated());
//! assert!((design.parameters[0] - 1.5 * 9.81 / std::f64::consts::TAU.powi(2)).abs() < 1e-6);
//! # Ok::<(), branched_pendulum_measure::design::DesignError>(())
//! ```

mod error;
mod found;
mod problem;
mod search;
mod solver;

pub use error::DesignError;
pub use found::{Design, Side};
pub use problem::{DesignTarget, DesignVariable, Goal};
pub use search::DesignSearch;
