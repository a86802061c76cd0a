//! The findings as text.

use std::fmt::Write as _;

use super::apparatus::{Apparatus, FORMS};
use super::arguments::Arguments;
use super::experiment::Run;
use super::findings::{Findings, Frequencies, Peak};
use super::terms::{Sizes, TERMS};
use branched_pendulum_frame::command_line::plain;

/// Three lines of headings for each column of a table.
type Headings = [[&'static str; 3]];

const MOTION: &Headings = &[
    ["θ_1(0)", "", "deg"],
    ["growth", "of θ_d", ""],
    ["H_d peak", "", "mJ"],
    ["at", "", "s"],
    ["largest", "|θ_m|", "rad"],
    ["W_K : W_P", "published", "%"],
    ["W_K : W_P", "exact", "%"],
];

const MOTION_NOTES: &str = "\
growth     largest |θ_d| of the run, folded to π/2 at most, over |θ_d(0)|
H_d peak   first maximum of H_d that is not exceeded within 2 s on either side
           (the paper: 3.8 s after release from 47.8°); largest |θ_m| and
           W_K : W_P are taken from the release to this peak
W_K : W_P  shares of the kinetic and the potential part in the energy that W
           transfers, in the published and in the exact form
";

const ACCURACY: &Headings = &[
    ["θ_1(0)", "", "deg"],
    ["error of W", FORMS[0], ""],
    ["error of W", FORMS[1], ""],
    ["error of W", FORMS[2], ""],
    ["energy", "error", ""],
    ["steps +", "rejected", ""],
    ["evaluations", "", ""],
];

const ACCURACY_NOTES: &str = "\
error of W    rms of W − dH_d/dt over rms of dH_d/dt until |θ_d| exceeds 0.5 rad,
              in means over one sampling interval; dH_d/dt is taken from H_d
              itself. Forms: angle 1 as published, amplitude 2 the complete
              quadratic form in (θ_d, p_d), exact
energy error  largest deviation of the energy from what friction leaves of the
              initial energy, relative to the latter
";

const SIZES: &Headings = &[
    ["θ_1(0)", "", "deg"],
    ["published", TERMS[0], "rms"],
    ["published", TERMS[1], "rms"],
    ["missing", TERMS[2], "rms"],
    ["missing", TERMS[3], "rms"],
    ["missing", TERMS[2], "max"],
    ["missing", TERMS[3], "max"],
];

const SIZES_NOTES: &str = "\
terms of W's leading order, a quadratic form in (θ_d, p_d): those of the
published form and those that it lacks, over the rms of dH_d/dt until |θ_d|
exceeds 0.5 rad; P of the potential, K of the kinetic energy
";

/// Returns the complete report of the runs: the frequencies, and three tables with one row for each
/// run (findings, accuracy, and size of the terms of W).
pub fn report(
    arguments: &Arguments,
    apparatus: &Apparatus,
    frequencies: Frequencies,
    runs: &[Run],
    findings: &[Findings],
) -> String {
    let mut text = conditions(arguments);
    text.push('\n');
    text.push_str(&frequency_table(frequencies));
    text.push('\n');
    let rows = || runs.iter().zip(findings);
    let motion: Vec<_> = rows().map(|(run, found)| motion_row(run, found)).collect();
    let accuracy: Vec<_> = rows()
        .map(|(run, found)| accuracy_row(run, found))
        .collect();
    text.push_str(&table(MOTION, &motion));
    text.push_str(MOTION_NOTES);
    text.push('\n');
    text.push_str(&table(ACCURACY, &accuracy));
    text.push_str(ACCURACY_NOTES);
    text.push('\n');
    let sizes: Vec<_> = runs.iter().map(|run| sizes_row(apparatus, run)).collect();
    text.push_str(&table(SIZES, &sizes));
    text.push_str(SIZES_NOTES);
    text
}

fn conditions(arguments: &Arguments) -> String {
    let Arguments {
        angles_deg: _,
        disturbance,
        duration,
        friction,
        rate,
        precision,
        tolerance,
        animate: _,
    } = arguments;
    format!(
        "Branched double pendulum, released from rest with the children vertical\n\
         θ_d(0) = {} rad, {friction}, {duration} s, {rate} samples/s\n\
         Integrated in {precision}, Dormand–Prince 8(5,3), tolerance {tolerance:e}\n",
        plain(*disturbance)
    )
}

fn frequency_table(computed: Frequencies) -> String {
    let measured = Frequencies::MEASURED;
    let mut text = String::from("Eigenfrequencies (Hz)   computed   measured (paper)\n");
    for (name, computed, measured) in [
        ("f_+  in phase        ", computed.plus, measured.plus),
        ("f_−  in phase        ", computed.minus, measured.minus),
        (
            "f_d  antiphase       ",
            computed.antiphase,
            measured.antiphase,
        ),
    ] {
        text += &format!("  {name} {computed:.7}   {measured:.2}\n");
    }
    text
}

fn table(columns: &Headings, rows: &[Vec<String>]) -> String {
    let widths: Vec<usize> = columns
        .iter()
        .enumerate()
        .map(|(column, headings)| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            let cells = cells.map(String::as_str).chain(headings.iter().copied());
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        })
        .collect();
    let mut text = String::new();
    for line in 0..3 {
        let headings = columns.iter().filter_map(|headings| headings.get(line));
        push_line(&mut text, headings.copied(), &widths);
    }
    for row in rows {
        push_line(&mut text, row.iter().map(String::as_str), &widths);
    }
    text
}

fn push_line<'a>(text: &mut String, cells: impl Iterator<Item = &'a str>, widths: &[usize]) {
    let mut line = String::new();
    for (cell, &width) in cells.zip(widths) {
        let _ = write!(line, "  {cell:>width$}");
    }
    text.push_str(line.trim_end());
    text.push('\n');
}

fn motion_row(run: &Run, findings: &Findings) -> Vec<String> {
    let peak = findings.peak.as_ref();
    let shares = |shares: Option<(f64, f64)>| {
        or_dash(shares.map(|(kinetic, potential)| {
            format!("{:.0} : {:.0}", 100.0 * kinetic, 100.0 * potential)
        }))
    };
    vec![
        angle(run),
        or_dash(findings.growth.map(three_digits)),
        or_dash(peak.map(|peak| three_digits(1e3 * peak.energy))),
        or_dash(peak.map(|peak| format!("{:.2}", peak.time))),
        or_dash(peak.map(|peak| format!("{:.2}", peak.largest_mean))),
        shares(peak.and_then(Peak::published_shares)),
        shares(peak.and_then(Peak::exact_shares)),
    ]
}

fn accuracy_row(run: &Run, findings: &Findings) -> Vec<String> {
    let small = |value: Option<f64>| or_dash(value.map(|value| format!("{value:.1e}")));
    let mut row = vec![angle(run)];
    row.extend(findings.deviations.map(small));
    row.push(small(findings.energy_error));
    row.push(format!("{} + {}", run.work.steps, run.work.rejected));
    row.push(run.work.evaluations.to_string());
    row
}

fn sizes_row(apparatus: &Apparatus, run: &Run) -> Vec<String> {
    let mut row = vec![angle(run)];
    let sizes = Sizes::of(apparatus, run);
    let cell = |value: Option<f64>| or_dash(value.map(|value| format!("{value:.2}")));
    row.extend((0..4).map(|term| cell(sizes.map(|sizes| sizes.rms[term]))));
    row.extend((2..4).map(|term| cell(sizes.map(|sizes| sizes.largest[term]))));
    row
}

fn angle(run: &Run) -> String {
    format!("{:?}", run.angle_deg)
}

fn or_dash(text: Option<String>) -> String {
    text.unwrap_or_else(|| "—".to_owned())
}

/// Formats a number with three significant digits, or with all digits before the decimal point if
/// these are more.
pub(super) fn three_digits(value: f64) -> String {
    let before = value.abs().log10().floor();
    if before < -3.0 {
        format!("{value:.2e}")
    } else {
        let after = (2.0 - before).clamp(0.0, 5.0) as usize;
        format!("{value:.after$}")
    }
}

#[cfg(test)]
mod tests {
    use super::{ACCURACY_NOTES, MOTION_NOTES, SIZES_NOTES, table, three_digits};
    use crate::branched_double::findings::{PEAK_REACH, SMALL_ANGLE};

    #[test]
    fn numbers_keep_three_digits() {
        for (value, text) in [
            (1.2345, "1.23"),
            (12.345, "12.3"),
            (12345.6, "12346"),
            (0.0012345, "0.00123"),
            (1.2345e-5, "1.23e-5"),
            (0.0, "0.00e0"),
        ] {
            assert_eq!(three_digits(value), text);
        }
    }

    #[test]
    fn the_notes_tell_the_limits_in_force() {
        assert!(MOTION_NOTES.contains(&format!("within {PEAK_REACH} s on either side")));
        for notes in [ACCURACY_NOTES, SIZES_NOTES] {
            assert!(notes.contains(&format!("exceeds {SMALL_ANGLE} rad")));
        }
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let rows = [
            vec!["1".to_owned(), "θ_d".to_owned()],
            vec!["10000".to_owned(), "—".to_owned()],
        ];
        let table = table(&[["a", "", "s"], ["b", "c", ""]], &rows);
        assert_eq!(
            table,
            "      a    b\n           c\n      s\n      1  θ_d\n  10000    —\n"
        );
    }
}
