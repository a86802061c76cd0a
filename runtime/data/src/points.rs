//! End points of links: tracked points, and points that do not move.

use super::error::{ReadError, ReadErrorKind};
use super::exchange;
use super::finding::Finding;
use super::outliers::resolution;
use super::table::Table;
use super::timing::Times;
use super::track::Track;

/// Coordinates of a point and its likelihood.
type Dot = ([f64; 2], f64);
/// Vector between two markers, with the smaller of their likelihoods; `None` if one is missing.
pub(crate) type Arrow = Option<Dot>;

/// End point of a link: a tracked point, or a point that does not move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Point<'a> {
    Track(&'a Track),
    Fixed([f64; 2]),
}

impl<'a> Point<'a> {
    /// Returns the track with this name, or the fixed point that the text describes.
    pub(crate) fn named(table: &'a Table, name: &str) -> Result<Self, ReadError> {
        match (table.track(name), place(name)) {
            (Err(_), Some(place)) => Ok(Self::Fixed(place)),
            (track, _) => track.map(Self::Track),
        }
    }

    pub(crate) fn name(self) -> String {
        match self {
            Self::Track(track) => track.name.clone(),
            Self::Fixed([0.0, 0.0]) => "origin".to_owned(),
            Self::Fixed([x, y]) => format!("{x},{y}"),
        }
    }
}

/// Parses a fixed point: `origin`, or `X,Y`.
fn place(text: &str) -> Option<[f64; 2]> {
    let number = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    match text.split_once(',') {
        Some((x, y)) => Some([number(x)?, number(y)?]),
        None => (text == "origin").then_some([0.0; 2]),
    }
}

/// Positions of the tracks of some links in all rows.
pub(crate) struct TrackPositions<'a> {
    tracks: Vec<&'a Track>,
    dots: Vec<Vec<Option<Dot>>>,
    /// Steps to which the coordinates of each track are rounded.
    steps: Vec<f64>,
}

impl<'a> TrackPositions<'a> {
    pub(crate) fn read(table: &Table, pairs: &[[Point<'a>; 2]]) -> Result<Self, ReadError> {
        let tracks = pairs.iter().flatten().filter_map(|point| match point {
            Point::Track(track) => Some(*track),
            Point::Fixed(_) => None,
        });
        let mut tracks: Vec<&Track> = tracks.collect();
        tracks.sort_by_key(|track| &track.name);
        tracks.dedup();
        let mut places = Self {
            dots: Vec::with_capacity(tracks.len()),
            steps: Vec::with_capacity(tracks.len()),
            tracks,
        };
        for track in &places.tracks {
            let (x, y) = (table.values(track.x)?, table.values(track.y)?);
            let likelihood = track.likelihood.map(|column| table.values(column));
            let likelihood = likelihood.transpose()?;
            // A track without likelihoods is certain; a missing likelihood is not.
            let dot = |row: usize| {
                let likelihood = likelihood.map_or(1.0, |all| all[row].unwrap_or(0.0));
                Some(([x[row]?, y[row]?], likelihood))
            };
            let step = |values: &[Option<f64>]| resolution(values.iter().flatten().copied());
            places.dots.push((0..table.rows()).map(dot).collect());
            places.steps.push(step(x).max(step(y)));
        }
        Ok(places)
    }

    /// Exchanges tracks back in rows in which they are exchanged, and returns the findings.
    pub(crate) fn mend(&mut self, times: &Times) -> Vec<Finding> {
        let (seconds, interval) = (&times.seconds, times.timing.interval);
        let place = |(place, _): Dot| place;
        let exchanges = exchange::mend(seconds, interval, &self.steps, &mut self.dots, place);
        let names: Vec<&str> = self
            .tracks
            .iter()
            .map(|track| track.name.as_str())
            .collect();
        exchange::exchange_findings(&exchanges, &names, seconds, interval).collect()
    }

    fn index(&self, point: Point<'_>) -> Option<usize> {
        match point {
            Point::Track(track) => self.tracks.iter().position(|own| *own == track),
            Point::Fixed(_) => None,
        }
    }

    /// Returns the step to which the coordinates of a point are rounded; 0 for a fixed point.
    pub(crate) fn step(&self, point: Point<'_>) -> f64 {
        self.index(point).map_or(0.0, |index| self.steps[index])
    }

    /// Returns the vector from one point to another in each row.
    pub(crate) fn arrows(
        &self,
        table: &Table,
        [upper, lower]: [Point<'_>; 2],
    ) -> Result<Vec<Arrow>, ReadError> {
        let ends = [upper, lower].map(|point| (point, self.index(point)));
        let arrow = |row: usize| {
            let [one, other] = ends.map(|(point, index)| match point {
                Point::Fixed(place) => Some((place, 1.0)),
                Point::Track(_) => self.dots[index?][row],
            });
            let (([a, b], one), ([c, d], other)) = (one?, other?);
            Some(([c - a, d - b], one.min(other)))
        };
        let arrows: Vec<Arrow> = (0..table.rows()).map(arrow).collect();
        let same = arrows
            .iter()
            .position(|arrow| matches!(arrow, Some(([0.0, 0.0], _))));
        let Some(row) = same else { return Ok(arrows) };
        let what = format!("`{}` and `{}` are at one place", upper.name(), lower.name());
        let column = match lower {
            Point::Track(track) => Some(track.x),
            Point::Fixed(_) => None,
        };
        Err(table.refused_at(ReadErrorKind::Nothing { what }, row, column))
    }
}
