//! Exact propagation of the linear model, frame by frame.

use alloc::vec;
use alloc::vec::Vec;

use super::error::LinearError;
use super::linear::Linear;
use super::matrix::PreciseMatrix;
use super::{Approximation, ForcedApproximation};
use crate::scalar::{Double, Real, Scalar};

/// A [`Linear`] model with its exact propagation over frames of one length.
///
/// [`step`](Approximation::step) advances a full state by one frame. For many frames it is cheaper
/// to keep the motion in modes: call [`set_state`](Self::set_state) once,
/// [`advance`](Self::advance) for each frame, and read angles or the whole state when they are
/// needed.
///
/// Number of multiplications for m modes of n links: a frame takes 4b² for each group of b modes
/// that friction couples: 4m if no modes are coupled, at most 4m². Reading the angles takes mn;
/// setting or reading a state takes 2mn; torques take mn, and 2b² for each group. Nothing is
/// allocated after construction.
///
/// Without friction and torques, the energy of the model is conserved to rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearFrames<T> {
    frame: T,
    links: usize,
    equilibrium: Vec<T>,
    groups: Vec<CoupledModes<T>>,
    /// Shapes of the kept modes, in the order of the groups.
    shapes: Vec<T>,
    /// Projections of angles onto all modes, one row per mode; the kept modes come first.
    projections: Vec<T>,
    estimates: Vec<ModeError<T>>,
    /// Coordinates and rates of the modes, group by group, at the present frame and at the next
    /// one.
    now: Vec<T>,
    next: Vec<T>,
    forces: Vec<T>,
}

/// A group of modes that friction couples.
#[derive(Clone, Debug, PartialEq)]
struct CoupledModes<T> {
    size: usize,
    /// Matrix (column by column) that advances the coordinates and rates of the group by one frame.
    propagator: Vec<T>,
    /// Matrix (column by column) from constant torques on the modes to the change of the group's
    /// coordinates and rates in one frame.
    response: Vec<T>,
}

/// Numbers from which the error of one mode is estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ModeError<T> {
    /// Factor that converts a rate of the mode to an amplitude, in s.
    per_rate: T,
    /// Largest absolute component of the mode's shape.
    peak: T,
    /// Coefficients of the relative error as a function of the amplitude: of its first and of its
    /// second power.
    errors: [T; 2],
}

impl Linear {
    /// Prepares the model for frames of length `frame` (s), in numbers of type `T`. The matrix
    /// exponential is computed in double-double numbers and rounded once.
    ///
    /// # Errors
    ///
    /// [`LinearError::Frame`] if the frame is not positive and finite; [`LinearError::NotFinite`]
    /// if the motion overflows within one frame.
    pub fn frames<T: Real>(&self, frame: f64) -> Result<LinearFrames<T>, LinearError> {
        LinearFrames::new(self, frame)
    }
}

impl<T: Real> LinearFrames<T> {
    pub(super) fn new(linear: &Linear, frame: f64) -> Result<Self, LinearError> {
        if !(frame.is_finite() && frame > 0.0) {
            return Err(LinearError::Frame { value: frame });
        }
        let rounded = |value: Double| T::from_parts(value.high(), value.low());
        let by_columns = |matrix: &PreciseMatrix| -> Vec<T> {
            let columns = matrix.transposed();
            columns.entries().iter().copied().map(rounded).collect()
        };
        let groups = linear.groups();
        let mut order: Vec<usize> = groups.iter().flatten().copied().collect();
        let group = |modes: &Vec<usize>| {
            let (propagator, response) = linear.propagator(modes, frame);
            CoupledModes {
                size: modes.len(),
                propagator: by_columns(&propagator),
                response: by_columns(&response),
            }
        };
        let groups: Vec<CoupledModes<T>> = groups.iter().map(group).collect();
        let finite =
            |group: &CoupledModes<T>| group.propagator.iter().all(|entry| entry.is_finite());
        if !groups.iter().all(finite) {
            return Err(LinearError::NotFinite);
        }
        let kept = order.len();
        let links = linear.equilibrium.len();
        let shapes = linear.shapes.transposed();
        let shape = |&mode: &usize| shapes.row(mode).iter().copied().map(rounded);
        let kept_shapes = order.iter().flat_map(shape).collect();
        order.extend(kept..links);
        let projection = |&mode: &usize| linear.projections.row(mode).iter().copied().map(rounded);
        Ok(Self {
            frame: T::from_f64(frame),
            links,
            equilibrium: linear.equilibrium.iter().map(|&a| T::from_f64(a)).collect(),
            groups,
            shapes: kept_shapes,
            projections: order.iter().flat_map(projection).collect(),
            estimates: order
                .iter()
                .map(|&mode| ModeError::new(linear, mode))
                .collect(),
            now: vec![T::ZERO; 2 * kept],
            next: vec![T::ZERO; 2 * kept],
            forces: vec![T::ZERO; kept],
        })
    }

    /// Returns the number of kept modes.
    pub fn modes(&self) -> usize {
        self.forces.len()
    }

    /// Iterates over the groups of modes that friction couples, and returns the number of modes in
    /// each.
    pub fn group_sizes(&self) -> impl Iterator<Item = usize> {
        self.groups.iter().map(|group| group.size)
    }

    /// Sets the motion to a full state (angles in rad, then angular velocities in rad/s). Only its
    /// part in the kept modes remains.
    pub fn set_state(&mut self, state: &[T]) {
        if state.len() != 2 * self.links {
            self.now.fill(T::NAN);
            return;
        }
        let mut projections = self.projections.chunks_exact(self.links);
        let (theta, omega) = state.split_at(self.links);
        let mut now = &mut self.now[..];
        for group in &self.groups {
            let (own, rest) = now.split_at_mut(2 * group.size);
            let (coordinates, rates) = own.split_at_mut(group.size);
            let modes = coordinates.iter_mut().zip(rates).zip(&mut projections);
            for ((coordinate, rate), row) in modes {
                *coordinate = product(row, theta, &self.equilibrium);
                *rate = product(row, omega, &[]);
            }
            now = rest;
        }
    }

    /// Advances the motion by one frame.
    pub fn advance(&mut self) {
        self.propagate();
        core::mem::swap(&mut self.now, &mut self.next);
    }

    /// Advances the motion by one frame under torques (N m) on the links that stay constant during
    /// it.
    pub fn advance_under(&mut self, torques: &[T]) {
        if torques.len() != self.links {
            self.now.fill(T::NAN);
            return;
        }
        let shapes = self.shapes.chunks_exact(self.links);
        for (force, shape) in self.forces.iter_mut().zip(shapes) {
            *force = product(shape, torques, &[]);
        }
        self.propagate();
        let (mut next, mut forces) = (&mut self.next[..], &self.forces[..]);
        for group in &self.groups {
            let (own, rest) = next.split_at_mut(2 * group.size);
            let (pushing, others) = forces.split_at(group.size);
            add_columns(own, &group.response, pushing);
            (next, forces) = (rest, others);
        }
        core::mem::swap(&mut self.now, &mut self.next);
    }

    fn propagate(&mut self) {
        let (mut now, mut next) = (&self.now[..], &mut self.next[..]);
        for group in &self.groups {
            let (own, others) = now.split_at(2 * group.size);
            let (moved, rest) = next.split_at_mut(2 * group.size);
            moved.fill(T::ZERO);
            add_columns(moved, &group.propagator, own);
            (now, next) = (others, rest);
        }
    }

    /// Writes the angles (rad) of all links; NaN if `angles` has another length.
    pub fn angles_into(&self, angles: &mut [T]) {
        if angles.len() != self.links {
            angles.fill(T::NAN);
            return;
        }
        angles.copy_from_slice(&self.equilibrium);
        self.add_shapes(angles, 0);
    }

    /// Writes the full state: angles (rad) of all links, then their angular velocities (rad/s).
    pub fn state_into(&self, state: &mut [T]) {
        if state.len() != 2 * self.links {
            state.fill(T::NAN);
            return;
        }
        let (theta, omega) = state.split_at_mut(self.links);
        self.angles_into(theta);
        omega.fill(T::ZERO);
        self.add_shapes(omega, 1);
    }

    /// Adds the motion of all links to `sums`: the shapes of the modes times their coordinates (if
    /// `half` is 0) or their rates (if `half` is 1).
    fn add_shapes(&self, sums: &mut [T], half: usize) {
        let (mut now, mut shapes) = (&self.now[..], &self.shapes[..]);
        for group in &self.groups {
            let (own, others) = now.split_at(2 * group.size);
            let (columns, rest) = shapes.split_at(group.size * self.links);
            add_columns(sums, columns, &own[half * group.size..][..group.size]);
            (now, shapes) = (others, rest);
        }
    }

    /// Returns the estimated error of the linear model at a state, and the amplitude of the state,
    /// both in rad.
    fn estimate(&self, state: &[T]) -> (T, T) {
        if state.len() != 2 * self.links {
            return (T::NAN, T::NAN);
        }
        let (theta, omega) = state.split_at(self.links);
        let rows = self.projections.chunks_exact(self.links);
        // Sums of squares: `all` of all amplitudes, `dropped` of those of the modes that are left
        // out, and `by_errors` of those of the kept modes times E₁², E₁E₂ and E₂², the coefficients
        // of their errors.
        let (mut all, mut dropped, mut by_errors) = (T::ZERO, T::ZERO, [T::ZERO; 3]);
        for (number, (row, estimate)) in rows.zip(&self.estimates).enumerate() {
            let coordinate = product(row, theta, &self.equilibrium);
            let rate = estimate.per_rate * product(row, omega, &[]);
            let peak = estimate.peak * estimate.peak;
            let square = peak * (coordinate * coordinate + rate * rate);
            all += square;
            if number < self.modes() {
                let [first, second] = estimate.errors;
                by_errors[0] += square * first * first;
                by_errors[1] += square * first * second;
                by_errors[2] += square * second * second;
            } else {
                dropped += square;
            }
        }
        let amplitude = all.sqrt();
        let [first, mixed, second] = by_errors;
        let two = T::from_f64(2.0);
        let curved = all * (first + amplitude * (two * mixed + amplitude * second));
        ((dropped + curved).sqrt(), amplitude)
    }
}

impl<T: Real> Approximation<T> for LinearFrames<T> {
    fn frame(&self) -> T {
        self.frame
    }

    fn step(&mut self, state: &mut [T]) {
        self.set_state(state);
        self.advance();
        self.state_into(state);
    }

    fn validity(&self, state: &[T]) -> T {
        let (error, amplitude) = self.estimate(state);
        if amplitude == T::ZERO {
            error
        } else {
            error / amplitude
        }
    }

    fn error(&self, state: &[T]) -> T {
        self.estimate(state).0
    }
}

impl<T: Real> ForcedApproximation<T> for LinearFrames<T> {
    fn step_under(&mut self, state: &mut [T], torques: &[T]) {
        self.set_state(state);
        self.advance_under(torques);
        self.state_into(state);
    }
}

impl<T: Real> ModeError<T> {
    fn new(linear: &Linear, mode: usize) -> Self {
        let square = linear.squares[mode].high().abs();
        // A mode with ω < 1/s moves during the one second of the estimate about as far as its rate
        // takes it.
        let per_rate = 1.0 / Real::max(Scalar::sqrt(square), 1.0);
        let shape = (0..linear.equilibrium.len()).map(|link| linear.shapes.at(link, mode).high());
        let peak = shape.fold(0.0, |peak, part| Real::max(peak, part.abs()));
        Self {
            per_rate: T::from_f64(per_rate),
            peak: T::from_f64(peak),
            errors: linear.errors[mode].map(T::from_f64),
        }
    }
}

/// Returns Σ row · (values − origin); an empty origin counts as zero. It adds in eight partial
/// sums, for vector registers.
#[inline]
fn product<T: Real>(row: &[T], values: &[T], origin: &[T]) -> T {
    let mut sums = [T::ZERO; 8];
    if origin.is_empty() {
        for (row, values) in row.chunks(8).zip(values.chunks(8)) {
            for ((sum, &factor), &value) in sums.iter_mut().zip(row).zip(values) {
                *sum += factor * value;
            }
        }
    } else {
        for ((row, values), origin) in row.chunks(8).zip(values.chunks(8)).zip(origin.chunks(8)) {
            let terms = row.iter().zip(values).zip(origin);
            for (sum, ((&factor, &value), &origin)) in sums.iter_mut().zip(terms) {
                *sum += factor * (value - origin);
            }
        }
    }
    sums.into_iter().fold(T::ZERO, |sum, part| sum + part)
}

/// Adds the columns, each multiplied by its factor, to `sums`, four columns in each pass.
#[inline]
fn add_columns<T: Real>(sums: &mut [T], columns: &[T], factors: &[T]) {
    let rows = sums.len();
    let mut fours = factors.chunks_exact(4);
    let mut rest = columns;
    for factors in &mut fours {
        let (four, others) = rest.split_at(4 * rows);
        let (ab, cd) = four.split_at(2 * rows);
        let ((a, b), (c, d)) = (ab.split_at(rows), cd.split_at(rows));
        let &[p, q, r, s] = factors else { continue };
        let columns = a.iter().zip(b).zip(c.iter().zip(d));
        for (sum, ((&a, &b), (&c, &d))) in sums.iter_mut().zip(columns) {
            *sum += (p * a + q * b) + (r * c + s * d);
        }
        rest = others;
    }
    for (column, &factor) in rest.chunks_exact(rows).zip(fours.remainder()) {
        for (sum, &entry) in sums.iter_mut().zip(column) {
            *sum += factor * entry;
        }
    }
}
