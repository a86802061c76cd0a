use tiny_skia::{
    FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

use crate::drawing::{Drawing, LARGEST_SIDE, Mark, Point, Text};
use crate::error::ChartError;
use crate::font::{Font, Outline};
use crate::style::{Color, Dash, Fill, Symbol, WHITE};

const BLACK: Color = Color::rgb(0, 0, 0);

/// Returns the drawing as a PNG of `scale` pixels per px; a px has `unit` mm.
pub(crate) fn encode(
    drawing: &Drawing,
    font: &Font,
    scale: f64,
    unit: f64,
) -> Result<Vec<u8>, ChartError> {
    let failed = |source: png::EncodingError| ChartError::Encode(Box::new(source));
    let image = raster(drawing, font, scale, WHITE)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width(), image.height());
    encoder.set_color(png::ColorType::Rgba);
    let metre = (1e3 * scale / unit).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: metre,
        yppu: metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(failed)?;
    // The background is opaque, and so is what lies on it: colours are as they stand.
    writer.write_image_data(image.data()).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Returns drawings of one size as an animated PNG, which shows each for `interval` seconds.
pub(crate) fn encode_film(
    drawings: impl ExactSizeIterator<Item = Drawing>,
    font: &Font,
    background: Color,
    interval: f64,
) -> Result<Vec<u8>, ChartError> {
    let failed = |source: png::EncodingError| ChartError::Encode(Box::new(source));
    let count = u32::try_from(drawings.len()).unwrap_or(u32::MAX);
    let mut images = drawings.map(|drawing| raster(&drawing, font, 1.0, background));
    let first = images.next().ok_or(ChartError::Empty { panel: None })??;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, first.width(), first.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_animated(count, 0).map_err(failed)?;
    let milliseconds = (1e3 * interval).round().clamp(1.0, f64::from(u16::MAX));
    let delay = encoder.set_frame_delay(milliseconds as u16, 1000);
    delay.map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for image in core::iter::once(Ok(first)).chain(images) {
        // The background is opaque, and so is what lies on it.
        let image = image?;
        let pixels = image.data().chunks_exact(4);
        let colors: Vec<u8> = pixels.flat_map(|pixel| pixel[..3].to_vec()).collect();
        writer.write_image_data(&colors).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn raster(
    drawing: &Drawing,
    font: &Font,
    scale: f64,
    background: Color,
) -> Result<Pixmap, ChartError> {
    let error = || ChartError::Size {
        width: drawing.width,
        height: drawing.height,
        scale,
    };
    let pixels = |side: f64| {
        let side = (side * scale).round();
        ((1.0..=LARGEST_SIDE).contains(&side)).then_some(side as u32)
    };
    let width = pixels(drawing.width).ok_or_else(error)?;
    let height = pixels(drawing.height).ok_or_else(error)?;
    let mut pixmap = Pixmap::new(width, height).ok_or_else(error)?;
    let Color { red, green, blue } = background;
    pixmap.fill(tiny_skia::Color::from_rgba8(red, green, blue, 255));
    let mut canvas = Canvas {
        pixmap,
        view: Transform::from_scale(scale as f32, scale as f32),
    };
    for mark in &drawing.marks {
        match mark {
            Mark::Lines {
                lines,
                color,
                width,
                dash,
            } => canvas.lines(lines, *color, *width, *dash),
            Mark::Symbols {
                symbol,
                at,
                radius,
                color,
            } => canvas.symbols(*symbol, at, *radius, *color),
            Mark::Areas {
                polygons,
                color,
                fill,
            } => canvas.areas(polygons, *color, *fill),
            Mark::Text(text) => canvas.text(text, font),
        }
    }
    Ok(canvas.pixmap)
}

struct Canvas {
    pixmap: Pixmap,
    view: Transform,
}

impl Canvas {
    fn lines(&mut self, lines: &[Vec<Point>], color: Color, width: f64, dash: Dash) {
        let mut path = PathBuilder::new();
        for line in lines {
            push_polygon(&mut path, line.iter().copied());
        }
        let stroke = Stroke {
            width: width as f32,
            line_join: LineJoin::Round,
            dash: StrokeDash::new(dash.pattern().to_vec(), 0.0),
            ..Stroke::default()
        };
        // There is no path where there is no line.
        if let Some(path) = path.finish() {
            let paint = paint(color);
            self.pixmap
                .stroke_path(&path, &paint, &stroke, self.view, None);
        }
    }

    fn symbols(&mut self, symbol: Symbol, at: &[Point], radius: f64, color: Color) {
        let mut path = PathBuilder::new();
        for (x, y) in at {
            if symbol == Symbol::Circle {
                path.push_circle(*x as f32, *y as f32, radius as f32);
                continue;
            }
            let corners = symbol.corners().iter();
            push_polygon(
                &mut path,
                corners.map(|(dx, dy)| (x + dx * radius, y + dy * radius)),
            );
            path.close();
        }
        if let Some(path) = path.finish() {
            self.fill(&path, color, self.view);
        }
    }

    fn areas(&mut self, polygons: &[Vec<Point>], color: Color, fill: Fill) {
        let mut path = PathBuilder::new();
        for polygon in polygons {
            push_polygon(&mut path, polygon.iter().copied());
            path.close();
        }
        let mut paint = paint(color);
        let alpha = (255.0 * fill.opacity()).round() as u8;
        paint.set_color_rgba8(color.red, color.green, color.blue, alpha);
        paint.anti_alias = fill == Fill::Sheer;
        if let Some(path) = path.finish() {
            self.pixmap
                .fill_path(&path, &paint, FillRule::Winding, self.view, None);
        }
    }

    fn text(&mut self, text: &Text, font: &Font) {
        let mut sink = Sink(PathBuilder::new());
        let mut x = -text.label.width(font, text.size) * text.anchor.before();
        for run in &text.label.runs {
            let size = run.level.size() * text.size;
            let pen = (x, run.level.drop() * text.size);
            font.outline(&run.text, pen, size, &mut sink);
            x += run
                .text
                .chars()
                .map(|c| font.advance(c) * size)
                .sum::<f64>();
        }
        let turn = Transform::from_rotate(if text.upwards { -90.0 } else { 0.0 });
        let (x, y) = (text.at.0 as f32, text.at.1 as f32);
        let view = self.view.pre_translate(x, y).pre_concat(turn);
        // There is no path where all glyphs are blank.
        if let Some(path) = sink.0.finish() {
            self.fill(&path, BLACK, view);
        }
    }

    fn fill(&mut self, path: &Path, color: Color, view: Transform) {
        let paint = paint(color);
        self.pixmap
            .fill_path(path, &paint, FillRule::Winding, view, None);
    }
}

fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color.red, color.green, color.blue, 255);
    paint.anti_alias = true;
    paint
}

fn push_polygon(path: &mut PathBuilder, points: impl Iterator<Item = Point>) {
    for (index, (x, y)) in points.enumerate() {
        let (x, y) = (x as f32, y as f32);
        if index == 0 {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
}

/// Glyph outlines as a path.
struct Sink(PathBuilder);

impl Outline for Sink {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }
    fn cubic_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.0.close();
    }
}
