//! Check of the integration by the balance of input and friction.

use branched_pendulum::analysis::statistics::{Average, StatisticsError};

/// Largest error bar, relative to the input, at which an energy balance is conclusive.
const LARGEST_BAR: f64 = 0.1;

/// Check of the integration: input and friction must balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Balance {
    /// The powers are equal within three error bars, and the error bar of their difference is at most
    /// a tenth of the input.
    Closed,
    /// The powers differ by more than three error bars, and the energy is steady: the integration
    /// steps are too long.
    Lost,
    /// The powers differ by more than three error bars, and the energy is not steady: the tree stores
    /// or gives back energy, and the run is too short.
    Drifting,
    /// The error bars are too wide for a conclusion, or there are none.
    Undecided,
}

impl Balance {
    /// Compares `loss`, the difference between input and friction, with its error bar. `steady` is true
    /// if the energy does not drift.
    pub fn of(
        loss: &Result<Average, StatisticsError>,
        input: &Result<Average, StatisticsError>,
        steady: bool,
    ) -> Self {
        match (loss, input) {
            (Ok(loss), _) if loss.mean.abs() > 3.0 * loss.error => match steady {
                true => Self::Lost,
                false => Self::Drifting,
            },
            (Ok(loss), Ok(input)) if loss.error <= LARGEST_BAR * input.mean.abs() => Self::Closed,
            _ => Self::Undecided,
        }
    }

    /// Returns the result in words, with the option that helps; `longer` names a longer run.
    pub fn verdict(self, longer: &str) -> String {
        match self {
            Self::Closed => "balanced".to_owned(),
            Self::Lost => "NOT balanced, take more `--steps`".to_owned(),
            Self::Drifting => {
                format!("NOT balanced, since the energy is not steady; take {longer}")
            }
            Self::Undecided => {
                format!(
                    "undecided, since the error bar is above a tenth of the input; take {longer}"
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Balance;
    use branched_pendulum::analysis::statistics::{Average, StatisticsError};

    fn average(mean: f64, error: f64) -> Result<Average, StatisticsError> {
        Ok(Average {
            mean,
            error,
            deviation: 1.0,
            correlation_time: 1.0,
            samples: 100,
        })
    }

    #[test]
    fn an_unbalanced_run_that_drifts_needs_time_and_not_steps() {
        let verdict = |loss, steady| Balance::of(&average(loss, 0.01), &average(1.0, 0.01), steady);
        assert_eq!(verdict(0.02, true), Balance::Closed);
        assert_eq!(verdict(0.2, true), Balance::Lost);
        assert_eq!(verdict(0.2, false), Balance::Drifting);
        let wide = Balance::of(&average(0.2, 0.2), &average(1.0, 0.01), false);
        assert_eq!(wide, Balance::Undecided);
        let text = Balance::Drifting.verdict("at least `--duration 40`");
        assert!(
            text.ends_with("not steady; take at least `--duration 40`"),
            "{text}"
        );
        assert!(Balance::Lost.verdict("").contains("`--steps`"));
    }
}
