//! Conversion of a model's links to those of a film, whose angles are measured from the downward
//! vertical.

use std::f64::consts::PI;

use branched_pendulum::Positions;
use branched_pendulum_charts::FilmLink;

/// Returns the links of a model for a film, each from its pivot to its end.
pub fn links<P: Positions<f64>>(model: &P) -> Vec<FilmLink> {
    let links = (0..).map_while(|link| model.properties_of(link));
    let across = if model.stands() { -1.0 } else { 1.0 };
    let place = |[along, lateral]: [f64; 2]| [along, across * lateral];
    links
        .map(|link| FilmLink {
            parent: link.parent,
            pivot: place(link.pivot),
            end: place(link.end),
        })
        .collect()
}

/// Returns the angles of a model measured from the downward vertical, in rad.
pub fn angles<P: Positions<f64>>(model: &P, theta: &[f64]) -> Vec<f64> {
    let theta = theta.iter();
    match model.stands() {
        true => theta.map(|angle| PI - angle).collect(),
        false => theta.copied().collect(),
    }
}
