//! Linear model of small motions about an equilibrium, computed in modes.

use alloc::vec::Vec;

use super::error::LinearError;
use super::matrix::{PreciseMatrix, largest, number};
use crate::scalar::{Double, Real, Scalar};

/// The linear model of small motions about an equilibrium: M q̈ + C q̇ + K q = Q with the mass
/// matrix M, the matrix C of friction and drag, the stiffness matrix K of gravity and springs, and
/// torques Q.
///
/// Motions are computed in the modes of M and K without friction. Friction couples some of the
/// modes: never modes in different sectors of a symmetric tree (sets of coordinates between which
/// its symmetry forbids linear coupling), and none if friction is proportional to mass or
/// stiffness. All numbers are kept to 30 digits until [`frames`](Self::frames) rounds them. The
/// effort of construction and of `frames` grows with the third power of the number of links: a
/// tenth of a second for 31 links. At most 1,000 links are accepted.
///
/// The model holds at time 0: a drive that starts later is left out.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::approximate::{Approximation, Linear};
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5, friction = 0.01) [
///         twig: rod(mass = 0.1, length = 0.3, friction = 0.001) * 2
///     ],
///     emit(energies),
/// )]
/// struct Branch;
///
/// let branch = Branch::<f64>::new();
/// let linear = Linear::about(&branch, &[0.0; 3])?;
/// assert_eq!(linear.frequencies_hz().len(), 3);
///
/// // A second in frames, all links at 3 degrees.
/// let mut frames = linear.frames(1.0 / 60.0)?;
/// let mut state = [0.05, 0.05, 0.05, 0.0, 0.0, 0.0];
/// let estimate = frames.error(&state);
/// for _ in 0..60 {
///     frames.step(&mut state);
/// }
/// let start = State::at_rest(0.0, &[0.05; 3]);
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let full = method.run(&AbsoluteAngles(&branch), &start, 1.0)?;
/// let error = (state[0] - full.state.values[0]).abs();
/// assert!(error < estimate && estimate < 1e-3);
///
/// // The slow modes alone, in single precision.
/// let slow = linear.truncate(1.5);
/// assert!(slow.frequencies_hz().len() < 3 && slow.frames::<f32>(1.0 / 60.0).is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    pub(super) equilibrium: Vec<f64>,
    /// Squared angular frequencies ω² (1/s²) of the modes, ascending.
    pub(super) squares: Vec<Double>,
    /// Shapes of the modes, one per column, normalised to modal mass 1.
    pub(super) shapes: PreciseMatrix,
    /// Transposed shapes times the mass matrix, one row per mode: the matrix that converts angles
    /// to mode coordinates.
    pub(super) projections: PreciseMatrix,
    /// Friction matrix in mode coordinates.
    pub(super) damping: PreciseMatrix,
    /// Size, relative to the largest entry, below which an entry of the friction matrix counts as
    /// rounding.
    pub(super) rounding: f64,
    /// Number of kept modes, which are the slowest ones.
    pub(super) kept: usize,
    /// Measured error coefficients E₁ and E₂ of each mode, defined in `measured`.
    pub(super) errors: Vec<[f64; 2]>,
}

/// Largest accepted number of links; larger matrices would take hours.
const MOST_LINKS: usize = 1000;

impl Linear {
    /// Returns the model with these matrices, given row by row: mass (kg m²), stiffness (N m/rad)
    /// and friction (N m s/rad), for coordinates that are zero at the equilibrium. The system is
    /// assumed to be linear, so the estimated errors of its modes are zero.
    ///
    /// # Errors
    ///
    /// [`LinearError`] if the matrices are not square, finite and symmetric, or if the mass matrix
    /// is not positive definite.
    pub fn of_matrices<R: AsRef<[f64]>>(
        mass: &[R],
        stiffness: &[R],
        damping: &[R],
    ) -> Result<Self, LinearError> {
        let n = mass.len();
        check_size(n)?;
        let read = |name, rows: &[R]| {
            let lengths = rows.iter().map(|row| row.as_ref().len());
            match core::iter::once(rows.len())
                .chain(lengths)
                .find(|&l| l != n)
            {
                Some(found) => Err(LinearError::Length {
                    name,
                    expected: n,
                    found,
                }),
                None => Ok(PreciseMatrix::new(n, n, |i, j| number(rows[i].as_ref()[j]))),
            }
        };
        let matrices = [
            read("mass", mass)?,
            read("stiffness", stiffness)?,
            read("damping", damping)?,
        ];
        Self::new(alloc::vec![0.0; n], matrices, f64::EPSILON)
    }

    /// Returns the model from the matrices of mass, stiffness and damping, whose entries have
    /// relative errors of `rounding`. The caller has checked the number of links.
    pub(super) fn new(
        equilibrium: Vec<f64>,
        [mass, stiffness, damping]: [PreciseMatrix; 3],
        rounding: f64,
    ) -> Result<Self, LinearError> {
        let n = equilibrium.len();
        let sizes = [&mass, &stiffness, &damping].map(PreciseMatrix::size);
        if n == 0 || !sizes.iter().all(|size| size.is_finite()) {
            return Err(LinearError::NotFinite);
        }
        let stiffness = stiffness.symmetrised("stiffness")?;
        let damping = damping.symmetrised("damping")?;
        let lower = mass
            .cholesky()
            .ok_or(LinearError::MassNotPositiveDefinite)?;
        // L⁻¹ K L⁻ᵀ, with M = L Lᵀ.
        let half = lower.solve_lower(stiffness).transposed();
        let (squares, vectors) = lower.solve_lower(half).eigen();
        let shapes = lower.solve_upper(vectors);
        let projections = shapes.transposed().times(&mass);
        let damping = shapes.transposed().times(&damping.times(&shapes));
        let finite = largest(&squares).is_finite() && projections.size().is_finite();
        if !finite || !damping.size().is_finite() {
            return Err(LinearError::NotFinite);
        }
        Ok(Self {
            equilibrium,
            squares,
            shapes,
            projections,
            damping,
            rounding,
            kept: n,
            errors: alloc::vec![[0.0; 2]; n],
        })
    }

    /// Returns the angles of the equilibrium, rad.
    #[must_use]
    pub fn equilibrium(&self) -> &[f64] {
        &self.equilibrium
    }

    /// Returns the eigenfrequencies (Hz) of the kept modes without friction, in ascending order.
    /// For a mode that grows, about an unstable equilibrium, it is 0.
    #[must_use]
    pub fn frequencies_hz(&self) -> Vec<f64> {
        let frequency = |square: &Double| Real::max(square.high(), 0.0);
        let squares = self.squares[..self.kept].iter().map(frequency);
        squares
            .map(|square| Scalar::sqrt(square) / core::f64::consts::TAU)
            .collect()
    }

    /// Returns the time (s) over which errors accumulate. It is 1/(2δ) for the mode with the
    /// slowest decay, whose amplitude decays as exp(−δ t) together with its errors. It is infinite
    /// without friction, and only an estimate if friction couples modes.
    #[must_use]
    pub fn fading_time(&self) -> f64 {
        (0..self.kept).fold(0.0, |longest, mode| {
            let half = 0.5 * self.damping.at(mode, mode).high();
            let rest = half * half - self.squares[mode].high();
            // The smaller of the two decay rates of an overdamped mode.
            let decay = half - Scalar::sqrt(Real::max(rest, 0.0));
            let time = if decay > 0.0 {
                0.5 / decay
            } else {
                f64::INFINITY
            };
            Real::max(longest, time)
        })
    }

    /// Returns the model without the modes above the frequency `highest_hz` (Hz). Friction that
    /// couples them to the kept modes is dropped too.
    #[must_use]
    pub fn truncate(&self, highest_hz: f64) -> Self {
        let frequencies = self.frequencies_hz();
        let kept = frequencies.iter().filter(|&&f| f <= highest_hz).count();
        Self {
            kept,
            ..self.clone()
        }
    }

    /// Returns the energy (J) of a state in all modes, relative to the equilibrium: kinetic and
    /// potential, to second order. NaN for a state of a wrong length.
    #[must_use]
    pub fn energy(&self, state: &[f64]) -> f64 {
        self.energy_of(0..self.squares.len(), state)
    }

    /// Returns the energy (J) of a state in the modes that [`truncate`](Self::truncate) has left
    /// out.
    #[must_use]
    pub fn dropped_energy(&self, state: &[f64]) -> f64 {
        self.energy_of(self.kept..self.squares.len(), state)
    }

    fn energy_of(&self, modes: core::ops::Range<usize>, state: &[f64]) -> f64 {
        let n = self.equilibrium.len();
        if state.len() != 2 * n {
            return f64::NAN;
        }
        let (theta, omega) = state.split_at(n);
        modes.fold(0.0, |sum, mode| {
            let row = self.projections.row(mode).iter();
            let (mut q, mut rate) = (0.0, 0.0);
            for (link, projection) in row.enumerate() {
                q += projection.high() * (theta[link] - self.equilibrium[link]);
                rate += projection.high() * omega[link];
            }
            sum + 0.5 * (rate * rate + self.squares[mode].high() * q * q)
        })
    }

    /// Returns the indices of the kept modes, grouped so that friction couples only modes within a
    /// group.
    pub(super) fn groups(&self) -> Vec<Vec<usize>> {
        let negligible = self.rounding * self.damping.size();
        let mut open: Vec<usize> = (0..self.kept).collect();
        let mut groups = Vec::new();
        while let Some(&first) = open.first() {
            let mut group = alloc::vec![first];
            open.remove(0);
            let mut next = 0;
            while let Some(&mode) = group.get(next) {
                let coupled =
                    |&other: &usize| self.damping.at(mode, other).high().abs() > negligible;
                group.extend(open.iter().copied().filter(coupled));
                open.retain(|other| !coupled(other));
                next += 1;
            }
            group.sort_unstable();
            groups.push(group);
        }
        groups
    }

    /// Returns exp(A h) for a group of modes, with the matrix A of its equations and the length h
    /// (s) of a frame, and the matrix of its response to constant torques on the modes. States
    /// consist of the coordinates of the group, then their rates.
    pub(super) fn propagator(&self, group: &[usize], frame: f64) -> (PreciseMatrix, PreciseMatrix) {
        let size = group.len();
        // Coordinates times their frequencies: they then have the size of the rates, and the norm
        // of A is as small as it can be.
        let scale = |k: usize| {
            let square = self.squares[group[k]].high().abs();
            Real::max(Scalar::sqrt(square), 1e-3 / frame)
        };
        let matrix = PreciseMatrix::new(2 * size, 2 * size, |row, column| {
            let (i, j) = (row % size, column % size);
            match (row < size, column < size) {
                (true, false) if i == j => number(scale(i)),
                (false, true) if i == j => -(self.squares[group[i]] / number(scale(i))),
                (false, false) => -self.damping.at(group[i], group[j]),
                _ => number(0.0),
            }
        });
        let input = PreciseMatrix::new(2 * size, size, |row, column| {
            number(f64::from(u8::from(row == size + column)))
        });
        let (propagator, response) = matrix.exponential(frame, input);
        let factor = |row: usize| number(if row < size { scale(row) } else { 1.0 });
        let propagator = PreciseMatrix::new(2 * size, 2 * size, |row, column| {
            propagator.at(row, column) * factor(column) / factor(row)
        });
        let response = PreciseMatrix::new(2 * size, size, |row, column| {
            response.at(row, column) / factor(row)
        });
        (propagator, response)
    }
}

/// Returns an error if matrices for this number of links would be too large.
pub(super) fn check_size(links: usize) -> Result<(), LinearError> {
    if links > MOST_LINKS {
        return Err(LinearError::Size {
            links,
            most: MOST_LINKS,
        });
    }
    Ok(())
}
