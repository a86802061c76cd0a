//! The plane of a map: two quantities, with the values that they take.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use branched_pendulum::system::State;
use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series, Symbol, verbatim};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::parts;
use crate::subject::Subject;

/// A quantity, with the values that it takes along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AxisValues {
    pub(super) name: String,
    values: Vec<f64>,
    /// True if neighbouring values have equal ratios instead of equal differences.
    by_ratio: bool,
}

/// Colour of marks, visible on dark blue and on yellow.
const MARKED: Color = Color::rgb(250, 120, 200);

/// Most values along an axis.
const MOST_VALUES: f64 = 2000.0;

impl AxisValues {
    /// Reads `NAME=FROM:TO:STEP`, or `NAME=FROM:TO:xRATIO`.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is not an axis: write `NAME=FROM:TO:STEP`, as in `parent=0:90:5`, or \
                 `NAME=FROM:TO:xRATIO`, as in `mass=0.1:10:x1.2`, with at most {MOST_VALUES} \
                 steps"
            )
        };
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let parts: Vec<&str> = range.split(':').collect();
        let [from, to, step] = *parts else {
            return Err(wrong());
        };
        let (from, to) = (number(from)?, number(to)?);
        let ratio = step.trim().strip_prefix('x');
        let step = number(ratio.unwrap_or(step))?;
        let by_ratio = ratio.is_some();
        let steps = match by_ratio {
            true => (to / from).ln() / step.ln(),
            false => (to - from) / step,
        };
        let steps = (steps + 1e-9).floor();
        if !(0.0..MOST_VALUES).contains(&steps) || by_ratio && from <= 0.0 {
            return Err(wrong());
        }
        let value = |k: u32| match by_ratio {
            true => from * step.powi(k as i32),
            false => from + f64::from(k) * step,
        };
        Ok(Self {
            name: name.trim().to_owned(),
            values: (0..=steps as u32).map(value).collect(),
            by_ratio,
        })
    }

    /// Returns the values.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Reads `NAME=VALUE,VALUE`.
    pub(super) fn read_values(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not `NAME=VALUE,VALUE`, as in `parent=20,40`");
        let (name, values) = text.split_once('=').ok_or_else(wrong)?;
        let values = parts(values).map(|value| value.parse().map_err(|_| wrong()));
        Ok(Self {
            name: name.trim().to_owned(),
            values: values.collect::<Result<_, _>>()?,
            by_ratio: false,
        })
    }
}

/// Quantity along an axis.
enum AxisQuantity {
    Parameter(String),
    Angles(Vec<usize>),
}

impl AxisQuantity {
    fn of(subject: &Subject, axis: &AxisValues) -> Result<Self, Failure> {
        if axis.name.contains('+') {
            let links = axis.name.split('+');
            let links = links.map(|name| subject.links_named(name.trim()));
            return Ok(Self::Angles(links.collect::<Result<Vec<_>, _>>()?.concat()));
        }
        let description = subject.tree.description();
        let is_parameter = description.parameters().any(|own| own == axis.name);
        match (is_parameter, subject.links_named(&axis.name)) {
            (true, Err(_)) => Ok(Self::Parameter(axis.name.clone())),
            (false, Ok(links)) => Ok(Self::Angles(links)),
            (true, Ok(_)) => Err(Failure::Lacking {
                what: format!(
                    "`{}` is the name of both a link and a parameter: rename one of them",
                    axis.name
                ),
            }),
            (false, Err(_)) => {
                let parameters: Vec<&str> = description.parameters().collect();
                Err(Failure::Lacking {
                    what: format!(
                        "`{}` is neither a link ({}) nor a parameter ({})",
                        axis.name,
                        subject.tree.names().join(", "),
                        if parameters.is_empty() {
                            "there are none".to_owned()
                        } else {
                            parameters.join(", ")
                        }
                    ),
                })
            }
        }
    }

    fn unit(&self) -> &'static str {
        match self {
            Self::Parameter(_) => "",
            Self::Angles(_) => "degrees",
        }
    }
}

/// A point of the plane: values of the two quantities.
pub(super) type Point = [f64; 2];

/// The plane of a map, with everything that does not change over it.
pub(super) struct MapPlane<'a> {
    pub(super) subject: &'a Subject,
    start: State<f64>,
    axes: [&'a AxisValues; 2],
    quantities: [AxisQuantity; 2],
}

impl<'a> MapPlane<'a> {
    /// Creates the plane of two quantities; everything else is as in `subject` and in its state
    /// `start`.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if the name of an axis is neither a link nor a parameter, or is both.
    pub(super) fn new(
        subject: &'a Subject,
        start: State<f64>,
        axes: [&'a AxisValues; 2],
    ) -> Result<Self, Failure> {
        let [x, y] = axes.map(|axis| AxisQuantity::of(subject, axis));
        Ok(Self {
            subject,
            start,
            axes,
            quantities: [x?, y?],
        })
    }

    /// Returns all points of the plane, row by row.
    pub(super) fn points(&self) -> Vec<Point> {
        let [x, y] = self.axes;
        let rows = y.values.iter();
        rows.flat_map(|&y| x.values.iter().map(move |&x| [x, y]))
            .collect()
    }

    /// Returns the lines across the plane on which the quantity of one axis is constant and has
    /// these values. Each line is a list of points along the other axis.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if no axis has this name.
    pub(super) fn lines(&self, at: &AxisValues) -> Result<Vec<Vec<Point>>, Failure> {
        let [x, y] = self.axes;
        let values = at.values.iter();
        if at.name == x.name {
            let line = |&x: &f64| y.values.iter().map(|&y| [x, y]).collect();
            Ok(values.map(line).collect())
        } else if at.name == y.name {
            let line = |&y: &f64| x.values.iter().map(|&x| [x, y]).collect();
            Ok(values.map(line).collect())
        } else {
            Err(Failure::Lacking {
                what: format!(
                    "`{}` is on neither axis of the map: they are {} and {}",
                    at.name, x.name, y.name
                ),
            })
        }
    }

    /// Returns the names of the two axes.
    pub(super) fn names(&self) -> [&str; 2] {
        self.axes.map(|axis| axis.name.as_str())
    }

    /// Formats a value of an axis with its name and unit.
    pub(super) fn words(&self, axis: usize, value: f64) -> String {
        match self.quantities[axis] {
            AxisQuantity::Parameter(_) => value.to_string(),
            AxisQuantity::Angles(_) => format!("{value}°"),
        }
    }

    /// Returns true if the quantity of an axis is a parameter.
    pub(super) fn is_parameter(&self, axis: usize) -> bool {
        match self.quantities[axis] {
            AxisQuantity::Parameter(_) => true,
            AxisQuantity::Angles(_) => false,
        }
    }

    /// Returns the links whose angles the axes are; `None` if an axis is a parameter.
    pub(super) fn links(&self) -> Option<[&[usize]; 2]> {
        match &self.quantities {
            [AxisQuantity::Angles(x), AxisQuantity::Angles(y)] => Some([x, y]),
            _ => None,
        }
    }

    /// Returns the largest absolute value along both axes.
    pub(super) fn largest(&self) -> f64 {
        let values = self.axes.iter().flat_map(|axis| &axis.values);
        values.fold(0.0, |most, value| most.max(value.abs()))
    }

    /// Returns the number of columns and the number of rows of the plane.
    pub(super) fn size(&self) -> [usize; 2] {
        self.axes.map(|axis| axis.values.len())
    }

    /// Returns true if both quantities take more than one value.
    pub(super) fn is_plane(&self) -> bool {
        self.axes.iter().all(|axis| axis.values.len() > 1)
    }

    /// Returns the tree at a point of the plane.
    ///
    /// # Errors
    /// [`Failure::Tree`] for a value that is not physical.
    pub(super) fn tree_at(&self, point: &Point) -> Result<PendulumTree, Failure> {
        let mut tree = self.subject.tree.clone();
        for (quantity, &value) in self.quantities.iter().zip(point) {
            if let AxisQuantity::Parameter(name) = quantity {
                let changed = tree.with(name, value);
                tree = changed.map_err(|source| Failure::tree(&self.subject.name, source))?;
            }
        }
        Ok(tree)
    }

    /// Returns the trees at some points of the plane. Points with the same parameters share one
    /// tree.
    ///
    /// # Errors
    /// As [`tree_at`](Self::tree_at).
    pub(super) fn trees_at(&self, points: &[Point]) -> Result<Vec<Arc<PendulumTree>>, Failure> {
        let mut known: HashMap<Vec<u64>, Arc<PendulumTree>> = HashMap::new();
        let tree = |point: &Point| {
            let both = self.quantities.iter().zip(point);
            let parameters =
                both.filter(|(quantity, _)| matches!(quantity, AxisQuantity::Parameter(_)));
            let parameters = parameters.map(|(_, value)| value.to_bits()).collect();
            Ok(match known.entry(parameters) {
                Entry::Occupied(own) => own.get().clone(),
                Entry::Vacant(place) => place.insert(Arc::new(self.tree_at(point)?)).clone(),
            })
        };
        points.iter().map(tree).collect()
    }

    /// Returns the initial state at a point of the plane.
    pub(super) fn start_at(&self, point: &Point) -> State<f64> {
        let mut start = self.start.clone();
        for (quantity, &value) in self.quantities.iter().zip(point) {
            if let AxisQuantity::Angles(links) = quantity {
                for link in links {
                    start.values[*link] = value.to_radians();
                }
            }
        }
        start
    }

    /// Returns the table columns of the two quantities.
    pub(super) fn columns(&self) -> [Column; 2] {
        [0, 1].map(|axis| {
            let name = self.axes[axis].name.as_str();
            Column::new(name, self.quantities[axis].unit())
        })
    }

    /// Creates a chart of the plane; `fill` adds the series to its panel.
    pub(super) fn chart(&self, title: &str, fill: impl FnOnce(Panel) -> Panel) -> Chart {
        let [x, y] = [0, 1].map(|axis| {
            let AxisValues {
                values, by_ratio, ..
            } = self.axes[axis];
            let label = self.label(axis);
            match (by_ratio, values.as_slice()) {
                (true, _) => Axis::log(label),
                (false, &[first, .., last]) => Axis::linear(label).range(first, last),
                (false, _) => Axis::linear(label),
            }
        });
        let panel = fill(Panel::new(y));
        let title = format!("{}: {title}", verbatim(&self.subject.name));
        let chart = Chart::new(title, x).panel(panel);
        chart.size(960.0, 720.0)
    }

    /// Returns the label of an axis in the chart.
    fn label(&self, axis: usize) -> String {
        let name = verbatim(&self.axes[axis].name);
        match self.quantities[axis] {
            AxisQuantity::Parameter(_) => name,
            AxisQuantity::Angles(_) => format!("angle of {name} at the release (°)"),
        }
    }
}

/// Creates a series that shows points as cells, coloured by their values.
pub(super) fn shaded(values: &[(Point, f64)]) -> Series {
    let [x, y] = coordinates(values.iter().map(|(point, _)| *point));
    let values: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
    Series::shaded(&x, &y, &values)
}

/// Creates a series that shows points as cells of one colour.
pub(super) fn cells(label: String, points: &[Point]) -> Series {
    let [x, y] = coordinates(points.iter().copied());
    Series::cells(label, &x, &y)
}

/// Adds the marked points of a map to its panel.
pub(super) fn marks(panel: Panel, points: &[Point]) -> Panel {
    if points.is_empty() {
        return panel;
    }
    let [x, y] = coordinates(points.iter().copied());
    let marked = Series::points("marked", &x, &y).color(MARKED);
    panel.series(marked.symbol(Symbol::Diamond))
}

fn coordinates(points: impl Iterator<Item = Point>) -> [Vec<f64>; 2] {
    let (x, y) = points.map(|[x, y]| (x, y)).unzip();
    [x, y]
}

/// Question that a map answers at every point of the plane.
pub(super) trait Question {
    /// Answer at a point.
    type Answer;
    /// Number of points that are computed between two checks for Ctrl-C.
    const BLOCK: usize;

    /// Returns the answers at some points; `None` where the motion could not be integrated.
    ///
    /// # Errors
    /// [`Failure`].
    fn at(&self, points: &[Point]) -> Result<Vec<Option<Self::Answer>>, Failure>;

    /// Computes what the map shows in addition to the answers at its points.
    ///
    /// # Errors
    /// [`Failure`].
    fn complete(&mut self, _: &Job) -> Result<(), Failure> {
        Ok(())
    }

    /// Returns the table columns of an answer.
    fn columns(&self) -> Vec<Column>;

    /// Returns the table cells of an answer.
    fn row(&self, answer: &Self::Answer) -> Vec<Cell<'_>>;

    /// Returns the text that the program prints about all answers; `lost` is the number of motions
    /// that could not be integrated.
    fn report(&self, found: &[(Point, Self::Answer)], lost: usize) -> String;

    /// Returns the values for the record of the run.
    fn record(&self, found: &[(Point, Self::Answer)]) -> Vec<(&'static str, usize)>;

    /// The map.
    fn chart(&self, found: &[(Point, Self::Answer)]) -> Chart;
}
