use crate::axis::scales;
use crate::clip::Rect;
use crate::color_bar::ColorBar;
use crate::description::{Axis, Chart, Panel};
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
use crate::ticks::{Ticks, labelled, most, tick_labels};

/// Positions of all parts of the chart.
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
    /// True if the common part of the tick labels is on its own line, because there is no room for
    /// it next to the label of the axis.
    pub(crate) common_below: bool,
}

pub(crate) struct PanelPlan {
    pub(crate) frame: Rect,
    /// Left edge of the label of the panel's y axis, in px.
    pub(crate) outer_left: f64,
    /// True if the x axis is labelled below this panel, since it is the last of its column.
    pub(crate) lowest: bool,
    pub(crate) scale: Scale,
    pub(crate) ticks: Ticks,
    pub(crate) label: Vec<Label>,
    pub(crate) strip: Heading,
    pub(crate) styles: Vec<Style>,
}

/// Text above a panel.
pub(crate) struct Heading {
    pub(crate) guides: Vec<Guide>,
    /// Name of the panel, with the distance of its beginning from the panel's left edge.
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
    /// Returns the plan for panels of these heights.
    fn plan(&self, heights: &[f64]) -> Result<Plan, ChartError> {
        let Self { chart, font, .. } = *self;
        let inner = chart.width - 2.0 * EDGE;
        let title = Label::parse(&chart.title).wrap(font, TITLE_SIZE, inner);
        let legend = Legend::plan(chart, &self.styles, font, inner, heights);

        let all = heights.iter().step_by(chart.columns).sum();
        let colors = ColorBar::plan(chart, font, all)?;
        let y = chart.panels.iter().zip(self.y).zip(heights);
        let y = y.map(|((panel, scale), height)| {
            let (ticks, label) = labelled(&panel.y, scale, most(*height, 42.0));
            let label = Label::parse(&label);
            let room = height.max(LEAST_PANEL.1);
            (ticks, label.wrap(font, LABEL_SIZE, room))
        });
        let (y_ticks, y_labels): (Vec<Ticks>, Vec<Vec<Label>>) = y.unzip();
        let margin = self.margin(&y_ticks, &y_labels);
        let columns = chart.columns.min(chart.panels.len()) as f64;
        let bar = colors.as_ref().map_or(0.0, ColorBar::width);
        let outer = chart.width - EDGE - legend.side_width() - bar;
        let column = (outer - EDGE - (columns - 1.0) * COLUMN_GAP) / columns;
        // From one column to the next.
        let step = column + COLUMN_GAP;
        let left = EDGE + margin;
        let beyond = chart.width - bar - (columns - 1.0) * step;
        let ((ticks, label), right) = self.x_ticks(left, EDGE + column, beyond);
        let room = right - left;
        if room < LEAST_PANEL.0 {
            return Err(ChartError::NoRoom {
                width: chart.width,
                left: room,
            });
        }
        let x = self.x_axis(ticks, &label, room);

        let mut top = EDGE + title.len() as f64 * TITLE_LINE;
        let across = |index: usize| Rect {
            left: left + step * (index % chart.columns) as f64,
            right: right + step * (index % chart.columns) as f64,
            top: 0.0,
            bottom: 0.0,
        };
        let strips = chart.panels.iter().zip(&y_ticks).enumerate();
        let strips = strips.map(|(index, (panel, ticks))| self.strip(panel, ticks, &across(index)));
        let strips: Vec<Heading> = strips.collect();
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

    /// Returns the heights of the text above the panels and of the panels, row by row; together
    /// with the gaps they fill `free` px.
    fn rows(&self, strips: &[Heading], free: f64) -> Vec<[f64; 2]> {
        // The strips of a row are as high as its highest.
        let highest = |row: &[Heading]| row.iter().map(|strip| strip.height).fold(0.0, f64::max);
        let above: Vec<f64> = strips.chunks(self.chart.columns).map(highest).collect();
        let rows = above.len() as f64;
        let free = free - above.iter().sum::<f64>() - PANEL_GAP * (rows - 1.0);
        let height = (free / rows).max(LEAST_PANEL.1);
        above.into_iter().map(|above| [above, height]).collect()
    }

    /// Returns the width needed left of each panel, for the widest axis label and tick labels.
    fn margin(&self, ticks: &[Ticks], labels: &[Vec<Label>]) -> f64 {
        let lines = labels.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let gap = if lines > 0.0 { LABEL_GAP } else { 0.0 };
        let labels = ticks.iter().flat_map(tick_labels);
        let widest = widest(&labels.collect::<Vec<_>>(), self.font, TICK_SIZE);
        lines * LABEL_LINE + gap + widest + TICK + TICK_GAP
    }

    /// Returns ticks and label of the x axis, with as many ticks as fit, and the right edge of the
    /// first column. The edge is moved inwards if the last tick label would extend beyond `beyond`,
    /// which is the edge of the canvas for the last column.
    fn x_ticks(&self, left: f64, right: f64, beyond: f64) -> ((Ticks, String), f64) {
        let fitting = |right: f64| fitting(&self.chart.x, &self.x, right - left, self.font);
        let (wide, _) = fitting(right);
        let half = widest(&tick_labels(&wide), self.font, TICK_SIZE) / 2.0;
        let right = right.min(beyond - half - 4.0);
        (fitting(right), right)
    }

    fn x_axis(&self, ticks: Ticks, label: &str, room: f64) -> XAxis {
        let label = Label::parse(label);
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

    /// Returns the text above a panel: the common part of the tick labels, the panel's name, and
    /// the labels of marker lines.
    fn strip(&self, panel: &Panel, ticks: &Ticks, across: &Rect) -> Heading {
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
        Heading {
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
    /// Returns the height of ticks, tick labels and axis label below the last panel.
    pub(crate) fn height(&self) -> f64 {
        let common = if self.common_below { TICK_LINE } else { 0.0 };
        // The label's first line holds what is common to the tick labels.
        let lines = self
            .label
            .len()
            .max(usize::from(self.ticks.common.is_some()));
        let ticks = TICK + TICK_GAP + TICK_LINE;
        ticks + common + lines as f64 * LABEL_LINE + LABEL_GAP
    }
}

/// Returns as many ticks as fit along `length` px without touching labels, and the label of the
/// axis.
fn fitting(axis: &Axis, scale: &Scale, length: f64, font: &Font) -> (Ticks, String) {
    let mut most = most(length, 60.0);
    loop {
        let (candidate, label) = labelled(axis, scale, most);
        if most <= 2 || apart(&candidate, scale, length, font) {
            return (candidate, label);
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
