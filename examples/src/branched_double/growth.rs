//! Growth of θ_d against the angle of release: the angles that were computed and what was found at
//! each. Makes no claim about the angles between them.

use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series, Symbol};
use branched_pendulum_data::{Cell, Column};
use std::f64::consts::FRAC_PI_2;

use super::apparatus::DIFFERENCE;
use super::arguments::Arguments;
use super::experiment::Run;
use super::findings::Findings;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

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
        let turned = |angle: f64| angle.abs() >= FRAC_PI_2;
        let mut angles = run.samples.iter().map(|s| s.coordinates[DIFFERENCE]);
        if angles.any(turned) {
            Self::TurnedOver
        } else if growth >= GROWN {
            Self::Grown
        } else {
            Self::Small
        }
    }
}

/// Consecutive computed angles with the same fate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The fate.
    pub fate: Fate,
    /// First and last angle, degrees.
    pub angles: [f64; 2],
    /// Number of angles.
    pub count: usize,
    /// Least and largest growth.
    pub growth: [f64; 2],
}

/// Returns angle, growth and fate of each run whose growth is defined.
fn points(runs: &[Run], findings: &[Findings]) -> Vec<(f64, f64, Fate)> {
    let growths = findings.iter().map(|findings| findings.growth);
    let pairs = runs.iter().zip(growths);
    pairs
        .filter_map(|(run, growth)| {
            let growth = growth?;
            Some((run.angle_deg, growth, Fate::of(run, growth)))
        })
        .collect()
}

/// Returns the bands of a scan, by ascending angle.
pub fn bands(points: &[(f64, f64, Fate)]) -> Vec<Band> {
    let mut bands: Vec<Band> = Vec::new();
    for &(angle, growth, fate) in points {
        match bands.last_mut() {
            Some(band) if band.fate == fate => {
                band.angles[1] = angle;
                band.count += 1;
                band.growth = [band.growth[0].min(growth), band.growth[1].max(growth)];
            }
            _ => bands.push(Band {
                fate,
                angles: [angle; 2],
                count: 1,
                growth: [growth; 2],
            }),
        }
    }
    bands
}

/// Returns the bands as text; empty if there are too few angles for a scan.
pub fn report(runs: &[Run], findings: &[Findings]) -> String {
    let points = points(runs, findings);
    if points.len() < SCAN {
        return String::new();
    }
    let mut text = String::from(
        "Bands of θ_1(0) by the growth of θ_d, at the angles above; between them\n\
         nothing was looked at\n",
    );
    for Band {
        fate,
        angles: [first, last],
        count,
        growth: [least, most],
    } in bands(&points)
    {
        let angles = match count {
            1 => format!("{first:?}°"),
            _ => format!("{first:?}° to {last:?}°"),
        };
        let plural = if count == 1 { " " } else { "s" };
        let growth = match fate {
            Fate::TurnedOver => String::new(),
            _ if count == 1 => format!(": {most:.1}"),
            _ => format!(": {least:.1} to {most:.1}"),
        };
        text += &format!(
            "  {angles:18} {count:>4} angle{plural}   {}{growth}\n",
            fate.name()
        );
    }
    text
}

/// Writes the table and the chart of a scan; nothing if there are too few angles.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write(
    job: &Job,
    arguments: &Arguments,
    runs: &[Run],
    findings: &[Findings],
) -> Result<(), Failure> {
    let points = points(runs, findings);
    if points.len() < SCAN {
        return Ok(());
    }
    let columns = [
        Column::new("theta_1", "degrees"),
        Column::new("growth of theta_d", ""),
        Column::new("fate", ""),
    ];
    job.csv("growth.csv", &columns, |csv| {
        let mut points = points.iter();
        points.try_for_each(|&(angle, growth, fate)| {
            csv.row([Cell::from(angle), growth.into(), fate.name().into()])
        })
    })?;
    job.chart("growth", &chart(arguments, &points))
}

fn chart(arguments: &Arguments, points: &[(f64, f64, Fate)]) -> Chart {
    let styles = [
        (Color::rgb(0, 114, 178), Symbol::Circle),
        (Color::rgb(230, 159, 0), Symbol::Diamond),
        (Color::rgb(213, 94, 0), Symbol::Triangle),
    ];
    let title = format!(
        "Growth of θ_d in {} s; {}",
        arguments.duration,
        arguments.conditions()
    );
    let axis = Axis::log("largest |θ_d|, folded to π/2, over |θ_d(0)|");
    let panel = Fate::ALL.into_iter().zip(styles).fold(
        Panel::new(axis),
        |panel, (fate, (color, symbol))| {
            let own = points.iter().filter(|point| point.2 == fate);
            let (x, y): (Vec<f64>, Vec<f64>) = own.map(|&(x, y, _)| (x, y)).unzip();
            if x.is_empty() {
                return panel;
            }
            panel.series(
                Series::points(fate.name(), &x, &y)
                    .color(color)
                    .symbol(symbol),
            )
        },
    );
    Chart::new(title, Axis::linear("θ_1(0) (°)"))
        .size(900.0, 460.0)
        .panel(panel)
}

#[cfg(test)]
mod tests {
    use super::{Band, Fate, bands};

    #[test]
    fn neighbours_with_one_fate_make_a_band() {
        let points = [
            (40.0, 1.5, Fate::Small),
            (40.1, 1.2, Fate::Small),
            (40.2, 157.0, Fate::TurnedOver),
            (40.3, 3.0, Fate::Small),
        ];
        let band = |fate, angles, count, growth| Band {
            fate,
            angles,
            count,
            growth,
        };
        assert_eq!(
            bands(&points),
            [
                band(Fate::Small, [40.0, 40.1], 2, [1.2, 1.5]),
                band(Fate::TurnedOver, [40.2, 40.2], 1, [157.0, 157.0]),
                band(Fate::Small, [40.3, 40.3], 1, [3.0, 3.0]),
            ]
        );
        assert!(bands(&[]).is_empty());
    }
}
