//! A link as data.

use super::{Link, Quantity};

/// Meaning of the properties of a link, in the order of [`Link::properties`].
pub const LINK_PROPERTIES: [&str; 8] = [
    "mass (kg)",
    "moment of inertia about the centre of mass (kg m²)",
    "place of the centre of mass along the link, from its pivot (m)",
    "place of the centre of mass across the link (m)",
    "place of the pivot along the parent, from the parent's pivot (m)",
    "place of the pivot across the parent (m)",
    "place of the end along the link, from its pivot (m)",
    "place of the end across the link (m)",
];

impl Link {
    /// The properties that say where its points are and how heavy it is.
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
