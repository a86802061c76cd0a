use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::error::ChartError;

const DATA: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");

/// The embedded font: its metrics for the layout, its outlines for PNG, and its file for PDF.
pub(crate) struct Font {
    face: Face<'static>,
    units_per_em: f64,
}

impl Font {
    /// Height of capital letters above the baseline, in em.
    pub(crate) const CAP: f64 = 0.73;

    pub(crate) fn embedded() -> Result<Self, ChartError> {
        let face = Face::parse(DATA, 0).map_err(|_| ChartError::Font)?;
        let units_per_em = f64::from(face.units_per_em());
        Ok(Self { face, units_per_em })
    }

    /// Returns the width of a character, in em.
    pub(crate) fn advance(&self, character: char) -> f64 {
        let units = self.face.glyph_hor_advance(self.glyph(character));
        f64::from(units.unwrap_or(0)) / self.units_per_em
    }

    /// Draws the outlines of `text` to `sink`, beginning with the pen at `(x, y)` (px, y down).
    pub(crate) fn outline(&self, text: &str, pen: (f64, f64), size: f64, sink: &mut impl Outline) {
        for PlacedGlyph { id, origin, .. } in self.place(text, pen, size) {
            let mut pen = Pen {
                origin,
                scale: size / self.units_per_em,
                sink: &mut *sink,
            };
            // `None` stands for a glyph without outline, such as a space.
            let _ = self.face.outline_glyph(id, &mut pen);
        }
    }

    /// Returns the glyphs of `text` with their positions, beginning with the pen at `(x, y)` (px, y
    /// down).
    pub(crate) fn place(
        &self,
        text: &str,
        (mut x, y): (f64, f64),
        size: f64,
    ) -> impl Iterator<Item = PlacedGlyph> {
        let scale = size / self.units_per_em;
        let mut base: Option<(GlyphId, f64)> = None;
        text.chars().map(move |character| {
            let id = self.glyph(character);
            let origin = match base {
                Some((base, pen)) if is_combining(character) => {
                    let (dx, dy) = self.accent_shift(base, id);
                    (pen + dx * scale, y - dy * scale)
                }
                _ => (x, y),
            };
            if !is_combining(character) {
                base = Some((id, x));
            }
            let advance = self.advance(character) * size;
            x += advance;
            PlacedGlyph {
                id,
                origin,
                advance,
                next: x,
            }
        })
    }

    /// The file of the font.
    pub(crate) const fn data() -> &'static [u8] {
        DATA
    }

    /// Returns the index of the glyph of a character; 0 if the font does not contain it.
    pub(crate) fn index(&self, character: char) -> u16 {
        self.glyph(character).0
    }

    /// Returns the widths in em of all glyphs, in their order.
    pub(crate) fn advances(&self) -> impl Iterator<Item = f64> {
        let all = 0..self.face.number_of_glyphs();
        all.map(|glyph| {
            let units = self.face.glyph_hor_advance(GlyphId(glyph));
            f64::from(units.unwrap_or(0)) / self.units_per_em
        })
    }

    /// Returns the left, lower, right and upper bound of all glyphs, in em.
    pub(crate) fn bounds(&self) -> [f64; 4] {
        let all = self.face.global_bounding_box();
        [all.x_min, all.y_min, all.x_max, all.y_max]
            .map(|units| f64::from(units) / self.units_per_em)
    }

    /// Returns the shift (font units, relative to the pen before the base) that centres an accent
    /// over its base and lifts it above a tall one. Without it, the dot of a velocity would overlap
    /// the theta.
    fn accent_shift(&self, base: GlyphId, accent: GlyphId) -> (f64, f64) {
        let boxes = self
            .face
            .glyph_bounding_box(base)
            .zip(self.face.glyph_bounding_box(accent));
        let Some((base, accent)) = boxes else {
            return (0.0, 0.0);
        };
        let centre = |b: ttf_parser::Rect| f64::from(b.x_min + b.x_max) / 2.0;
        let clear = f64::from(base.y_max) + 0.06 * self.units_per_em;
        let lift = (clear - f64::from(accent.y_min)).max(0.0);
        (centre(base) - centre(accent), lift)
    }

    fn glyph(&self, character: char) -> GlyphId {
        self.face.glyph_index(character).unwrap_or_default()
    }
}

/// A glyph of a text.
pub(crate) struct PlacedGlyph {
    pub(crate) id: GlyphId,
    /// Position of the pen for the glyph, px, y down.
    pub(crate) origin: (f64, f64),
    /// Distance by which the glyph moves the pen, in px.
    pub(crate) advance: f64,
    /// Position of the pen after the glyph, in px.
    pub(crate) next: f64,
}

fn is_combining(character: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&character)
}

/// Receiver of glyph outlines, in px with y down.
pub(crate) trait Outline {
    fn move_to(&mut self, x: f32, y: f32);
    fn line_to(&mut self, x: f32, y: f32);
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32);
    fn cubic_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32);
    fn close(&mut self);
}

/// Converts font units with y up to px with y down.
struct Pen<'a, S> {
    origin: (f64, f64),
    scale: f64,
    sink: &'a mut S,
}

impl<S> Pen<'_, S> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (
            (self.origin.0 + f64::from(x) * self.scale) as f32,
            (self.origin.1 - f64::from(y) * self.scale) as f32,
        )
    }
}

impl<S: Outline> OutlineBuilder for Pen<'_, S> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.sink.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.sink.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (x1, y1) = self.at(x1, y1);
        let (x, y) = self.at(x, y);
        self.sink.quad_to(x1, y1, x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (x1, y1) = self.at(x1, y1);
        let (x2, y2) = self.at(x2, y2);
        let (x, y) = self.at(x, y);
        self.sink.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.sink.close();
    }
}
