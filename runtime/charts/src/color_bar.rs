//! The bar that explains the colours of a map.

use crate::axis::color_scale;
use crate::clip::Rect;
use crate::description::Chart;
use crate::drawing::{Anchor, Mark, Text};
use crate::error::ChartError;
use crate::font::Font;
use crate::label::{Label, widest};
use crate::scale::Scale;
use crate::sizes::{LABEL_GAP, LABEL_LINE, LABEL_SIZE, TICK, TICK_GAP, TICK_SIZE};
use crate::style::{Color, Fill, ramp};
use crate::ticks::{Ticks, most, tick_labels, ticks};

/// Width of the bar, and space between the panels and it, px.
const WIDTH: f64 = 16.0;
const GAP: f64 = 14.0;

/// Colours of a bar: as many as can be told from their neighbours.
pub(crate) const COLORS: usize = 64;

const FRAME: Color = Color::rgb(60, 60, 60);

/// The bar at the right of all panels.
pub(crate) struct ColorBar {
    scale: Scale,
    ticks: Ticks,
    label: Vec<Label>,
    /// Widest label of a tick.
    widest: f64,
}

impl ColorBar {
    /// The bar of panels that are `height` high together; none for a chart without
    /// shaded series.
    pub(crate) fn plan(
        chart: &Chart,
        font: &Font,
        height: f64,
    ) -> Result<Option<Self>, ChartError> {
        let Some(scale) = color_scale(chart)? else {
            return Ok(None);
        };
        let ticks = ticks(&scale, most(height, 42.0));
        let label = chart.colors.as_ref().map_or("", |axis| &axis.label);
        Ok(Some(Self {
            label: Label::parse(label).wrap(font, LABEL_SIZE, height),
            widest: widest(&tick_labels(&ticks), font, TICK_SIZE),
            scale,
            ticks,
        }))
    }

    /// Width that it takes from the panels.
    pub(crate) fn width(&self) -> f64 {
        let lines = self.label.len() as f64;
        let gap = if lines > 0.0 { LABEL_GAP } else { 0.0 };
        GAP + WIDTH + TICK + TICK_GAP + self.widest + gap + lines * LABEL_LINE
    }

    /// Colour of a value, the nearest one for those beyond the ends; none for what the
    /// scale does not have.
    pub(crate) fn class(&self, value: f64) -> Option<usize> {
        // Zero and less are below all that a logarithmic scale has.
        let beyond = if value <= 0.0 { 0.0 } else { f64::NAN };
        let place = self.scale.fraction(value).unwrap_or(beyond);
        let class = (place.clamp(0.0, 1.0) * COLORS as f64) as usize;
        (!place.is_nan()).then_some(class.min(COLORS - 1))
    }

    /// The bar beside panels that end at `frame`'s right edge, as high as it.
    pub(crate) fn draw(&self, frame: &Rect, marks: &mut Vec<Mark>) {
        let left = frame.right + GAP;
        let bar = Rect {
            left,
            right: left + WIDTH,
            ..*frame
        };
        draw_colors(&bar, marks);
        marks.push(self.frame_and_ticks(&bar));
        self.draw_texts(&bar, marks);
    }

    /// The frame of the bar, and its ticks.
    fn frame_and_ticks(&self, bar: &Rect) -> Mark {
        let mut lines = vec![vec![
            (bar.left, bar.top),
            (bar.right, bar.top),
            (bar.right, bar.bottom),
            (bar.left, bar.bottom),
            (bar.left, bar.top),
        ]];
        let major = self.ticks.major.iter().map(|tick| (tick.at, TICK));
        let minor = self.ticks.minor.iter().map(|at| (*at, 0.5 * TICK));
        for (at, length) in major.chain(minor) {
            let y = height_at(bar, self.scale.place(at));
            lines.push(vec![(bar.right, y), (bar.right + length, y)]);
        }
        Mark::Lines {
            lines,
            color: FRAME,
            width: 1.1,
            dash: crate::style::Dash::Solid,
        }
    }

    /// The labels of the ticks, what they have in common, and the label of the bar.
    fn draw_texts(&self, bar: &Rect, marks: &mut Vec<Mark>) {
        let text = |label: &Label, at, size, upwards| {
            Mark::Text(Text {
                label: label.clone(),
                at,
                anchor: if upwards {
                    Anchor::Middle
                } else {
                    Anchor::Start
                },
                size,
                upwards,
            })
        };
        let x = bar.right + TICK + TICK_GAP;
        for (tick, label) in self.ticks.major.iter().zip(tick_labels(&self.ticks)) {
            let y = height_at(bar, self.scale.place(tick.at)) + 0.5 * Font::CAP * TICK_SIZE;
            marks.push(text(&label, (x, y), TICK_SIZE, false));
        }
        if let Some(common) = &self.ticks.common {
            let at = (bar.left, bar.top - 8.0);
            marks.push(text(&Label::parse(common), at, TICK_SIZE, false));
        }
        let middle = (bar.top + bar.bottom) / 2.0;
        for (index, line) in self.label.iter().enumerate() {
            let baseline = x + self.widest + LABEL_GAP + (index as f64 + 0.75) * LABEL_LINE;
            marks.push(text(line, (baseline, middle), LABEL_SIZE, true));
        }
    }
}

/// Height of a place between the bottom of a bar, 0, and its top, 1.
fn height_at(bar: &Rect, place: f64) -> f64 {
    bar.bottom - place * bar.height()
}

fn draw_colors(bar: &Rect, marks: &mut Vec<Mark>) {
    for (index, color) in ramp(COLORS).into_iter().enumerate() {
        let at = |index: usize| height_at(bar, index as f64 / COLORS as f64);
        let cell = Rect {
            left: bar.left,
            right: bar.right,
            top: at(index + 1),
            bottom: at(index),
        };
        marks.push(Mark::Areas {
            polygons: vec![cell.corners()],
            color,
            fill: Fill::Crisp,
        });
    }
}
