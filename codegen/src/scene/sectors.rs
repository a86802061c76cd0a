//! Sectors: sets of symmetric coordinates that belong to one branching and one
//! difference.

use super::coordinates::Coordinate;

/// A sector: the variables that block of the mass matrix couples which belongs
/// to one branching and one difference, or to all means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectorVariables {
    /// `in_phase`, or the name of its uppermost coordinate.
    pub name: String,
    /// Group and number of the difference; `None` for the means.
    pub difference: Option<(usize, usize)>,
    /// Indices of its symmetric coordinates, from the root outwards.
    pub coordinates: Vec<usize>,
}

/// The sectors of a set of symmetric coordinates.
pub fn sectors(coordinates: &[Coordinate]) -> Vec<SectorVariables> {
    let mut sectors: Vec<SectorVariables> = Vec::new();
    // The coordinates of a sector follow each other.
    for (index, coordinate) in coordinates.iter().enumerate() {
        let (_, difference) = coordinate.kind.orbit_and_difference();
        let last = sectors.last_mut();
        match last.filter(|sector| sector.difference == difference) {
            Some(sector) => sector.coordinates.push(index),
            None => sectors.push(SectorVariables {
                name: match difference {
                    None => "in_phase".to_owned(),
                    Some(_) => coordinate.name.clone(),
                },
                difference,
                coordinates: vec![index],
            }),
        }
    }
    sectors
}
