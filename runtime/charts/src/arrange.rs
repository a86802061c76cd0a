use crate::axis::scales;
use crate::clip::Rect;
use crate::color_bar::ColorBar;
use crate::description::{Chart, Panel};
use crate::drawing::LARGEST_SIDE;
use crate::error::ChartError;
use crate::font::Font;
use crate::guides::{self, Guide};
use crate::label::{Label, widest};
use crate::legend::{self, Legend};
use crate::scale::Scale;
use crate::sizes::{
    COLUMN_GAP, EDGE, LABEL_GAP, LABEL_LINE, LABEL_SIZE, LEAST_PANEL, LEAST_SIZE, LEGEND_GAP,
    NAME_GAP, PANEL_GAP, TICK, TICK_GAP, TICK_LINE, TICK_SIZE, TITLE_LINE, TITLE_SIZE,
};
use crate::style::Style;
use crate::ticks::{Ticks, most, tick_labels, ticks};

/// Where everything stands.
pub(crate) struct Plan {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) title: Vec<Label>,
    pub(crate) x: XAxis,
    pub(crate) panels: Vec<PanelPlan>,
    pub(crate) legend: Legend,
    pub(crate) colors: Option<ColorBar>,
}

pub(crate) struct XAxis {
    pub(crate) scale: Scale,
    pub(crate) ticks: Ticks,
    pub(crate) label: Vec<Label>,
    /// The part common to the tick labels has a line of its own, since the
    /// label of the axis leaves no room beside it.
    pub(crate) common_below: bool,
}

pub(crate) struct PanelPlan {
    pub(crate) frame: Rect,
    /// Left edge of the label of its y axis.
    pub(crate) outer_left: f64,
    /// The x axis is labelled below it: it is the last of its column.
    pub(crate) lowest: bool,
    pub(crate) scale: Scale,
    pub(crate) ticks: Ticks,
    pub(crate) label: Vec<Label>,
    pub(crate) strip: Above,
    pub(crate) styles: Vec<Style>,
}

/// What stands above a panel.
pub(crate) struct Above {
    pub(crate) guides: Vec<Guide>,
    /// Name of the panel, and how far from its left edge it begins.
    pub(crate) name: Vec<Label>,
    pub(crate) indent: f64,
    height: f64,
}

/// Finds the place of everything.
pub(crate) fn arrange(chart: &Chart, font: &Font) -> Result<Plan, ChartError> {
    let sides = [(chart.width, LEAST_SIZE.0), (chart.height, LEAST_SIZE.1)];
    let usable = |(side, least)| side >= least && side <= LARGEST_SIDE;
    if !sides.into_iter().all(usable) {
        return Err(ChartError::Size {
            width: chart.width,
            height: chart.height,
            scale: chart.scale,
        });
    }
    let (x, y) = scales(chart)?;
    let sketch = Sketch {
        chart,
        font,
        x,
        y: &y,
        styles: legend::styles(chart),
    };
    // Ticks, wrapped labels and legend depend on the height of the panels,
    // which depends on the room they take: estimate, then correct once.
    let rows = y.len().div_ceil(chart.columns);
    let estimate = chart.height / rows as f64;
    let first = sketch.plan(&vec![estimate; y.len()])?;
    let heights = first.panels.iter().map(|p| p.frame.height());
    sketch.plan(&heights.collect::<Vec<_>>())
}

struct Sketch<'a> {
    chart: &'a Chart,
    font: &'a Font,
    x: Scale,
    y: &'a [Scale],
    styles: Vec<Vec<Style>>,
}

impl Sketch<'_> {
    /// The plan whose parts are chosen for panels as high as `heights`.
    fn plan(&self, heights: &[f64]) -> Result<Plan, ChartError> {
        let Self { chart, font, .. } = *self;
        let inner = chart.width - 2.0 * EDGE;
        let title = Label::parse(&chart.title).wrap(font, TITLE_SIZE, inner);
        let legend = Legend::plan(chart, &self.styles, font, inner, heights);

        let all = heights.iter().step_by(chart.columns).sum();
        let colors = ColorBar::plan(chart, font, all)?;
        let y_ticks: Vec<Ticks> = self
            .y
            .iter()
            .zip(heights)
            .map(|(scale, height)| ticks(scale, most(*height, 42.0)))
            .collect();
        let y_labels = self.y_labels(heights);
        let margin = self.margin(&y_ticks, &y_labels);
        let columns = chart.columns.min(chart.panels.len()) as f64;
        let bar = colors.as_ref().map_or(0.0, ColorBar::width);
        let outer = chart.width - EDGE - legend.side_width() - bar;
        let column = (outer - EDGE - (columns - 1.0) * COLUMN_GAP) / columns;
        // From one column to the next.
        let step = column + COLUMN_GAP;
        let left = EDGE + margin;
        let beyond = chart.width - bar - (columns - 1.0) * step;
        let (ticks, right) = self.x_ticks(left, EDGE + column, beyond);
        let room = right - left;
        if room < LEAST_PANEL.0 {
            return Err(ChartError::NoRoom {
                width: chart.width,
                left: room,
            });
        }
        let x = self.x_axis(ticks, room);

        let mut top = EDGE + title.len() as f64 * TITLE_LINE;
        let across = |index: usize| Rect {
            left: left + step * (index % chart.columns) as f64,
            right: right + step * (index % chart.columns) as f64,
            top: 0.0,
            bottom: 0.0,
        };
        let strips = chart.panels.iter().zip(&y_ticks).enumerate();
        let strips = strips.map(|(index, (panel, ticks))| self.strip(panel, ticks, &across(index)));
        let strips: Vec<Above> = strips.collect();
        let bottom = x.height() + self.legend_height(&legend, inner) + EDGE;
        let rows = self.rows(&strips, chart.height - top - bottom);

        let count = chart.panels.len();
        let mut panels = Vec::new();
        let parts = strips.into_iter().zip(y_ticks).zip(y_labels);
        let axes = self.y.iter().zip(&self.styles);
        for (index, (((strip, ticks), label), (scale, styles))) in parts.zip(axes).enumerate() {
            let [above, height] = rows[index / chart.columns];
            let across = across(index);
            let frame = Rect {
                top: top + above,
                bottom: top + above + height,
                ..across
            };
            if (index + 1) % chart.columns == 0 || index + 1 == count {
                top = frame.bottom + PANEL_GAP;
            }
            panels.push(PanelPlan {
                frame,
                outer_left: across.left - margin,
                lowest: index + chart.columns >= count,
                scale: *scale,
                ticks,
                label,
                strip,
                styles: styles.clone(),
            });
        }
        Ok(Plan {
            width: chart.width,
            height: top - PANEL_GAP + bottom,
            title,
            x,
            panels,
            legend,
            colors,
        })
    }

    /// Heights of the strips and of the panels below them, row by row, that fill `free` together
    /// with the gaps.
    fn rows(&self, strips: &[Above], free: f64) -> Vec<[f64; 2]> {
        // The strips of a row are as high as its highest.
        let highest = |row: &[Above]| row.iter().map(|strip| strip.height).fold(0.0, f64::max);
        let above: Vec<f64> = strips.chunks(self.chart.columns).map(highest).collect();
        let rows = above.len() as f64;
        let free = free - above.iter().sum::<f64>() - PANEL_GAP * (rows - 1.0);
        let height = (free / rows).max(LEAST_PANEL.1);
        above.into_iter().map(|above| [above, height]).collect()
    }

    fn y_labels(&self, heights: &[f64]) -> Vec<Vec<Label>> {
        let panels = self.chart.panels.iter().zip(heights);
        let wrap = |label: &str, height: f64| {
            Label::parse(label).wrap(self.font, LABEL_SIZE, height.max(LEAST_PANEL.1))
        };
        panels
            .map(|(p, height)| wrap(&p.y.label, *height))
            .collect()
    }

    /// Room left of each panel, for the widest labels and tick labels.
    fn margin(&self, ticks: &[Ticks], labels: &[Vec<Label>]) -> f64 {
        let lines = labels.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let gap = if lines > 0.0 { LABEL_GAP } else { 0.0 };
        let labels = ticks.iter().flat_map(tick_labels);
        let widest = widest(&labels.collect::<Vec<_>>(), self.font, TICK_SIZE);
        lines * LABEL_LINE + gap + widest + TICK + TICK_GAP
    }

    /// Ticks of the x axis, as many as fit, and the right edge of the first column,
    /// moved in where the last label would reach `beyond`: the canvas' edge for
    /// the last column.
    fn x_ticks(&self, left: f64, right: f64, beyond: f64) -> (Ticks, f64) {
        let wide = fitting(&self.x, right - left, self.font);
        let half = widest(&tick_labels(&wide), self.font, TICK_SIZE) / 2.0;
        let right = right.min(beyond - half - 4.0);
        (fitting(&self.x, right - left, self.font), right)
    }

    fn x_axis(&self, ticks: Ticks, room: f64) -> XAxis {
        let label = Label::parse(&self.chart.x.label);
        let common = ticks.common.as_deref().map_or(0.0, |common| {
            Label::parse(common).width(self.font, TICK_SIZE)
        });
        let beside = label.width(self.font, LABEL_SIZE) / 2.0 + common + 12.0;
        XAxis {
            scale: self.x,
            label: label.wrap(self.font, LABEL_SIZE, room),
            common_below: common > 0.0 && beside > room / 2.0,
            ticks,
        }
    }

    /// Text above a panel: what is common to the tick labels, the panel's name, and labels of
    /// marker lines.
    fn strip(&self, panel: &Panel, ticks: &Ticks, across: &Rect) -> Above {
        let common = ticks.common.as_deref().map(|common| {
            let label = Label::parse(common);
            label.width(self.font, TICK_SIZE)
        });
        let indent = common.map_or(0.0, |common| common + NAME_GAP);
        let name = panel.name.as_deref().map_or(Vec::new(), |name| {
            Label::parse(name).wrap(self.font, guides::SIZE, across.width() - indent)
        });
        let mut reserved: Vec<f64> = name
            .iter()
            .rev()
            .map(|line| indent + line.width(self.font, guides::SIZE))
            .collect();
        if reserved.is_empty() {
            reserved.extend(common);
        }
        let (guides, rows) = guides::place(panel, &self.x, across, self.font, &reserved);
        let space = if rows > 0 { 10.0 } else { 6.0 };
        Above {
            guides,
            name,
            indent,
            height: rows as f64 * guides::LINE + space,
        }
    }

    fn legend_height(&self, legend: &Legend, inner: f64) -> f64 {
        let rows = legend.rows(inner);
        let height: f64 = rows.iter().map(|row| legend::row_height(row)).sum();
        if rows.is_empty() {
            0.0
        } else {
            height + LEGEND_GAP
        }
    }
}

impl XAxis {
    /// Height of ticks, tick labels and label below the last panel.
    pub(crate) fn height(&self) -> f64 {
        let common = if self.common_below { TICK_LINE } else { 0.0 };
        // What is common to the tick labels stands in the label's first line.
        let lines = self
            .label
            .len()
            .max(usize::from(self.ticks.common.is_some()));
        let ticks = TICK + TICK_GAP + TICK_LINE;
        ticks + common + lines as f64 * LABEL_LINE + LABEL_GAP
    }
}

/// The most ticks along `length` px whose labels do not touch.
fn fitting(scale: &Scale, length: f64, font: &Font) -> Ticks {
    let mut most = most(length, 60.0);
    loop {
        let candidate = ticks(scale, most);
        if most <= 2 || apart(&candidate, scale, length, font) {
            return candidate;
        }
        most -= 1;
    }
}

fn apart(ticks: &Ticks, scale: &Scale, length: f64, font: &Font) -> bool {
    let mut end = f64::NEG_INFINITY;
    ticks
        .major
        .iter()
        .zip(tick_labels(ticks))
        .all(|(tick, label)| {
            let middle = scale.place(tick.at) * length;
            let half = label.width(font, TICK_SIZE) / 2.0;
            let clear = middle - half >= end + 10.0;
            end = middle + half;
            clear
        })
}
