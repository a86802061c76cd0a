//! Small motions in modes.

use alloc::vec::Vec;

use super::error::LinearError;
use super::matrix::{PreciseMatrix, largest, number};
use crate::scalar::{Double, Real, Scalar};

/// The linear model of small motions about an equilibrium: M q̈ + C q̇ + K q = Q with
/// masses M, friction and drag C, stiffness K of gravity and springs, and torques Q.
///
/// Motions are in the modes of M and K without friction. Friction couples those that it
/// must: modes in different sectors of a symmetric tree are not, nor is any where
/// friction is everywhere in proportion to mass or stiffness. All numbers are kept to
/// 30 digits until [`frames`](Self::frames) rounds them. Effort of construction and of
/// `frames` grows with the third power of the number of links, of which there may be
/// 1,000: a tenth of a second for 31.
///
/// The model is of time 0: a drive that moves later is left out.
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
    /// ω² of the modes, ascending.
    pub(super) squares: Vec<Double>,
    /// Shapes of the modes in columns, of modal mass 1.
    pub(super) shapes: PreciseMatrix,
    /// Shapes times masses, a mode a row: what turns angles into modes.
    pub(super) projections: PreciseMatrix,
    /// Friction between modes.
    pub(super) damping: PreciseMatrix,
    /// Friction below this, relative to the largest, is rounding.
    pub(super) rounding: f64,
    /// Number of modes that take part.
    pub(super) kept: usize,
    /// Measured error of each mode: see `measured`.
    pub(super) errors: Vec<[f64; 2]>,
}

/// Most links: matrices of so many rows take hours.
const MOST_LINKS: usize = 1000;

impl Linear {
    /// The model with these matrices, row by row: masses (kg m²), stiffness (N m/rad) and
    /// friction (N m s/rad), for coordinates that are zero at the equilibrium. What they
    /// describe is linear: no error is told.
    ///
    /// # Errors
    ///
    /// [`LinearError`] if they are not square, finite and symmetric, or if the masses are
    /// not positive definite.
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

    /// From mass, stiffness and damping of not too many links, whose entries have errors of `rounding`.
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
        // L⁻¹ K L⁻ᵀ
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

    /// Angles of the equilibrium, rad.
    #[must_use]
    pub fn equilibrium(&self) -> &[f64] {
        &self.equilibrium
    }

    /// Eigenfrequencies of the modes that take part, without friction, ascending, Hz.
    /// Zero for those of an unstable equilibrium that grow.
    #[must_use]
    pub fn frequencies_hz(&self) -> Vec<f64> {
        let frequency = |square: &Double| Real::max(square.high(), 0.0);
        let squares = self.squares[..self.kept].iter().map(frequency);
        squares
            .map(|square| Scalar::sqrt(square) / core::f64::consts::TAU)
            .collect()
    }

    /// Time (s) in which errors of the mode that friction lets live longest add up:
    /// 1/(2δ) where its amplitude decays as exp(−δ t), and with it the errors that it
    /// makes. Infinite without friction; of modes that friction couples, an estimate.
    #[must_use]
    pub fn fading_time(&self) -> f64 {
        (0..self.kept).fold(0.0, |longest, mode| {
            let half = 0.5 * self.damping.at(mode, mode).high();
            let rest = half * half - self.squares[mode].high();
            // Of two real rates the smaller one.
            let decay = half - Scalar::sqrt(Real::max(rest, 0.0));
            let time = if decay > 0.0 {
                0.5 / decay
            } else {
                f64::INFINITY
            };
            Real::max(longest, time)
        })
    }

    /// The model without the modes above a frequency (Hz). Friction between them and
    /// those that stay is left out with them.
    #[must_use]
    pub fn truncate(&self, highest_hz: f64) -> Self {
        let frequencies = self.frequencies_hz();
        let kept = frequencies.iter().filter(|&&f| f <= highest_hz).count();
        Self {
            kept,
            ..self.clone()
        }
    }

    /// Energy (J) of a state, of all modes, from the equilibrium: kinetic and potential,
    /// to second order. NaN for a state of another length.
    #[must_use]
    pub fn energy(&self, state: &[f64]) -> f64 {
        self.energy_of(0..self.squares.len(), state)
    }

    /// Energy (J) that a state has in the modes that [`truncate`](Self::truncate) has
    /// left out.
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

    /// The modes that take part, in groups that friction couples.
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

    /// exp(A h) of a group of modes, and its answer to constant torques on them. States
    /// are the coordinates of the group, followed by their rates.
    pub(super) fn propagator(&self, group: &[usize], frame: f64) -> (PreciseMatrix, PreciseMatrix) {
        let size = group.len();
        // Coordinates times their frequencies: then all have the size of the rates, and
        // the norm of A is as small as it can be.
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

/// Passes numbers of links whose matrices can be handled.
pub(super) fn check_size(links: usize) -> Result<(), LinearError> {
    if links > MOST_LINKS {
        return Err(LinearError::Size {
            links,
            most: MOST_LINKS,
        });
    }
    Ok(())
}
