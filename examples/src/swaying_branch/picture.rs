//! The branch as an animated picture: one SVG file that browsers play.

use std::fmt::Write;

use branched_pendulum::prelude::*;

use super::motion::Seen;
use super::scene::{Branch, HELD, LINKS};
use super::weather::{PULL, Weather};

/// Pixels in a metre, and the size of the picture.
const SCALE: f64 = 190.0;
const SIZE: (f64, f64) = (720.0, 560.0);

/// Where the branch stands, and where the wind is shown.
const FOOT: (f64, f64) = (360.0, 520.0);
const VANE: (f64, f64) = (40.0, 60.0);

/// Pictures in a second, between which browsers interpolate.
const RATE: f64 = 20.0;

/// Pixels of the wind's arrow for a metre a second.
const ARROW: f64 = 12.0;

/// Draws the branch. Each link is a group that turns about its pivot in the group of its
/// parent, so that lengths stay what they are between two pictures.
pub fn animated(branch: &Branch, seen: &Seen, weather: &Weather) -> String {
    let stride = (1.0 / (RATE * seen.frame)).round().max(1.0) as usize;
    let film = Film {
        branch,
        states: seen
            .states
            .iter()
            .step_by(stride)
            .map(Vec::as_slice)
            .collect(),
        interval: seen.frame * stride as f64,
    };
    let (width, height) = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\">\n\
         <title>A branch of {LINKS} links in the wind, pulled by a hand and let go</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#f4f7f9\"/>\n\
         <rect y=\"{y}\" width=\"{width}\" height=\"{rest}\" fill=\"#dfe5d8\"/>\n",
        y = FOOT.1,
        rest = height - FOOT.1,
    );
    film.wind(&mut svg, weather);
    push(
        &mut svg,
        format_args!(
            "<g transform=\"translate({} {})\" stroke-linecap=\"round\">\n",
            FOOT.0, FOOT.1
        ),
    );
    film.link(&mut svg, 0, 0);
    svg.push_str("</g>\n</svg>\n");
    svg
}

fn push(svg: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = svg.write_fmt(arguments);
}

/// The states that are drawn.
struct Film<'a> {
    branch: &'a Branch,
    states: Vec<&'a [f64]>,
    /// Time between two, s.
    interval: f64,
}

impl Film<'_> {
    /// Duration and repetition, as attributes.
    fn clock(&self) -> String {
        let duration = self.interval * self.states.len().saturating_sub(1) as f64;
        format!("dur=\"{duration:.3}s\" repeatCount=\"indefinite\"")
    }

    /// One value for each picture.
    fn values(&self, value: impl Fn(usize, &[f64]) -> f64) -> String {
        let values = self.states.iter().enumerate();
        let values = values.map(|(number, state)| format!("{:.1}", value(number, state)));
        values.collect::<Vec<_>>().join(";")
    }

    fn link(&self, svg: &mut String, link: usize, depth: usize) {
        let Some(properties) = self.branch.properties_of(link) else {
            return;
        };
        let parent = properties.parent;
        let angle = |state: &[f64]| {
            let bend = state[link] - parent.map_or(0.0, |parent| state[parent]);
            bend.to_degrees()
        };
        let length = SCALE * properties.length();
        // 14 px at the foot, and less at each branching.
        let thickness = 14.0 * 0.62_f64.powi(depth as i32);
        let first = self.states.first().map_or(0.0, |state| angle(state));
        push(
            svg,
            format_args!(
                "<g transform=\"rotate({first:.1})\"><animateTransform \
                 attributeName=\"transform\" type=\"rotate\" {} values=\"{}\"/>\n\
                 <line y2=\"{:.1}\" stroke=\"{}\" stroke-width=\"{thickness:.1}\"/>\n",
                self.clock(),
                self.values(|_, state| angle(state)),
                -length,
                ["#5b4636", "#66503d", "#735b45", "#7f664d", "#8b7256"][depth.min(4)],
            ),
        );
        if depth >= 3 {
            for (side, at) in [(1.0, 0.55), (-1.0, 0.8), (1.0, 1.0)] {
                push(
                    svg,
                    format_args!(
                        "<ellipse cx=\"{:.1}\" cy=\"{:.1}\" rx=\"7\" ry=\"3.4\" \
                         transform=\"rotate({} {:.1} {:.1})\" fill=\"#6f9a56\" \
                         fill-opacity=\"0.85\"/>\n",
                        6.0 * side,
                        -at * length,
                        -40.0 * side,
                        6.0 * side,
                        -at * length
                    ),
                );
            }
        }
        push(
            svg,
            format_args!("<g transform=\"translate(0 {:.1})\">\n", -length),
        );
        for child in self.branch.children(link) {
            self.link(svg, child, depth + 1);
        }
        if link == HELD {
            self.hand(svg);
        }
        svg.push_str("</g></g>\n");
    }

    /// A hand, while it holds the branch.
    fn hand(&self, svg: &mut String) {
        let holds = |number: usize| {
            let time = number as f64 * self.interval;
            f64::from(u8::from((PULL.0..PULL.1).contains(&time)))
        };
        push(
            svg,
            format_args!(
                "<circle r=\"11\" fill=\"#c8553d\" opacity=\"0\"><animate \
                 attributeName=\"opacity\" calcMode=\"discrete\" {} values=\"{}\"/></circle>\n",
                self.clock(),
                self.values(|number, _| holds(number))
            ),
        );
    }

    /// The wind as an arrow of its speed.
    fn wind(&self, svg: &mut String, weather: &Weather) {
        let (x, y) = VANE;
        let end = |number: usize| x + ARROW * weather.speed(number as f64 * self.interval);
        let moves = |attribute: &str, offset: f64| {
            format!(
                "<animate attributeName=\"{attribute}\" {} values=\"{}\"/>",
                self.clock(),
                self.values(|number, _| end(number) + offset)
            )
        };
        push(
            svg,
            format_args!(
                "<text x=\"{x}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"15\" \
                 fill=\"#34495e\">wind</text>\n\
                 <line x1=\"{x}\" y1=\"{y}\" x2=\"{:.1}\" y2=\"{y}\" stroke=\"#34495e\" \
                 stroke-width=\"4\" stroke-linecap=\"round\">{}</line>\n\
                 <circle cx=\"{:.1}\" cy=\"{y}\" r=\"6\" fill=\"#34495e\">{}</circle>\n",
                y - 16.0,
                end(0),
                moves("x2", 0.0),
                end(0),
                moves("cx", 0.0)
            ),
        );
    }
}
