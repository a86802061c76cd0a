//! Numbers of a link as a list.

use super::{Link, Quantity};
use crate::functions::LINK_PROPERTIES;

impl Link {
    /// Returns the values of the link's [properties](LINK_PROPERTIES): its points, mass and
    /// inertia.
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
