//! Times of contenders that take turns, and the tables that show them.
//!
//! Contenders run one after the other in every round, so that a change of the processor's clock
//! affects all of them. Disturbances only lengthen a run: the shortest time is the one to compare.
//! If two contenders differ by a few per cent, the median of their ratios round by round is more
//! reliable.

use std::fmt;
use std::time::Instant;

/// One pass of a contender, which is timed as a whole.
pub type Pass<'a> = Box<dyn FnMut() + 'a>;

/// Times of the passes of one contender in s, round by round.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times(Vec<f64>);

impl Times {
    /// Returns the shortest time in s; infinite if there are no rounds.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Returns the median time in s; NaN if there are no rounds.
    #[must_use]
    pub fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// Returns the median of the ratios to the times of another contender in the same rounds.
    #[must_use]
    pub fn ratio_to(&self, other: &Self) -> f64 {
        let pairs = self.0.iter().zip(&other.0);
        median(pairs.map(|(own, other)| own / other).collect())
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Runs all passes one after the other, this many rounds, and returns the times of each.
pub fn in_turns<P: FnMut()>(rounds: usize, passes: &mut [P]) -> Vec<Times> {
    turns(rounds, passes, false)
}

/// Runs all passes like [`in_turns`], each with an untimed pass before the timed one, so that its
/// code and data are in the caches.
pub fn in_warm_turns<P: FnMut()>(rounds: usize, passes: &mut [P]) -> Vec<Times> {
    turns(rounds, passes, true)
}

fn turns<P: FnMut()>(rounds: usize, passes: &mut [P], is_warmed: bool) -> Vec<Times> {
    let mut times = vec![Times::default(); passes.len()];
    for _ in 0..rounds {
        for (pass, Times(times)) in passes.iter_mut().zip(&mut times) {
            if is_warmed {
                pass();
            }
            let start = Instant::now();
            pass();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    times
}

/// Runs a pass this many times, and returns its shortest time in s.
pub fn least(rounds: usize, pass: impl FnMut()) -> f64 {
    in_turns(rounds, &mut [pass])[0].least()
}

/// Contender of a comparison.
pub struct Contender<'a> {
    /// Name in the table.
    pub name: String,
    /// Number of units, such as states or trajectories, that one pass computes.
    pub units: f64,
    /// The pass.
    pub pass: Pass<'a>,
}

impl<'a> Contender<'a> {
    /// Creates a contender whose pass computes this many units.
    pub fn new(name: impl Into<String>, units: f64, pass: impl FnMut() + 'a) -> Self {
        Self {
            name: name.into(),
            units,
            pass: Box::new(pass),
        }
    }
}

/// Runs the contenders in turns. Returns a table with the shortest time of each for one unit, the
/// units per second, and the ratio of the times to that of the first contender.
#[must_use]
pub fn compared(rounds: usize, contenders: Vec<Contender<'_>>) -> Table {
    let labels = contenders.iter().map(|own| (own.name.clone(), own.units));
    let labels: Vec<(String, f64)> = labels.collect();
    let mut passes: Vec<Pass<'_>> = contenders.into_iter().map(|own| own.pass).collect();
    let times = in_turns(rounds, &mut passes);
    let each = labels.iter().zip(&times);
    let each: Vec<f64> = each.map(|((_, units), own)| own.least() / units).collect();
    let table = Table::new(["", "time", "per second", "over the first"]);
    let rows = labels.iter().zip(&each);
    rows.fold(table, |table, ((name, _), seconds)| {
        table.row([
            name.clone(),
            duration(*seconds),
            format!("{:.0}", 1.0 / seconds),
            format!("{:.2}", seconds / each[0]),
        ])
    })
}

/// Returns a duration in s as text with three digits and a unit.
fn duration(seconds: f64) -> String {
    let (factor, unit) = match seconds {
        _ if seconds < 1e-6 => (1e9, "ns"),
        _ if seconds < 1e-3 => (1e6, "µs"),
        _ => (1e3, "ms"),
    };
    let value = seconds * factor;
    let places = usize::from(value < 100.0) + usize::from(value < 10.0);
    format!("{value:.places$} {unit}")
}

/// Table in Markdown. The first column is aligned to the left, all others to the right.
#[derive(Clone, Debug, PartialEq)]
pub struct Table(Vec<Vec<String>>);

impl Table {
    /// Creates a table with the heads of its columns.
    #[must_use]
    pub fn new<const N: usize>(heads: [&str; N]) -> Self {
        Self(vec![heads.map(str::to_owned).to_vec()])
    }

    /// Appends a row.
    #[must_use]
    pub fn row(mut self, cells: impl IntoIterator<Item = String>) -> Self {
        self.0.push(cells.into_iter().collect());
        self
    }
}

impl fmt::Display for Table {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells = |column: usize| self.0.iter().filter_map(move |row| row.get(column));
        let width = |column| cells(column).map(|cell| cell.chars().count()).max();
        for (index, row) in self.0.iter().enumerate() {
            for (column, cell) in row.iter().enumerate() {
                let width = width(column).unwrap_or(0);
                match column {
                    0 => write!(formatter, "| {cell:width$} |")?,
                    _ => write!(formatter, " {cell:>width$} |")?,
                }
            }
            writeln!(formatter)?;
            if index == 0 {
                let rules = (1..row.len()).map(|_| "---:|").collect::<String>();
                writeln!(formatter, "|---|{rules}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::{Table, Times, in_turns, in_warm_turns};

    #[test]
    fn passes_take_turns() {
        let order = RefCell::new(String::new());
        let pass = |name: char| {
            let order = &order;
            move || order.borrow_mut().push(name)
        };
        assert_eq!(in_turns(2, &mut [pass('a'), pass('b')]).len(), 2);
        assert_eq!(order.take(), "abab");
        in_warm_turns(2, &mut [pass('a'), pass('b')]);
        assert_eq!(order.take(), "aabbaabb");
    }

    #[test]
    fn ratios_are_of_the_same_round() {
        let (one, other) = (Times(vec![2.0, 30.0, 4.0]), Times(vec![1.0, 10.0, 4.0]));
        assert_eq!((one.least(), one.median()), (2.0, 4.0));
        assert_eq!(one.ratio_to(&other), 2.0);
        assert!(Times::default().median().is_nan());
    }

    #[test]
    fn columns_are_as_wide_as_their_cells() {
        let table = Table::new(["links", "µs"]).row(["3".to_owned(), "1.25".to_owned()]);
        let expected = "| links |   µs |\n|---|---:|\n| 3     | 1.25 |\n";
        assert_eq!(table.to_string(), expected);
        let durations = [1.18e-8, 3.456e-6, 0.2134].map(super::duration);
        assert_eq!(durations, ["11.8 ns", "3.46 µs", "213 ms"]);
    }
}
