//! The findings as text.

use branched_pendulum_frame::Failure;

use super::apparatus::{EXACT, PUBLISHED};
use super::findings::{Findings, Frequencies};
use super::release::{Run, TOLERANCE};
use super::scan::{ScanPoint, bands};
use super::{Arguments, RATE, spectrum};

const MOTION: &str = "  θ_1(0)  growth  H_d peak    at  largest   W_K : W_P   W_K : W_P
          of θ_d                    |θ_m|   published       exact
     deg                mJ     s      rad           %           %
";

const MOTION_NOTES: &str = "\
growth     largest |θ_d| of the run, folded to π/2 at most, over |θ_d(0)|
H_d peak   first maximum of H_d that is not exceeded within 2 s on either side
           (the paper: 3.8 s after release from 47.8°); largest |θ_m| and
           W_K : W_P are taken from the release to this peak
W_K : W_P  shares of the kinetic and the potential part in the energy that W
           transfers, in the published and in the exact form

";

const ACCURACY: &str = "  θ_1(0)  error of W   error of W  error of W
             angle 1  amplitude 2       exact
     deg
";

const ACCURACY_NOTES: &str = "\
error of W  rms of W − dH_d/dt over rms of dH_d/dt until |θ_d| exceeds 0.5 rad,
            in means over one sampling interval; dH_d/dt is taken from H_d
            itself. Forms: angle 1 as published, amplitude 2 the complete
            quadratic form in (θ_d, p_d), exact

";

const TERMS: &str = "  θ_1(0)  published  published    missing  missing    missing  missing
               p_d²  p_dθ_d, P  p_dθ_d, K     θ_d²  p_dθ_d, K     θ_d²
     deg        rms        rms        rms      rms        max      max
";

const TERMS_NOTES: &str = "\
terms of W's leading order, a quadratic form in (θ_d, p_d): those of the
published form and those that it lacks, over the rms of dH_d/dt until |θ_d|
exceeds 0.5 rad; P of the potential, K of the kinetic energy

";

/// Printed if a run without friction is requested; it names the nearest run to the paper's.
const NEAREST_THE_PAPER: &str = "\
Without friction the antiphase mode grows from more angles than in the paper's experiment.
Its figures are met best by `--friction-children 3.5e-5 --disturbance 0.02`.

";

/// Returns the complete report of the runs: the frequencies, three tables with one row for each run
/// (findings, accuracy, and size of the terms of W), the bands of a scan, and the spectral lines.
///
/// # Errors
/// [`Failure::Spectrum`].
pub fn text(
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
    scan: &[ScanPoint],
) -> Result<String, Failure> {
    let mut text = format!(
        "Branched double pendulum, released from rest with the children vertical\n\
         {}, {} s, {RATE} samples/s\n\
         Integrated by Dormand–Prince 8(5,3), tolerance {TOLERANCE:e}\n\n",
        arguments.conditions(),
        arguments.duration
    );
    text += &frequency_table(frequencies);
    let findings: Vec<Findings> = runs.iter().map(Findings::new).collect();
    for (heading, row, notes) in [
        (MOTION, motion_row as fn(&Findings) -> String, MOTION_NOTES),
        (ACCURACY, accuracy_row, ACCURACY_NOTES),
        (TERMS, terms_row, TERMS_NOTES),
    ] {
        text += heading;
        for (run, findings) in runs.iter().zip(&findings) {
            let angle = format!("{:?}", run.angle_deg);
            text += &format!("  {angle:>6}  {}\n", row(findings));
        }
        text += notes;
    }
    text += &bands(scan);
    if let Some(gentlest) = runs.first() {
        text += &spectrum::lines(gentlest)?;
    }
    if arguments.is_frictionless() {
        text += NEAREST_THE_PAPER;
    }
    Ok(text)
}

fn frequency_table(computed: Frequencies) -> String {
    let mut text = String::from("Eigenfrequencies (Hz)   computed   measured (paper)\n");
    for (name, computed, measured) in [
        ("f_+  in phase ", computed.plus, 0.88),
        ("f_−  in phase ", computed.minus, 1.58),
        ("f_d  antiphase", computed.antiphase, 1.26),
    ] {
        text += &format!("  {name:21} {computed:.7}   {measured:.2}\n");
    }
    text + "\n"
}

fn motion_row(findings: &Findings) -> String {
    let peak = findings.peak.as_ref();
    let shares = |form| {
        let shares = peak.and_then(|peak| peak.shares(form));
        or_dash(shares, |(kinetic, potential)| {
            format!("{:.0} : {:.0}", 100.0 * kinetic, 100.0 * potential)
        })
    };
    format!(
        "{:>6}  {:>8}  {:>4}  {:>7}  {:>10}  {:>10}",
        or_dash(findings.growth, three_digits),
        or_dash(peak, |peak| three_digits(
            1e3 * peak.sample.antiphase_energy
        )),
        or_dash(peak, |peak| format!("{:.2}", peak.sample.time)),
        or_dash(peak, |peak| format!("{:.2}", peak.largest_mean)),
        shares(PUBLISHED),
        shares(EXACT),
    )
}

fn accuracy_row(findings: &Findings) -> String {
    let error = |error: Option<f64>| or_dash(error, |error| format!("{error:.1e}"));
    let [published, quadratic, exact] = findings.deviations.map(error);
    format!("{published:>10}  {quadratic:>11}  {exact:>10}")
}

fn terms_row(findings: &Findings) -> String {
    let cell = |term: usize, size: usize| {
        or_dash(findings.terms, |terms| format!("{:.2}", terms[term][size]))
    };
    format!(
        "{:>9}  {:>9}  {:>9}  {:>7}  {:>9}  {:>7}",
        cell(0, 0),
        cell(1, 0),
        cell(2, 0),
        cell(3, 0),
        cell(2, 1),
        cell(3, 1)
    )
}

fn or_dash<V>(value: Option<V>, format: impl Fn(V) -> String) -> String {
    value.map_or("—".to_owned(), format)
}

/// Formats a number with three significant digits, or with all digits before the decimal point if
/// these are more.
pub fn three_digits(value: f64) -> String {
    let before = value.abs().log10().floor();
    if before < -3.0 {
        return format!("{value:.2e}");
    }
    let after = (2.0 - before).clamp(0.0, 5.0) as usize;
    format!("{value:.after$}")
}
