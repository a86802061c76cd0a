use crate::sizes::{LEAST_SIZE, TICK_SIZE};
use crate::style::{Color, Dash, Symbol, ramp};

/// Description of a chart: plain data until it is rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) colors: Option<Axis>,
    pub(crate) panels: Vec<Panel>,
    pub(crate) columns: usize,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) scale: f64,
    /// Size of a px in mm, in a figure of fixed width.
    pub(crate) unit: Option<f64>,
}

/// Size of a px in a figure, in mm; it makes tick labels 7 points high.
const FIGURE_UNIT: f64 = 7.0 / 72.0 * 25.4 / TICK_SIZE;
/// Pixels per mm of a figure's PNG: 600 per inch.
const FIGURE_PIXELS: f64 = 600.0 / 25.4;

/// An axis: its label, its kind and its range, if one is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) log: bool,
    pub(crate) range: Option<(f64, f64)>,
    /// True if ticks are only at whole numbers.
    pub(crate) whole: bool,
}

/// One y axis with its series.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub(crate) name: Option<String>,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
    pub(crate) verticals: Vec<(f64, String)>,
    pub(crate) zero_line: bool,
}

/// Samples drawn as a line, as symbols, as both, as a band or as cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub(crate) label: String,
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// Lower edge of a band; its upper edge is `y`.
    pub(crate) low: Option<Vec<f64>>,
    pub(crate) cells: bool,
    /// Values of cells, which are shown by colour.
    pub(crate) shades: Option<Vec<f64>>,
    /// Index among the classes of a heatmap.
    pub(crate) class: usize,
    pub(crate) joined: bool,
    pub(crate) symbols: bool,
    /// Half the length of the error bar of each sample.
    pub(crate) errors: Option<Vec<f64>>,
    pub(crate) small: bool,
    pub(crate) marks_beyond: bool,
    pub(crate) color: Option<Color>,
    pub(crate) dash: Option<Dash>,
    pub(crate) symbol: Option<Symbol>,
}

impl Axis {
    /// Creates a linear axis. The label names quantity and unit: `t (s)`. If the numbers need a
    /// power of ten and the unit is a single SI unit, the unit gets a prefix instead: `energy
    /// (nJ)`.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            log: false,
            range: None,
            whole: false,
        }
    }

    /// A logarithmic axis, base 10.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            log: true,
            ..Self::linear(label)
        }
    }

    /// Restricts the ticks of a linear axis to whole numbers, for counts or indices.
    pub fn whole(mut self) -> Self {
        self.whole = true;
        self
    }

    /// Shows exactly the range from `low` to `high`; what lies outside is cut off. Without this,
    /// the axis spans the samples in view, with a small margin.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }
}

impl Series {
    /// Creates a line through the samples `(x[i], y[i])` in their order. Series with equal labels
    /// share one style and one legend entry; a series with an empty label has no entry.
    pub fn line(label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self {
            label: label.into(),
            x: x.to_vec(),
            y: y.to_vec(),
            low: None,
            cells: false,
            shades: None,
            class: 0,
            joined: true,
            symbols: false,
            errors: None,
            small: false,
            marks_beyond: false,
            color: None,
            dash: None,
            symbol: None,
        }
    }

    /// Creates separate symbols at the samples `(x[i], y[i])`.
    pub fn points(label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self {
            joined: false,
            symbols: true,
            ..Self::line(label, x, y)
        }
    }

    /// Creates the area between the samples `(x[i], low[i])` and `(x[i], high[i])`, for example a
    /// confidence interval. Series added later are drawn over it.
    pub fn band(label: impl Into<String>, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        Self {
            joined: false,
            low: Some(low.to_vec()),
            ..Self::line(label, x, high)
        }
    }

    /// Creates filled cells at the samples `(x[i], y[i])`. Each cell extends half way to its
    /// neighbours among all cells of the panel.
    pub fn cells(label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self {
            joined: false,
            cells: true,
            ..Self::line(label, x, y)
        }
    }

    /// Creates cells whose colour shows their value on the colour axis of the chart
    /// ([`colors`](Chart::colors)); low values are dark. The cell of a NaN stays empty.
    pub fn shaded(x: &[f64], y: &[f64], values: &[f64]) -> Self {
        Self {
            shades: Some(values.to_vec()),
            ..Self::cells("", x, y)
        }
    }

    /// Adds a symbol at each sample of a line.
    pub fn with_symbols(mut self) -> Self {
        self.symbols = true;
        self
    }

    /// Draws in this colour instead of the next unused one.
    pub fn color(mut self, color: Color) -> Self {
        self.color = Some(color);
        self
    }

    /// Draws the line with this dash pattern instead of the next unused one.
    pub fn dash(mut self, dash: Dash) -> Self {
        self.dash = Some(dash);
        self
    }

    /// Draws an error bar from `y[i] - errors[i]` to `y[i] + errors[i]` through each sample; no bar
    /// if the error is NaN.
    pub fn errors(mut self, errors: &[f64]) -> Self {
        self.errors = Some(errors.to_vec());
        self
    }

    /// Draws symbols as small dots, for large numbers of measured points.
    pub fn small(mut self) -> Self {
        self.small = true;
        self
    }

    /// Marks on the panel's edge the x positions of samples above or below the range of its y axis.
    pub fn mark_beyond(mut self) -> Self {
        self.marks_beyond = true;
        self
    }

    /// Draws each sample with this symbol.
    pub fn symbol(mut self, symbol: Symbol) -> Self {
        self.symbols = true;
        self.symbol = Some(symbol);
        self
    }
}

impl Panel {
    /// A panel without series.
    pub fn new(y: Axis) -> Self {
        Self {
            name: None,
            y,
            series: Vec::new(),
            verticals: Vec::new(),
            zero_line: false,
        }
    }

    /// Sets the name of the panel, or a remark on it, which is drawn above its left end.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// Adds a series.
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds [`Series::line`].
    pub fn line(self, label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        self.series(Series::line(label, x, y))
    }

    /// Adds [`Series::points`].
    pub fn points(self, label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        self.series(Series::points(label, x, y))
    }

    /// Adds [`Series::band`].
    pub fn band(self, label: impl Into<String>, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        self.series(Series::band(label, x, low, high))
    }

    /// Adds a heatmap: cells ([`Series::cells`]) at `(x[i], y[i])` whose colour shows between which
    /// of the ascending `levels` their value lies; low values are dark. Each class is a separate
    /// series with an entry in the legend. The cell of a NaN stays empty.
    pub fn heatmap(self, x: &[f64], y: &[f64], values: &[f64], levels: &[f64]) -> Self {
        let classes = levels.len() + 1;
        let class = |value: f64| levels.partition_point(|level| *level <= value);
        let samples: Vec<(f64, f64, f64)> = x
            .iter()
            .zip(y)
            .zip(values)
            .map(|((x, y), value)| (*x, *y, *value))
            .filter(|(.., value)| !value.is_nan())
            .collect();
        let colors = ramp(classes).into_iter().enumerate();
        colors.fold(self, |panel, (index, color)| {
            let own = samples.iter().filter(|(.., value)| class(*value) == index);
            let (x, y): (Vec<f64>, Vec<f64>) = own.map(|&(x, y, _)| (x, y)).unzip();
            if x.is_empty() {
                return panel;
            }
            let level = |index: usize| levels.get(index).map_or(String::new(), f64::to_string);
            let label = match index {
                _ if levels.is_empty() => String::new(),
                0 => format!("below {}", level(0)),
                _ if index == classes - 1 => format!("from {}", level(index - 1)),
                _ => format!("{} to {}", level(index - 1), level(index)),
            };
            panel.series(Series {
                class: index,
                ..Series::cells(label, &x, &y).color(color)
            })
        })
    }

    /// Adds a vertical marker line at `x`, with its label above the panel. The x axis is extended
    /// to the line. If the range of the axis is given, a line outside it is left out.
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.verticals.push((x, label.into()));
        self
    }

    /// Adds a horizontal line at y = 0. The y axis is extended to the line. If the range of the
    /// axis is given, a line outside it is left out. On a logarithmic axis the line causes the
    /// error [`ChartError::MarkerLine`](crate::ChartError::MarkerLine).
    pub fn zero_line(mut self) -> Self {
        self.zero_line = true;
        self
    }
}

impl Chart {
    /// Creates a chart of 900 x 560 px without panels. Its PNG has 2 pixels per px.
    pub fn new(title: impl Into<String>, x: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            colors: None,
            panels: Vec::new(),
            columns: 1,
            width: 900.0,
            height: 560.0,
            scale: 2.0,
            unit: None,
        }
    }

    /// Arranges the panels in rows of `columns` panels. Each column has one x axis, and the legend
    /// is below all of them.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Sets the axis that assigns colours to the values of [`Series::shaded`] in all panels. It is
    /// drawn as a colour bar on the right; values beyond its range have the colour of its end. By
    /// default, a linear axis spans the values.
    pub fn colors(mut self, axis: Axis) -> Self {
        self.colors = Some(axis);
        self
    }

    /// Adds a panel after the existing ones.
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Sets the width and the least height in px, at least 320 x 200.
    pub fn size(mut self, width: f64, height: f64) -> Self {
        self.width = width;
        self.height = height;
        self
    }

    /// Sets the number of pixels of the PNG per px.
    pub fn scale(mut self, scale: f64) -> Self {
        self.scale = scale;
        self
    }

    /// Turns the chart into a figure of this width (mm, at least 66) whose text has a fixed size: 7
    /// points at ticks and 8 at axes. Its proportions are kept, unless panels would become too low;
    /// its PNG has 600 pixels per inch.
    pub fn figure(mut self, width: f64) -> Self {
        let px = width / FIGURE_UNIT;
        self.height = (self.height * px / self.width).max(LEAST_SIZE.1);
        self.width = px;
        self.unit = Some(FIGURE_UNIT);
        self.scale = FIGURE_UNIT * FIGURE_PIXELS;
        self
    }
}
