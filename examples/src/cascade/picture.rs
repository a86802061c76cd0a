//! The tree in motion: one SVG file that browsers play.

use std::fmt::Write;

use super::scene::Shape;

/// Width and height of the picture, px.
const SIZE: f64 = 640.0;

/// Colours of the generations, the oldest first; younger ones have the last.
const COLORS: [&str; 8] = [
    "#1b3a4b", "#1f5f7a", "#2a8a86", "#4fa36b", "#93b048", "#d3a52f", "#dc7a2b", "#c8453a",
];

/// Draws states that follow each other by `interval` seconds. Each rod is a group that
/// turns about its pivot in the group of its parent, so that lengths stay what they are
/// between two states.
pub fn animated(shape: &Shape, states: &[Vec<f64>], interval: f64) -> String {
    let reach: f64 = (0..shape.generations).map(|g| shape.length(g)).sum();
    let film = Film {
        shape,
        states,
        scale: 0.47 * SIZE / reach,
        clock: format!(
            "dur=\"{:.3}s\" repeatCount=\"indefinite\"",
            interval * states.len().saturating_sub(1) as f64
        ),
    };
    let middle = 0.5 * SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\">\n\
         <title>{} rods, the root driven by a motor</title>\n\
         <rect width=\"{SIZE}\" height=\"{SIZE}\" fill=\"#ffffff\"/>\n\
         <g transform=\"translate({middle} {middle})\" stroke-linecap=\"round\">\n",
        shape.links()
    );
    film.link(&mut svg, 0, 0);
    svg.push_str("</g>\n<circle cx=\"320\" cy=\"320\" r=\"5\" fill=\"#000000\"/>\n</svg>\n");
    svg
}

struct Film<'a> {
    shape: &'a Shape,
    states: &'a [Vec<f64>],
    /// Pixels in a metre.
    scale: f64,
    /// Duration and repetition, as attributes.
    clock: String,
}

impl Film<'_> {
    /// Draws the rod `place` of a generation, and what hangs from it.
    fn link(&self, svg: &mut String, generation: usize, place: usize) {
        let link = self.shape.first(generation) + place;
        let parent = generation
            .checked_sub(1)
            .map(|above| self.shape.first(above) + place % self.shape.width(above));
        // Angles are counted from straight down towards the right, SVG's from right to down.
        let angle = |state: &Vec<f64>| {
            let bend = state[link] - parent.map_or(0.0, |parent| state[parent]);
            format!("{:.1}", -bend.to_degrees())
        };
        let angles: Vec<String> = self.states.iter().map(angle).collect();
        let length = self.scale * self.shape.length(generation);
        let width = (9.0 * 0.75_f64.powi(generation as i32)).max(1.0);
        let color = COLORS[generation.min(COLORS.len() - 1)];
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<g transform=\"rotate({})\"><animateTransform attributeName=\"transform\" \
             type=\"rotate\" {} values=\"{}\"/>\n<line y2=\"{length:.1}\" stroke=\"{color}\" \
             stroke-width=\"{width:.1}\"/>\n",
            angles.first().map_or("0", String::as_str),
            self.clock,
            angles.join(";")
        );
        if generation + 1 < self.shape.generations {
            let _ = writeln!(svg, "<g transform=\"translate(0 {length:.1})\">");
            for copy in 0..self.shape.branching {
                let child = copy * self.shape.width(generation) + place;
                self.link(svg, generation + 1, child);
            }
            svg.push_str("</g>");
        }
        svg.push_str("</g>\n");
    }
}
