//! The tables of all implementations, and the chart.

use branched_pendulum::scalar::InstructionSet;
use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_timing::Table;

use super::accuracy::Errors;
use super::large;
use super::measure::{CONTENDERS, Row};

/// Returns the table that the program prints: times, with their ratios to the times of the standard
/// library's sines and cosines in parentheses.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let rows = rows.iter().map(|row| {
        let sines = row.times[0].unwrap_or(f64::NAN);
        let cell = |time: f64| format!("{time:.2} ({:.3})", time / sines);
        (row.links, row.scene, row.times.map(|time| time.map(cell)))
    });
    format!(
        "Median time for the accelerations of one state, ns, and over that of the \
         system's\nsines and cosines alone. Batches with {}.\n\n{}",
        InstructionSet::widest(),
        of_contenders(rows)
    )
}

/// Returns the table of errors: the largest in units of the conditioning bound, with the medians in
/// units in the last place in parentheses.
#[must_use]
pub fn errors(rows: &[Errors]) -> String {
    let rows = rows.iter().map(|row| {
        let cell = |index: usize| {
            let (worst, ulps) = row.worst[index].zip(row.ulps[index])?;
            Some(format!("{worst:.2} ({ulps:.1})"))
        };
        (row.links, row.scene, std::array::from_fn(cell))
    });
    format!(
        "Worst error in units of u |M⁻¹| (|M| |ω̇| + |b|), and median in ulps. Lanes have\n\
         the bits of single states.\n\n{}",
        of_contenders(rows)
    )
}

/// Cells of the implementations for a scene, after its number of links and its name.
type Cells = (usize, &'static str, [Option<String>; CONTENDERS.len()]);

/// Returns a table with a column for each implementation.
fn of_contenders(rows: impl Iterator<Item = Cells>) -> Table {
    let mut heads = ["links"; CONTENDERS.len() + 1];
    heads[1..].copy_from_slice(&CONTENDERS);
    rows.fold(Table::new(heads), |table, (links, scene, cells)| {
        let cells = cells.map(|cell| cell.unwrap_or("-".to_owned()));
        table.row([format!("{links} {scene}")].into_iter().chain(cells))
    })
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
