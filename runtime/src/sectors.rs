//! Sectors: what identical subtrees do in phase and against each other.
//!
//! At the in-phase motion, where all copies move alike, the mass matrix falls
//! into blocks: one for the means and one for each branching and difference. The
//! coordinates of a block are a sector. Emitted code lists them
//! ([`Sectors::SECTORS`]) and reports their energies and the transfers between
//! them ([`Budget`]).

/// A coordinate of a sector, in terms of the links: θ_link = Σ weight ·
/// coordinate over all coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectorCoordinate {
    /// Name, as in [`COORDINATE_NAMES`](crate::SymmetricPendulum::COORDINATE_NAMES).
    pub name: &'static str,
    /// Index and weight of each link in which it shows.
    pub weights: &'static [(usize, f64)],
}

impl SectorCoordinate {
    /// Σ weight²: the square of the factor that turns the coordinate into the
    /// orthonormal one. The orthonormal coordinate is √norm · coordinate, its
    /// momentum that of the coordinate divided by √norm; for the difference of
    /// two links the norm is 2. `analysis::sector_modes` says more.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.weights.iter().map(|(_, weight)| weight * weight).sum()
    }

    /// Mean or difference of the links' values: Σ weight · value / norm.
    /// Links that `values` lacks count as zero.
    #[must_use]
    pub fn of(&self, values: &[f64]) -> f64 {
        let weighted = self.weights.iter().filter_map(|&(link, weight)| {
            let value = values.get(link)?;
            Some(weight * value)
        });
        weighted.sum::<f64>() / self.norm()
    }
}

/// The coordinates of one block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    /// `in_phase` for the means, else the name of the uppermost difference.
    pub name: &'static str,
    /// Its coordinates, from the root outwards.
    pub coordinates: &'static [SectorCoordinate],
}

/// A model whose sectors are known.
pub trait Sectors {
    /// The sectors: the means, then the differences, those of a branching before
    /// those of the branchings below it.
    /// Together they have as many coordinates as there are links.
    const SECTORS: &'static [Sector];
}

/// Energies of `S` sectors and what changes them: dE/dt = transfer + power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget<T, const S: usize> {
    /// E_s, in joules.
    pub energies: [T; S],
    /// W_s, what other sectors give, in watts.
    pub transfers: [T; S],
    /// P_s, what friction and drive give, in watts; negative where they take.
    pub powers: [T; S],
}

#[cfg(test)]
mod tests {
    use super::SectorCoordinate;

    #[test]
    fn norm_and_value_of_a_second_difference() {
        let difference = SectorCoordinate {
            name: "theta_d2",
            weights: &[(1, 1.0), (2, 1.0), (3, -2.0)],
        };
        assert_eq!(difference.norm(), 6.0);
        assert_eq!(difference.of(&[9.0, 1.0, 1.0, 1.0]), 0.0);
        assert_eq!(difference.of(&[0.0, 1.0, 1.0, -2.0]), 1.0);
    }
}
