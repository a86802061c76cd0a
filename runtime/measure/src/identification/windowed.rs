//! Search in windows, followed by a search of one motion: the usual way to identify the parameters
//! of a record.

use super::convergence::SearchFailure;
use super::effort::{Effort, SearchObserver};
use super::error::IdentificationError;
use super::family::Family;
use super::fit::{AngleErrors, Fit, Unfound};
use super::problem::{Identification, Shooting};
use super::record::AngleRecord;

/// Largest share of all work that the search in windows may use.
const OF_WINDOWS: f64 = 0.6;
/// Shortest windows that are tried, relative to the requested length; any model fits shorter ones.
const SHORTEST: f64 = 0.125;
/// Number of standard deviations below zero at which a friction coefficient counts as negative.
const DRIVES: f64 = 2.0;

/// A fit, or the best values of a search without a valid result.
pub type SearchOutcome = Result<Fit, Box<Unfound>>;

/// Returns the fit of a search, even if it is not a valid result.
#[must_use]
pub fn best(found: &SearchOutcome) -> &Fit {
    match found {
        Ok(fit) => fit,
        Err(unfound) => &unfound.best,
    }
}

/// Fit in windows of a record, and fit of one motion over the whole record.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowedFit {
    /// The fit in windows, each with a separate initial state.
    pub in_windows: SearchOutcome,
    /// The fit of one motion. If there is no fit in windows, a copy of its outcome.
    pub one_motion: SearchOutcome,
}

impl WindowedFit {
    /// Returns the result: of one motion or, if that was not found, of windows.
    ///
    /// # Errors
    ///
    /// The best that was found, if no fit is a result.
    pub fn result(&self) -> Result<&Fit, &Unfound> {
        let found = self.one_motion.as_ref().or(self.in_windows.as_ref());
        found.map_err(|unfound| &**unfound)
    }

    /// Returns the fit of one motion to the whole record, even if it is not valid; `None` if the
    /// search ended with windows.
    #[must_use]
    pub fn motion(&self) -> Option<&Fit> {
        Some(best(&self.one_motion)).filter(|fit| fit.starts.len() == 1)
    }

    /// Returns the length of the windows (s): shorter than requested if the motion is lost in such
    /// windows. `None` for a fit of frequencies only.
    #[must_use]
    pub fn window(&self) -> Option<f64> {
        let last = best(&self.in_windows).stages.last();
        last.map(|stage| stage.length)
    }
}

impl<F: Family> Identification<F> {
    /// Fits the unknowns in windows of this length (s), or in shorter ones if these lose the
    /// motion, and then by one motion that starts from that result. Without a record, only the
    /// frequencies are fitted.
    ///
    /// The search starts from the result `before`, which may have fewer unknowns, such as a
    /// friction law with fewer terms. The number of evaluations of the equations of motion is
    /// limited, in proportion to the number of times and of unknowns. `observer` can end the
    /// search; the best values are then in the [`Unfound`] of its outcomes.
    ///
    /// Constants that no pendulum can have are no result ([`SearchFailure::Unphysical`]). A negative
    /// coefficient of friction means that the law of friction is another one: the fit then has no
    /// deviations, unless the coefficient is zero within its own.
    ///
    /// # Errors
    ///
    /// A mistake in the request, and [`IdentificationError::Ended`].
    pub fn fit_by_windows(
        &self,
        record: &AngleRecord,
        window: f64,
        before: Option<&WindowedFit>,
        observer: SearchObserver<'_>,
    ) -> Result<WindowedFit, IdentificationError> {
        if record.times().is_empty() {
            let found = self.judged(found(self.fit_to_frequencies())?);
            return Ok(WindowedFit {
                in_windows: found.clone(),
                one_motion: found,
            });
        }
        let effort = Effort::of(record.times().len(), self.unknowns(record), observer);
        let in_windows =
            effort.within(OF_WINDOWS, || self.windows(record, window, before, &effort));
        let in_windows = in_windows?;
        let one_motion = match &in_windows {
            Ok(windows) => match self.fit_from_within(windows, record, self.shooting, &effort) {
                // There are windows, but no motion as yet.
                Err(IdentificationError::Ended | IdentificationError::NoMotion { .. })
                    if effort.is_over() =>
                {
                    Err(Box::new(Unfound {
                        failure: effort.end().unwrap_or(SearchFailure::Unsettled),
                        release: None,
                        best: windows.clone().without_deviations(),
                    }))
                }
                result => self.judged(found(result)?),
            },
            Err(_) => in_windows.clone(),
        };
        Ok(WindowedFit {
            in_windows,
            one_motion,
        })
    }

    /// Compares the fit of one motion with a record: the fitted one, or a longer one that also has
    /// the times after it. `None` if the search ended with windows, or if it found no valid result
    /// and its best values have no motion.
    ///
    /// # Errors
    ///
    /// As [`errors`](Self::errors), for a valid result.
    pub fn motion_errors(
        &self,
        found: &WindowedFit,
        record: &AngleRecord,
    ) -> Result<Option<AngleErrors>, IdentificationError> {
        let errors = found.motion().map(|fit| self.errors(fit, record));
        match &found.one_motion {
            Ok(_) => errors.transpose(),
            Err(_) => Ok(errors.and_then(Result::ok)),
        }
    }

    fn windows(
        &self,
        record: &AngleRecord,
        window: f64,
        before: Option<&WindowedFit>,
        effort: &Effort<'_>,
    ) -> Result<SearchOutcome, IdentificationError> {
        let short = Shooting {
            first: window,
            longest: window,
            ..self.shooting
        };
        let before = before.map(|before| &before.in_windows);
        // Values that no pendulum has lead nowhere.
        let before = before.filter(|before| self.is_physical(best(before)));
        let in_windows = found(match before {
            Some(before) => self.fit_from_within(best(before), record, short, effort),
            None => self.fit_within(record, short, effort),
        })?;
        let in_windows = match in_windows {
            Err(unfound) if matches!(unfound.failure, SearchFailure::Lost { .. }) => {
                found(self.fit_in_segments_within(record, short, effort))?
            }
            found => found,
        };
        let is_short = |fit: &Fit| {
            let length = fit.stages.last().map_or(window, |stage| stage.length);
            length < SHORTEST * window * (1.0 - 1e-9)
        };
        let in_windows = match in_windows {
            Ok(fit) if is_short(&fit) => Err(Box::new(Unfound {
                failure: SearchFailure::Astray,
                release: record.release(),
                best: fit.without_deviations(),
            })),
            found => found,
        };
        Ok(self.judged(in_windows))
    }

    /// Returns true if the constants of a fit, except friction, are physical.
    fn is_physical(&self, fit: &Fit) -> bool {
        let values = fit.parameters().iter().enumerate();
        let values = values.map(|(index, &value)| match self.family.is_friction(index) {
            true => value.max(0.0),
            false => value,
        });
        self.family.check(&values.collect::<Vec<_>>()).is_ok()
    }

    /// Rejects a fit whose constants are not physical, and removes the error bars of a fit with
    /// negative friction.
    fn judged(&self, found: SearchOutcome) -> SearchOutcome {
        let fit = match found {
            Ok(fit) if fit.impossible.is_some() => fit,
            found => return found,
        };
        if !self.is_physical(&fit) {
            return Err(Box::new(Unfound {
                failure: SearchFailure::Unphysical,
                release: None,
                best: fit.without_deviations(),
            }));
        }
        let parameters = self.family.parameters();
        let drives = fit.estimates.iter().any(|own| {
            let index = parameters.iter().position(|name| *name == own.name);
            let bar = own.deviation().unwrap_or(0.0);
            index.is_some_and(|index| self.family.is_friction(index))
                && own.value < 0.0
                && (!bar.is_finite() || own.value < -DRIVES * bar)
        });
        Ok(match drives {
            true => fit.without_deviations(),
            false => fit,
        })
    }
}

/// Converts the error of a search without a valid result to an outcome; other errors are mistakes
/// in the request.
fn found(result: Result<Fit, IdentificationError>) -> Result<SearchOutcome, IdentificationError> {
    match result {
        Ok(fit) => Ok(Ok(fit)),
        Err(IdentificationError::NotFound(unfound)) => Ok(Err(unfound)),
        Err(error) => Err(error),
    }
}
