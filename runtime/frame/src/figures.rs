//! Charts as figures of a paper: `--figure-width` and `--show`.

use std::fmt;

use branched_pendulum_charts::Chart;

use crate::failure::Failure;

/// The charts of a program, by the options that they have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Charts {
    /// None.
    None,
    /// Charts whose width may be asked for.
    Any,
    /// Some of them over time, of which a span may be asked for.
    OverTime,
}

/// What is asked of charts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Width as figures of a paper, mm.
    pub width: Option<f64>,
    /// Time that charts over time show.
    pub shown: Option<TimeSpan>,
}

/// A span of time, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// Where it begins.
    pub from: f64,
    /// Where it ends, later.
    pub to: f64,
}

impl Figures {
    /// The chart as it is asked for.
    pub(crate) fn of(&self, chart: &Chart) -> Chart {
        match self.width {
            Some(width) => chart.clone().figure(width),
            None => chart.clone(),
        }
    }

    /// The chart, whose x axis is time in s, over the time that is asked for.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where none of its samples is from that time.
    pub(crate) fn over_time(&self, chart: &Chart) -> Result<Chart, Failure> {
        let chart = chart.clone();
        let Some(shown @ TimeSpan { from, to }) = self.shown else {
            return Ok(chart);
        };
        if let Some((first, last)) = chart.x_extent() {
            let checked = shown.check(first, last);
            checked.map_err(|what| Failure::Lacking { what })?;
        }
        Ok(chart.x_range(from, to))
    }
}

impl TimeSpan {
    /// Reads `FROM:TO`.
    ///
    /// # Errors
    /// What is wrong, with what to write.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let number = |part: &str| part.trim().parse().ok().filter(|at: &f64| at.is_finite());
        let ends = text.split_once(':');
        let ends = ends.and_then(|(from, to)| Some([number(from)?, number(to)?]));
        match ends {
            Some([from, to]) if from < to => Ok(Self { from, to }),
            Some([from, to]) if from > to => {
                Err(format!("it ends before it begins: write `{to}:{from}`"))
            }
            Some(_) => Err("it is empty: the end must be later than the beginning".to_owned()),
            None => Err("not a span of time: write `FROM:TO` in seconds, as in `2:10`".to_owned()),
        }
    }

    /// Refuses a span that has nothing of the time from `first` to `last`.
    pub(crate) fn check(self, first: f64, last: f64) -> Result<(), String> {
        match self.from < last && self.to > first {
            true => Ok(()),
            false => Err(format!(
                "`--show {self}` has nothing of the motion, which goes from {first} to {last} s: \
                 choose a span of that"
            )),
        }
    }
}

impl fmt::Display for TimeSpan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.from, self.to)
    }
}

#[cfg(test)]
mod tests {
    use super::{Figures, TimeSpan};
    use branched_pendulum_charts::{Axis, Chart, Panel};

    #[test]
    fn a_span_is_read_or_refused_with_what_to_write() {
        let read = |text| TimeSpan::read(text);
        for (text, from, to) in [("2:10", 2.0, 10.0), ("-1: 0.5", -1.0, 0.5)] {
            assert_eq!(read(text), Ok(TimeSpan { from, to }));
        }
        for (text, told) in [
            ("10:2", "write `2:10`"),
            ("3:3", "it is empty"),
            ("3", "write `FROM:TO`"),
            ("3:nan", "write `FROM:TO`"),
            ("1:2:3", "write `FROM:TO`"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.contains(told), "{text}: {error}");
        }
    }

    #[test]
    fn a_chart_shows_the_span_or_refuses_a_foreign_one() {
        let times = [0.0, 1.0, 2.0];
        let panel = Panel::new(Axis::linear("y")).line("", &times, &times);
        let chart = Chart::new("", Axis::linear("t (s)")).panel(panel);
        let over = |from, to| {
            let figures = Figures {
                width: None,
                shown: Some(TimeSpan { from, to }),
            };
            figures.over_time(&chart)
        };
        assert_eq!(
            over(0.5, 3.0).expect("it meets the chart"),
            chart.clone().x_range(0.5, 3.0)
        );
        for (from, to) in [(2.0, 3.0), (-1.0, 0.0)] {
            let error = over(from, to).expect_err("nothing is there").to_string();
            assert!(error.contains("from 0 to 2 s"), "{error}");
        }
        let all = Figures::default().over_time(&chart);
        assert_eq!(all.expect("nothing is asked for"), chart);
    }
}
