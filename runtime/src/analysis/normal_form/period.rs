//! Averages over one period of the slow motion, by Floquet theory.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use nalgebra::{Complex, DMatrix, DVector};

use super::evaluation;
use super::flow::SlowEquations;
use super::lattice::one_turn;
use super::refusal::Refusal;
use super::resonance::Resonance;
use crate::analysis::eigenvalues::eigenvalues;
use crate::integrate::{Crossing, Dop853, Event, Integrator, Options, StopReason};
use crate::system::State;

/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-8;

/// Shortest period, s.
const SHORTEST: f64 = 0.1;

/// Largest change of an action over a period, as a part of the sum of all.
const RETURNED: f64 = 1e-4;

/// Largest change of the slow phase over a period, rad.
const TURNED: f64 = 0.01;

/// Averages of a slow motion.
pub(super) struct SlowMotion {
    /// Mean frequencies of all modes, rad/s.
    pub(super) frequencies: Vec<f64>,
    /// Growth rate of differences, 1/s.
    pub(super) rate: f64,
    /// The growth rate if differences grow; otherwise the distance of their frequencies from
    /// resonance with a minus sign, rad/s.
    pub(super) margin: f64,
}

/// Slow motion under a few resonances.
pub(super) struct SlowOrbit<'a> {
    pub(super) equations: SlowEquations<'a>,
    pub(super) resonances: &'a [Resonance],
    /// Multiples of the one slow phase; none if all phases advance steadily.
    pub(super) slow_phase: Option<&'a [i64]>,
    /// Longest period that is waited for, s.
    pub(super) longest: f64,
}

impl SlowOrbit<'_> {
    /// Returns the averages of the motion through these coordinates of the modes in phase.
    pub(super) fn averages(&self, start: &[evaluation::Complex]) -> Result<SlowMotion, Refusal> {
        match self.slow_phase {
            None => self.steady(start),
            Some(phase) => self.periodic(start, phase),
        }
    }

    /// Averages a motion whose actions are constant: exponents of a constant matrix.
    fn steady(&self, start: &[evaluation::Complex]) -> Result<SlowMotion, Refusal> {
        let rates = self.equations.phase_rates(start);
        let followed = self.followed(&rates);
        let matrix = self.equations.constant_matrix(start, &followed);
        let modes = DifferenceModes::of(&matrix)?;
        let largest = modes.all.iter().map(|own| own.re).fold(0.0, f64::max);
        let advance = followed.iter().zip(&modes.own).map(|(a, own)| a + own.im);
        let advance: Vec<f64> = rates.iter().copied().chain(advance).collect();
        let turns: Vec<f64> = modes.own.iter().map(|own| own.im).collect();
        let margin = nearest_pair(&turns, |own| own);
        Ok(self.motion(&advance, largest, margin, 1.0))
    }

    /// Averages a motion in which one combination of the phases exchanges energy between modes:
    /// it is periodic up to a rotation by a symmetry of all resonances.
    fn periodic(
        &self,
        start: &[evaluation::Complex],
        phase: &[i64],
    ) -> Result<SlowMotion, Refusal> {
        let mode = (0..phase.len())
            .max_by_key(|j| phase[*j].abs())
            .unwrap_or(0);
        let end = self.period(start, mode, phase)?;
        let advance: Vec<f64> = end.values[self.equations.phases()].to_vec();
        // Whole turns of the slow phase belong to no symmetry, and are none of a mode.
        let turns = (slow_angle(phase, &advance) / TAU).round();
        let turn = one_turn(phase);
        let reduced = advance.iter().zip(turn);
        let reduced: Vec<f64> = reduced
            .map(|(own, h)| own - TAU * turns * h as f64)
            .collect();
        let followed = self.followed(&reduced);
        let k = followed.len();
        let columns = &end.values[self.equations.integrals().end..];
        let matrix = DMatrix::from_column_slice(2 * k, 2 * k, columns);
        // z of the end, rotated back by the angle that the symmetry has for a difference.
        let rotated = DMatrix::from_fn(2 * k, 2 * k, |row, column| {
            let a = row % k;
            let (sine, cosine) = followed[a].sin_cos();
            let [x, y] = [matrix[(a, column)], matrix[(k + a, column)]];
            match row < k {
                true => cosine * x + sine * y,
                false => cosine * y - sine * x,
            }
        });
        let modes = DifferenceModes::of(&rotated)?;
        let size = modes.all.iter().map(|own| own.norm()).fold(1.0, f64::max);
        let angles: Vec<f64> = modes.own.iter().map(|own| own.arg()).collect();
        let means = &end.values[self.equations.integrals()];
        let of_differences = followed
            .iter()
            .zip(&angles)
            .zip(means)
            .map(|((a, angle), mean)| {
                let known = a + angle;
                known + TAU * ((-mean - known) / TAU).round()
            });
        let advance: Vec<f64> = advance.iter().copied().chain(of_differences).collect();
        let distance = nearest_pair(&angles, |own| own - TAU * (own / TAU).round());
        Ok(self.motion(
            &advance,
            size.ln() / end.time,
            distance / end.time,
            end.time,
        ))
    }

    /// Returns the averages from the advance of all phases in this frame within `time`, and the
    /// distance of the differences from resonance in rad/s.
    fn motion(&self, advance: &[f64], rate: f64, distance: f64, time: f64) -> SlowMotion {
        let frequencies = self.equations.frame.iter().zip(advance);
        SlowMotion {
            frequencies: frequencies
                .map(|(own, advance)| own - advance / time)
                .collect(),
            rate,
            margin: if rate > distance { rate } else { -distance },
        }
    }

    /// Returns the angles of the differences for which these angles of the modes in phase leave
    /// all resonances as they are.
    fn followed(&self, in_phase: &[f64]) -> Vec<f64> {
        let differences = self.equations.frame.len() - in_phase.len();
        let of_differences = self.resonances.iter();
        let own: Vec<&Resonance> = of_differences
            .filter(|own| own.differences.iter().any(|n| *n != 0))
            .collect();
        if own.is_empty() {
            return vec![0.0; differences];
        }
        let matrix = DMatrix::from_fn(own.len(), differences, |row, column| {
            f64::from(own[row].differences[column])
        });
        let sums = own.iter().map(|own| {
            let parts = own.in_phase.iter().zip(in_phase);
            parts.map(|(n, angle)| -f64::from(*n) * angle).sum()
        });
        let sums = DVector::from_iterator(own.len(), sums);
        match matrix.pseudo_inverse(1e-9) {
            Ok(inverse) => (inverse * sums).iter().copied().collect(),
            Err(_) => vec![f64::NAN; differences],
        }
    }

    /// Follows a motion until it returns: from a turning point of an action on, until the actions
    /// and the slow phase are the same again, or until the slow phase has made a turn.
    fn period(
        &self,
        start: &[evaluation::Complex],
        mode: usize,
        phase: &[i64],
    ) -> Result<State<f64>, Refusal> {
        let equations = &self.equations;
        let method = Dop853::new(Options::with_tolerance(TOLERANCE));
        let failed = |error: &dyn std::fmt::Display| Refusal::Failed {
            reason: error.to_string(),
        };
        let angle = |state: &[f64]| slow_angle(phase, &state[equations.phases()]);
        let rate = |_: f64, state: &[f64]| equations.action_rate(mode, state);
        let turn = |_: f64, state: &[f64]| angle(state).abs() - TAU;
        let turning = Event::new(Crossing::Either, &rate).with_checks(4);
        let turned = Event::new(Crossing::Rising, &turn).with_checks(4);
        let mut state = State::new(0.0, equations.start(start));
        // A release from rest is a turning point.
        if start.iter().any(|own| own[1] != 0.0) {
            let events = [turning, turned];
            let first =
                method.integrate_with_events(equations, &state, self.longest, &events, |_| {
                    ControlFlow::Break(())
                });
            let first = first.map_err(|error| failed(&error))?.state;
            state = State::new(0.0, equations.start(&equations.in_phase(&first.values)));
        }
        let actions = |state: &[f64]| -> Vec<f64> {
            let all = equations.in_phase(state).into_iter();
            all.map(|[x, y]| x * x + y * y).collect()
        };
        let first = actions(&state.values);
        let total: f64 = first.iter().sum();
        let returned = |state: &[f64]| {
            let own = actions(state);
            let mut both = own.iter().zip(&first);
            let angle = angle(state);
            both.all(|(a, b)| (a - b).abs() <= RETURNED * total)
                && (angle - TAU * (angle / TAU).round()).abs() <= TURNED
        };
        let events = [turning, turned];
        let end = method.integrate_with_events(equations, &state, self.longest, &events, |own| {
            match own.time > SHORTEST && returned(own.state) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        let end = end.map_err(|error| failed(&error))?;
        match end.report.stop == StopReason::StoppedByEvent || returned(&end.state.values) {
            true => Ok(end.state),
            false => Err(Refusal::NoReturn {
                names: super::names(self.resonances),
                time: self.longest,
            }),
        }
    }
}

/// Returns half the smallest sum of two angles, reduced by `reduce`.
fn nearest_pair(angles: &[f64], reduce: impl Fn(f64) -> f64) -> f64 {
    let pairs = angles.iter().enumerate().flat_map(|(place, one)| {
        let others = angles.iter().skip(place);
        others.map(move |other| one + other)
    });
    0.5 * pairs
        .map(|sum| reduce(sum).abs())
        .fold(f64::INFINITY, f64::min)
}

/// Returns the combination of angles with these multiples.
fn slow_angle(multiples: &[i64], angles: &[f64]) -> f64 {
    let both = multiples.iter().zip(angles);
    both.map(|(n, angle)| *n as f64 * angle).sum()
}

/// Eigenvalues of a matrix of the differences: real parts of z, then imaginary parts.
struct DifferenceModes {
    all: Vec<Complex<f64>>,
    /// The eigenvalue of each difference: of the vector with the largest part of z_a.
    own: Vec<Complex<f64>>,
}

impl DifferenceModes {
    fn of(matrix: &DMatrix<f64>) -> Result<Self, Refusal> {
        let k = matrix.nrows() / 2;
        if k == 0 {
            return Ok(Self {
                all: Vec::new(),
                own: Vec::new(),
            });
        }
        let all = eigenvalues(matrix).ok_or_else(|| Refusal::Failed {
            reason: "the search for the exponents of the differences did not converge".into(),
        })?;
        let complex = matrix.map(|own| Complex::new(own, 0.0));
        let largest = matrix.amax();
        let parts: Vec<Vec<f64>> = all
            .iter()
            .map(|value| parts(&complex, *value, largest))
            .collect();
        let own = (0..k).map(|a| {
            let best = (0..all.len()).max_by(|i, j| parts[*i][a].total_cmp(&parts[*j][a]));
            best.map_or(Complex::new(f64::NAN, f64::NAN), |best| all[best])
        });
        Ok(Self {
            own: own.collect(),
            all,
        })
    }
}

/// Returns the part |z_a|² of each difference in an eigenvector, by inverse iteration.
fn parts(matrix: &DMatrix<Complex<f64>>, value: Complex<f64>, largest: f64) -> Vec<f64> {
    let n = matrix.nrows();
    let mut shifted = matrix.clone();
    for j in 0..n {
        shifted[(j, j)] -= value + Complex::new(1e-9, 1e-9) * largest;
    }
    let mut vector = DVector::from_fn(n, |j, _| {
        Complex::new(1.0 / (1.0 + j as f64), 0.3 * j as f64)
    });
    let lu = shifted.lu();
    for _ in 0..2 {
        let norm = vector.norm();
        vector = lu.solve(&vector).unwrap_or(vector) / Complex::new(norm, 0.0);
    }
    let k = n / 2;
    let i = Complex::new(0.0, 1.0);
    let norm = 2.0 * vector.norm_squared();
    let part = |a: usize| (vector[a] + i * vector[k + a]).norm_sqr() / norm;
    (0..k).map(part).collect()
}
