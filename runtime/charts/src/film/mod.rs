//! Trees in motion.

mod layout;
mod still;

pub use still::FilmPoint;

use std::fmt::Write;

use crate::drawing::{Anchor, Drawing, Mark, Text};
use crate::error::ChartError;
use crate::font::Font;
use crate::label::Label;
use crate::style::{Color, Dash, Symbol, automatic};
use crate::{png, svg};
use layout::Layout;

/// A link of a [`Film`]. Positions on the link have two components in m: along the link and across
/// it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmLink {
    /// Index of the link from which this one hangs, which must be an earlier one; `None` for a
    /// root.
    pub parent: Option<usize>,
    /// Position of the link's pivot on its parent, relative to the parent's pivot.
    pub pivot: [f64; 2],
    /// Position of the link's end, relative to its pivot.
    pub end: [f64; 2],
}

/// Trees in motion side by side, as one SVG file that browsers play without a script, or
/// as an animated PNG.
///
/// Links are given once, and then an angle for each link and picture, in rad from the
/// downward vertical. All trees have the scale in which all of them fit at all times.
/// In the SVG a link turns about its pivot in the frame of its parent, so that lengths stay
/// what they are between two pictures.
///
/// ```
/// use branched_pendulum_charts::{ChartError, Film, FilmLink};
///
/// # fn main() -> Result<(), ChartError> {
/// let upper = FilmLink { parent: None, pivot: [0.0; 2], end: [0.3, 0.0] };
/// let lower = FilmLink { parent: Some(0), pivot: [0.3, 0.0], end: [0.2, 0.0] };
/// let pictures = [[0.5, 0.0], [0.4, 0.1], [0.2, 0.3]];
/// let film = Film::new("Two links", 0.05).tree("θ_1(0) = 0.5", &[upper, lower], &pictures)?;
/// assert!(film.to_svg()?.contains("animateTransform"));
/// assert!(film.to_png()?.starts_with(b"\x89PNG"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Film {
    title: String,
    interval: f64,
    columns: usize,
    width: f64,
    background: Color,
    trees: Vec<Tree>,
}

#[derive(Clone, Debug)]
struct Tree {
    label: String,
    /// SVG drawn behind the tree, with the root's pivot at (0, 0) and y downwards, in px.
    behind: String,
    links: Vec<FilmLink>,
    looks: Vec<LinkStyle>,
    /// Names of the links, written next to them. Links beyond the last name are not named.
    names: Vec<String>,
    /// Points between which dashed lines are drawn.
    ties: Vec<[FilmPoint; 2]>,
    pictures: Vec<Vec<f64>>,
}

/// How a link is drawn.
#[derive(Clone, Debug)]
struct LinkStyle {
    color: Color,
    /// Thickness, px.
    width: f64,
    /// SVG attached to the link, with its pivot at (0, 0) and its direction downwards, in px.
    attached: String,
}

/// Size of the labels, px.
const TEXT_SIZE: f64 = 13.0;

/// Thickness of the root in px, and ratio of the thickness of a link to that of its parent.
const ROOT_WIDTH: f64 = 7.0;
const THINNER: f64 = 0.8;

/// Largest number of pictures of an animated PNG, each of which is a compressed image.
const MOST_PNG_PICTURES: usize = 600;

impl Film {
    /// Creates a film without trees; `interval` is the time (s) between two pictures.
    pub fn new(title: impl Into<String>, interval: f64) -> Self {
        Self {
            title: title.into(),
            interval,
            columns: 3,
            width: 720.0,
            background: Color::rgb(255, 255, 255),
            trees: Vec::new(),
        }
    }

    /// Adds a tree. Each picture contains one angle for each of its links.
    ///
    /// # Errors
    /// [`ChartError::Link`] if a link does not hang from an earlier one or a position is not
    /// finite, [`ChartError::Picture`] if the number of angles of a picture is wrong or an angle is
    /// not finite.
    pub fn tree<P: AsRef<[f64]>>(
        mut self,
        label: impl Into<String>,
        links: &[FilmLink],
        pictures: &[P],
    ) -> Result<Self, ChartError> {
        let mut looks: Vec<LinkStyle> = Vec::new();
        let mut depths: Vec<usize> = Vec::new();
        for (index, link) in links.iter().enumerate() {
            let finite = link.pivot.iter().chain(&link.end).all(|x| x.is_finite());
            if !finite || link.parent.is_some_and(|parent| parent >= index) {
                return Err(ChartError::Link { link: index });
            }
            let depth = link.parent.map_or(0, |parent| depths[parent] + 1);
            depths.push(depth);
            looks.push(LinkStyle {
                color: automatic(depth).0,
                width: (ROOT_WIDTH * THINNER.powf(depth as f64)).max(1.0),
                attached: String::new(),
            });
        }
        let pictures: Vec<Vec<f64>> = pictures.iter().map(|p| p.as_ref().to_vec()).collect();
        let wrong = |picture: &Vec<f64>| {
            picture.len() != links.len() || picture.iter().any(|angle| !angle.is_finite())
        };
        if let Some(number) = pictures.iter().position(wrong) {
            return Err(ChartError::Picture {
                picture: number,
                found: pictures[number].len(),
                links: links.len(),
            });
        }
        self.trees.push(Tree {
            label: label.into(),
            behind: String::new(),
            links: links.to_vec(),
            looks,
            names: Vec::new(),
            ties: Vec::new(),
            pictures,
        });
        Ok(self)
    }

    /// Sets the width (px) and the number of trees in a row; by default 720 and 3.
    #[must_use]
    pub fn size(mut self, width: f64, columns: usize) -> Self {
        (self.width, self.columns) = (width, columns.max(1));
        self
    }

    /// Sets the colour behind the trees, by default white.
    #[must_use]
    pub fn background(mut self, color: Color) -> Self {
        self.background = color;
        self
    }

    /// Sets colour and thickness (px) of a link of the last tree; the default depends on its
    /// generation. An index without a link is ignored.
    #[must_use]
    pub fn link(mut self, link: usize, color: Color, width: f64) -> Self {
        let looks = self
            .trees
            .last_mut()
            .and_then(|tree| tree.looks.get_mut(link));
        if let Some(look) = looks {
            (look.color, look.width) = (color, width);
        }
        self
    }

    /// Draws SVG behind the last tree, with the root's pivot at (0, 0) and y downwards, in px. It
    /// is left out of an animated PNG.
    #[must_use]
    pub fn behind(mut self, svg: &str) -> Self {
        if let Some(tree) = self.trees.last_mut() {
            tree.behind.push_str(svg);
        }
        self
    }

    /// Attaches SVG to a link of the last tree, so that it moves with the link: the link's pivot is
    /// at (0, 0) and the link points downwards, in px. [`scale`](Self::scale) returns the number of
    /// px per metre. It is left out of an animated PNG.
    #[must_use]
    pub fn attach(mut self, link: usize, svg: &str) -> Self {
        let looks = self
            .trees
            .last_mut()
            .and_then(|tree| tree.looks.get_mut(link));
        if let Some(look) = looks {
            look.attached.push_str(svg);
        }
        self
    }

    /// Returns the attributes of an SVG animation that takes one value per picture.
    pub fn timed(&self, value: impl Fn(usize) -> f64) -> String {
        let count = self.pictures();
        let duration = self.interval * count.saturating_sub(1) as f64;
        let values: Vec<String> = (0..count)
            .map(|number| svg::Px(value(number)).to_string())
            .collect();
        let values = values.join(";");
        format!("dur=\"{duration:.3}s\" repeatCount=\"indefinite\" values=\"{values}\"")
    }

    /// Returns the number of pixels per metre.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg).
    pub fn scale(&self) -> Result<f64, ChartError> {
        Ok(self.layout()?.scale)
    }

    /// Returns the number of pictures of the tree that has the fewest.
    fn pictures(&self) -> usize {
        let counts = self.trees.iter().map(|tree| tree.pictures.len());
        counts.min().unwrap_or(0)
    }

    /// Renders the film as an SVG document.
    ///
    /// # Errors
    /// [`ChartError::Empty`] without trees, links or pictures, [`ChartError::Size`] if the
    /// width is not usable.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        let layout = self.layout()?;
        let mut out = svg::opening(
            &self.title,
            (layout.width, layout.height),
            None,
            self.background,
        );
        for ((tree, root), marks) in self
            .trees
            .iter()
            .zip(&layout.roots)
            .zip(self.labels(&layout))
        {
            svg::push_mark(&mut out, &marks);
            if self.pictures() == 1 {
                for mark in tree.still_marks(&layout, *root, 0) {
                    svg::push_mark(&mut out, &mark);
                }
            }
            put(
                &mut out,
                format_args!(
                    "<g transform=\"translate({} {})\">\n{}<g stroke-linecap=\"round\">\n",
                    svg::Px(root.0),
                    svg::Px(root.1),
                    tree.behind,
                ),
            );
            let roots = (0..tree.links.len()).filter(|&link| tree.links[link].parent.is_none());
            for link in roots {
                self.push_link(&mut out, tree, link, layout.scale);
            }
            out.push_str("</g></g>\n");
        }
        out.push_str("</svg>\n");
        Ok(out)
    }

    /// Writes a link and, in its coordinate frame, the links that hang from it.
    fn push_link(&self, out: &mut String, tree: &Tree, index: usize, scale: f64) {
        let (link, look) = (tree.links[index], &tree.looks[index]);
        // Positive angles turn the end to the right, which in SVG is against the clock.
        let turn = |picture: usize| {
            let angles = &tree.pictures[picture];
            -(angles[index] - link.parent.map_or(0.0, |parent| angles[parent])).to_degrees()
        };
        let at = |[along, across]: [f64; 2]| (svg::Px(scale * across), svg::Px(scale * along));
        let (pivot, end) = (at(link.pivot), at(link.end));
        put(
            out,
            format_args!(
                "<g transform=\"translate({} {})\"><g transform=\"rotate({})\">\
                 <animateTransform attributeName=\"transform\" type=\"rotate\" {}/>\n\
                 <line x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n{}",
                pivot.0,
                pivot.1,
                svg::Px(turn(0)),
                self.timed(turn),
                end.0,
                end.1,
                svg::Hex(look.color),
                svg::Px(look.width),
                look.attached,
            ),
        );
        let children =
            (index + 1..tree.links.len()).filter(|&child| tree.links[child].parent == Some(index));
        for child in children {
            self.push_link(out, tree, child, scale);
        }
        out.push_str("</g></g>\n");
    }

    /// Renders the film as the bytes of an animated PNG with at most 600 pictures. Of longer films,
    /// only every second picture, every third picture and so on is included.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg), and [`ChartError::Font`] and [`ChartError::Encode`].
    pub fn to_png(&self) -> Result<Vec<u8>, ChartError> {
        let (font, layout) = (Font::embedded()?, self.layout()?);
        let stride = self.pictures().div_ceil(MOST_PNG_PICTURES);
        let drawings = (0..self.pictures())
            .step_by(stride)
            .map(|picture| self.drawing(&layout, picture));
        let interval = self.interval * stride as f64;
        png::encode_film(drawings, &font, self.background, interval)
    }

    fn drawing(&self, layout: &Layout, picture: usize) -> Drawing {
        let mut marks = self.labels(layout);
        for (tree, root) in self.trees.iter().zip(&layout.roots) {
            let place = |[x, y]: [f64; 2]| (root.0 + layout.scale * x, root.1 + layout.scale * y);
            for (ends, look) in tree.segments(picture).iter().zip(&tree.looks) {
                let [from, to] = ends.map(place);
                marks.push(Mark::Lines {
                    lines: vec![vec![from, to]],
                    color: look.color,
                    width: look.width,
                    dash: Dash::Solid,
                });
                marks.push(Mark::Symbols {
                    symbol: Symbol::Circle,
                    at: vec![from, to],
                    radius: look.width / 2.0,
                    color: look.color,
                });
            }
            marks.extend(tree.still_marks(layout, *root, picture));
        }
        Drawing {
            width: layout.width,
            height: layout.height,
            title: Label::parse(&self.title).plain(),
            marks,
        }
    }

    fn labels(&self, layout: &Layout) -> Vec<Mark> {
        let labels = self.trees.iter().zip(&layout.labels);
        labels
            .map(|(tree, &at)| {
                Mark::Text(Text {
                    label: Label::parse(&tree.label),
                    at,
                    anchor: Anchor::Middle,
                    size: TEXT_SIZE,
                    upwards: false,
                })
            })
            .collect()
    }
}

fn put(out: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = out.write_fmt(arguments);
}
