//! Windows in words, and the table of all values.

use std::fmt::Write;

use branched_pendulum::analysis::growth::{Checked, Grown};
use branched_pendulum_data::{Cell, Column};

use super::arguments::Arguments;
use super::scan::{Friction, PAPER, Scan};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;
use branched_pendulum_frame::windows::{windows, words};

/// Most windows that a line tells; the table has all of them.
const MOST_WINDOWS: usize = 12;

/// The report of all frictions.
pub fn report(arguments: &Arguments, scans: &[Scan]) -> String {
    let (Some(first), Some(last)) = (arguments.angles_deg.first(), arguments.angles_deg.last())
    else {
        return String::new();
    };
    let mut text = format!(
        "Growth factor G(T) of a small antiphase difference: largest |θ_d| within T over\n\
         |θ_d(0)|, released from rest with vertical children, at {} angles from {first}° to\n\
         {last}°; between them nothing was looked at\n",
        arguments.angles_deg.len()
    );
    for scan in scans {
        text.push_str(&windows_of(arguments, scan));
    }
    text.push_str(&paper(arguments, scans));
    text.push_str(&conclusions(arguments, scans));
    text
}

fn windows_of(arguments: &Arguments, scan: &Scan) -> String {
    let mut text = match scan.friction {
        Friction::Without => format!("\n{}\n", scan.friction),
        Friction::Quality(_) => format!(
            "\n{} (friction {:.3e} N m s in each child's pivot)\n",
            scan.friction, scan.constant
        ),
    };
    let angles = &scan.angles_deg;
    let told = |windows: Vec<[usize; 2]>| match windows.len().checked_sub(MOST_WINDOWS) {
        None | Some(0) => words(&windows, angles),
        Some(more) => format!(
            "{}, and {more} more",
            words(&windows[..MOST_WINDOWS], angles)
        ),
    };
    for (number, horizon) in arguments.horizons.iter().enumerate() {
        let factor = |index: usize| scan.grown[index].factors[number];
        for level in &arguments.levels {
            let inside = windows(angles.len(), |index| factor(index).value >= *level);
            let from = format!("G({horizon} s) ≥ {level}");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {from:20} {}", told(inside));
        }
        let open = |index: usize| !factor(index).is_determined();
        let count = (0..scan.grown.len()).filter(|index| open(*index)).count();
        if count > 0 {
            let all = told(windows(angles.len(), open));
            let _ = writeln!(
                text,
                "  G({horizon} s) is not determined at {count} angles: {all}"
            );
        }
    }
    text
}

/// The growth at the angles of the paper.
fn paper(arguments: &Arguments, scans: &[Scan]) -> String {
    let mut text = format!(
        "\nThe paper sees no growth up to {}°, and growth from {}° on; there G is\n{:24}",
        PAPER[0], PAPER[1], ""
    );
    for horizon in &arguments.horizons {
        for angle in PAPER {
            let _ = write!(text, "{:>16}", format!("{angle}°, {horizon} s"));
        }
    }
    text.push('\n');
    for scan in scans {
        let _ = write!(text, "  {:22}", scan.friction.to_string());
        for number in 0..arguments.horizons.len() {
            for grown in &scan.paper {
                let _ = write!(text, "{:>16}", told(grown.factors[number]));
            }
        }
        text.push('\n');
    }
    text.push_str("(a ? stands where the two tolerances differ by more than 1 %)\n");
    text
}

/// A factor in few digits, with a mark where it is not determined.
fn told(factor: Checked) -> String {
    let mark = if factor.is_determined() { "" } else { " ?" };
    match factor.value {
        value if value < 1e4 => format!("{value:.1}{mark}"),
        value => format!("{value:.1e}{mark}"),
    }
}

/// Consequences for the paper's threshold.
fn conclusions(arguments: &Arguments, scans: &[Scan]) -> String {
    let (Some(level), Some(first)) = (arguments.levels.first(), scans.first()) else {
        return String::new();
    };
    let mut text = String::from("\n");
    let begins = |scan: &Scan, number: usize| {
        let grows = |grown: &Grown| grown.factors[number].value >= *level;
        scan.points()
            .find(|(_, grown)| grows(grown))
            .map(|(a, _)| a)
    };
    for (number, horizon) in arguments.horizons.iter().enumerate() {
        let angles = scans.iter().filter_map(|scan| {
            let angle = begins(scan, number)?;
            Some(format!("{angle}° ({})", scan.friction))
        });
        let angles: Vec<String> = angles.collect();
        if !angles.is_empty() {
            let _ = writeln!(
                text,
                "G reaches {level} within {horizon} s first at {}",
                angles.join(", ")
            );
        }
    }
    let separates = |scan: &&Scan| {
        (0..arguments.horizons.len()).any(|number| {
            let [below, above] = [0, 1].map(|i| scan.paper[i].factors[number].value >= *level);
            !below && above
        })
    };
    let separating: Vec<String> = scans
        .iter()
        .filter(separates)
        .map(|scan| scan.friction.to_string())
        .collect();
    let both = (0..arguments.horizons.len()).map(|number| {
        let [below, above] = [0, 1].map(|i| told(first.paper[i].factors[number]));
        format!(
            "{below} and {above} within {} s",
            arguments.horizons[number]
        )
    });
    let both: Vec<String> = both.collect();
    let side = if separates(&first) {
        "does"
    } else {
        "does not"
    };
    let _ = writeln!(
        text,
        "The ideal model {side} separate {}° from {}°: G is {}",
        PAPER[0],
        PAPER[1],
        both.join(", ")
    );
    if !separating.is_empty() {
        let _ = writeln!(
            text,
            "G = {level} lies between them with {}: so much friction brings the model to the paper's \
             threshold",
            separating.join(", ")
        );
    }
    text
}

/// Writes the table of all angles and frictions.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write(job: &Job, arguments: &Arguments, scans: &[Scan]) -> Result<(), Failure> {
    let names: Vec<[String; 2]> = arguments
        .horizons
        .iter()
        .map(|horizon| {
            let name = format!("growth factor within {horizon} s");
            [name.clone(), format!("{name} between tolerances")]
        })
        .collect();
    let mut columns = vec![
        Column::new("quality factor", ""),
        Column::new("theta_1", "degrees"),
        Column::new("growth rate", "1/s"),
        Column::new("frequency of the difference", "Hz"),
    ];
    let factors = names.iter().flatten();
    columns.extend(factors.map(|name| Column::new(name.as_str(), "")));
    job.csv("growth-factor.csv", &columns, |csv| {
        for scan in scans {
            let quality = match scan.friction {
                Friction::Without => f64::INFINITY,
                Friction::Quality(quality) => quality,
            };
            for (angle, grown) in scan.points() {
                let Grown {
                    factors,
                    rate,
                    frequency_hz,
                } = grown;
                let both = factors.iter().flat_map(|f| [f.value, f.difference]);
                let row = [quality, angle, rate.value, frequency_hz.value];
                csv.row(row.into_iter().chain(both).map(Cell::from))?;
            }
        }
        Ok(())
    })
}
