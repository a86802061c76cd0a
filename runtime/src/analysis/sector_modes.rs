//! The blocks into which an in-phase equilibrium splits the linear motion.
//!
//! Where all copies of a subtree stand alike, mass and stiffness matrix couple
//! no two sectors: in the coordinates of [`Sectors::sectors`] each sector has a
//! mass matrix, a stiffness matrix and linear modes of its own, and the modes
//! of all sectors together are those of the tree. (A full binary tree of g
//! generations has one sector of g coordinates and 2^(g−1−s) of s each for
//! s = 1 to g − 1.)
//!
//! # Normalisation
//!
//! A link's angle is Σ weight · coordinate. In the *plain* normalisation of
//! [`SectorCoordinate::weights`] the coordinates are means and (for two copies,
//! half) differences: q_j = Σ_i weight_ij θ_i / norm_j with norm_j = Σ_i
//! weight_ij² ([`SectorCoordinate::norm`]). The *orthonormal* coordinates are
//! x_j = √norm_j · q_j. These are the image of the angles under a rotation, so
//! that squares sum: Σ x_j² = Σ θ_i². Momenta go the other way, by 1/√norm_j,
//! and entry (j, k) of a matrix by 1/√(norm_j norm_k). Frequencies do not
//! depend on the choice; sizes of entries in different blocks compare in the
//! orthonormal one only, which is why the blocks here use it.
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
    /// Names of its coordinates, in the order of rows and columns.
    pub coordinates: Vec<String>,
    /// Block of the mass matrix by rows, kg m².
    pub mass: Vec<Vec<f64>>,
    /// Block of the stiffness matrix by rows, N m/rad.
    pub stiffness: Vec<Vec<f64>>,
    /// Modes within the block. Their shapes are in orthonormal coordinates:
    /// divided by the root of a coordinate's norm, a component is that of the
    /// plain coordinate.
    pub modes: Modes,
}

/// The block structure of a tree about an in-phase equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorModes {
    /// One block for each sector, in their order.
    pub blocks: Vec<SectorBlock>,
    /// Largest absolute entry of the mass matrix between two sectors, over the
    /// largest of all entries, both in orthonormal coordinates: rounding where
    /// the equilibrium is in phase.
    pub mass_off_block: f64,
    /// Largest absolute entry of the stiffness matrix between two sectors, over
    /// the largest of all; zero where that is zero.
    pub stiffness_off_block: f64,
}

impl SectorModes {
    /// Splits `mass` (kg m²) and `stiffness` (N m/rad), both by rows and for
    /// absolute angles at an in-phase equilibrium, into the blocks of `sectors`.
    ///
    /// Entries between sectors are left out of the blocks and reported as
    /// [`mass_off_block`](Self::mass_off_block) and
    /// [`stiffness_off_block`](Self::stiffness_off_block): look at them where
    /// the equilibrium might not be in phase. Whether the angles are an equilibrium
    /// at all, [`AtRest::sector_modes`](super::AtRest::sector_modes) asks. Effort grows as n³ with n links.
    ///
    /// # Errors
    ///
    /// [`SectorModesError`] if the matrices are not square, finite and symmetric
    /// of one size, if the sectors' coordinates are not an orthogonal basis for
    /// that many links, or if a block has no modes.
    ///
    /// # Examples
    ///
    /// The pendulum of the paper: two modes in phase and one antiphase mode, in
    /// which the parent rests.
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

    /// Frequencies of all blocks in hertz, ascending: those of the whole tree.
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

/// Cosine of the angle between two coordinates above which they are refused as
/// not orthogonal: rounding of the weights leaves far less.
const SKEWNESS: f64 = 1e-12;

/// One column for each coordinate, sector after sector.
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

/// Qᵀ A Q, symmetric to the last bit.
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
    /// Why a tree has no modes sector by sector.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum SectorModesError {
        /// Mass or stiffness matrix is not what it must be.
        Matrices(error: ModesError) => "the matrices cannot be split into sectors",
        /// The sectors have not as many coordinates as the matrices have rows.
        Count {
            /// Coordinates of all sectors.
            coordinates: usize,
            /// Rows of the matrices, one for each link.
            links: usize,
        } => "the sectors have {coordinates} coordinates and the matrices {links} rows",
        /// The weights of a coordinate are all zero, or not finite.
        Weights {
            /// The coordinate.
            coordinate: String,
        } => "the weights of `{coordinate}` are zero or not finite",
        /// A coordinate weighs a link that the matrices lack.
        Link {
            /// The coordinate.
            coordinate: String,
            /// Index of the link.
            link: usize,
            /// Rows of the matrices.
            links: usize,
        } => "`{coordinate}` weighs link {link}, but the matrices have {links} rows",
        /// Two coordinates are not orthogonal.
        NotOrthogonal {
            /// The one.
            first: String,
            /// The other.
            second: String,
        } => "`{first}` and `{second}` are not orthogonal",
        /// A block has no modes.
        Sector {
            /// Name of the sector.
            sector: String,
            /// Why.
            source: ModesError,
        } => "the sector `{sector}` has no linear modes",
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
            _ => None,
        }
    }
}
