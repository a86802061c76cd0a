//! Links of a model as those of a film.

use branched_pendulum::Positions;
use branched_pendulum_charts::FilmLink;

/// The links of a model, from pivot to end.
pub fn links<P: Positions<f64>>(model: &P) -> Vec<FilmLink> {
    let links = (0..).map_while(|link| model.properties_of(link));
    links
        .map(|link| FilmLink {
            parent: link.parent,
            pivot: link.pivot,
            end: link.end,
        })
        .collect()
}
