//! Maps of the region in which each truncated form of W fails. The axes are the amplitude of the
//! motion that the truncation assumes to be small, and the size of the motion that feeds it.

use branched_pendulum::analysis::truncation::{Background, PhaseAverage, logarithmic};
use branched_pendulum::{TransferForm, TransferForms};
use branched_pendulum_charts::{Axis, Chart, Panel};
use branched_pendulum_data::{Cell, Column};

use crate::scenes::BranchedDouble;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Random states at each place.
const STATES: usize = 400;

/// Seed of their random numbers.
const SEED: u64 = 0;

/// Time after the release during which the in-phase motion is used, in s.
const BACKGROUND: f64 = 10.0;

/// Accuracy of a form of W, in classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worth {
    /// Error at most 1 % of the exact form, comparing rms values.
    Accurate,
    /// Error larger than that, but smaller than the transfer itself.
    Bounded,
    /// Error larger than the transfer itself.
    Useless,
}

impl Worth {
    /// All truncations.
    pub const ALL: [Self; 3] = [Self::Accurate, Self::Bounded, Self::Useless];

    /// As the chart names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accurate => "accurate",
            Self::Bounded => "bounded but wrong",
            Self::Useless => "useless",
        }
    }

    /// Returns the class of an error relative to the transfer.
    pub fn of(error: f64) -> Self {
        if error <= 0.01 {
            Self::Accurate
        } else if error < 1.0 {
            Self::Bounded
        } else {
            Self::Useless
        }
    }
}

/// Error of a form of W, for an amplitude and a release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormError {
    /// The form.
    pub form: TransferForm,
    /// Amplitude of θ_d, rad.
    pub amplitude: f64,
    /// Angle of release of the in-phase motion, in degrees.
    pub release: f64,
    /// Rms of the difference from the exact W, divided by the rms of the exact W.
    pub error: f64,
}

/// Computes the map of the paper's apparatus, on all cores.
///
/// # Errors
/// [`Failure::Truncation`].
pub fn map(job: &Job) -> Result<Vec<FormError>, Failure> {
    let releases: Vec<f64> = (1..=11).map(|k| 15.0 * f64::from(k)).collect();
    let progress = job.progress(releases.len());
    progress.begin("truncation");
    job.report("seed", SEED);
    let mut places = Vec::new();
    for release in releases {
        places.extend(after(release)?);
        progress.next();
    }
    Ok(places)
}

/// Computes the errors after one release (in degrees), at all amplitudes.
///
/// # Errors
/// [`Failure::Truncation`].
pub fn after(release: f64) -> Result<Vec<FormError>, Failure> {
    let model = BranchedDouble::new();
    let start = [release.to_radians(), 0.0, 0.0];
    let average = PhaseAverage {
        amplitudes: logarithmic([0.01, 1.5], 20),
        states: STATES,
        seed: SEED,
        background: Background::visited(&model, &start, BACKGROUND)?,
    };
    let mut places = Vec::new();
    for curve in average.curves(&model)? {
        for point in &curve.points {
            let forms = curve.forms.iter().zip(&point.errors);
            places.extend(forms.map(|(&form, &error)| FormError {
                form,
                amplitude: point.amplitude,
                release,
                error,
            }));
        }
    }
    Ok(places)
}

fn forms() -> impl Iterator<Item = TransferForm> {
    let forms = <BranchedDouble as TransferForms<f64>>::TRANSFER_FORMS.iter();
    forms.copied().filter(|form| *form != TransferForm::Exact)
}

/// Returns the table of the number of map points at which each form has each accuracy.
pub fn table(places: &[FormError]) -> String {
    let mut text = format!(
        "Truncations of W: amplitude of θ_d against release\n\n{:24}",
        ""
    );
    for worth in Worth::ALL {
        text += &format!("{:>18}", worth.name());
    }
    text.push('\n');
    for form in forms() {
        text += &format!("{:24}", form.to_string());
        for worth in Worth::ALL {
            let own = places.iter().filter(|place| place.form == form);
            let count = own.filter(|place| Worth::of(place.error) == worth).count();
            text += &format!("{count:>18}");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// Prints the table and writes CSV file and chart.
///
/// # Errors
/// [`Failure`].
pub fn deliver(job: &Job, places: &[FormError]) -> Result<(), Failure> {
    let columns = [
        Column::new("form", ""),
        Column::new("amplitude", "rad"),
        Column::new("release", "degrees"),
        Column::new("relative error", ""),
        Column::new("worth", ""),
    ];
    job.csv("stability-truncation.csv", &columns, |csv| {
        places.iter().try_for_each(|place| {
            let form = place.form.to_string();
            csv.row([
                Cell::from(form.as_str()),
                place.amplitude.into(),
                place.release.into(),
                place.error.into(),
                Worth::of(place.error).name().into(),
            ])
        })
    })?;
    job.chart("stability-truncation", &chart(places))?;
    job.print(&table(places))
}

/// Errors at which the colours of the map change; they include the limits of [`Worth`].
const LEVELS: [f64; 4] = [1e-4, 0.01, 0.1, 1.0];

fn chart(places: &[FormError]) -> Chart {
    let title = "Relative error of truncated W: amplitude of θ_d against the release that feeds it";
    let rows = forms().count().div_ceil(2);
    let chart = Chart::new(title, Axis::log("amplitude of θ_d (rad)"))
        .columns(2)
        .size(1000.0, 120.0 + 240.0 * rows as f64);
    forms().fold(chart, |chart, form| {
        let own = || places.iter().filter(|place| place.form == form);
        let x: Vec<f64> = own().map(|place| place.amplitude).collect();
        let y: Vec<f64> = own().map(|place| place.release).collect();
        let errors: Vec<f64> = own().map(|place| place.error).collect();
        let panel = Panel::new(Axis::linear(format!("{form}: θ_1(0) (°)")));
        chart.panel(panel.heatmap(&x, &y, &errors, &LEVELS))
    })
}
