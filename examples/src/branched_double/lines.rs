//! Spectral lines of θ_m that can be separated in a record as long as the paper's.

use branched_pendulum_measure::{LineSearch, Lines, SpectrumError};

use super::apparatus::MEAN;
use super::experiment::Run;

/// Length of the record from which the paper's spectrum was computed, in s.
pub(super) const SPAN: f64 = 32.0;

/// Number of lines that are searched for, and number of those that are reported: the last ones
/// found are distorted by still weaker ones.
const SOUGHT: usize = 18;
const TOLD: usize = 12;

/// Highest order of a combination that names a line, and the largest distance of the line from the
/// combination's frequency, in cycles per record.
const ORDER: u32 = 11;
const TOLERANCE: f64 = 0.01;

/// Names of the two strongest lines, in the order of their frequencies.
const NAMES: [&str; 2] = ["f_+", "f_−"];

/// Returns θ_m of a run, up to the time [`SPAN`].
pub(super) fn mean_angle(run: &Run) -> Vec<f64> {
    let samples = run.samples.iter();
    let samples = samples.take_while(|sample| sample.time < SPAN);
    samples.map(|sample| sample.coordinates[MEAN]).collect()
}

/// Finds the spectral lines of a run that was sampled at `rate` (Hz).
///
/// # Errors
/// [`SpectrumError`].
pub fn of(run: &Run, rate: f64) -> Result<Lines, SpectrumError> {
    let search = LineSearch {
        most: SOUGHT,
        ..LineSearch::default()
    };
    search.find(&mean_angle(run), rate)
}

/// Returns names of the lines as combinations of the two strongest lines.
fn names(lines: &Lines) -> Vec<String> {
    let [first, second, ..] = lines.lines.as_slice() else {
        return vec![String::new(); lines.lines.len()];
    };
    let mut fundamentals = [first.frequency_hz, second.frequency_hz];
    fundamentals.sort_by(f64::total_cmp);
    let named = lines.named(&fundamentals, ORDER, TOLERANCE * lines.resolution_hz);
    let named = named.iter();
    named
        .map(|name| {
            name.as_ref()
                .map_or(String::new(), |name| name.named(&NAMES))
        })
        .collect()
}

/// The lines as a table.
pub fn report(angle_deg: f64, lines: &Lines) -> String {
    let mut text = format!(
        "Lines of θ_m from {angle_deg:?}°; those nearer than {:.3} Hz are one in a record this long\n  \
         frequency (Hz)         amplitude (rad)  name\n",
        lines.resolution_hz
    );
    for (line, name) in lines.lines.iter().zip(names(lines)).take(TOLD) {
        let row = format!(
            "  {:<9.7} ± {:<8.1e} {:>16.6}  {name}",
            line.frequency_hz, line.deviation_hz, line.amplitude
        );
        text += &format!("{}\n", row.trim_end());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{TOLD, names, of, report};
    use crate::branched_double::{Arguments, Run};

    #[test]
    fn lines_of_the_gentlest_release_have_names() {
        let arguments = Arguments {
            disturbance: 0.0,
            ..Arguments::default()
        };
        let run = Run::new(39.5, &arguments, |_| {}).unwrap();
        let lines = of(&run, arguments.rate).unwrap();
        let names = names(&lines);
        let named = names.iter().take(TOLD).filter(|name| !name.is_empty());
        assert!(named.count() >= 10, "{names:?}");
        assert_eq!(names[..3], ["f_+", "f_−", "2f_+ − f_−"]);
        // The paper saw them at 1.38 and near 0.33 Hz.
        assert!((lines.lines[1].frequency_hz - 1.38467395).abs() < 1e-5);
        assert!((lines.lines[2].frequency_hz - 0.32396674).abs() < 1e-5);
        assert!(report(39.5, &lines).contains("  2f_+ − f_−\n"));
    }
}
