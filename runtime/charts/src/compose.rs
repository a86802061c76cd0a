use crate::areas;
use crate::arrange::{PanelPlan, Plan};
use crate::beyond;
use crate::cells::Grid;
use crate::clip::{self, Rect};
use crate::decimate;
use crate::description::{Chart, Panel, Series};
use crate::drawing::{Anchor, Drawing, Mark, Point, Text};
use crate::error_bars;
use crate::font::Font;
use crate::guides;
use crate::label::Label;
use crate::legend::{self, Entry};
use crate::sizes::{
    EDGE, LABEL_GAP, LABEL_LINE, LABEL_SIZE, LEGEND_GAP, TICK, TICK_GAP, TICK_LINE, TICK_SIZE,
    TITLE_LINE, TITLE_SIZE,
};
use crate::style::{Color, Dash, Style, Symbol};
use crate::ticks::Ticks;

const GRID: Color = Color::rgb(228, 228, 228);
const GUIDE: Color = Color::rgb(90, 90, 90);
const FRAME: Color = Color::rgb(60, 60, 60);
pub(crate) const LINE_WIDTH: f64 = 1.8;

/// Returns the chart as marks, from back to front.
pub(crate) fn draw(chart: &Chart, plan: &Plan) -> Drawing {
    let mut marks = Vec::new();
    for (panel, place) in chart.panels.iter().zip(&plan.panels) {
        draw_grid(plan, place, &mut marks);
        let grid = Grid::of(panel, chart.x.log);
        let all = || panel.series.iter().zip(&place.styles);
        for (series, style) in all().filter(|(series, _)| series.cells) {
            match plan.colors.as_ref().zip(series.shades.as_ref()) {
                Some((colors, values)) => {
                    colors.cells(series, values, (&grid, plan, place), &mut marks);
                }
                None => areas::cells(series, *style, &grid, plan, place, &mut marks),
            }
        }
        draw_guides(panel, place, &mut marks);
        for (series, style) in all() {
            areas::band(series, *style, plan, place, &mut marks);
            error_bars::draw(series, *style, plan, place, &mut marks);
            draw_series(series, *style, plan, place, &mut marks);
        }
        beyond::draw(panel, plan, place, &mut marks);
        draw_axes(plan, place, &mut marks);
        draw_y_text(place, &mut marks);
        draw_name(place, &mut marks);
        if place.lowest {
            draw_x_text(plan, &place.frame, &mut marks);
        }
    }
    draw_colors(plan, &mut marks);
    draw_title(plan, &mut marks);
    draw_legend(plan, &mut marks);
    Drawing {
        width: plan.width,
        height: plan.height,
        title: Label::parse(&chart.title).plain(),
        marks,
    }
}

fn strokes(lines: Vec<Vec<Point>>, color: Color, width: f64) -> Mark {
    let dash = Dash::Solid;
    Mark::Lines {
        lines,
        color,
        width,
        dash,
    }
}

fn text(label: &Label, at: Point, anchor: Anchor, size: f64) -> Mark {
    Mark::Text(Text {
        label: label.clone(),
        at,
        anchor,
        size,
        upwards: false,
    })
}

fn across(plan: &Plan, frame: &Rect, coordinate: f64) -> f64 {
    frame.left + plan.x.scale.place(coordinate) * frame.width()
}

fn up(place: &PanelPlan, coordinate: f64) -> f64 {
    let frame = &place.frame;
    frame.bottom - place.scale.place(coordinate) * frame.height()
}

fn draw_grid(plan: &Plan, place: &PanelPlan, marks: &mut Vec<Mark>) {
    let frame = &place.frame;
    let verticals = plan.x.ticks.major.iter().map(|tick| {
        let x = across(plan, frame, tick.at);
        vec![(x, frame.top), (x, frame.bottom)]
    });
    let horizontals = place.ticks.major.iter().map(|tick| {
        let y = up(place, tick.at);
        vec![(frame.left, y), (frame.right, y)]
    });
    marks.push(strokes(verticals.chain(horizontals).collect(), GRID, 1.0));
}

/// Adds the marker lines with their labels, and the line at zero.
fn draw_guides(panel: &Panel, place: &PanelPlan, marks: &mut Vec<Mark>) {
    let frame = &place.frame;
    let zero = place.scale.fraction(0.0).filter(|_| panel.zero_line);
    if let Some(place) = zero.filter(|at| (0.0..=1.0).contains(at)) {
        let y = frame.bottom - place * frame.height();
        let line = vec![(frame.left, y), (frame.right, y)];
        marks.push(strokes(vec![line], GUIDE, 1.2));
    }
    let lines = place.strip.guides.iter();
    let lines = lines.map(|g| vec![(g.x, frame.top - 6.0), (g.x, frame.bottom)]);
    marks.push(Mark::Lines {
        lines: lines.collect(),
        color: GUIDE,
        width: 1.3,
        dash: Dash::Dashed,
    });
    for guide in &place.strip.guides {
        let count = guide.lines.len();
        for (index, line) in guide.lines.iter().enumerate() {
            let row = (guide.row + count - 1 - index) as f64;
            let at = (guide.text_x, frame.top - 11.0 - row * guides::LINE);
            marks.push(text(line, at, Anchor::Middle, guides::SIZE));
        }
    }
}

fn draw_series(
    series: &Series,
    style: Style,
    plan: &Plan,
    place: &PanelPlan,
    marks: &mut Vec<Mark>,
) {
    let frame = &place.frame;
    let point = |(x, y): (&f64, &f64)| -> Option<Point> {
        let x = plan.x.scale.fraction(*x)?;
        let y = place.scale.fraction(*y)?;
        Some((
            frame.left + x * frame.width(),
            frame.bottom - y * frame.height(),
        ))
    };
    let points = || series.x.iter().zip(&series.y).map(point);
    if let Some(dash) = style.dash {
        let lines = decimate::lines(points());
        let parts = lines.iter().flat_map(|line| clip::line(line, frame));
        let (dots, lines) = parts.partition::<Vec<_>, _>(|part| part.len() == 1);
        if style.symbol.is_none() && !dots.is_empty() {
            marks.push(Mark::Symbols {
                symbol: Symbol::Circle,
                at: dots.into_iter().flatten().collect(),
                radius: LINE_WIDTH,
                color: style.color,
            });
        }
        marks.push(Mark::Lines {
            lines,
            color: style.color,
            width: LINE_WIDTH,
            dash,
        });
    }
    if let Some(symbol) = style.symbol {
        let inside = points().flatten().filter(|p| frame.contains(*p));
        marks.push(Mark::Symbols {
            symbol,
            at: decimate::symbols(inside),
            radius: style.radius,
            color: style.color,
        });
    }
}

/// Adds frame and ticks. They are drawn over the data so that the edges are clean.
fn draw_axes(plan: &Plan, place: &PanelPlan, marks: &mut Vec<Mark>) {
    let frame = &place.frame;
    let mut lines = vec![
        vec![(frame.left, frame.top), (frame.left, frame.bottom)],
        vec![(frame.left, frame.bottom), (frame.right, frame.bottom)],
    ];
    let coordinates = |ticks: &Ticks| -> Vec<(f64, f64)> {
        let major = ticks.major.iter().map(|tick| (tick.at, TICK));
        let minor = ticks.minor.iter().map(|at| (*at, 0.5 * TICK));
        major.chain(minor).collect()
    };
    for (at, length) in coordinates(&plan.x.ticks) {
        let x = across(plan, frame, at);
        lines.push(vec![(x, frame.bottom), (x, frame.bottom + length)]);
    }
    for (at, length) in coordinates(&place.ticks) {
        let y = up(place, at);
        lines.push(vec![(frame.left - length, y), (frame.left, y)]);
    }
    marks.push(strokes(lines, FRAME, 1.1));
}

fn draw_y_text(place: &PanelPlan, marks: &mut Vec<Mark>) {
    let frame = &place.frame;
    let x = frame.left - TICK - TICK_GAP;
    for tick in &place.ticks.major {
        let y = up(place, tick.at) + 0.5 * Font::CAP * TICK_SIZE;
        let label = Label::parse(&tick.label);
        marks.push(text(&label, (x, y), Anchor::End, TICK_SIZE));
    }
    if let Some(common) = &place.ticks.common {
        let at = (frame.left, frame.top - 8.0);
        marks.push(text(&Label::parse(common), at, Anchor::Start, TICK_SIZE));
    }
    let middle = (frame.top + frame.bottom) / 2.0;
    for (index, line) in place.label.iter().enumerate() {
        let baseline = place.outer_left + (index as f64 + 0.75) * LABEL_LINE;
        marks.push(Mark::Text(Text {
            label: line.clone(),
            at: (baseline, middle),
            anchor: Anchor::Middle,
            size: LABEL_SIZE,
            upwards: true,
        }));
    }
}

/// Adds the name of a panel, above its left end.
fn draw_name(place: &PanelPlan, marks: &mut Vec<Mark>) {
    let (strip, frame) = (&place.strip, &place.frame);
    for (row, line) in strip.name.iter().rev().enumerate() {
        let baseline = frame.top - 8.0 - row as f64 * guides::LINE;
        let at = (frame.left + strip.indent, baseline);
        marks.push(text(line, at, Anchor::Start, guides::SIZE));
    }
}

fn draw_x_text(plan: &Plan, frame: &Rect, marks: &mut Vec<Mark>) {
    let mut y = frame.bottom + TICK + TICK_GAP + 0.75 * TICK_LINE;
    for tick in &plan.x.ticks.major {
        let at = (across(plan, frame, tick.at), y);
        let label = Label::parse(&tick.label);
        marks.push(text(&label, at, Anchor::Middle, TICK_SIZE));
    }
    if let Some(common) = &plan.x.ticks.common {
        // Beside the first line of the label, or above it.
        let below = if plan.x.common_below {
            TICK_LINE
        } else {
            LABEL_GAP + LABEL_LINE
        };
        let at = (frame.right, y + below);
        marks.push(text(&Label::parse(common), at, Anchor::End, TICK_SIZE));
    }
    if plan.x.common_below {
        y += TICK_LINE;
    }
    y += LABEL_LINE;
    y += LABEL_GAP;
    let middle = (frame.left + frame.right) / 2.0;
    for (index, line) in plan.x.label.iter().enumerate() {
        let at = (middle, y + index as f64 * LABEL_LINE);
        marks.push(text(line, at, Anchor::Middle, LABEL_SIZE));
    }
}

fn draw_title(plan: &Plan, marks: &mut Vec<Mark>) {
    for (index, line) in plan.title.iter().enumerate() {
        let y = EDGE + (index as f64 + 0.72) * TITLE_LINE;
        let at = (plan.width / 2.0, y);
        marks.push(text(line, at, Anchor::Middle, TITLE_SIZE));
    }
}

/// Adds the colour bar to the right of all panels, as high as they are.
fn draw_colors(plan: &Plan, marks: &mut Vec<Mark>) {
    let frames = || plan.panels.iter().map(|place| &place.frame);
    if let Some(colors) = &plan.colors {
        let frame = Rect {
            left: frames().map(|f| f.left).fold(f64::INFINITY, f64::min),
            right: frames().map(|f| f.right).fold(0.0, f64::max),
            top: frames().map(|f| f.top).fold(f64::INFINITY, f64::min),
            bottom: frames().map(|f| f.bottom).fold(0.0, f64::max),
        };
        colors.draw(&frame, marks);
    }
}

fn draw_legend(plan: &Plan, marks: &mut Vec<Mark>) {
    let legend = &plan.legend;
    if !legend.below {
        for (list, place) in legend.lists.iter().zip(&plan.panels) {
            let mut y = place.frame.top;
            let x = place.frame.right.max(plan.width - EDGE - legend.cell);
            for entry in list {
                draw_entry(entry, (x, y), marks);
                y += entry.height();
            }
        }
        return;
    }
    let rows = legend.rows(plan.width - 2.0 * EDGE);
    let columns = rows.first().map_or(0, |row| row.len()) as f64;
    let step = legend.cell + legend::COLUMN_GAP;
    let left = (plan.width - columns * step + legend::COLUMN_GAP) / 2.0;
    let bottom = plan.panels.last().map_or(0.0, |p| p.frame.bottom);
    let mut y = bottom + plan.x.height() + LEGEND_GAP;
    for row in rows {
        for (index, entry) in row.iter().enumerate() {
            draw_entry(entry, (left + index as f64 * step, y), marks);
        }
        y += legend::row_height(row);
    }
}

/// Adds an entry of the legend, the sample of the series and its label, with its top left corner at
/// `(x, y)`.
fn draw_entry(entry: &Entry, (x, y): Point, marks: &mut Vec<Mark>) {
    let middle = y + 0.5 * legend::LINE;
    let Style {
        color,
        dash,
        symbol,
        radius,
        fill,
    } = entry.style;
    if let Some(fill) = fill {
        marks.push(areas::sample((x, middle), color, fill));
    }
    if let Some(dash) = dash {
        marks.push(Mark::Lines {
            lines: vec![vec![(x, middle), (x + legend::SAMPLE, middle)]],
            color,
            width: LINE_WIDTH,
            dash,
        });
    }
    if let Some(symbol) = symbol {
        marks.push(Mark::Symbols {
            symbol,
            at: vec![(x + 0.5 * legend::SAMPLE, middle)],
            radius,
            color,
        });
    }
    for (index, line) in entry.lines.iter().enumerate() {
        let baseline = middle + 0.5 * Font::CAP * legend::SIZE;
        let at = (
            x + legend::SAMPLE + legend::GAP,
            baseline + index as f64 * legend::LINE,
        );
        marks.push(text(line, at, Anchor::Start, legend::SIZE));
    }
}
