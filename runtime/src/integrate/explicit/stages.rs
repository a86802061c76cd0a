//! Arithmetic of one step of an explicit pair: stages, state at the end, error norm.
//!
//! It is written once, for numbers `W` of any width: a single number, or a vector register with one
//! state in each lane. The traits [`RightHandSide`] and [`ErrorScale`] cover the differences.

// The types are public because the trait of a pair mentions them; users name only the pairs.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::pair::EmbeddedPair;
use crate::integrate::options::{Options, Tolerance};
use crate::integrate::right_hand_side::{MOST_STAGES, RightHandSide, StepSpan};
use crate::scalar::two_sum;
use crate::scalar::{Real, Scalar};

/// True if one loop computes all stages, for small code, as on web pages, which have to load the
/// code and spend little time in stages. If false, each stage has separate code.
const SMALL: bool = cfg!(target_family = "wasm");

/// Scaling of errors by their tolerances, for one state or for one state in each lane.
pub trait ErrorScale<W: Scalar>: RightHandSide<W> {
    /// Type of a flag that a step is accepted, or of one such flag per lane.
    type Accepted: Copy;

    /// Returns the larger magnitude of two numbers.
    fn larger_size(one: W, other: W) -> W;

    /// Returns the values divided by their common tolerance. If a component is exactly zero by
    /// symmetry, its scaled error is zero at any tolerance, not 0/0.
    fn scaled<const N: usize>(&self, values: [W; N], tolerance: W) -> [W; N];

    /// Returns `new` if the step is accepted and `old` if it is rejected, lane by lane.
    fn accept(new: W, old: W, accepted: Self::Accepted) -> W;
}

/// Workspace of a run, allocated once: states, rates of the stages, tolerances, dense output.
#[derive(Clone, Debug)]
pub struct StepStages<W> {
    /// Relative tolerance of each component.
    relative: Vec<W>,
    /// Absolute tolerance of each component.
    absolute: Vec<W>,
    /// State at the start of the step.
    pub(super) start: Vec<W>,
    /// State at the end of the step.
    pub(super) end: Vec<W>,
    /// State at which a stage is evaluated.
    pub(super) stage: Vec<W>,
    /// Rates of the stages, one after the other.
    pub(super) rates: Vec<W>,
    /// True if the sums y + Δy keep their rounding errors (compensated summation).
    compensated: bool,
    /// Rounding error of `start`, which compensated sums add to it; zero otherwise.
    pub(super) start_residue: Vec<W>,
    /// Rounding error of `end`.
    end_residue: Vec<W>,
    /// Coefficients of the dense output after the start value, one vector after the other.
    pub(super) dense: Vec<W>,
}

/// `make_stages!(self, system, span, first, last)` computes the stages `first` to `last` of the
/// pair `M`, each by separate code, in which the rows of the table are constants and their sums are
/// written out.
macro_rules! make_stages {
    ($self:ident, $system:ident, $span:ident, $first:expr, $last:expr) => {
        make_stages!($self, $system, $span, $first, $last;
            2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21)
    };
    ($self:ident, $system:ident, $span:ident, $first:expr, $last:expr; $($stage:literal)+) => {
        $(if const { $first <= $stage && $stage <= $last } {
            $self.make_stage::<M, S>($stage, const { table_entry::<M>($stage) }, $system, $span)?;
        })+
    };
}

/// Returns the row and the node of a stage of the table. The compiler also evaluates this for
/// stages that the pair does not have, before it removes their code.
const fn table_entry<M: EmbeddedPair>(stage: usize) -> (&'static [(usize, f64)], f64) {
    if stage <= M::NODES.len() {
        (M::ROWS[stage - 2], M::NODES[stage - 1])
    } else {
        (&[], 0.0)
    }
}

impl<W: Scalar> StepStages<W> {
    /// Allocates the workspace of the pair `M` for a run from `start`. `wide` converts the
    /// tolerances to `W`.
    pub(super) fn new<M: EmbeddedPair, T: Real>(
        options: &Options<T>,
        start: Vec<W>,
        wide: impl Fn(T) -> W,
    ) -> Self {
        const { assert!(M::NODES.len() <= MOST_STAGES) }
        let n = start.len();
        let tolerances = |tolerance: &Tolerance<T>| {
            let each = tolerance.expand(n).into_iter();
            each.map(&wide).collect()
        };
        let zeros = |vectors: usize| vec![W::from_f64(0.0); vectors * n];
        Self {
            relative: tolerances(&options.relative),
            absolute: tolerances(&options.absolute),
            end: zeros(1),
            stage: zeros(1),
            rates: zeros(M::NODES.len()),
            compensated: options.compensated,
            start_residue: zeros(1),
            end_residue: zeros(1),
            dense: zeros(M::DENSE.terms()),
            start,
        }
    }

    /// Computes stages 2 to [`EmbeddedPair::STAGES`] and the state at the end of the step, after
    /// stage 1 has been evaluated.
    #[inline(always)]
    pub(super) fn make<M: EmbeddedPair, S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<(), S::Failure> {
        if SMALL {
            for stage in 2..=M::STAGES {
                self.make_stage::<M, S>(stage, table_entry::<M>(stage), system, span)?;
            }
        } else {
            make_stages!(self, system, span, 2, M::STAGES);
        }
        self.finish::<M, S>(system, span.step);
        Ok(())
    }

    /// Computes the additional stages that the dense output needs.
    #[inline(always)]
    pub(super) fn make_dense<M: EmbeddedPair, S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<(), S::Failure> {
        if SMALL {
            for stage in M::STAGES + 2..=M::NODES.len() {
                self.make_stage::<M, S>(stage, table_entry::<M>(stage), system, span)?;
            }
        } else {
            make_stages!(self, system, span, M::STAGES + 2, M::NODES.len());
        }
        Ok(())
    }

    /// Evaluates the rates of stage `number` at y + h · Σ (row · rates), with the start y and the
    /// length h of the step.
    #[inline(always)]
    fn make_stage<M: EmbeddedPair, S: RightHandSide<W>>(
        &mut self,
        number: usize,
        (row, node): (&'static [(usize, f64)], f64),
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<(), S::Failure> {
        let n = system.dimension();
        let (before, rates) = self.rates.split_at_mut((number - 1) * n);
        let (start, stage) = (&self.start[..n], &mut self.stage[..n]);
        let terms = terms(row, before, n);
        for i in 0..n {
            stage[i] = span.step.mul_add(sum(row, &terms, i), start[i]);
        }
        system.evaluate(number, span.node(node), stage, &mut rates[..n])
    }

    /// Computes the state at the end of the step, y + h · Σ (row · rates), with the start y and the
    /// length h of the step.
    #[inline(always)]
    fn finish<M: EmbeddedPair, S: RightHandSide<W>>(&mut self, system: &S, step: W) {
        let row = const { M::ROWS[M::STAGES - 1] };
        let n = system.dimension();
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        let terms = terms(row, &self.rates, n);
        if self.compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for i in 0..n {
                let change = step.mul_add(sum(row, &terms, i), residue[i]);
                (end[i], rest[i]) = two_sum(start[i], change);
            }
        } else {
            for i in 0..n {
                end[i] = step.mul_add(sum(row, &terms, i), start[i]);
            }
        }
    }

    /// Restarts from the state `values`, whose rates are not known yet.
    pub(super) fn restart(&mut self, values: &[W]) {
        self.start.copy_from_slice(values);
        self.start_residue.fill(W::from_f64(0.0));
    }

    /// Evaluates the rates at the start of the first step: stage 1.
    #[inline(always)]
    pub(super) fn evaluate_start<S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        time: W,
    ) -> Result<(), S::Failure> {
        let n = system.dimension();
        system.evaluate(1, time, &self.start[..n], &mut self.rates[..n])
    }

    /// Evaluates the rates at the end of the step, at time `time`. They are stage 1 of the next
    /// step.
    #[inline(always)]
    pub(super) fn evaluate_end<M: EmbeddedPair, S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        time: W,
    ) -> Result<(), S::Failure> {
        let n = system.dimension();
        let rates = &mut self.rates[M::STAGES * n..][..n];
        system.evaluate(M::STAGES + 1, time, &self.end[..n], rates)
    }

    /// Evaluates the rates after an Euler step and stores them as stage 2. Returns the norm of
    /// their change since the start of the step.
    #[inline(always)]
    pub(super) fn euler_change<S: ErrorScale<W>>(
        &mut self,
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<W, S::Failure> {
        let n = system.dimension();
        let (rates, after) = self.rates.split_at_mut(n);
        let (start, stage) = (&self.start[..n], &mut self.stage[..n]);
        for i in 0..n {
            stage[i] = span.step.mul_add(rates[i], start[i]);
        }
        system.evaluate(2, span.time + span.step, stage, &mut after[..n])?;
        for i in 0..n {
            after[i] = after[i] - rates[i];
        }
        Ok(self.norm(system, &self.rates[n..2 * n]))
    }

    /// Returns the Euclidean norm of a vector whose components are divided by their tolerances at
    /// the start of the step.
    #[inline(always)]
    pub(super) fn norm<S: ErrorScale<W>>(&self, system: &S, vector: &[W]) -> W {
        let mut squares = W::from_f64(0.0);
        for (i, &value) in vector.iter().enumerate() {
            let size = S::larger_size(self.start[i], self.start[i]);
            let tolerance = self.relative[i].mul_add(size, self.absolute[i]);
            let [ratio] = system.scaled([value], tolerance);
            squares = ratio.mul_add(ratio, squares);
        }
        squares.sqrt()
    }

    /// Returns the rates at the start of the step.
    #[inline(always)]
    pub(super) fn start_rates(&self) -> &[W] {
        &self.rates[..self.start.len()]
    }

    /// Returns, for each of the rows, the sum over the components of the squares of Σ (row · rates)
    /// / tolerance, from which error norms are computed.
    #[inline(always)]
    pub(super) fn squares<S: ErrorScale<W>, const N: usize>(
        &self,
        system: &S,
        rows: [&'static [(usize, f64)]; N],
    ) -> [W; N] {
        let n = system.dimension();
        let (start, end) = (&self.start[..n], &self.end[..n]);
        let (relative, absolute) = (&self.relative[..n], &self.absolute[..n]);
        let mut all_terms: [[&[W]; MOST_STAGES]; N] = [[&[]; MOST_STAGES]; N];
        for (row_terms, row) in all_terms.iter_mut().zip(rows) {
            *row_terms = terms(row, &self.rates, n);
        }
        let mut squares = [W::from_f64(0.0); N];
        for i in 0..n {
            let mut values = squares;
            for j in 0..N {
                values[j] = sum(rows[j], &all_terms[j], i);
            }
            let tolerance = relative[i].mul_add(S::larger_size(start[i], end[i]), absolute[i]);
            let ratios = system.scaled(values, tolerance);
            for j in 0..N {
                squares[j] = ratios[j].mul_add(ratios[j], squares[j]);
            }
        }
        squares
    }

    /// Returns the scaled error of a step of length `size` with a single estimate h · Σ (row ·
    /// rates): its root mean square over the components (Solving ODEs I, section II.4, eq. (4.11)).
    #[inline(always)]
    pub(super) fn mean_square_error<S: ErrorScale<W>>(
        &self,
        system: &S,
        row: &'static [(usize, f64)],
        size: W,
    ) -> W {
        let [squares] = self.squares(system, [row]);
        size * (squares / count(system)).sqrt()
    }

    /// Makes the end of each accepted step the start of the next one, in the first `n` components.
    /// The rates at the end become the first stage.
    #[inline(always)]
    pub(super) fn advance<M: EmbeddedPair, S: ErrorScale<W>>(
        &mut self,
        n: usize,
        accepted: S::Accepted,
    ) {
        let (first, rest) = self.rates.split_at_mut(n);
        let last = &rest[(M::STAGES - 1) * n..][..n];
        let (start, end) = (&mut self.start[..n], &self.end[..n]);
        for i in 0..n {
            start[i] = S::accept(end[i], start[i], accepted);
            first[i] = S::accept(last[i], first[i], accepted);
        }
        if self.compensated {
            let (residue, rest) = (&mut self.start_residue[..n], &self.end_residue[..n]);
            for i in 0..n {
                residue[i] = S::accept(rest[i], residue[i], accepted);
            }
        }
    }
}

/// Returns the number of components, as a number of type `W`.
#[inline(always)]
pub(super) fn count<W: Scalar, S: ErrorScale<W>>(system: &S) -> W {
    W::from_f64(system.dimension() as f64)
}

/// Returns the rates of the stages of a row, in the row's order; the rest of the array is empty.
/// All slices have one known length, so that loops need no bounds checks.
#[inline(always)]
pub(super) fn terms<'a, W>(
    row: &[(usize, f64)],
    rates: &'a [W],
    n: usize,
) -> [&'a [W]; MOST_STAGES] {
    // One check of the length, for the last stage, makes those of the others needless.
    let count = row.last().map_or(0, |&(stage, _)| stage * n);
    let rates = &rates[..count];
    let mut terms: [&[W]; MOST_STAGES] = [&[]; MOST_STAGES];
    for (term, &(stage, _)) in terms.iter_mut().zip(row) {
        *term = &rates[(stage - 1) * n..][..n];
    }
    terms
}

/// Returns component i of the sum of a row over the stages.
///
/// It uses no closures, because a closure is a separate function, which may be compiled without the
/// vector instructions.
#[inline(always)]
pub(super) fn sum<W: Scalar>(row: &[(usize, f64)], terms: &[&[W]; MOST_STAGES], i: usize) -> W {
    let mut sum = W::from_f64(row[0].1) * terms[0][i];
    for j in 1..row.len() {
        sum = W::from_f64(row[j].1).mul_add(terms[j][i], sum);
    }
    sum
}
