//! What the tables of loops hold, in words: docs above the `static` items.

use super::Emission;
use super::doc_text::doc_lines;
use crate::scene::{Forces, placed_columns};
use proc_macro2::TokenStream;

/// A table of constants of links.
#[derive(Clone, Copy)]
pub(super) enum Constants {
    /// What the equations of motion read.
    Motion,
    /// What a link is to its parent, where children hang at several places.
    Hanging,
    /// What energies read.
    Energy,
    /// What energies, momentum and powers read where there are bodies.
    Bodies,
}

impl Constants {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Motion => "motion",
            Self::Hanging => "hanging",
            Self::Energy => "energy",
            Self::Bodies => "bodies",
        }
    }
}

/// Columns of energies in generations.
const ENERGY: [&str; 6] = [
    "half of the mass m (kg)",
    "first moment m d about the pivot (kg m)",
    "half of the moment of inertia about the pivot (kg m²)",
    "distance of the children's pivots (m)",
    "g times the first moment of the link and of what hangs from it as points (J)",
    "half of the torsion spring's stiffness (N m)",
];

/// Columns of energies in a table.
const TABLE_ENERGY: [&str; 7] = [
    ENERGY[0],
    ENERGY[1],
    ENERGY[2],
    "distance of the pivot from the parent's (m)",
    "weight m g (N)",
    "g m d (J)",
    ENERGY[5],
];

/// Columns of bodies, d along and e across the link.
const BODIES: [&str; 12] = [
    ENERGY[0],
    ENERGY[1],
    "first moment m e across the link (kg m)",
    "half of the moment of inertia I + m (d² + e²) about the pivot (kg m²)",
    "place of the pivot along the parent (m)",
    "place of the pivot across the parent (m)",
    "weight m g (N)",
    "g m d (J)",
    "g m e (J)",
    ENERGY[5],
    "friction c in the pivot (N m s)",
    "drag k against the ground (N m s)",
];

/// What a link is to its parent, where children hang at several places.
const HANGING: [&str; 6] = [
    "`square`: factor of its Φ",
    "`ratio`: factor of its **β**",
    "`reach`: factor of the acceleration that it takes",
    "`rest`: what its mass adds to Φ at any angle (kg)",
    "`along`: place of its pivot along the parent (m)",
    "`across`: place of its pivot across the parent (m)",
];

impl Emission<'_> {
    /// Docs of a table of constants.
    pub(super) fn columns(&self, table: Constants) -> TokenStream {
        let row = match self.scene.generations {
            Some(_) => "generation",
            None => "link",
        };
        let (what, columns): (&str, Vec<String>) = match table {
            Constants::Motion => ("the equations of motion", self.motion_columns()),
            Constants::Hanging => ("what a link is to its parent", owned(&HANGING)),
            Constants::Energy if self.scene.table.is_some() => {
                ("the energies", owned(&TABLE_ENERGY))
            }
            Constants::Energy => ("the energies", owned(&ENERGY)),
            Constants::Bodies => ("the energies and powers", owned(&BODIES)),
        };
        let mut lines = vec![
            format!(
                "Constants of {what}, a row for each {row}, the root's first; of every number the nearest `f64` and what remains. Columns:"
            ),
            String::new(),
        ];
        let numbered = columns.iter().enumerate();
        lines.extend(numbered.map(|(column, meaning)| format!("{}. {meaning}", column + 1)));
        doc_lines(&lines)
    }

    fn motion_columns(&self) -> Vec<String> {
        let forces = Forces::of(self.scene);
        let shape = match &self.scene.table {
            None => Shape::Generations,
            Some(table) if table.hanging.is_none() => Shape::Table,
            Some(_) => Shape::Placed,
        };
        let names = match shape {
            Shape::Placed => placed_columns(forces),
            Shape::Generations | Shape::Table => forces.columns(),
        };
        let names = names.into_iter();
        names
            .map(|name| format!("`{name}`: {}", motion_column(name, shape)))
            .collect()
    }
}

/// What the rows of the equations' constants are.
#[derive(Clone, Copy)]
enum Shape {
    Generations,
    Table,
    Placed,
}

/// A column of the equations. ℓ is the distance of the children's pivots, the unit
/// of length where these hang at one place.
fn motion_column(name: &str, shape: Shape) -> &'static str {
    match (name, shape) {
        ("rest", _) => "what the children's masses add to Φ at any angle (kg m²)",
        ("inertia", _) => "I + m d² (kg m²), of leaves one over it",
        ("moment", Shape::Placed) => "m d (kg m)",
        ("moment", _) => "m d ℓ (kg m²), ℓ being the distance of the children's pivots",
        ("square", Shape::Generations) => "factor of the children's Φ",
        ("square", _) => "factor of its Φ at the parent",
        ("ratio", Shape::Generations) => "factor of the children's **β**",
        ("ratio", _) => "factor of its **β** at the parent",
        ("reach", Shape::Generations) => "factor of the acceleration that it hands on",
        ("reach", _) => "factor of the acceleration that its parent hands on",
        ("along", Shape::Placed) => "direction of a leaf's centre of mass, along the link; 1 else",
        ("across", Shape::Placed) => "the same across the link; 0 else",
        ("along", _) => "children's pivot or leaf's centre of mass, along the link, over ℓ",
        ("across", _) => "the same across the link",
        ("lateral", _) => "first moment across the direction of that place",
        ("friction", _) => "c in the pivot (N m s)",
        ("drag", _) => "k against the ground (N m s)",
        ("spring", _) => "stiffness of the torsion spring (N m)",
        _ => "torque on the root (N m), stated anew by every evaluation",
    }
}

fn owned(columns: &[&str]) -> Vec<String> {
    columns.iter().map(|&column| column.to_owned()).collect()
}
