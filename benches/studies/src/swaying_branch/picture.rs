//! The branch as an animated picture.

use branched_pendulum_charts::{ChartError, Color, Film};

use super::motion::Seen;
use super::scene::{Branch, HELD};
use super::weather::{PULL, Weather};
use branched_pendulum_frame::film::{angles, links};

/// Pictures per second of the film; browsers interpolate between them.
const RATE: f64 = 20.0;

/// Length (px) of the wind's arrow for a wind of 1 m/s, and position of its beginning relative to
/// the foot of the branch.
const ARROW: f64 = 12.0;
const VANE: (f64, f64) = (-320.0, -440.0);

/// Colours of the generations.
const BARK: [Color; 5] = [
    Color::rgb(91, 70, 54),
    Color::rgb(102, 80, 61),
    Color::rgb(115, 91, 69),
    Color::rgb(127, 102, 77),
    Color::rgb(139, 114, 86),
];

/// Draws the branch with leaves, the hand while it holds a bough, and the wind as an arrow whose
/// length shows its speed.
///
/// # Errors
/// [`ChartError`] if the film has no pictures.
pub fn film(branch: &Branch, seen: &Seen, weather: &Weather) -> Result<Film, ChartError> {
    let stride = (1.0 / (RATE * seen.frame)).round().max(1.0) as usize;
    let interval = seen.frame * stride as f64;
    let links = links(branch);
    let pictures: Vec<Vec<f64>> = seen
        .states
        .iter()
        .step_by(stride)
        .map(|s| angles(branch, &s[..links.len()]))
        .collect();
    let title = format!(
        "A branch of {} links in the wind, pulled by a hand and let go",
        links.len()
    );
    let mut film = Film::new(title, interval)
        .background(Color::rgb(244, 247, 249))
        .tree("", &links, &pictures)?;
    let scale = film.scale()?;
    let wind = wind(&film, |picture| weather.speed(picture as f64 * interval));
    film = film.behind(&wind);
    let mut depths: Vec<usize> = Vec::new();
    for (index, link) in links.iter().enumerate() {
        let depth = link.parent.map_or(0, |parent| depths[parent] + 1);
        depths.push(depth);
        // 14 px at the foot, and less at each branching.
        let width = 14.0 * 0.62_f64.powi(depth as i32);
        film = film.link(index, BARK[depth.min(BARK.len() - 1)], width);
        let length = scale * link.end[0];
        if depth >= 3 {
            film = film.attach(index, &leaves(length));
        }
        if index == HELD {
            let holds = |picture: usize| (PULL.0..PULL.1).contains(&(picture as f64 * interval));
            let hand = film.timed(|picture| f64::from(u8::from(holds(picture))));
            film = film.attach(
                index,
                &format!(
                    "<circle cy=\"{length:.1}\" r=\"11\" fill=\"#c8553d\" opacity=\"0\"><animate \
                     attributeName=\"opacity\" calcMode=\"discrete\" {hand}/></circle>\n"
                ),
            );
        }
    }
    Ok(film)
}

/// Returns the SVG of three leaves along a link of this length in px.
fn leaves(length: f64) -> String {
    let leaf = |(side, at): (f64, f64)| {
        let (x, y, turn) = (6.0 * side, at * length, 40.0 * side);
        format!(
            "<ellipse cx=\"{x}\" cy=\"{y:.1}\" rx=\"7\" ry=\"3.4\" \
             transform=\"rotate({turn} {x} {y:.1})\" fill=\"#6f9a56\" fill-opacity=\"0.85\"/>\n"
        )
    };
    [(1.0, 0.55), (-1.0, 0.8), (1.0, 1.0)].map(leaf).concat()
}

/// Returns the SVG of the ground, and of the wind as an arrow.
fn wind(film: &Film, speed: impl Fn(usize) -> f64) -> String {
    let (x, y) = VANE;
    let end = |picture: usize| x + ARROW * speed(picture);
    format!(
        "<rect x=\"-1000\" width=\"2000\" height=\"100\" fill=\"#dfe5d8\"/>\n\
         <text x=\"{x}\" y=\"{}\" font-size=\"15\" fill=\"#34495e\">wind</text>\n\
         <line x1=\"{x}\" y1=\"{y}\" x2=\"{first:.1}\" y2=\"{y}\" stroke=\"#34495e\" \
         stroke-width=\"4\" stroke-linecap=\"round\"><animate attributeName=\"x2\" {moves}/></line>\n\
         <circle cx=\"{first:.1}\" cy=\"{y}\" r=\"6\" fill=\"#34495e\"><animate \
         attributeName=\"cx\" {moves}/></circle>\n",
        y - 16.0,
        first = end(0),
        moves = film.timed(end),
    )
}
