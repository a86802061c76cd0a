//! Bands and cells as filled areas.

use crate::arrange::{PanelPlan, Plan};
use crate::cells::Grid;
use crate::clip::Rect;
use crate::description::Series;
use crate::drawing::{Mark, Point};
use crate::legend;
use crate::scale::{coordinate, drawable};
use crate::style::{Color, Fill, Style};

/// Adds the filled cells of a series, as far as they are in view, to `marks`.
pub(crate) fn cells(
    series: &Series,
    style: Style,
    grid: &Grid,
    plan: &Plan,
    place: &PanelPlan,
    marks: &mut Vec<Mark>,
) {
    let samples = series.x.iter().zip(&series.y);
    let shown = samples.filter_map(|(x, y)| cell((*x, *y), grid, plan, place));
    marks.push(Mark::Areas {
        polygons: shown.map(|cell| cell.corners()).collect(),
        color: style.color,
        fill: Fill::Crisp,
    });
}

/// Returns the rectangle of the cell about a sample, as far as it is in view.
pub(crate) fn cell(
    (x, y): (f64, f64),
    grid: &Grid,
    plan: &Plan,
    place: &PanelPlan,
) -> Option<Rect> {
    let frame = &place.frame;
    let across = |at: f64| {
        let x = frame.left + plan.x.scale.place(at) * frame.width();
        x.clamp(frame.left, frame.right)
    };
    let up = |at: f64| {
        let y = frame.bottom - place.scale.place(at) * frame.height();
        y.clamp(frame.top, frame.bottom)
    };
    let (x_log, y_log) = (plan.x.scale.log, place.scale.log);
    if !(drawable(x_log, x) && drawable(y_log, y)) {
        return None;
    }
    let (left, right) = grid.across(coordinate(x_log, x));
    let (low, high) = grid.up(coordinate(y_log, y));
    let cell = Rect {
        left: across(left),
        right: across(right),
        top: up(high),
        bottom: up(low),
    };
    (cell.left < cell.right && cell.top < cell.bottom).then_some(cell)
}

/// Adds the area of a band to `marks`, one polygon between two gaps; nothing for other series.
pub(crate) fn band(
    series: &Series,
    style: Style,
    plan: &Plan,
    place: &PanelPlan,
    marks: &mut Vec<Mark>,
) {
    let Some(low) = &series.low else { return };
    let frame = &place.frame;
    let point = |x: f64, y: f64| -> Option<Point> {
        let (x, y) = (plan.x.scale.fraction(x)?, place.scale.fraction(y)?);
        Some((
            frame.left + x.clamp(0.0, 1.0) * frame.width(),
            frame.bottom - y.clamp(0.0, 1.0) * frame.height(),
        ))
    };
    let mut polygons = Vec::new();
    let (mut upper, mut lower): (Vec<Point>, Vec<Point>) = Default::default();
    let mut close = |upper: &mut Vec<Point>, lower: &mut Vec<Point>| {
        let mut polygon = std::mem::take(upper);
        polygon.extend(std::mem::take(lower).into_iter().rev());
        if polygon.len() > 2 {
            polygons.push(polygon);
        }
    };
    for ((x, high), low) in series.x.iter().zip(&series.y).zip(low) {
        match point(*x, *high).zip(point(*x, *low)) {
            Some((high, low)) => {
                upper.push(high);
                lower.push(low);
            }
            None => close(&mut upper, &mut lower),
        }
    }
    close(&mut upper, &mut lower);
    marks.push(Mark::Areas {
        polygons,
        color: style.color,
        fill: Fill::Sheer,
    });
}

/// Returns the filled box that stands for the series in a legend; the middle of its left edge is at
/// `(x, middle)`.
pub(crate) fn sample((x, middle): Point, color: Color, fill: Fill) -> Mark {
    let (left, right) = (x + 0.2 * legend::SAMPLE, x + 0.8 * legend::SAMPLE);
    let cell = Rect {
        left,
        right,
        top: middle - 5.0,
        bottom: middle + 5.0,
    };
    Mark::Areas {
        polygons: vec![cell.corners()],
        color,
        fill,
    }
}
