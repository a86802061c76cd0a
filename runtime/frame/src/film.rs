//! Links of a model as those of a film, whose angles are from the downward vertical.

use std::f64::consts::PI;

use branched_pendulum::Positions;
use branched_pendulum_charts::FilmLink;

/// The links of a model, from pivot to end.
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

/// The angles of a model from the downward vertical.
pub fn angles<P: Positions<f64>>(model: &P, theta: &[f64]) -> Vec<f64> {
    let theta = theta.iter();
    match model.stands() {
        true => theta.map(|angle| PI - angle).collect(),
        false => theta.copied().collect(),
    }
}
