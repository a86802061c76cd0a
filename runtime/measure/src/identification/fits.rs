//! Fitting of models to records and frequencies.

use core::ops::ControlFlow;

use super::convergence::SearchFailure;
use super::effort::Effort;
use super::error::IdentificationError;
use super::family::Family;
use super::fit::Fit;
use super::problem::{Identification, Shooting};
use super::record::AngleRecord;
use super::search::Search;
use super::start::SmoothedRecord;

impl<F: Family> Identification<F> {
    /// Fits the unknowns to frequencies only; there must be at least as many frequencies as
    /// unknowns. Error bars are computed from the standard errors of the frequencies. The search
    /// also starts from points far from the given one; if these lead to other values, the fit lists
    /// them ([`Fit::alternatives`]).
    ///
    /// # Errors
    ///
    /// As [`fit`](Self::fit).
    pub fn fit_to_frequencies(&self) -> Result<Fit, IdentificationError> {
        self.fit(&AngleRecord::default())
    }

    /// Fits the unknowns to a record, and to frequencies if there are any.
    ///
    /// The number of evaluations of the equations of motion is limited, in proportion to the number
    /// of times and of unknowns.
    ///
    /// # Errors
    ///
    /// [`IdentificationError`]. A search that ended nowhere is
    /// [`NotFound`](IdentificationError::NotFound), which carries the best that it found. What the
    /// data do not determine is no error: the fit reports it ([`Fit::identifiability`]).
    pub fn fit(&self, record: &AngleRecord) -> Result<Fit, IdentificationError> {
        self.fit_within(record, self.shooting, &self.effort(record))
    }

    /// Fits the unknowns like [`fit`](Self::fit), but in the longest segments that still fit the
    /// motion of the record; if possible, this is one motion.
    ///
    /// # Errors
    ///
    /// As [`fit`](Self::fit), except that a motion which is lost in longer segments is not an
    /// error.
    pub fn fit_in_segments(&self, record: &AngleRecord) -> Result<Fit, IdentificationError> {
        self.fit_in_segments_within(record, self.shooting, &self.effort(record))
    }

    /// Fits the unknowns to a record, starting from the result of another fit: from its values of
    /// the common unknowns and, if it has the same times, from its segments and their motions. This
    /// continues from short segments to one motion, or from one friction law to a law with more
    /// terms.
    ///
    /// # Errors
    ///
    /// As [`fit`](Self::fit).
    pub fn fit_from(&self, fit: &Fit, record: &AngleRecord) -> Result<Fit, IdentificationError> {
        self.fit_from_within(fit, record, self.shooting, &self.effort(record))
    }

    /// Returns the work count of a search without an observer.
    fn effort(&self, record: &AngleRecord) -> Effort<'static> {
        let unknowns = self.unknowns(record);
        Effort::of(record.times().len(), unknowns, &|_| {
            ControlFlow::Continue(())
        })
    }

    /// Returns the number of unknown parameters and offsets.
    pub(super) fn unknowns(&self, record: &AngleRecord) -> usize {
        let offsets = if self.offsets { record.links.len() } else { 0 };
        self.unknown.len() + offsets
    }

    pub(super) fn fit_within(
        &self,
        record: &AngleRecord,
        shooting: Shooting,
        effort: &Effort<'_>,
    ) -> Result<Fit, IdentificationError> {
        let (search, globals) = self.search(record, shooting, effort)?;
        search.try_starts(globals)
    }

    pub(super) fn fit_in_segments_within(
        &self,
        record: &AngleRecord,
        mut shooting: Shooting,
        effort: &Effort<'_>,
    ) -> Result<Fit, IdentificationError> {
        loop {
            match self.fit_within(record, shooting, effort) {
                Err(IdentificationError::NotFound(unfound)) => match unfound.failure {
                    SearchFailure::Lost { followed }
                        if followed < shooting.longest && !effort.is_over() =>
                    {
                        shooting.longest = followed;
                        shooting.first = shooting.first.min(followed);
                    }
                    _ => return Err(IdentificationError::NotFound(unfound)),
                },
                result => return result,
            }
        }
    }

    pub(super) fn fit_from_within(
        &self,
        fit: &Fit,
        record: &AngleRecord,
        shooting: Shooting,
        effort: &Effort<'_>,
    ) -> Result<Fit, IdentificationError> {
        let (search, mut globals) = self.search(record, shooting, effort)?;
        let task = &search.task;
        for (index, (global, name)) in globals.iter_mut().zip(&task.names).enumerate() {
            *global = task.within(index, fit.value(name).unwrap_or(*global));
        }
        match (task.segments_of(fit), fit.stages.last()) {
            (Some(segments), Some(last)) => {
                self.check_unknowns(task, &segments)?;
                let smoothed = &search.smoothed;
                let stage = self.stage(task, smoothed, segments, fit.start_states(), globals);
                search.continue_from(stage, last.length, &fit.convergence)
            }
            _ => search.try_starts(globals),
        }
    }

    fn search<'a>(
        &'a self,
        record: &'a AngleRecord,
        shooting: Shooting,
        effort: &'a Effort<'a>,
    ) -> Result<(Search<'a, F>, Vec<f64>), IdentificationError> {
        let (task, globals) = self.task(record, effort)?;
        let search = Search {
            identification: self,
            shooting,
            task,
            record,
            smoothed: SmoothedRecord::new(record)?,
        };
        Ok((search, globals))
    }
}
