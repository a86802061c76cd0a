//! Error bars of samples.

use crate::arrange::{PanelPlan, Plan};
use crate::compose::LINE_WIDTH;
use crate::description::Series;
use crate::drawing::{Mark, Point};
use crate::style::{Dash, Style};

/// Half the width of the caps at the ends of an error bar, in px.
const CAP: f64 = 4.0;

/// Draws the error bars of the samples in view, clipped at the ends of the axis.
pub(crate) fn draw(
    series: &Series,
    style: Style,
    plan: &Plan,
    place: &PanelPlan,
    marks: &mut Vec<Mark>,
) {
    let frame = &place.frame;
    let samples = series.x.iter().zip(&series.y);
    let bars = samples.zip(series.errors.iter().flatten());
    let mut lines: Vec<Vec<Point>> = Vec::new();
    for ((x, y), error) in bars {
        let Some(across) = plan.x.scale.fraction(*x) else {
            continue;
        };
        let is_seen = (0.0..=1.0).contains(&across) && error.is_finite() && y.is_finite();
        let x = frame.left + across * frame.width();
        // A logarithmic axis has nothing at zero and below: the bar goes on to its lower end.
        let up = |value: f64| place.scale.fraction(value).unwrap_or(f64::NEG_INFINITY);
        let (low, high) = (up(y - error), up(y + error));
        if !is_seen || high < 0.0 || low > 1.0 {
            continue;
        }
        let at = |part: f64| frame.bottom - part.clamp(0.0, 1.0) * frame.height();
        lines.push(vec![(x, at(low)), (x, at(high))]);
        for end in [low, high]
            .into_iter()
            .filter(|end| (0.0..=1.0).contains(end))
        {
            lines.push(vec![(x - CAP, at(end)), (x + CAP, at(end))]);
        }
    }
    if !lines.is_empty() {
        marks.push(Mark::Lines {
            lines,
            color: style.color,
            width: LINE_WIDTH,
            dash: Dash::Solid,
        });
    }
}
