//! Angles computed from points that a camera tracked.

use std::iter;

use super::clock::Clock;
use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed, rounded};
use super::header::FileKind;
use super::points::{Arrow, Point, TrackPositions};
use super::recording::{LinkSeries, Recording, check_memory, check_width};
use super::sample::Sample;
use super::table::Table;
use super::timing::Times;

/// The two points by which a link is tracked, given by the names of their tracks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkMarkers {
    /// The point nearer to the link's pivot. A point that does not move is `origin`, or `X,Y` in
    /// the units of the file.
    pub upper: String,
    /// The point farther from the pivot. At angle 0 it is directly below the other.
    pub lower: String,
}

/// How the direction of gravity in a picture is determined.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Gravity {
    /// The y axis, if the camera is level.
    #[default]
    Axis,
    /// A given direction, in the units of the file, such as that of a plumb line in the picture.
    Along([f64; 2]),
    /// The mean direction of the first link. This is accurate if the link swings evenly about the
    /// vertical; the error is the angle between that mean and the vertical.
    FirstLink,
}

/// How angles are computed from tracked points. A link's angle is that of the line from its upper
/// to its lower marker, so that the scale of the picture does not matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Markers {
    /// Source of the times.
    pub clock: Clock,
    /// The links, in the order of the model. If empty, each two tracks in the order of the file are
    /// a link or, if a pivot is given, the tracks are a chain from the pivot.
    pub links: Vec<LinkMarkers>,
    /// Position of the fixed pivot, in the units of the file, if no track is at it. Each track in
    /// the order of the file ends a link, the first one at the pivot, each other at the track
    /// before.
    pub pivot: Option<[f64; 2]>,
    /// Direction of gravity.
    pub gravity: Gravity,
    /// True if y increases downwards, as rows of a picture do. `None`: true for tables of
    /// DeepLabCut, false for others.
    pub y_down: Option<bool>,
    /// True if positive angles turn in the direction opposite to the model's, in which a lower
    /// marker to the right is at a positive angle.
    pub mirrored: bool,
    /// Smallest likelihood of both points at which an angle is used.
    pub likelihood: f64,
    /// As that of [`AngleColumns`](super::AngleColumns::outliers).
    pub outliers: Option<f64>,
}

impl Default for Markers {
    fn default() -> Self {
        Self {
            clock: Clock::Detect,
            links: Vec::new(),
            pivot: None,
            gravity: Gravity::Axis,
            y_down: None,
            mirrored: false,
            likelihood: 0.9,
            outliers: Some(25.0),
        }
    }
}

impl Markers {
    /// Computes the angles from a table of tracked points.
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
        check_memory(table, 2 * pairs.len())?;
        let mut places = TrackPositions::read(table, &pairs)?;
        if self.outliers.is_some() {
            findings.extend(places.mend(&times));
        }
        let mut arrows = Vec::with_capacity(pairs.len());
        for pair in &pairs {
            arrows.push(places.arrows(table, *pair)?);
        }
        let down = self.down(table, &arrows, &mut findings)?;
        if self.mirrored {
            findings.push(Finding::new(
                Basis::Given,
                "positive angles turn the other way",
            ));
        }
        let links = pairs.iter().zip(&arrows);
        let links = links.map(|([upper, lower], arrows)| {
            let name = format!("{} to {}", upper.name(), lower.name());
            self.series(name, arrows, down)
        });
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
        let resolutions = links.iter().zip(&pairs).map(|(link, pair)| {
            let steps = pair.map(|point| places.step(point));
            let distance = link.marker_distance.map(|[mean, _]| mean);
            distance.map_or(0.0, |mean| steps[0].max(steps[1]) / mean)
        });
        let resolutions: Vec<f64> = resolutions.collect();
        Recording::new(table, times, links, &resolutions, self.outliers, findings)
    }

    fn pairs<'a>(
        &self,
        table: &'a Table,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<[Point<'a>; 2]>, ReadError> {
        let refused = |what| Err(table.refused(ReadErrorKind::Option { what }));
        if let Some(place) = self
            .pivot
            .filter(|place| !place.iter().all(|x| x.is_finite()))
        {
            return refused(format!("a pivot at ({}, {})", place[0], place[1]));
        }
        if !self.links.is_empty() {
            if self.pivot.is_some() {
                let what = "the pivot next to named points; a link from it is `X,Y` to a point";
                return refused(what.to_owned());
            }
            let mut pairs = Vec::with_capacity(self.links.len());
            for LinkMarkers { upper, lower } in &self.links {
                let pair = [Point::named(table, upper)?, Point::named(table, lower)?];
                if pairs.contains(&pair) {
                    return refused(format!(
                        "the link from `{upper}` to `{lower}` is named twice"
                    ));
                }
                pairs.push(pair);
            }
            return Ok(pairs);
        }
        check_width(table, table.tracks().len(), "tracks")?;
        let tracks: Vec<Point<'a>> = table.tracks().iter().map(Point::Track).collect();
        let pairs: Vec<[Point<'a>; 2]> = match (self.pivot, tracks.as_chunks::<2>()) {
            (Some(place), _) if !tracks.is_empty() => {
                let uppers = iter::once(Point::Fixed(place)).chain(tracks.iter().copied());
                uppers.zip(&tracks).map(|(a, b)| [a, *b]).collect()
            }
            (None, (pairs @ [_, ..], [])) => pairs.to_vec(),
            _ => {
                let what = format!(
                    "{}; a link needs two, from its pivot outwards: name those of each, or give \
                     the place of the pivot",
                    counted(tracks.len(), "track")
                );
                return Err(table.refused(ReadErrorKind::Nothing { what }));
            }
        };
        let links = pairs.iter();
        let links =
            links.map(|[upper, lower]| format!("from `{}` to `{}`", upper.name(), lower.name()));
        let text = format!("links by two markers each: {}", listed(links));
        findings.push(Finding::new(Basis::Assumed, text));
        Ok(pairs)
    }

    /// Returns true if an option is set that applies to points only.
    pub(crate) fn is_asked_for(&self) -> bool {
        !self.links.is_empty()
            || self.pivot.is_some()
            || self.y_down.is_some()
            || self.gravity != Gravity::Axis
    }

    /// Returns the direction of gravity in the file, as a unit vector, and the direction to its
    /// right as seen in the picture.
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

    fn series(&self, name: String, arrows: &[Arrow], [down, right]: [[f64; 2]; 2]) -> LinkSeries {
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
            name,
            samples: samples.collect(),
            marker_distance: (count > 0.0).then(|| [mean, square.sqrt()]),
        }
    }
}

/// Returns the sum of the directions of the arrows, each of length 1.
fn mean_direction(arrows: &[Arrow]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for ([x, y], _) in arrows.iter().flatten() {
        let length = x.hypot(*y);
        sum = [sum[0] + x / length, sum[1] + y / length];
    }
    sum
}
