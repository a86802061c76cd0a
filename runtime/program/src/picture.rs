//! Springs in the picture of a tree.

use branched_pendulum::Positions;
use branched_pendulum_charts::FilmPoint;
use branched_pendulum_trees::{LinePoint, PendulumTree};

/// Most springs that are drawn.
const MOST: usize = 200;

/// Returns the points between which springs are drawn: the ends of straight springs and, for
/// torsion springs, the middles of the two links.
pub fn springs(tree: &PendulumTree) -> Vec<[FilmPoint; 2]> {
    // Angles of trees that stand are counted from above.
    let side = if tree.stands() { -1.0 } else { 1.0 };
    let on_film = |point: LinePoint| match point {
        LinePoint::Link {
            link,
            at: [along, lateral],
        } => FilmPoint::Link {
            link,
            at: [along, side * lateral],
        },
        LinePoint::Ground(place) => FilmPoint::Ground(place),
    };
    let middle = |link: usize| {
        let [along, lateral] = tree.properties_of(link).map_or([0.0; 2], |own| own.end);
        FilmPoint::Link {
            link,
            at: [0.5 * along, 0.5 * side * lateral],
        }
    };
    let straight = tree.line_points().into_iter().map(|ends| ends.map(on_film));
    let torsional = tree
        .spring_dampers()
        .iter()
        .map(|own| own.links.map(middle));
    straight.chain(torsional).take(MOST).collect()
}
