//! The colour bar that explains the colours of a map.

use crate::axis::color_scale;
use crate::clip::Rect;
use crate::description::{Axis, Chart};
use crate::drawing::{Anchor, Mark, Text};
use crate::error::ChartError;
use crate::font::Font;
use crate::label::{Label, widest};
use crate::scale::Scale;
use crate::sizes::{LABEL_GAP, LABEL_LINE, LABEL_SIZE, TICK, TICK_GAP, TICK_SIZE};
use crate::style::{Color, Fill, ramp};
use crate::ticks::{Ticks, labelled, most, tick_labels};

/// Width of the bar, and gap between the panels and the bar, in px.
const WIDTH: f64 = 16.0;
const GAP: f64 = 14.0;

/// Number of colours of a bar, chosen so that neighbours differ visibly.
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
    /// Plans the bar for panels with a total height of `height`; `None` for a chart without a
    /// shaded series.
    pub(crate) fn plan(
        chart: &Chart,
        font: &Font,
        height: f64,
    ) -> Result<Option<Self>, ChartError> {
        let Some(scale) = color_scale(chart)? else {
            return Ok(None);
        };
        let nameless = Axis::linear("");
        let axis = chart.colors.as_ref().unwrap_or(&nameless);
        let (ticks, label) = labelled(axis, &scale, most(height, 42.0));
        Ok(Some(Self {
            label: Label::parse(&label).wrap(font, LABEL_SIZE, height),
            widest: widest(&tick_labels(&ticks), font, TICK_SIZE),
            scale,
            ticks,
        }))
    }

    /// Returns the width that the bar takes from the panels.
    pub(crate) fn width(&self) -> f64 {
        let lines = self.label.len() as f64;
        let gap = if lines > 0.0 { LABEL_GAP } else { 0.0 };
        GAP + WIDTH + TICK + TICK_GAP + self.widest + gap + lines * LABEL_LINE
    }

    /// Returns the index of the colour of a value. Values beyond the ends have the colour of the
    /// nearest end; `None` if the value cannot be shown on the scale.
    pub(crate) fn class(&self, value: f64) -> Option<usize> {
        // Zero and less are below all that a logarithmic scale has.
        let beyond = if value <= 0.0 { 0.0 } else { f64::NAN };
        let place = self.scale.fraction(value).unwrap_or(beyond);
        let class = (place.clamp(0.0, 1.0) * COLORS as f64) as usize;
        (!place.is_nan()).then_some(class.min(COLORS - 1))
    }

    /// Draws the bar to the right of `frame`, which encloses the panels, and as high as it.
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

    /// Returns the frame of the bar with its ticks.
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

    /// Adds the labels of the ticks, their common part, and the label of the bar.
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

/// Returns the height on the canvas of a position between the bottom (0) and the top (1) of a bar.
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
