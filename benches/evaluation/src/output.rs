//! The tables of all implementations, and the chart.

use branched_pendulum::scalar::InstructionSet;
use branched_pendulum_charts::{Axis, Chart, Panel, Series};

use super::accuracy::Errors;
use super::large;
use super::measure::{CONTENDERS, Row};

/// Returns the table that the program prints: times, and below each row their ratios to the times
/// of the standard library's sines and cosines.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "Median time for the accelerations of one state, ns, and over that of the \
         system's\nsines and cosines alone. Batches with {}.\n\n",
        InstructionSet::widest(),
    );
    text += &line("links", CONTENDERS.map(str::to_owned));
    for row in rows {
        let cell = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{time:.2}"));
        let ratio = |time: Option<f64>| {
            let ratio = time.zip(row.times[0]).map(|(time, sines)| time / sines);
            ratio.map_or(String::new(), |ratio| format!("({ratio:.3})"))
        };
        let name = format!("{} {}", row.links, row.scene);
        text += &(line(&name, row.times.map(cell)) + line("", row.times.map(ratio)).as_str());
    }
    text
}

/// Returns the table of errors: the largest in units of the conditioning bound, and below each row
/// the medians in units in the last place.
#[must_use]
pub fn errors(rows: &[Errors]) -> String {
    let mut text =
        "Worst error in units of u |M⁻¹| (|M| |ω̇| + |b|), and median in ulps. Lanes have\n\
         the bits of single states.\n\n"
            .to_owned();
    text += &line("links", CONTENDERS.map(str::to_owned));
    for row in rows {
        let worst =
            |error: Option<f64>| error.map_or("-".to_owned(), |error| format!("{error:.2}"));
        let ulps = |ulps: Option<f64>| ulps.map_or(String::new(), |ulps| format!("({ulps:.1})"));
        let name = format!("{} {}", row.links, row.scene);
        text += &(line(&name, row.worst.map(worst)) + line("", row.ulps.map(ulps)).as_str());
    }
    text
}

/// Returns a line of a table, with a cell for each implementation.
fn line(name: &str, cells: [String; CONTENDERS.len()]) -> String {
    let cells = cells.map(|cell| format!(" {cell:>14}"));
    format!("{name:12}{}\n", cells.concat())
}

/// Returns the chart of the time for one link against the number of links.
#[must_use]
pub fn chart(rows: &[Row], large: &[large::Row]) -> Chart {
    let mut panel = Panel::new(Axis::log("time for one link (ns)"));
    for (index, name) in CONTENDERS.iter().enumerate() {
        let points: Vec<(f64, f64)> = rows
            .iter()
            .filter_map(|row| {
                let links = row.links as f64;
                row.times[index].map(|time| (links, time / links))
            })
            .collect();
        let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        panel = panel.series(Series::line(*name, &x, &y).with_symbols());
    }
    let column = |rows: &[large::Row], time: fn(&large::Row) -> f64| -> [Vec<f64>; 2] {
        let links = rows.iter().map(|row| row.links as f64);
        [links.collect(), rows.iter().map(time).collect()]
    };
    // In smaller trees threads take longer to start than the work takes.
    let threaded = &large[large.partition_point(|row| row.links < 100_000)..];
    let [links, one] = column(large, |row| row.one);
    let [many, two] = column(threaded, |row| row.two.unwrap_or(f64::NAN));
    panel = panel
        .series(Series::line("loops", &links, &one).with_symbols())
        .series(Series::line("two threads", &many, &two).with_symbols());
    Chart::new("Accelerations of one state", Axis::log("links")).panel(panel)
}
