//! Options for charts as figures of a paper: `--figure-width` and `--show`.

use std::fmt;

use branched_pendulum_charts::Chart;

use crate::failure::Failure;

/// Kinds of charts of a program, which determine the options that apply.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Charts {
    /// The program has no charts.
    None,
    /// The program draws charts, whose width can be set, but none with a time axis.
    Any,
    /// The program has charts over time, whose time span can be set too.
    OverTime,
}

/// Options of charts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Width of figures for a paper, in mm.
    pub width: Option<f64>,
    /// Time span that charts over time show; `None` for the whole span.
    pub shown: Option<TimeSpan>,
}

/// A span of time, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// Start of the span, s.
    pub from: f64,
    /// End of the span in s, later than its start.
    pub to: f64,
}

impl Figures {
    /// Returns a copy of a chart with the requested width.
    pub(crate) fn of(&self, chart: &Chart) -> Chart {
        match self.width {
            Some(width) => chart.clone().figure(width),
            None => chart.clone(),
        }
    }

    /// Returns a chart, whose x axis is time in s, restricted to the requested span.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if it has no sample in that span.
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
    /// Parses `FROM:TO`.
    ///
    /// # Errors
    /// A message about the mistake, with what to write.
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

    /// Returns an error if the span contains no time from `first` to `last` (s).
    pub(crate) fn check(self, first: f64, last: f64) -> Result<(), String> {
        match self.from < last && self.to > first {
            true => Ok(()),
            false => Err(format!(
                "`--show {self}` contains nothing of the motion, which lasts from {first} to \
                 {last} s: choose a span within these times"
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
        for (text, reported) in [
            ("10:2", "write `2:10`"),
            ("3:3", "it is empty"),
            ("3", "write `FROM:TO`"),
            ("3:nan", "write `FROM:TO`"),
            ("1:2:3", "write `FROM:TO`"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.contains(reported), "{text}: {error}");
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
