//! Search from several starts: segments become longer until one motion covers the record.

use super::convergence::{Convergence, SearchFailure};
use super::error::IdentificationError;
use super::family::Family;
use super::fit::{Fit, StageReport, Unfound};
use super::least_squares::{FULL, FitStage, ROUGH, Solved};
use super::problem::{Identification, Shooting};
use super::record::{AngleRecord, no_motion};
use super::start::SmoothedRecord;
use super::task::{FitTask, split};

/// Number of starts that are tried: if the residual is noise, if starts agree, and at most.
const STARTS: [usize; 3] = [2, 3, 6];
/// Relative distance of further starts from the given one.
const OFF: f64 = 0.3;
/// Factor by which further starts are larger or smaller if only frequencies are fitted.
const FAR: f64 = 3.0;
/// Length of the first segments of further starts, relative to that of the given start, and the
/// smallest number of samples in each. The shorter the segments, the closer the sum of squares is
/// to a parabola.
const SHORT: f64 = 0.25;
const SAMPLES: f64 = 6.0;
/// Largest number of choices of fixed unknowns that are tried in the first stage.
const CHOICES: usize = 8;
/// Factor by which the tolerance of early stages is larger.
const LOOSENED: f64 = 1e3;
/// Factor by which the weight of jumps is increased if longer segments lose the motion, and how
/// often.
const DEARER: f64 = 10.0;
const TRIES: usize = 1;

/// A solved stage of the search, with reports of all stages so far.
#[derive(Clone)]
pub(super) struct Rung {
    pub(super) stage: FitStage,
    pub(super) solved: Solved,
    pub(super) reports: Vec<StageReport>,
    pub(super) convergence: Convergence,
    /// Length of the segments, s.
    length: f64,
    is_last: bool,
    /// True if longer segments have lost the motion of the record.
    is_lost: bool,
}

/// A search under way.
pub(super) struct Search<'a, F> {
    pub(super) identification: &'a Identification<F>,
    pub(super) shooting: Shooting,
    pub(super) task: FitTask<'a>,
    pub(super) record: &'a AngleRecord,
    pub(super) smoothed: SmoothedRecord,
}

impl<F: Family> Search<'_, F> {
    /// Tries several starts, and lengthens the segments of the best one.
    pub(super) fn try_starts(mut self, globals: Vec<f64>) -> Result<Fit, IdentificationError> {
        if self.record.links.is_empty() {
            return self.try_starts_at_rest(&globals);
        }
        let first = self.shooting.first;
        let segments = split(self.record.times(), first);
        self.identification.check_unknowns(&self.task, &segments)?;
        let mut rungs: Vec<Rung> = Vec::new();
        for number in 0..STARTS[2] {
            if self.task.effort.is_over() {
                break;
            }
            rungs.extend(self.scout(number, &globals));
            let Some(best) = best(&rungs) else {
                continue;
            };
            let convergence = with_starts(best, &rungs, number + 1);
            let enough = match convergence.is_noise() && !best.is_lost {
                true => STARTS[0],
                false if convergence.agreed > 1 => STARTS[1],
                false => STARTS[2],
            };
            if number + 1 >= enough {
                break;
            }
        }
        let best = best(&rungs).ok_or_else(|| self.nothing())?;
        let mut rung = best.clone();
        rung.convergence = with_starts(best, &rungs, rungs.len());
        self.finish(rung)
    }

    /// Continues from a stage that another search has solved.
    pub(super) fn continue_from(
        mut self,
        stage: FitStage,
        length: f64,
        before: &Convergence,
    ) -> Result<Fit, IdentificationError> {
        let rung = self.solve(stage, length, Vec::new(), before);
        let rung = rung.ok_or_else(|| self.nothing())?;
        self.finish(rung)
    }

    /// Returns the error of a search that has found no motion.
    fn nothing(&self) -> IdentificationError {
        match self.task.effort.end() == Some(SearchFailure::Interrupted) {
            true => IdentificationError::Ended,
            false => no_motion(self.record),
        }
    }

    /// Solves the first segments from start number `number`: the given start, in segments of the
    /// first length and in shorter ones, or another start around it.
    pub(super) fn scout(&mut self, number: usize, globals: &[f64]) -> Option<Rung> {
        let shooting = self.shooting;
        let mut globals = globals.to_vec();
        if number > 1 {
            let parameters = self.task.unknown.len();
            for (index, global) in globals.iter_mut().enumerate().take(parameters) {
                *global *= match self.record.links.is_empty() {
                    true => FAR.powf(spread(number, index)),
                    false => 1.0 + OFF * spread(number, index),
                };
            }
            self.identification
                .family
                .check(&self.task.parameters(&globals))
                .ok()?;
        }
        let times = self.record.times();
        let span = times
            .last()
            .zip(times.first())
            .map_or(0.0, |(last, first)| last - first);
        let interval = span / times.len().max(2) as f64;
        let length = match number {
            0 => shooting.first,
            _ => (shooting.first * SHORT)
                .max(SAMPLES * interval)
                .min(shooting.first),
        };
        let segments = split(times, length);
        let starts = self.task.first_states(&self.smoothed, &globals, &segments);
        let stage =
            self.identification
                .stage(&self.task, &self.smoothed, segments, starts, globals);
        let none = Convergence::before(self.smoothed.noise, self.smoothed.swing);
        let rung = self.solve(stage, length, Vec::new(), &none)?;
        let rung = self.lengthen(rung, shooting.first);
        let segments = split(times, shooting.first);
        if rung.is_lost || rung.stage.segments == segments {
            return Some(rung);
        }
        // In the segments of the others, to be compared with them.
        let globals = rung.stage.globals.clone();
        let starts = self.task.first_states(&self.smoothed, &globals, &segments);
        let stage =
            self.identification
                .stage(&self.task, &self.smoothed, segments, starts, globals);
        let same = self.solve(stage, shooting.first, rung.reports.clone(), &none);
        let kept = same.filter(|same| rung.convergence.is_kept(&same.convergence));
        Some(kept.unwrap_or(rung))
    }

    /// Solves a stage with segments of this length (s).
    fn solve(
        &mut self,
        mut stage: FitStage,
        length: f64,
        mut reports: Vec<StageReport>,
        before: &Convergence,
    ) -> Option<Rung> {
        let shooting = self.shooting;
        let is_last = stage.segments.len() <= 1 || 2.0 * length > shooting.longest * (1.0 + 1e-9);
        let (settled, loosened) = match is_last {
            true => (FULL, 1.0),
            false => (ROUGH, LOOSENED),
        };
        self.task.tolerance = shooting.tolerance * loosened;
        let choices = if reports.is_empty() { CHOICES } else { 1 };
        let solved = stage.solve_weighed(&self.task, settled, choices)?;
        let errors = self.task.errors(&stage, &solved.residuals);
        let rms = errors.rms();
        self.task.effort.show(length, rms);
        reports.push(StageReport {
            segments: stage.segments.len(),
            length,
            rms,
            steps: solved.steps,
        });
        Some(Rung {
            stage,
            solved,
            reports,
            convergence: self.smoothed.compare(before, &errors),
            length,
            is_last,
            is_lost: false,
        })
    }

    /// Joins every two segments into one, until they have this length (s) or lose the motion.
    fn lengthen(&mut self, mut rung: Rung, until: f64) -> Rung {
        let mut tries = 0;
        while !rung.is_last && !rung.is_lost && rung.length < until * (1.0 - 1e-9) {
            let mut stage = rung.stage.clone();
            stage.merge();
            let before = rung.convergence;
            let longer = self.solve(stage, 2.0 * rung.length, rung.reports.clone(), &before);
            if self.task.effort.is_over() {
                break;
            }
            match longer.filter(|longer| before.is_kept(&longer.convergence)) {
                Some(longer) => rung = longer,
                None if tries < TRIES => {
                    // Where segments join more closely, one motion through two of them is nearer.
                    tries += 1;
                    let mut stage = rung.stage.clone();
                    stage
                        .junction
                        .iter_mut()
                        .for_each(|weight| *weight *= DEARER);
                    let closer = self.solve(stage, rung.length, rung.reports.clone(), &before);
                    match closer.filter(|closer| before.is_kept(&closer.convergence)) {
                        Some(closer) => rung = closer,
                        None => rung.is_lost = true,
                    }
                }
                None => rung.is_lost = true,
            }
        }
        rung
    }

    /// Lengthens the segments as far as allowed, and judges the result.
    pub(super) fn finish(mut self, rung: Rung) -> Result<Fit, IdentificationError> {
        let rung = match rung.convergence.is_followed() {
            true => self.lengthen(rung, f64::INFINITY),
            false => rung,
        };
        let (is_lost, length, stages) = (rung.is_lost, rung.length, rung.reports.len());
        let (is_last, end) = (rung.is_last, self.task.effort.end());
        let effort = self.task.effort;
        let fit = effort.unlimited(|| self.report(rung))?;
        let failure = match fit.convergence.failure() {
            _ if is_lost => Some(SearchFailure::Lost { followed: length }),
            // More work might have led to longer segments, or to an end.
            Some(_) if end.is_some() => end,
            None if end.is_some() && !is_last => end,
            // Chaos makes the sum of squares so rough that a search does not come to its end.
            Some(SearchFailure::Unsettled) if stages > 1 => Some(SearchFailure::Lost {
                followed: 0.5 * length,
            }),
            // Without angles there is nothing to follow.
            Some(SearchFailure::Astray | SearchFailure::Alone) if self.task.links.is_empty() => {
                None
            }
            failure => failure,
        };
        match failure {
            None => Ok(fit),
            Some(failure) => Err(IdentificationError::NotFound(Box::new(Unfound {
                failure,
                release: self.record.release(),
                best: fit.without_deviations(),
            }))),
        }
    }
}

/// Returns the best of several starts, which is the one whose segments fit the motion for the
/// longest time.
fn best(rungs: &[Rung]) -> Option<&Rung> {
    let key = |rung: &Rung| {
        let followed = rung.convergence.is_followed();
        (
            followed,
            if followed { rung.length } else { 0.0 },
            -rung.convergence.rms,
        )
    };
    rungs.iter().max_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0)
            .then(a.1.total_cmp(&b.1))
            .then(a.2.total_cmp(&b.2))
    })
}

/// Returns the convergence of the best start, with the number of starts that ended in the same
/// minimum.
fn with_starts(best: &Rung, rungs: &[Rung], starts: usize) -> Convergence {
    let alike = rungs.iter().filter(|rung| {
        rung.length >= best.length && best.convergence.is_same_minimum(rung.convergence.rms)
    });
    Convergence {
        starts,
        agreed: alike.count(),
        ..best.convergence
    }
}

/// Returns a number between −1 and 1; the numbers are spread evenly over starts and unknowns.
fn spread(start: usize, unknown: usize) -> f64 {
    // Multiples of the golden ratio stay apart from each other.
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let turned = golden * ((start * start + 1) * (2 * unknown + 1)) as f64;
    2.0 * turned.fract() - 1.0
}
