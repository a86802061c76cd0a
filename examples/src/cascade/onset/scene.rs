//! The tree, and its sectors by where they branch.

use branched_pendulum::analysis::{SectorModes, SectorModesError};
use branched_pendulum::branched_pendulum;

/// Fifteen rods: every rod carries two of half its mass and seven tenths of
/// its length. Friction in every pivot, a motor on the root.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
    drive(torque = torque * cos(pace * t)),
    emit(modes, symmetric, budget(rest, canonical, velocity, parseval, matrix)),
)]
pub struct Tree;

/// Links of the tree.
pub const LINKS: usize = 15;

/// Sectors of the tree.
pub const SECTORS: usize = 8;

/// All sectors of the tree, as emitted.
pub fn sectors() -> &'static [branched_pendulum::sectors::Sector] {
    Tree::<f64>::SECTORS
}

/// The modes of every sector about the hanging equilibrium.
///
/// # Errors
/// [`SectorModesError`], which the numbers of this tree rule out.
pub fn modes(tree: &Tree) -> Result<SectorModes, SectorModesError> {
    let hanging = [0.0; LINKS];
    let (mass, stiffness) = (tree.mass_matrix(&hanging), tree.stiffness_matrix(&hanging));
    SectorModes::new(sectors(), &mass, &stiffness)
}

/// Where the subtrees part whose difference a sector describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Nowhere: all copies move alike.
    InPhase,
    /// Below the root.
    First,
    /// Below the second generation.
    Second,
    /// Below the third generation.
    Third,
}

impl Level {
    /// All levels, from the root outwards.
    pub const ALL: [Self; 4] = [Self::InPhase, Self::First, Self::Second, Self::Third];

    /// The level of the sector with this index: it has a coordinate for each
    /// generation below its branching.
    pub fn of(sector: usize) -> Self {
        let generations = sectors().get(sector).map_or(0, |s| s.coordinates().len());
        match generations {
            4 => Self::InPhase,
            3 => Self::First,
            2 => Self::Second,
            _ => Self::Third,
        }
    }

    /// As shown in tables and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::InPhase => "in phase",
            Self::First => "first branching",
            Self::Second => "second branchings",
            Self::Third => "third branchings",
        }
    }
}

/// Sums over the sectors of each level, in the order of [`Level::ALL`].
pub fn by_level(values: &[f64; SECTORS]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for (sector, value) in values.iter().enumerate() {
        sums[Level::of(sector) as usize] += value;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::{LINKS, Level, SECTORS, by_level, sectors};

    #[test]
    fn levels_have_the_sectors_that_branch_there() {
        let sectors = sectors();
        assert_eq!(sectors.len(), SECTORS);
        let links: usize = sectors.iter().map(|s| s.coordinates().len()).sum();
        assert_eq!(links, LINKS);
        // `arm_3_2_d`: the second branching at which third-generation arms part.
        for (index, sector) in sectors.iter().enumerate() {
            let level = match sector.name().split('_').nth(1) {
                Some("phase") => Level::InPhase,
                Some("2") => Level::First,
                Some("3") => Level::Second,
                other => {
                    assert_eq!(other, Some("4"));
                    Level::Third
                }
            };
            assert_eq!(Level::of(index), level, "{}", sector.name());
        }
        assert_eq!(by_level(&[1.0; SECTORS]), [1.0, 1.0, 2.0, 4.0]);
    }
}
