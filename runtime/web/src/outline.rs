//! Bodies as they are drawn.

use std::f64::consts::PI;

use branched_pendulum::system::{LinkProperties, Model, Positions};
use branched_pendulum_trees::PendulumTree;

use crate::path::down_the_tree;

/// Largest width of a body, relative to the reach of the tree and to the length of its link.
const WIDEST: f64 = 0.11;
const STOUTEST: f64 = 0.4;

/// Value of the inertia about the centre of mass, divided by m length², below which a link is drawn
/// as a point mass at the end of a massless rod.
const POINT: f64 = 1e-9;

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Returns the largest distance (m) from the root's pivot that the end of a link can have.
pub(crate) fn reach(tree: &PendulumTree) -> f64 {
    let pivots = down_the_tree(tree, 0.0, |above, pivot| above + length(pivot));
    let ends = pivots
        .iter()
        .enumerate()
        .filter_map(|(link, pivot)| Some(pivot + tree.properties_of(link)?.length()));
    ends.fold(0.0, f64::max)
}

/// Returns the width (m) of each link and the radius (m) of the disc at its centre of mass; one of
/// them is zero. A description has masses but no widths: all bodies are drawn as plates of one
/// thickness, chosen so that no body is wider than a given fraction of the tree's reach and of its
/// link's length.
pub(crate) fn widths_and_radii(tree: &PendulumTree) -> Vec<[f64; 2]> {
    let widest = WIDEST * reach(tree);
    // Areas of a sheet of 1 kg/m², by whose number widths grow, and radii by its root.
    let mut area = f64::INFINITY;
    let links = (0..tree.links()).filter_map(|link| tree.properties_of(link));
    let cut = links.map(|link| {
        let centre = length(link.centre);
        if is_point(&link, centre) {
            let radius = (link.mass / PI).sqrt();
            area = area.min((0.5 * widest / radius).powi(2));
            return [0.0, radius];
        }
        let long = link.length().max(centre);
        let width = link.mass / long;
        area = area.min(widest.min(STOUTEST * long) / width);
        [width, 0.0]
    });
    let cut: Vec<[f64; 2]> = cut.collect();
    // A link without mass has no width, at any area.
    let area = if area.is_finite() { area } else { 0.0 };
    let scaled = cut.iter();
    scaled
        .map(|[width, radius]| [area * width, area.sqrt() * radius])
        .collect()
}

fn is_point(link: &LinkProperties<f64>, centre: f64) -> bool {
    centre > 0.0 && link.inertia <= POINT * link.mass * centre * centre
}
