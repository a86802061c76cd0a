//! Marks on the edges of a panel, at which lines leave the range of its y axis.

use crate::arrange::{PanelPlan, Plan};
use crate::compose::LINE_WIDTH;
use crate::description::{Panel, Series};
use crate::drawing::{Mark, Point};
use crate::style::{Dash, Symbol};

/// Distance of the first mark from the edge, and distance between the marks of two series, in px.
const INSET: f64 = 5.0;
const STEP: f64 = 7.0;

/// Radius of the triangle in the middle of a mark, in px.
const RADIUS: f64 = 3.2;

/// Adds marks for the series of a panel that mark their samples outside the range.
pub(crate) fn draw(panel: &Panel, plan: &Plan, place: &PanelPlan, marks: &mut Vec<Mark>) {
    let all = panel.series.iter().zip(&place.styles);
    let asking = all.filter(|(series, _)| series.marks_beyond).enumerate();
    for (rank, (series, style)) in asking {
        let frame = &place.frame;
        // Many series share rows rather than cover the panel.
        let rows = ((0.25 * frame.height() / STEP) as usize).max(1);
        let inset = INSET + STEP * (rank % rows) as f64;
        let edges = [
            (Side::Heading, frame.top + inset, Symbol::Triangle),
            (Side::Below, frame.bottom - inset, Symbol::TriangleDown),
        ];
        for (side, y, symbol) in edges {
            let stretches = stretches(series, side, plan, place);
            if stretches.is_empty() {
                continue;
            }
            let middle = |[from, to]: &[f64; 2]| -> Point { (0.5 * (from + to), y) };
            marks.push(Mark::Symbols {
                symbol,
                at: stretches.iter().map(middle).collect(),
                radius: RADIUS,
                color: style.color,
            });
            let lines = stretches
                .iter()
                .map(|[from, to]| vec![(*from, y), (*to, y)]);
            marks.push(Mark::Lines {
                lines: lines.collect(),
                color: style.color,
                width: LINE_WIDTH,
                dash: Dash::Solid,
            });
        }
    }
}

/// The side of a range on which a value lies.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Heading,
    Below,
}

/// Returns the first and the last x position (px) of each run of samples on that side of the range.
fn stretches(series: &Series, side: Side, plan: &Plan, place: &PanelPlan) -> Vec<[f64; 2]> {
    let frame = &place.frame;
    let side_of = |y: f64| match place.scale.fraction(y) {
        Some(part) if part > 1.0 => Some(Side::Heading),
        Some(part) if part < 0.0 => Some(Side::Below),
        None if y == f64::INFINITY => Some(Side::Heading),
        Some(_) | None => None,
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut goes_on = false;
    for (x, y) in series.x.iter().zip(&series.y) {
        let across = plan.x.scale.fraction(*x);
        let across = across.filter(|part| (0.0..=1.0).contains(part));
        let at = across.filter(|_| side_of(*y) == Some(side));
        let at = at.map(|part| frame.left + part * frame.width());
        match (at, found.last_mut().filter(|_| goes_on)) {
            (Some(at), Some(run)) => run[1] = at,
            (Some(at), None) => found.push([at, at]),
            (None, _) => {}
        }
        goes_on = at.is_some();
    }
    found
}
