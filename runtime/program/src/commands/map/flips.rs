//! Time until a link first turns over, at every point of a map.

use branched_pendulum::analysis::growth::Checked;
use branched_pendulum::integrate::{Crossing, Ending, StopReason};
use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Color};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::PendulumTree;

use super::bound;
use crate::Failure;
use crate::commands::plane::{MapPlane, Point, Question, cells, marks, shaded};
use crate::frame::Job;

/// Colour of points without a flip; it does not occur in the colour scale of times.
const NO_FLIP: Color = Color::rgb(232, 232, 232);

/// Ratio of the tighter tolerance, with which everything is repeated, to the looser one.
const FINER: f64 = 0.01;

/// Question of a map: how long does it take until one of the links first turns over?
///
/// A link flips when its angle passes an odd multiple of π: it then points opposite to its
/// direction at angle zero.
pub(super) struct Flips<'a> {
    pub(super) plane: &'a MapPlane<'a>,
    /// Links that are looked at.
    pub(super) links: Vec<usize>,
    /// Time followed, s.
    pub(super) duration: f64,
    pub(super) tolerance: f64,
    /// Points that the map marks.
    pub(super) marked: &'a [Point],
    /// Energy at each point relative to the lowest inverted configuration, in J; empty if it is not
    /// defined for the tree.
    pub(super) excess: Vec<f64>,
}

/// A tree with its start.
type TreeStart<'a> = (AbsoluteAngles<&'a PendulumTree>, State<f64>);

/// First flip of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flip {
    /// Time of the flip in s; NaN if there is none.
    time: Checked,
    /// The link that flips.
    link: Option<usize>,
}

impl Flip {
    /// Combines the results (time and link) for two tolerances; each is `None` if nothing flips.
    fn of(coarse: Option<(f64, usize)>, fine: Option<(f64, usize)>) -> Self {
        let difference = match (coarse, fine) {
            (None, None) => 0.0,
            (Some((coarse, _)), Some((fine, _))) => {
                (coarse - fine).abs() / fine.max(f64::MIN_POSITIVE)
            }
            // No time is near to never.
            _ => f64::INFINITY,
        };
        let time = Checked {
            value: fine.map_or(f64::NAN, |(time, _)| time),
            difference,
        };
        let link = fine.map(|(_, link)| link);
        Self { time, link }
    }
}

/// Returns a function of an angle that changes its sign when a link flips, and only then.
fn upright(angle: f64) -> f64 {
    let cosine = (0.5 * angle).cos();
    // No number is π: a link that starts upside down is on neither side, whichever way the
    // angle was rounded.
    match cosine.abs() < f64::EPSILON * (1.0 + angle.abs()) {
        true => 0.0,
        false => cosine,
    }
}

impl Flips<'_> {
    /// Returns the first flips of trees of one shape, each from its start; `None` if the motion
    /// could not be integrated.
    fn of_releases(
        &self,
        releases: &[TreeStart<'_>],
        tolerance: f64,
    ) -> Vec<Option<Option<(f64, usize)>>> {
        let functions: Vec<_> = self
            .links
            .iter()
            .map(|&link| move |_: f64, state: &[f64]| upright(state[link]))
            .collect();
        let endings = functions
            .iter()
            .map(|function| Ending::new(Crossing::Either, function));
        let endings: Vec<Ending<'_, f64>> = endings.collect();
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let ends = Ensemble::new().integrate_models_in_lanes_until(
            &method,
            releases,
            self.duration,
            &endings,
        );
        let flip = |end: Solution<f64>| {
            let State { time, values } = end.state;
            let nearness = |link: &usize| (0.5 * values[*link]).cos().abs();
            let nearest = |a: &usize, b: &usize| nearness(a).total_cmp(&nearness(b));
            let link = self.links.iter().copied().min_by(nearest)?;
            (end.report.stop == StopReason::StoppedByEvent).then_some((time, link))
        };
        ends.into_iter().map(|end| end.ok().map(flip)).collect()
    }
}

impl Question for Flips<'_> {
    type Answer = Flip;
    const BLOCK: usize = 2048;

    fn at(&self, points: &[Point]) -> Result<Vec<Option<Flip>>, Failure> {
        let trees = self.plane.trees_at(points)?;
        // A friction of zero is none: trees of other shapes, which do not share lanes.
        let mut places: Vec<(usize, usize)> =
            trees.iter().map(|tree| tree.shape()).zip(0..).collect();
        places.sort_unstable();
        let mut flips: Vec<Option<Flip>> = vec![None; points.len()];
        for places in places.chunk_by(|(one, _), (other, _)| one == other) {
            let places = || places.iter().map(|(_, place)| *place);
            let release = |place: usize| {
                (
                    AbsoluteAngles(trees[place].as_ref()),
                    self.plane.start_at(&points[place]),
                )
            };
            let releases: Vec<TreeStart<'_>> = places().map(release).collect();
            let [coarse, fine] = [self.tolerance, FINER * self.tolerance]
                .map(|tolerance| self.of_releases(&releases, tolerance));
            for (place, (coarse, fine)) in places().zip(coarse.into_iter().zip(fine)) {
                flips[place] = coarse
                    .zip(fine)
                    .map(|(coarse, fine)| Flip::of(coarse, fine));
            }
        }
        Ok(flips)
    }

    fn complete(&mut self, _: &Job) -> Result<(), Failure> {
        let excess = bound::excess(self.plane, &self.links, &self.plane.points())?;
        self.excess = excess.unwrap_or_default();
        Ok(())
    }

    fn columns(&self) -> Vec<Column> {
        vec![
            Column::new("time of the first flip", "s"),
            Column::new("time between tolerances", ""),
            Column::new("link that flips", ""),
        ]
    }

    fn row(&self, flip: &Flip) -> Vec<Cell<'_>> {
        let names = self.plane.subject.tree.names();
        let link = flip.link.map_or("", |link| names[link].as_str());
        vec![
            flip.time.value.into(),
            flip.time.difference.into(),
            link.into(),
        ]
    }

    fn report(&self, found: &[(Point, Flip)], lost: usize) -> String {
        let [flipped, open] = counts(found);
        let times = found.iter().map(|(_, flip)| flip.time.value);
        let first = match times.fold(f64::INFINITY, f64::min) {
            first if first.is_finite() => format!(", the first after {first:.4} s"),
            _ => String::new(),
        };
        let lost = match lost {
            0 => String::new(),
            lost => format!("; {lost} could not be followed"),
        };
        let below = self.excess.iter().filter(|excess| **excess < 0.0);
        let below = match below.count() {
            0 => String::new(),
            count => format!(
                "Of all points {count} have less energy than the lowest configuration with a link upside \
                 down:\nfrom there none flips, however long one waits.\n"
            ),
        };
        format!(
            "{}: {} points, {:.1} % with a flip within {} s{first}.\n\
             At {open} the two tolerances differ by more than 1 %{lost}.\n{below}",
            self.plane.subject.name,
            found.len(),
            100.0 * flipped as f64 / found.len().max(1) as f64,
            self.duration,
        )
    }

    fn record(&self, found: &[(Point, Flip)]) -> Vec<(&'static str, usize)> {
        let [flipped, open] = counts(found);
        vec![
            ("points", found.len()),
            ("flipped", flipped),
            ("undetermined", open),
        ]
    }

    fn chart(&self, found: &[(Point, Flip)]) -> Chart {
        let is_flip = |(_, flip): &&(Point, Flip)| flip.link.is_some();
        let flipped = found.iter().filter(is_flip);
        let times: Vec<(Point, f64)> = flipped.map(|(at, flip)| (*at, flip.time.value)).collect();
        let others = found.iter().filter(|own| !is_flip(own));
        let others: Vec<Point> = others.map(|(point, _)| *point).collect();
        let title = "time until the first flip";
        let chart = self.plane.chart(title, |mut panel| {
            if !times.is_empty() {
                panel = panel.series(shaded(&times));
            }
            if !others.is_empty() {
                let label = format!("no flip within {} s", self.duration);
                panel = panel.series(cells(label, &others).color(NO_FLIP));
            }
            if let Some(curve) = bound::curve(self.plane, &self.excess) {
                panel = panel.series(curve);
            }
            marks(panel, self.marked)
        });
        let times = times.iter().map(|(_, time)| *time);
        let first = times.fold(0.1 * self.duration, f64::min);
        chart.colors(Axis::log("time until the first flip (s)").range(first, self.duration))
    }
}

/// Returns the number of points with a flip, and the number of points that are not determined.
fn counts(found: &[(Point, Flip)]) -> [usize; 2] {
    let flipped = found.iter().filter(|(_, flip)| flip.link.is_some());
    let open = found.iter().filter(|(_, flip)| !flip.time.is_determined());
    [flipped.count(), open.count()]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{Flip, upright};

    #[test]
    fn signs_change_where_a_link_is_upside_down_and_nowhere_else() {
        for turn in [-3.0, -1.0, 1.0, 3.0, 101.0] {
            let inverted = turn * PI;
            assert_eq!(upright(inverted), 0.0);
            assert!(upright(inverted - 1e-9) * upright(inverted + 1e-9) < 0.0);
        }
        for whole in [-4.0, -2.0, 0.0, 2.0] {
            let hanging = whole * PI;
            assert!(upright(hanging - 3.1) * upright(hanging + 3.1) > 0.0);
        }
    }

    #[test]
    fn never_is_near_to_no_time() {
        let (early, late) = (Some((1.0, 0)), Some((1.005, 2)));
        assert!(Flip::of(early, late).time.is_determined());
        assert_eq!(Flip::of(early, late).link, Some(2));
        assert!(!Flip::of(early, None).time.is_determined());
        assert!(!Flip::of(None, late).time.is_determined());
        let never = Flip::of(None, None);
        assert!(never.time.is_determined() && never.time.value.is_nan());
    }
}
