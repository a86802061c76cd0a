//! A link as data.

use super::{Link, Quantity};
use crate::functions::LINK_PROPERTIES;

impl Link {
    /// Returns the [properties](LINK_PROPERTIES) that say where the points of the link are and
    /// how heavy it is.
    pub fn properties(&self) -> [&Quantity; LINK_PROPERTIES.len()] {
        let Self {
            mass,
            inertia,
            com,
            pivot,
            end,
            ..
        } = self;
        [
            mass,
            inertia,
            &com.along,
            &com.lateral,
            &pivot.along,
            &pivot.lateral,
            &end.along,
            &end.lateral,
        ]
    }
}
