//! Sums along the way from the root.

use branched_pendulum::system::{Model, Positions};
use branched_pendulum_trees::PendulumTree;

/// A number for each link, from that of the link that it hangs from and its pivot on it.
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
