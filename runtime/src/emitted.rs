//! Names that only emitted code uses. They can change in any version: code must be emitted by the
//! same version of this crate with which it runs. `Simd` is sealed, and the registers that
//! implement it cannot be named: see `simd`.

pub use crate::model::shown;
pub use crate::requirements::{
    LinkBody, free_link, require_downward, require_finite, require_magnitude, require_non_negative,
    require_positive, require_regular, require_upward,
};
pub use crate::scalar::SinCosPairs;
pub use crate::simd::{Part, Simd, outlined};
pub use crate::system::positions::{
    arrays, fill, no_answer, properties, unknown, write, write_each,
};
pub use crate::system::{WholeMotion, WholeOrbit};

/// Recurrences of Taylor coefficients.
pub mod taylor {
    pub use crate::taylor::{
        Connectivity, KnownOrder, LinkConstants, Quad, Start, expand, rows, sums, whole, workspace,
    };
}
