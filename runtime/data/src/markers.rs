//! Angles from points that a camera followed.

use std::collections::BTreeMap;

use super::error::{ReadError, ReadErrorKind};
use super::exchange;
use super::finding::{Basis, Finding, listed, rounded};
use super::header::{FileKind, Track};
use super::outliers::resolution;
use super::recording::{LinkSeries, Recording, Sample};
use super::table::Table;
use super::timing::{Clock, Times};

/// The two points by which a link is followed, by the names of their tracks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkMarkers {
    /// The one nearer to the link's pivot.
    pub upper: String,
    /// The one farther from it. At angle 0 it is right below the other.
    pub lower: String,
}

/// Source of the direction of gravity in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Gravity {
    /// The axis of y: the camera is level.
    #[default]
    Axis,
    /// A direction, in the units of the file: a plumb line in the picture.
    Along([f64; 2]),
    /// The mean direction of the first link. Good where it swings evenly about the vertical;
    /// the error is the angle between that mean and the vertical.
    FirstLink,
}

/// How angles follow from tracked points. A link's angle is that of the line from its upper
/// to its lower marker, so that the scale of the picture does not matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Markers {
    /// Where the times come from.
    pub clock: Clock,
    /// The links, in the order of the model; empty for one link for each two tracks, in the
    /// order of the file.
    pub links: Vec<LinkMarkers>,
    /// Direction of gravity.
    pub gravity: Gravity,
    /// True if y grows downwards, as rows of a picture do; without it so in DeepLabCut's
    /// tables and not in others.
    pub y_down: Option<bool>,
    /// True if positive angles turn the other way than the model's, in which a lower marker
    /// to the right is at a positive angle.
    pub mirrored: bool,
    /// Smallest likelihood of both points with which an angle is used.
    pub likelihood: f64,
    /// As that of [`AngleColumns`](super::AngleColumns::outliers).
    pub outliers: Option<f64>,
}

impl Default for Markers {
    fn default() -> Self {
        Self {
            clock: Clock::Detect,
            links: Vec::new(),
            gravity: Gravity::Axis,
            y_down: None,
            mirrored: false,
            likelihood: 0.9,
            outliers: Some(25.0),
        }
    }
}

/// Coordinates and likelihood.
type Dot = ([f64; 2], f64);
/// A vector from marker to marker with the smaller likelihood of the two.
type Arrow = Option<([f64; 2], f64)>;

impl Markers {
    /// Takes the angles out of a table of tracked points.
    ///
    /// # Errors
    /// [`ReadError`]: tracks that do not exist, a time that does not ascend, frames without a
    /// rate, markers of a link that coincide.
    pub fn read(&self, table: &Table) -> Result<Recording, ReadError> {
        if !(0.0..=1.0).contains(&self.likelihood) {
            let what = format!("a likelihood of {}; it is between 0 and 1", self.likelihood);
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        let mut findings = Vec::new();
        let times = Times::read(table, &self.clock)?;
        let pairs = self.pairs(table, &mut findings)?;
        let dots = self.dots(table, &times, &pairs, &mut findings);
        let mut arrows = Vec::with_capacity(pairs.len());
        for (upper, lower) in &pairs {
            arrows.push(arrows_of(table, &dots, upper, lower)?);
        }
        let down = self.down(table, &arrows, &mut findings)?;
        if self.mirrored {
            findings.push(Finding::new(
                Basis::Given,
                "positive angles turn the other way",
            ));
        }
        let links = pairs.iter().zip(&arrows);
        let links = links
            .map(|((upper, lower), arrows)| self.series(&upper.name, &lower.name, arrows, down));
        let links: Vec<LinkSeries> = links.collect();
        let distances = links.iter().filter_map(|link| {
            let [mean, deviation] = link.marker_distance?;
            let (percent, mean) = (100.0 * deviation / mean, rounded(mean, 5));
            Some(format!("`{}` {mean} to {percent:.3} % (rms)", link.name))
        });
        let distances: Vec<String> = distances.collect();
        if !distances.is_empty() {
            let text = format!("distances of markers: {}", listed(distances.into_iter()));
            findings.push(Finding::new(Basis::Detected, text));
        }
        let resolutions = links.iter().zip(&pairs).map(|(link, (upper, lower))| {
            let step = resolution_of(table, upper).max(resolution_of(table, lower));
            link.marker_distance.map_or(0.0, |[mean, _]| step / mean)
        });
        let resolutions: Vec<f64> = resolutions.collect();
        Recording::new(table, times, links, &resolutions, self.outliers, findings)
    }

    /// Places of the markers in every row, by their names; those that changed places are changed back.
    fn dots<'a>(
        &self,
        table: &Table,
        times: &Times,
        pairs: &[(&'a Track, &'a Track)],
        findings: &mut Vec<Finding>,
    ) -> BTreeMap<&'a str, Vec<Option<Dot>>> {
        let tracks = pairs.iter().flat_map(|(upper, lower)| [*upper, *lower]);
        let tracks: BTreeMap<&str, &Track> =
            tracks.map(|track| (track.name.as_str(), track)).collect();
        let names: Vec<&str> = tracks.keys().copied().collect();
        let places = |track: &&Track| {
            (0..table.rows())
                .map(|row| dot(table, track, row))
                .collect()
        };
        let mut series: Vec<Vec<Option<Dot>>> = tracks.values().map(places).collect();
        if self.outliers.is_some() {
            let steps = tracks.values().map(|track| resolution_of(table, track));
            let steps: Vec<f64> = steps.collect();
            let interval = times.timing.interval;
            let place = |(place, _): Dot| place;
            let exchanges = exchange::mend(&times.seconds, interval, &steps, &mut series, place);
            findings.extend(exchange::told(&exchanges, &names, &times.seconds, interval));
        }
        names.into_iter().zip(series).collect()
    }

    fn pairs<'a>(
        &self,
        table: &'a Table,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<(&'a Track, &'a Track)>, ReadError> {
        if !self.links.is_empty() {
            let pairs = self.links.iter();
            return pairs
                .map(|link| Ok((table.track(&link.upper)?, table.track(&link.lower)?)))
                .collect();
        }
        let (pairs, rest) = table.tracks().as_chunks::<2>();
        if pairs.is_empty() || !rest.is_empty() {
            let what = format!(
                "{} tracks; a link needs two, from its pivot outwards: name those of each",
                table.tracks().len()
            );
            return Err(table.refused(ReadErrorKind::Nothing { what }));
        }
        let links = pairs.iter();
        let links =
            links.map(|[upper, lower]| format!("from `{}` to `{}`", upper.name, lower.name));
        let text = format!("links by two markers each: {}", listed(links));
        findings.push(Finding::new(Basis::Assumed, text));
        Ok(pairs.iter().map(|[upper, lower]| (upper, lower)).collect())
    }

    /// Direction of gravity in the file, of length 1, and the direction to its right as a
    /// person sees the picture.
    fn down(
        &self,
        table: &Table,
        arrows: &[Vec<Arrow>],
        findings: &mut Vec<Finding>,
    ) -> Result<[[f64; 2]; 2], ReadError> {
        let (basis, y_down) = match self.y_down {
            Some(y_down) => (Basis::Given, y_down),
            None => (Basis::Assumed, table.kind() == FileKind::DeepLabCut),
        };
        let way = if y_down { "downwards" } else { "upwards" };
        findings.push(Finding::new(basis, format!("y points {way}")));
        let (basis, [x, y], text) = match self.gravity {
            Gravity::Axis if y_down => (Basis::Assumed, [0.0, 1.0], "gravity along y"),
            Gravity::Axis => (Basis::Assumed, [0.0, -1.0], "gravity against y"),
            Gravity::Along(line) => (Basis::Given, line, "gravity along a plumb line"),
            Gravity::FirstLink => {
                let mean = mean_direction(arrows.first().map_or(&[], Vec::as_slice));
                (
                    Basis::Given,
                    mean,
                    "gravity along the mean of the first link",
                )
            }
        };
        let length = x.hypot(y);
        if !(length.is_finite() && length > 0.0) {
            let what = format!("a vertical of direction ({x}, {y})");
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        findings.push(Finding::new(basis, text));
        let [x, y] = [x / length, y / length];
        // Right of down: a quarter turn, whose sense in the file depends on where y points.
        let right = if y_down { [y, -x] } else { [-y, x] };
        Ok([[x, y], right])
    }

    fn series(
        &self,
        upper: &str,
        lower: &str,
        arrows: &[Arrow],
        [down, right]: [[f64; 2]; 2],
    ) -> LinkSeries {
        let along = |[x, y]: [f64; 2], [a, b]: [f64; 2]| x * a + y * b;
        let sense = if self.mirrored { -1.0 } else { 1.0 };
        let samples = arrows.iter().map(|arrow| match arrow {
            None => Sample::Missing,
            Some((arrow, likelihood)) => {
                let angle = sense * along(*arrow, right).atan2(along(*arrow, down));
                match *likelihood >= self.likelihood {
                    true => Sample::Measured(angle),
                    false => Sample::Unlikely(angle),
                }
            }
        });
        let likely = arrows
            .iter()
            .flatten()
            .filter(|(_, l)| *l >= self.likelihood);
        let distances: Vec<f64> = likely.map(|([x, y], _)| x.hypot(*y)).collect();
        let count = distances.len() as f64;
        let mean = distances.iter().sum::<f64>() / count;
        let square = distances.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count;
        LinkSeries {
            name: format!("{upper} to {lower}"),
            samples: samples.collect(),
            marker_distance: (count > 0.0).then(|| [mean, square.sqrt()]),
        }
    }
}

/// Sum of the arrows, each taken of length 1.
fn mean_direction(arrows: &[Arrow]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for ([x, y], _) in arrows.iter().flatten() {
        let length = x.hypot(*y);
        sum = [sum[0] + x / length, sum[1] + y / length];
    }
    sum
}

/// A track's place in a row. One without likelihoods is certain; a missing likelihood is none.
fn dot(table: &Table, track: &Track, row: usize) -> Option<Dot> {
    let value = |column: usize| table.values(column)[row];
    let likelihood = |column| value(column).unwrap_or(0.0);
    let place = [value(track.x)?, value(track.y)?];
    Some((place, track.likelihood.map_or(1.0, likelihood)))
}

/// The step in which a track's coordinates are written.
fn resolution_of(table: &Table, track: &Track) -> f64 {
    let step = |column: usize| resolution(table.values(column).iter().flatten().copied());
    step(track.x).max(step(track.y))
}

fn arrows_of(
    table: &Table,
    dots: &BTreeMap<&str, Vec<Option<Dot>>>,
    upper: &Track,
    lower: &Track,
) -> Result<Vec<Arrow>, ReadError> {
    let [from, to] = [upper, lower].map(|track| &dots[track.name.as_str()]);
    let arrow = |(from, to): (&Option<Dot>, &Option<Dot>)| {
        let ((from, one), (to, other)) = ((*from)?, (*to)?);
        Some(([to[0] - from[0], to[1] - from[1]], one.min(other)))
    };
    let arrows: Vec<Arrow> = from.iter().zip(to).map(arrow).collect();
    let same = arrows
        .iter()
        .position(|arrow| matches!(arrow, Some(([0.0, 0.0], _))));
    match same {
        Some(row) => {
            let what = format!("`{}` and `{}` are at one place", upper.name, lower.name);
            Err(table.refused_at(ReadErrorKind::Nothing { what }, row, Some(lower.x)))
        }
        None => Ok(arrows),
    }
}
