use std::fmt::Write;

use crate::drawing::{Anchor, Drawing, Mark, Point, Text};
use crate::label::{Label, Level};
use crate::style::{Color, Dash, Fill, Symbol, WHITE};

/// Font families: first DejaVu Sans, whose widths the layout uses; the others are as wide or
/// narrower. Kerning is off, since the layout ignores it.
const FAMILIES: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";

/// Returns the drawing as an SVG 1.1 document, with `unit` mm per px if given.
pub(crate) fn document(drawing: &Drawing, unit: Option<f64>) -> String {
    let size = (drawing.width, drawing.height);
    let mut out = opening(&drawing.title, size, unit, WHITE);
    for mark in &drawing.marks {
        push_mark(&mut out, mark);
    }
    out.push_str("</svg>\n");
    out
}

/// Returns the beginning of a document of this size (px, each of `unit` mm if given): title and
/// background.
pub(crate) fn opening(
    title: &str,
    (width, height): Point,
    unit: Option<f64>,
    background: Color,
) -> String {
    let side = |side: f64| match unit {
        Some(unit) => format!("{}mm", Px(side * unit)),
        None => Px(side).to_string(),
    };
    let (outer_width, outer_height) = (side(width), side(height));
    let (width, height) = (Px(width), Px(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{outer_width}\" \
         height=\"{outer_height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         font-family=\"{FAMILIES}\" style=\"font-kerning:none\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        escape(title),
        Hex(background),
    )
}

pub(crate) fn push_mark(out: &mut String, mark: &Mark) {
    match mark {
        Mark::Lines {
            lines,
            color,
            width,
            dash,
        } => push_lines(out, lines, *color, *width, *dash),
        Mark::Symbols {
            symbol,
            at,
            radius,
            color,
        } => push_symbols(out, *symbol, at, *radius, *color),
        Mark::Areas {
            polygons,
            color,
            fill,
        } => push_areas(out, polygons, *color, *fill),
        Mark::Text(text) => push_text(out, text),
    }
}

/// Appends formatted text to a string, which cannot fail.
macro_rules! put {
    ($out:expr, $($arg:tt)*) => {
        let _ = write!($out, $($arg)*);
    };
}

fn push_lines(out: &mut String, lines: &[Vec<Point>], color: Color, width: f64, dash: Dash) {
    if lines.is_empty() {
        return;
    }
    out.push_str("<path d=\"");
    for line in lines {
        push_points(out, line.iter().copied());
    }
    put!(
        out,
        "\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
        Hex(color),
        Px(width)
    );
    if !dash.pattern().is_empty() {
        let lengths: Vec<String> = dash.pattern().iter().map(f32::to_string).collect();
        put!(out, " stroke-dasharray=\"{}\"", lengths.join(" "));
    }
    out.push_str("/>\n");
}

fn push_symbols(out: &mut String, symbol: Symbol, at: &[Point], radius: f64, color: Color) {
    if at.is_empty() {
        return;
    }
    out.push_str("<path d=\"");
    for (x, y) in at {
        if symbol == Symbol::Circle {
            let (r, d) = (Px(radius), Px(2.0 * radius));
            put!(out, "M{} {}", Px(x - radius), Px(*y));
            put!(out, "a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z");
        } else {
            let corners = symbol.corners().iter();
            push_points(
                out,
                corners.map(|(dx, dy)| (x + dx * radius, y + dy * radius)),
            );
            out.push('z');
        }
    }
    put!(out, "\" fill=\"{}\"/>\n", Hex(color));
}

fn push_areas(out: &mut String, polygons: &[Vec<Point>], color: Color, fill: Fill) {
    if polygons.is_empty() {
        return;
    }
    out.push_str("<path d=\"");
    for polygon in polygons {
        push_points(out, polygon.iter().copied());
        out.push('z');
    }
    put!(out, "\" fill=\"{}\"", Hex(color));
    match fill {
        Fill::Sheer => {
            put!(out, " fill-opacity=\"{}\"/>\n", fill.opacity());
        }
        Fill::Crisp => out.push_str(" shape-rendering=\"crispEdges\"/>\n"),
    }
}

fn push_points(out: &mut String, points: impl Iterator<Item = Point>) {
    for (index, (x, y)) in points.enumerate() {
        let command = if index == 0 { "M" } else { " " };
        put!(out, "{command}{} {}", Px(x), Px(y));
    }
}

fn push_text(out: &mut String, text: &Text) {
    let (x, y) = (Px(text.at.0), Px(text.at.1));
    put!(out, "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\"", text.size);
    match text.anchor {
        Anchor::Start => {}
        Anchor::Middle => out.push_str(" text-anchor=\"middle\""),
        Anchor::End => out.push_str(" text-anchor=\"end\""),
    }
    if text.upwards {
        put!(out, " transform=\"rotate(-90 {x} {y})\"");
    }
    out.push('>');
    push_runs(out, &text.label, text.size);
    out.push_str("</text>\n");
}

/// Writes the runs of a label one after the other, shifted only vertically, so that they stay
/// together in any font.
fn push_runs(out: &mut String, label: &Label, size: f64) {
    if let [only] = label.runs.as_slice()
        && only.level == Level::Line
    {
        out.push_str(&escape(&only.text));
        return;
    }
    let mut drop = 0.0;
    for run in &label.runs {
        let shift = (run.level.drop() - drop) * size;
        drop = run.level.drop();
        let size = run.level.size() * size;
        put!(
            out,
            "<tspan dy=\"{}\" font-size=\"{}\">{}</tspan>",
            Px(shift),
            Px(size),
            escape(&run.text)
        );
    }
}

fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// A length with at most two decimals.
#[derive(Clone, Copy)]
pub(crate) struct Px(pub(crate) f64);

impl std::fmt::Display for Px {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Adding zero turns -0 into 0.
        write!(f, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

/// A colour, written as six hexadecimal digits.
pub(crate) struct Hex(pub(crate) Color);

impl std::fmt::Display for Hex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Color { red, green, blue } = self.0;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}
