//! Growth of θ_d against the angle of release: the angles that were computed and what was found at
//! each. Makes no claim about the angles between them.

use std::f64::consts::FRAC_PI_2;

use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series, Symbol};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_frame::windows::{windows, words};
use branched_pendulum_frame::{Failure, Job};

use super::Arguments;
use super::findings::growth;
use super::release::Run;

/// Smallest number of angles that make a scan; fewer contain no band to report.
const SCAN: usize = 3;

/// Growth factor from which on θ_d counts as grown.
const GROWN: f64 = 10.0;

/// Fate of the disturbance in one run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It grows less than tenfold.
    Small,
    /// It grows tenfold or more.
    Grown,
    /// The children turn over: |θ_d| passes π/2, and the growth factor loses its meaning.
    TurnedOver,
}

impl Fate {
    /// All fates.
    pub const ALL: [Self; 3] = [Self::Small, Self::Grown, Self::TurnedOver];

    /// Words for text and legend.
    pub fn name(self) -> &'static str {
        match self {
            Self::Small => "less than 10-fold",
            Self::Grown => "10-fold or more",
            Self::TurnedOver => "children turn over",
        }
    }

    fn of(run: &Run, growth: f64) -> Self {
        let mut samples = run.samples.iter();
        if samples.any(|sample| sample.difference.abs() >= FRAC_PI_2) {
            Self::TurnedOver
        } else if growth >= GROWN {
            Self::Grown
        } else {
            Self::Small
        }
    }
}

/// One angle of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanPoint {
    /// Angle of release, degrees.
    pub angle_deg: f64,
    /// Growth factor of θ_d.
    pub growth: f64,
    /// Fate of the disturbance.
    pub fate: Fate,
}

/// Returns the points of a scan, by ascending angle: the runs whose growth is defined. Empty if
/// there are too few angles for a scan.
pub fn points(runs: &[Run]) -> Vec<ScanPoint> {
    let point = |run: &Run| {
        let growth = growth(&run.samples)?;
        Some(ScanPoint {
            angle_deg: run.angle_deg,
            growth,
            fate: Fate::of(run, growth),
        })
    };
    let points: Vec<ScanPoint> = runs.iter().filter_map(point).collect();
    match points.len() < SCAN {
        true => Vec::new(),
        false => points,
    }
}

/// Returns the bands of neighbouring angles with the same fate as text; empty without points.
pub fn bands(points: &[ScanPoint]) -> String {
    if points.is_empty() {
        return String::new();
    }
    let angles: Vec<f64> = points.iter().map(|point| point.angle_deg).collect();
    let mut text = String::from(
        "Bands of θ_1(0) by the growth of θ_d, at the angles above; between them\n\
         nothing was looked at\n",
    );
    for fate in Fate::ALL {
        let bands = windows(points.len(), |index| points[index].fate == fate);
        text += &format!("  {:18}  {}\n", fate.name(), words(&bands, &angles));
    }
    text + "\n"
}

/// Writes the table and the chart of a scan; nothing without points.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write(job: &Job, arguments: &Arguments, points: &[ScanPoint]) -> Result<(), Failure> {
    if points.is_empty() {
        return Ok(());
    }
    let columns = [
        Column::new("theta_1", "degrees"),
        Column::new("growth of theta_d", ""),
        Column::new("fate", ""),
    ];
    job.csv("growth.csv", &columns, |csv| {
        points.iter().try_for_each(|point| {
            let fate = Cell::from(point.fate.name());
            csv.row([point.angle_deg.into(), point.growth.into(), fate])
        })
    })?;
    job.chart("growth", &chart(arguments, points))
}

fn chart(arguments: &Arguments, points: &[ScanPoint]) -> Chart {
    let mut panel = Panel::new(Axis::log("largest |θ_d|, folded to π/2, over |θ_d(0)|"));
    for fate in Fate::ALL {
        let (color, symbol) = match fate {
            Fate::Small => (Color::rgb(0, 114, 178), Symbol::Circle),
            Fate::Grown => (Color::rgb(230, 159, 0), Symbol::Diamond),
            Fate::TurnedOver => (Color::rgb(213, 94, 0), Symbol::Triangle),
        };
        let own = points.iter().filter(|point| point.fate == fate);
        let (x, y): (Vec<f64>, Vec<f64>) = own.map(|own| (own.angle_deg, own.growth)).unzip();
        if !x.is_empty() {
            let series = Series::points(fate.name(), &x, &y);
            panel = panel.series(series.color(color).symbol(symbol));
        }
    }
    let (duration, conditions) = (arguments.duration, arguments.conditions());
    let title = format!("Growth of θ_d in {duration} s; {conditions}");
    Chart::new(title, Axis::linear("θ_1(0) (°)"))
        .size(900.0, 460.0)
        .panel(panel)
}
