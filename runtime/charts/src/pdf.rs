use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::drawing::{Drawing, Mark, Point, Text};
use crate::font::Font;
use crate::style::{Color, Dash, Fill, Symbol};

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Compression level, 0 to 10.
const EFFORT: u8 = 7;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
const SHEER: Ref = Ref::new(6);
const FONT: Ref = Ref::new(7);
const GLYPHS: Ref = Ref::new(8);
const DESCRIPTOR: Ref = Ref::new(9);
const FONT_FILE: Ref = Ref::new(10);
const CHARACTERS: Ref = Ref::new(11);

/// Names of resources on the page.
const FONT_NAME: Name<'_> = Name(b"F");
const SHEER_NAME: Name<'_> = Name(b"S");
const BASE_FONT: Name<'_> = Name(b"DejaVuSans");

/// Returns the drawing as a PDF document of one page, with `unit` mm per px. Text remains text,
/// since the font is embedded.
pub(crate) fn document(drawing: &Drawing, font: &Font, unit: f64) -> Vec<u8> {
    let scale = unit * POINTS;
    let [width, height] = [drawing.width, drawing.height].map(|side| (side * scale) as f32);
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.document_info(INFO).title(TextStr(&drawing.title));
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height));
    page.parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    resources.fonts().pair(FONT_NAME, FONT);
    resources.ext_g_states().pair(SHEER_NAME, SHEER);
    resources.finish();
    page.finish();
    let opacity = Fill::Sheer.opacity() as f32;
    pdf.ext_graphics(SHEER).non_stroking_alpha(opacity);

    let mut canvas = Canvas(Content::new());
    // From px, y down, to points, y up.
    let scale = scale as f32;
    canvas.0.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    for mark in &drawing.marks {
        canvas.mark(mark, font);
    }
    let content = compress_to_vec_zlib(canvas.0.finish().as_slice(), EFFORT);
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    embed(&mut pdf, font, drawing);
    pdf.finish()
}

/// Embeds the font in the file, with the characters of the glyphs that are drawn.
fn embed(pdf: &mut Pdf, font: &Font, drawing: &Drawing) {
    let info = SystemInfo {
        registry: Str(b"Adobe"),
        ordering: Str(b"Identity"),
        supplement: 0,
    };
    pdf.type0_font(FONT)
        .base_font(BASE_FONT)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(GLYPHS)
        .to_unicode(CHARACTERS);
    let mut glyphs = pdf.cid_font(GLYPHS);
    glyphs
        .subtype(CidFontType::Type2)
        .base_font(BASE_FONT)
        .system_info(info)
        .font_descriptor(DESCRIPTOR)
        .cid_to_gid_map_predefined(Name(b"Identity"));
    let widths = font.advances().map(|em| (1e3 * em) as f32);
    glyphs.widths().consecutive(0, widths);
    glyphs.finish();
    let [left, bottom, right, top] = font.bounds().map(|em| (1e3 * em) as f32);
    pdf.font_descriptor(DESCRIPTOR)
        .name(BASE_FONT)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(left, bottom, right, top))
        .italic_angle(0.0)
        .ascent(top)
        .descent(bottom)
        .cap_height((1e3 * Font::CAP) as f32)
        .stem_v(80.0)
        .font_file2(FONT_FILE);
    let data = Font::data();
    let file = compress_to_vec_zlib(data, EFFORT);
    pdf.stream(FONT_FILE, &file)
        .filter(Filter::FlateDecode)
        .pair(
            Name(b"Length1"),
            i32::try_from(data.len()).unwrap_or(i32::MAX),
        );
    let mut characters = UnicodeCmap::new(Name(b"Characters"), info);
    let mut seen = Vec::new();
    let texts = drawing.marks.iter().filter_map(|mark| match mark {
        Mark::Text(text) => Some(&text.label.runs),
        _ => None,
    });
    for character in texts.flatten().flat_map(|run| run.text.chars()) {
        let glyph = font.index(character);
        if !seen.contains(&glyph) {
            seen.push(glyph);
            characters.pair(glyph, character);
        }
    }
    pdf.stream(CHARACTERS, characters.finish().as_slice());
}

struct Canvas(Content);

impl Canvas {
    fn mark(&mut self, mark: &Mark, font: &Font) {
        match mark {
            Mark::Lines {
                lines,
                color,
                width,
                dash,
            } => self.lines(lines, *color, *width, *dash),
            Mark::Symbols {
                symbol,
                at,
                radius,
                color,
            } => self.symbols(*symbol, at, *radius, *color),
            Mark::Areas {
                polygons,
                color,
                fill,
            } => self.areas(polygons, *color, *fill),
            Mark::Text(text) => self.text(text, font),
        }
    }

    fn lines(&mut self, lines: &[Vec<Point>], color: Color, width: f64, dash: Dash) {
        if lines.is_empty() {
            return;
        }
        self.stroke_color(color);
        self.0
            .set_line_width(width as f32)
            .set_line_join(LineJoinStyle::RoundJoin)
            .set_dash_pattern(dash.pattern().iter().copied(), 0.0);
        for line in lines {
            self.polygon(line.iter().copied());
        }
        self.0.stroke();
    }

    fn symbols(&mut self, symbol: Symbol, at: &[Point], radius: f64, color: Color) {
        if at.is_empty() {
            return;
        }
        self.fill_color(color);
        for &(x, y) in at {
            if symbol == Symbol::Circle {
                self.circle((x, y), radius);
                continue;
            }
            let corners = symbol.corners().iter();
            self.polygon(corners.map(|(dx, dy)| (x + dx * radius, y + dy * radius)));
            self.0.close_path();
        }
        self.0.fill_nonzero();
    }

    fn areas(&mut self, polygons: &[Vec<Point>], color: Color, fill: Fill) {
        if polygons.is_empty() {
            return;
        }
        self.0.save_state();
        self.fill_color(color);
        if fill == Fill::Sheer {
            self.0.set_parameters(SHEER_NAME);
        }
        for polygon in polygons {
            self.polygon(polygon.iter().copied());
            self.0.close_path();
        }
        match fill {
            Fill::Sheer => self.0.fill_nonzero(),
            // A hairline over the edges: viewers smooth these, and white would show between
            // neighbours.
            Fill::Crisp => {
                self.stroke_color(color);
                self.0.set_line_width(0.3).set_dash_pattern([], 0.0);
                self.0.fill_nonzero_and_stroke()
            }
        };
        self.0.restore_state();
    }

    fn text(&mut self, text: &Text, font: &Font) {
        self.fill_color(Color::rgb(0, 0, 0));
        self.0.begin_text();
        let mut along = -text.label.width(font, text.size) * text.anchor.before();
        for run in &text.label.runs {
            let size = run.level.size() * text.size;
            let drop = run.level.drop() * text.size;
            self.0.set_font(FONT_NAME, size as f32);
            // Glyphs that follow each other are shown at once.
            let mut shown: Vec<u8> = Vec::new();
            let (mut start, mut next) = ((along, drop), along);
            for glyph in font.place(&run.text, (along, drop), size) {
                if glyph.origin != (next, drop) {
                    self.show(text, start, &shown);
                    shown.clear();
                }
                if shown.is_empty() {
                    start = glyph.origin;
                }
                shown.extend(glyph.id.0.to_be_bytes());
                next = glyph.origin.0 + glyph.advance;
                along = glyph.next;
            }
            self.show(text, start, &shown);
        }
        self.0.end_text();
    }

    /// Draws glyphs of a text, beginning at a position given by its distances along and below the
    /// text's baseline.
    fn show(&mut self, text: &Text, (along, below): Point, glyphs: &[u8]) {
        if glyphs.is_empty() {
            return;
        }
        let (x, y) = text.at;
        // Glyphs have y up.
        let matrix = match text.upwards {
            false => [1.0, 0.0, 0.0, -1.0, x + along, y + below],
            true => [0.0, -1.0, -1.0, 0.0, x + below, y - along],
        };
        self.0.set_text_matrix(matrix.map(|number| number as f32));
        self.0.show(Str(glyphs));
    }

    fn polygon(&mut self, points: impl Iterator<Item = Point>) {
        for (index, (x, y)) in points.enumerate() {
            let [x, y] = [x, y].map(rounded);
            match index {
                0 => self.0.move_to(x, y),
                _ => self.0.line_to(x, y),
            };
        }
    }

    fn circle(&mut self, (x, y): Point, radius: f64) {
        // Four cubics, each over a right angle.
        const HANDLE: f64 = 0.552_284_749_8;
        let at = |dx: f64, dy: f64| [x + dx * radius, y + dy * radius].map(rounded);
        let [a, b] = at(1.0, 0.0);
        self.0.move_to(a, b);
        for (c, s) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
            let [x1, y1] = at(c - s * HANDLE, s + c * HANDLE);
            let [x2, y2] = at(-s + c * HANDLE, c + s * HANDLE);
            let [x3, y3] = at(-s, c);
            self.0.cubic_to(x1, y1, x2, y2, x3, y3);
        }
        self.0.close_path();
    }

    fn fill_color(&mut self, color: Color) {
        let [red, green, blue] = parts(color);
        self.0.set_fill_rgb(red, green, blue);
    }

    fn stroke_color(&mut self, color: Color) {
        let [red, green, blue] = parts(color);
        self.0.set_stroke_rgb(red, green, blue);
    }
}

fn parts(Color { red, green, blue }: Color) -> [f32; 3] {
    [red, green, blue].map(|part| f32::from(part) / 255.0)
}

/// Rounds a length in px to two decimals, as in the SVG.
fn rounded(length: f64) -> f32 {
    ((length * 100.0).round() / 100.0) as f32
}
