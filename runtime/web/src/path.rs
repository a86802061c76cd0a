//! Sums along the path from the root.

use branched_pendulum::system::{Model, Positions};
use branched_pendulum_trees::PendulumTree;

/// Returns a value for each link; `next` computes it from the value of the parent and the position
/// of the link's pivot on the parent.
pub(crate) fn down_the_tree<T: Copy>(
    tree: &PendulumTree,
    root: T,
    next: impl Fn(T, [f64; 2]) -> T,
) -> Vec<T> {
    let mut numbers: Vec<T> = Vec::new();
    for link in 0..tree.links() {
        let own = tree.properties_of(link);
        let above = own.and_then(|own| Some((*numbers.get(own.parent?)?, own.pivot)));
        numbers.push(above.map_or(root, |(above, pivot)| next(above, pivot)));
    }
    numbers
}
