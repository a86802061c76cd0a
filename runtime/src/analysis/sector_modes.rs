//! Splits the linear motion about an in-phase equilibrium into blocks, one for each sector.
//!
//! A sector is a set of coordinates between which and all others the tree's symmetry forbids linear
//! coupling. If all copies of a subtree have equal angles, the mass and stiffness matrices do not
//! couple sectors: in the coordinates of [`Sectors::sectors`] each sector has its own mass matrix,
//! stiffness matrix and linear modes, and the modes of all sectors together are those of the tree.
//! (A full binary tree of g generations has one sector of g coordinates and 2^(g−1−s) sectors of s
//! coordinates each, for s = 1 to g − 1.)
//!
//! # Normalisation
//!
//! A link's angle is Σ weight · coordinate. In the *plain* normalisation of
//! [`SectorCoordinate::weights`] the coordinates are means and (for two copies, half) differences:
//! q_j = Σ_i weight_ij θ_i / norm_j with norm_j = Σ_i weight_ij² ([`SectorCoordinate::norm`]). The
//! *orthonormal* coordinates are x_j = √norm_j · q_j. These are a rotation of the angles, so that Σ
//! x_j² = Σ θ_i². Momenta are multiplied by 1/√norm_j, and entry (j, k) of a matrix by 1/√(norm_j
//! norm_k). Frequencies do not depend on the choice; sizes of entries in different blocks can be
//! compared in the orthonormal coordinates only, which is why the blocks here use them.
//!
//! [`Sectors::sectors`]: crate::Sectors::sectors

use nalgebra::DMatrix;

use super::modes::{Modes, ModesError, symmetric_matrix};
use crate::errors::errors;
use crate::sectors::{Sector, SectorCoordinate};

/// Mass, stiffness and linear modes of one sector, in orthonormal coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorBlock {
    /// Name of the sector.
    pub name: String,
    /// Names of the sector's coordinates, in the order of rows and columns.
    pub coordinates: Vec<String>,
    /// Block of the mass matrix, row by row, kg m².
    pub mass: Vec<Vec<f64>>,
    /// Block of the stiffness matrix, row by row, N m/rad.
    pub stiffness: Vec<Vec<f64>>,
    /// Linear modes within the block. Their shapes are in orthonormal coordinates: a component
    /// divided by the square root of its coordinate's norm is the component in the plain
    /// coordinate.
    pub modes: Modes,
}

/// Blocks of a tree's mass and stiffness matrices about an in-phase equilibrium, with the modes of
/// each.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorModes {
    /// The blocks, one for each sector, in the order of the sectors.
    pub blocks: Vec<SectorBlock>,
    /// Largest absolute entry of the mass matrix between two sectors, over the largest of all
    /// entries, both in orthonormal coordinates. It is only rounding if the equilibrium is in
    /// phase.
    pub mass_off_block: f64,
    /// Largest absolute entry of the stiffness matrix between two sectors, divided by the largest
    /// of all its entries; zero if all entries are zero.
    pub stiffness_off_block: f64,
}

impl SectorModes {
    /// Splits `mass` (kg m²) and `stiffness` (N m/rad), both row by row and for absolute angles at
    /// an in-phase equilibrium, into the blocks of `sectors`.
    ///
    /// Entries between sectors are left out of the blocks; [`mass_off_block`](Self::mass_off_block)
    /// and [`stiffness_off_block`](Self::stiffness_off_block) report them: check these if the
    /// equilibrium might not be in phase. [`AtRest::sector_modes`](super::AtRest::sector_modes)
    /// also checks that the angles are an equilibrium. The effort grows as n³ with n links.
    ///
    /// # Errors
    ///
    /// [`SectorModesError`] if the matrices are not square, finite and symmetric of one size, if
    /// the sectors' coordinates are not an orthogonal basis for that number of links, or if a block
    /// has no modes.
    ///
    /// # Examples
    ///
    /// The pendulum of the paper has two modes in phase and one antiphase mode, in which the parent
    /// stays at rest.
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::analysis::SectorModes;
    /// use branched_pendulum::{Sectors, prelude::*};
    ///
    /// #[branched_pendulum(
    ///     gravity = 9.80665,
    ///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    ///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ///     ],
    ///     emit(modes, budget(rest)),
    /// )]
    /// struct BranchedDouble;
    ///
    /// let model = BranchedDouble::<f64>::new();
    /// let (mass, stiffness) = (model.mass_matrix(&[0.0; 3]), model.stiffness_matrix(&[0.0; 3]));
    /// let modes = SectorModes::new(BranchedDouble::<f64>::SECTORS, &mass, &stiffness)?;
    /// let [in_phase, antiphase] = modes.blocks.as_slice() else { unreachable!() };
    /// assert_eq!(in_phase.coordinates, ["theta_parent", "theta_m"]);
    /// assert!((in_phase.modes.frequencies_hz[0] - 0.8731696).abs() < 1e-7);
    /// assert!((in_phase.modes.frequencies_hz[1] - 1.5825567).abs() < 1e-7);
    /// assert_eq!(antiphase.coordinates, ["theta_d"]);
    /// assert!((antiphase.modes.frequencies_hz[0] - 1.2580584).abs() < 1e-7);
    /// assert!(modes.mass_off_block < 1e-15 && modes.stiffness_off_block < 1e-15);
    /// # Ok::<(), branched_pendulum::analysis::SectorModesError>(())
    /// ```
    pub fn new<R: AsRef<[f64]>>(
        sectors: &[Sector],
        mass: &[R],
        stiffness: &[R],
    ) -> Result<Self, SectorModesError> {
        let mass = symmetric_matrix("mass", mass)?;
        let stiffness = symmetric_matrix("stiffness", stiffness)?;
        let links = mass.nrows();
        if stiffness.nrows() != links {
            return Err(SectorModesError::Matrices(ModesError::SizeMismatch {
                mass: links,
                stiffness: stiffness.nrows(),
            }));
        }
        let basis = orthonormal_basis(sectors, links)?;
        let mass = in_coordinates(&basis, &mass);
        let stiffness = in_coordinates(&basis, &stiffness);
        let mut blocks = Vec::with_capacity(sectors.len());
        let mut start = 0;
        for sector in sectors {
            let size = sector.coordinates().len();
            let [mass, stiffness] = [&mass, &stiffness].map(|matrix| block(matrix, start, size));
            let modes =
                Modes::new(&mass, &stiffness).map_err(|source| SectorModesError::Sector {
                    sector: sector.name().to_owned(),
                    source,
                })?;
            let names = sector.coordinates().iter().map(|own| own.name().to_owned());
            blocks.push(SectorBlock {
                name: sector.name().to_owned(),
                coordinates: names.collect(),
                mass,
                stiffness,
                modes,
            });
            start += size;
        }
        Ok(Self {
            blocks,
            mass_off_block: off_block(&mass, sectors),
            stiffness_off_block: off_block(&stiffness, sectors),
        })
    }

    /// Returns the frequencies (Hz) of all blocks, ascending: those of the whole tree.
    #[must_use]
    pub fn frequencies_hz(&self) -> Vec<f64> {
        let blocks = self.blocks.iter();
        let mut frequencies: Vec<f64> = blocks
            .flat_map(|block| block.modes.frequencies_hz.iter().copied())
            .collect();
        frequencies.sort_by(f64::total_cmp);
        frequencies
    }
}

/// Largest cosine of the angle between two coordinates that still count as orthogonal; rounding of
/// the weights causes far less.
const SKEWNESS: f64 = 1e-12;

/// Returns the matrix Q of the orthonormal coordinates: one column per coordinate, sector by
/// sector.
fn orthonormal_basis(sectors: &[Sector], links: usize) -> Result<DMatrix<f64>, SectorModesError> {
    let coordinates: Vec<&SectorCoordinate> =
        sectors.iter().flat_map(Sector::coordinates).collect();
    if coordinates.len() != links {
        return Err(SectorModesError::Count {
            coordinates: coordinates.len(),
            links,
        });
    }
    let mut basis = DMatrix::<f64>::zeros(links, links);
    for (column, coordinate) in coordinates.iter().enumerate() {
        let root = coordinate.norm().sqrt();
        if !(root.is_finite() && root > 0.0) {
            let coordinate = coordinate.name().to_owned();
            return Err(SectorModesError::Weights { coordinate });
        }
        for &(link, weight) in coordinate.weights() {
            let entry = basis
                .get_mut((link, column))
                .ok_or(SectorModesError::Link {
                    coordinate: coordinate.name().to_owned(),
                    link,
                    links,
                })?;
            *entry += weight / root;
        }
        for (other, first) in coordinates.iter().enumerate().take(column) {
            if basis.column(column).dot(&basis.column(other)).abs() > SKEWNESS {
                return Err(SectorModesError::NotOrthogonal {
                    first: first.name().to_owned(),
                    second: coordinate.name().to_owned(),
                });
            }
        }
    }
    Ok(basis)
}

/// Returns Qᵀ A Q for Q = `basis` and A = `matrix`, made exactly symmetric.
fn in_coordinates(basis: &DMatrix<f64>, matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let whole = basis.transpose() * matrix * basis;
    (&whole + whole.transpose()) * 0.5
}

fn block(matrix: &DMatrix<f64>, start: usize, size: usize) -> Vec<Vec<f64>> {
    let rows = matrix.view((start, start), (size, size));
    rows.row_iter()
        .map(|row| row.iter().copied().collect())
        .collect()
}

fn off_block(matrix: &DMatrix<f64>, sectors: &[Sector]) -> f64 {
    let scale = matrix.amax();
    if scale == 0.0 {
        return 0.0;
    }
    let mut largest = 0.0_f64;
    let mut start = 0;
    for sector in sectors {
        let end = start + sector.coordinates().len();
        let beside = matrix.view((end, start), (matrix.nrows() - end, end - start));
        largest = beside.iter().fold(largest, |most, x| most.max(x.abs()));
        start = end;
    }
    largest / scale
}

errors! {
    /// Reason why the modes of a tree cannot be computed sector by sector.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum SectorModesError {
        /// The mass matrix or the stiffness matrix is invalid.
        Matrices(error: ModesError) => "the matrices cannot be split into sectors",
        /// The number of coordinates of the sectors is not the number of rows of the matrices.
        Count {
            /// Number of coordinates in all sectors.
            coordinates: usize,
            /// Number of rows of the matrices, one for each link.
            links: usize,
        } => "the sectors have {coordinates} coordinates, but the matrices have {links} rows: \
            the numbers must be equal",
        /// The weights of a coordinate are all zero, or one is not finite.
        Weights {
            /// Name of the coordinate.
            coordinate: String,
        } => "the weights of `{coordinate}` are zero or not finite",
        /// A coordinate has a weight for a link that is not in the matrices.
        Link {
            /// Name of the coordinate.
            coordinate: String,
            /// Index of the link.
            link: usize,
            /// Number of rows of the matrices.
            links: usize,
        } => "coordinate `{coordinate}` has a weight for link {link}, but the matrices have only \
            {links} rows",
        /// Two coordinates are not orthogonal.
        NotOrthogonal {
            /// Name of the first coordinate.
            first: String,
            /// Name of the second coordinate.
            second: String,
        } => "the coordinates `{first}` and `{second}` are not orthogonal",
        /// A block has no modes.
        Sector {
            /// Name of the sector.
            sector: String,
            /// Reason why the block has no modes.
            source: ModesError,
        } => "the linear modes of sector `{sector}` could not be computed",
    }
}

impl From<ModesError> for SectorModesError {
    fn from(source: ModesError) -> Self {
        Self::Matrices(source)
    }
}

impl core::error::Error for SectorModesError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Matrices(source) | Self::Sector { sector: _, source } => Some(source),
            Self::Count { .. }
            | Self::Weights { .. }
            | Self::Link { .. }
            | Self::NotOrthogonal { .. } => None,
        }
    }
}
