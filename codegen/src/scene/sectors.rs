//! Sectors: sets of symmetric coordinates that belong to one branching and one difference, or to
//! all means.

use super::coordinates::Coordinate;

/// A sector: the symmetric coordinates of one diagonal block of the mass matrix at rest. They
/// belong to one branching and one difference, or are all means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectorVariables {
    /// `in_phase`, or the name of the uppermost coordinate.
    pub name: String,
    /// Group and number of the difference; `None` for the means.
    pub difference: Option<(usize, usize)>,
    /// Indices of the symmetric coordinates, from the root outwards.
    pub coordinates: Vec<usize>,
}

/// Sorts symmetric coordinates into sectors.
pub fn sectors(coordinates: &[Coordinate]) -> Vec<SectorVariables> {
    let mut sectors: Vec<SectorVariables> = Vec::new();
    // The coordinates of a sector are consecutive.
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
