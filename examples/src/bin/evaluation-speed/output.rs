//! The table, its CSV and the chart.

use std::fmt::Write;

use branched_pendulum::scalar::InstructionSet;
use branched_pendulum_charts::{Axis, Chart, Panel, Series};

use super::accuracy::Errors;
use super::large;
use super::measure::{CONTENDERS, Row};

/// The table that the program prints: times, and beneath each row the ratios to
/// the system's sines and cosines.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "Median time for the accelerations of one state, ns, and over that of the \
         system's\nsines and cosines alone. Batches with {}.\n\n{:12}",
        InstructionSet::widest(),
        "links",
    );
    for name in CONTENDERS {
        push(&mut text, format_args!(" {name:>14}"));
    }
    text.push('\n');
    for row in rows {
        push(
            &mut text,
            format_args!("{:12}", format!("{} {}", row.links, row.scene)),
        );
        for time in row.times {
            let cell = time.map_or("-".to_owned(), |time| format!("{time:.2}"));
            push(&mut text, format_args!(" {cell:>14}"));
        }
        push(&mut text, format_args!("\n{:12}", ""));
        for time in row.times {
            let ratio = time.zip(row.times[0]).map(|(time, sines)| time / sines);
            let cell = ratio.map_or(String::new(), |ratio| format!("({ratio:.3})"));
            push(&mut text, format_args!(" {cell:>14}"));
        }
        text.push('\n');
    }
    text
}

/// The table of errors: worst ones in units of the conditioning bound, and
/// beneath each row medians in units in the last place.
#[must_use]
pub fn errors(rows: &[Errors]) -> String {
    let mut text = format!(
        "Worst error in units of u |M⁻¹| (|M| |ω̇| + |b|), and median in ulps. Lanes have\n\
         the bits of single states.\n\n{:12}",
        "links",
    );
    for name in CONTENDERS {
        push(&mut text, format_args!(" {name:>14}"));
    }
    for row in rows {
        push(
            &mut text,
            format_args!("\n{:12}", format!("{} {}", row.links, row.scene)),
        );
        for worst in row.worst {
            let cell = worst.map_or("-".to_owned(), |worst| format!("{worst:.2}"));
            push(&mut text, format_args!(" {cell:>14}"));
        }
        push(&mut text, format_args!("\n{:12}", ""));
        for ulps in row.ulps {
            let cell = ulps.map_or(String::new(), |ulps| format!("({ulps:.1})"));
            push(&mut text, format_args!(" {cell:>14}"));
        }
    }
    text.push('\n');
    text
}

/// Writing to a `String` cannot fail.
fn push(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(arguments);
}

/// Time for one link against the number of links.
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
    // In smaller trees threads take longer to start than the work takes.
    let threaded = large.partition_point(|row| row.links < 100_000);
    let links: Vec<f64> = large.iter().map(|row| row.links as f64).collect();
    let one: Vec<f64> = large.iter().map(|row| row.one).collect();
    let two: Vec<f64> = large.iter().map(|row| row.two).collect();
    panel = panel
        .series(Series::line("loops", &links, &one).with_symbols())
        .series(Series::line("two threads", &links[threaded..], &two[threaded..]).with_symbols());
    Chart::new("Accelerations of one state", Axis::log("links")).panel(panel)
}
