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
    /// Size of a px in a figure of a fixed width, mm.
    pub(crate) unit: Option<f64>,
}

/// Size of a px in a figure, mm: tick labels have 7 points there.
const FIGURE_UNIT: f64 = 7.0 / 72.0 * 25.4 / TICK_SIZE;
/// Pixels of a figure's PNG in a millimetre: 600 in an inch.
const FIGURE_PIXELS: f64 = 600.0 / 25.4;

/// An axis: its label, its kind and, where given, its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) log: bool,
    pub(crate) range: Option<(f64, f64)>,
}

/// One set of axes of a chart.
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
    /// Lower edge of a band, whose upper edge is `y`.
    pub(crate) low: Option<Vec<f64>>,
    pub(crate) cells: bool,
    /// Values of cells whose colour tells them.
    pub(crate) shades: Option<Vec<f64>>,
    /// Place among the classes of a heatmap.
    pub(crate) class: usize,
    pub(crate) joined: bool,
    pub(crate) symbols: bool,
    pub(crate) color: Option<Color>,
    pub(crate) dash: Option<Dash>,
    pub(crate) symbol: Option<Symbol>,
}

impl Axis {
    /// A linear axis. The label names quantity and unit: `t (s)`.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            log: false,
            range: None,
        }
    }

    /// A logarithmic axis, base 10.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            log: true,
            ..Self::linear(label)
        }
    }

    /// Shows exactly `low` to `high`; what lies outside is cut off. Without a
    /// range the axis spans the samples in view, with a small margin.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }
}

impl Series {
    /// Samples `(x[i], y[i])`, joined by a line in their order. Series of equal
    /// label share one style and one legend entry; an empty label has none.
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
            color: None,
            dash: None,
            symbol: None,
        }
    }

    /// Samples `(x[i], y[i])`, each a symbol, not joined.
    pub fn points(label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self {
            joined: false,
            symbols: true,
            ..Self::line(label, x, y)
        }
    }

    /// The area between `(x[i], low[i])` and `(x[i], high[i])`: an interval of
    /// confidence, or errors. What is added after it is drawn over it.
    pub fn band(label: impl Into<String>, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        Self {
            joined: false,
            low: Some(low.to_vec()),
            ..Self::line(label, x, high)
        }
    }

    /// Samples `(x[i], y[i])`, each of which fills its cell: half way to its
    /// neighbours among all cells of the panel.
    pub fn cells(label: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self {
            joined: false,
            cells: true,
            ..Self::line(label, x, y)
        }
    }

    /// Cells whose colour tells their value, by the chart's [`colors`](Chart::colors):
    /// dark where it is low. A value that is not a number leaves its cell empty.
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

    /// Draws in this colour instead of the next free one.
    pub fn color(mut self, color: Color) -> Self {
        self.color = Some(color);
        self
    }

    /// Draws the line with this dash instead of the next free one.
    pub fn dash(mut self, dash: Dash) -> Self {
        self.dash = Some(dash);
        self
    }

    /// Draws each sample as this symbol.
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

    /// Names the panel, or says what holds for it alone, above its left end.
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

    /// Adds a heatmap: [`Series::cells`] at `(x[i], y[i])` whose colour tells
    /// between which of the ascending `levels` their value lies, dark where it is
    /// low. Each class is a series of its own, named in the legend; a value that
    /// is not a number leaves its cell empty.
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

    /// Adds a vertical marker line at `x`, its label above the panel. The x
    /// axis extends to it, unless its range is given: then a line outside the
    /// range is left out.
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.verticals.push((x, label.into()));
        self
    }

    /// Adds a horizontal line at y = 0. The y axis extends to it, unless its
    /// range is given: then a line outside the range is left out. On a
    /// logarithmic axis it is [`ChartError::MarkerLine`](crate::ChartError::MarkerLine).
    pub fn zero_line(mut self) -> Self {
        self.zero_line = true;
        self
    }
}

impl Chart {
    /// A chart of 900 x 560 px without panels, whose PNG has 2 pixels per px.
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

    /// Arranges the panels in rows of `columns`, over one x axis each; the legend
    /// then stands below all of them.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Values of [`Series::shaded`] in all panels by this axis, which stands at the right as
    /// a bar of colours; values beyond its range have the colour of its end. Without it,
    /// a linear one spans the values.
    pub fn colors(mut self, axis: Axis) -> Self {
        self.colors = Some(axis);
        self
    }

    /// Adds a panel after those already there.
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Width and least height in px, at least 320 x 200.
    pub fn size(mut self, width: f64, height: f64) -> Self {
        self.width = width;
        self.height = height;
        self
    }

    /// Pixels of the PNG per px.
    pub fn scale(mut self, scale: f64) -> Self {
        self.scale = scale;
        self
    }

    /// Makes a figure of this width (mm, at least 66) whose type has a fixed size, 7 points at ticks
    /// and 8 at axes. Its height keeps the proportion, unless panels would be too low; its
    /// PNG has 600 pixels in an inch.
    pub fn figure(mut self, width: f64) -> Self {
        let px = width / FIGURE_UNIT;
        self.height = (self.height * px / self.width).max(LEAST_SIZE.1);
        self.width = px;
        self.unit = Some(FIGURE_UNIT);
        self.scale = FIGURE_UNIT * FIGURE_PIXELS;
        self
    }
}
