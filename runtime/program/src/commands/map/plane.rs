//! The plane of a map: two quantities with the values that they take.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

use branched_pendulum::system::State;
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::subject::Subject;

/// A quantity with the values that it takes along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AxisValues {
    pub(super) name: String,
    values: Vec<f64>,
}

/// Most values along an axis.
const MOST_VALUES: f64 = 2000.0;

impl AxisValues {
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no axis: write `NAME=FROM:TO:STEP`, as in `parent=0:90:5`, with at \
                 most {MOST_VALUES} steps"
            )
        };
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let numbers: Vec<f64> = range
            .split(':')
            .map(|number| number.trim().parse().ok())
            .collect::<Option<_>>()
            .ok_or_else(wrong)?;
        let [from, to, step] = *numbers else {
            return Err(wrong());
        };
        let steps = ((to - from) / step + 1e-9).floor();
        if !(0.0..MOST_VALUES).contains(&steps) {
            return Err(wrong());
        }
        Ok(Self {
            name: name.trim().to_owned(),
            values: (0..=steps as u32)
                .map(|k| from + f64::from(k) * step)
                .collect(),
        })
    }
}

/// What the values of an axis are of.
enum Quantity {
    Parameter(String),
    Angles(Vec<usize>),
}

impl Quantity {
    fn of(subject: &Subject, axis: &AxisValues) -> Result<Self, Failure> {
        let description = subject.tree.description();
        let is_parameter = description.parameters().any(|own| own == axis.name);
        match (is_parameter, subject.links_named(&axis.name)) {
            (true, Err(_)) => Ok(Self::Parameter(axis.name.clone())),
            (false, Ok(links)) => Ok(Self::Angles(links)),
            (true, Ok(_)) => Err(Failure::Lacking {
                what: format!("`{}` is a link and a parameter: rename one", axis.name),
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

/// A point of the plane: the values of both quantities.
pub(super) type Point = [f64; 2];

/// The plane, with what does not change over it.
pub(super) struct MapPlane<'a> {
    pub(super) subject: &'a Subject,
    start: State<f64>,
    axes: [&'a AxisValues; 2],
    quantities: [Quantity; 2],
}

impl<'a> MapPlane<'a> {
    /// Returns the plane of two quantities of a tree that otherwise starts from `start`.
    ///
    /// # Errors
    /// [`Failure::Lacking`] for names that are neither a link nor a parameter, or both.
    pub(super) fn new(
        subject: &'a Subject,
        start: State<f64>,
        axes: [&'a AxisValues; 2],
    ) -> Result<Self, Failure> {
        let [x, y] = axes.map(|axis| Quantity::of(subject, axis));
        Ok(Self {
            subject,
            start,
            axes,
            quantities: [x?, y?],
        })
    }

    /// Returns all points, row by row.
    pub(super) fn points(&self) -> Vec<Point> {
        let [x, y] = self.axes;
        let rows = y.values.iter();
        rows.flat_map(|&y| x.values.iter().map(move |&x| [x, y]))
            .collect()
    }

    /// Returns true where both quantities take more than one value.
    pub(super) fn is_plane(&self) -> bool {
        self.axes.iter().all(|axis| axis.values.len() > 1)
    }

    /// Returns the tree at a point.
    ///
    /// # Errors
    /// [`Failure::Tree`] for a value that no pendulum can have.
    pub(super) fn tree_at(&self, point: &Point) -> Result<PendulumTree, Failure> {
        let mut tree = self.subject.tree.clone();
        for (quantity, &value) in self.quantities.iter().zip(point) {
            if let Quantity::Parameter(name) = quantity {
                let changed = tree.with(name, value);
                tree = changed.map_err(|source| Failure::tree(&self.subject.name, source))?;
            }
        }
        Ok(tree)
    }

    /// Returns the trees at some points. Points with the same parameters share one.
    ///
    /// # Errors
    /// As [`tree_at`](Self::tree_at).
    pub(super) fn trees_at(&self, points: &[Point]) -> Result<Vec<Rc<PendulumTree>>, Failure> {
        let mut known: HashMap<Vec<u64>, Rc<PendulumTree>> = HashMap::new();
        let tree = |point: &Point| {
            let both = self.quantities.iter().zip(point);
            let parameters =
                both.filter(|(quantity, _)| matches!(quantity, Quantity::Parameter(_)));
            let parameters = parameters.map(|(_, value)| value.to_bits()).collect();
            Ok(match known.entry(parameters) {
                Entry::Occupied(own) => own.get().clone(),
                Entry::Vacant(place) => place.insert(Rc::new(self.tree_at(point)?)).clone(),
            })
        };
        points.iter().map(tree).collect()
    }

    /// Returns the start at a point.
    pub(super) fn start_at(&self, point: &Point) -> State<f64> {
        let mut start = self.start.clone();
        for (quantity, &value) in self.quantities.iter().zip(point) {
            if let Quantity::Angles(links) = quantity {
                for link in links {
                    start.values[*link] = value.to_radians();
                }
            }
        }
        start
    }

    /// Columns of the quantities in a table.
    pub(super) fn columns(&self) -> [Column; 2] {
        [0, 1].map(|axis| {
            let name = self.axes[axis].name.as_str();
            Column::new(name, self.quantities[axis].unit())
        })
    }

    /// Returns a chart of the plane, whose panel `fill` gives its series.
    pub(super) fn chart(&self, title: &str, fill: impl FnOnce(Panel) -> Panel) -> Chart {
        let panel = fill(Panel::new(Axis::linear(self.label(1))));
        let title = format!("{}: {title}", verbatim(&self.subject.name));
        let chart = Chart::new(title, Axis::linear(self.label(0))).panel(panel);
        chart.size(960.0, 720.0)
    }

    /// Label of an axis in the chart.
    fn label(&self, axis: usize) -> String {
        let name = verbatim(&self.axes[axis].name);
        match self.quantities[axis] {
            Quantity::Parameter(_) => name,
            Quantity::Angles(_) => format!("angle of {name} at the release (°)"),
        }
    }
}

/// Points with their values as cells whose colours tell them.
pub(super) fn shaded(values: &[(Point, f64)]) -> Series {
    let [x, y] = coordinates(values.iter().map(|(point, _)| *point));
    let values: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
    Series::shaded(&x, &y, &values)
}

/// Points as cells of one colour.
pub(super) fn cells(label: String, points: &[Point]) -> Series {
    let [x, y] = coordinates(points.iter().copied());
    Series::cells(label, &x, &y)
}

fn coordinates(points: impl Iterator<Item = Point>) -> [Vec<f64>; 2] {
    let (x, y) = points.map(|[x, y]| (x, y)).unzip();
    [x, y]
}

/// What is asked at every point of the plane.
pub(super) trait Question {
    /// What is found at a point.
    type Answer;
    /// Points that are computed between two looks at Ctrl-C.
    const BLOCK: usize;

    /// Returns the answers at some points; none where the motion could not be followed.
    ///
    /// # Errors
    /// [`Failure`].
    fn at(&self, points: &[Point]) -> Result<Vec<Option<Self::Answer>>, Failure>;

    /// Columns of an answer in the table.
    fn columns(&self) -> Vec<Column>;

    /// Cells of an answer in the table.
    fn row(&self, answer: &Self::Answer) -> Vec<Cell<'_>>;

    /// What is printed; `lost` motions could not be followed.
    fn report(&self, found: &[(Point, Self::Answer)], lost: usize) -> String;

    /// Values of the record of the run.
    fn record(&self, found: &[(Point, Self::Answer)]) -> Vec<(&'static str, usize)>;

    /// The map.
    fn chart(&self, found: &[(Point, Self::Answer)]) -> Chart;
}
