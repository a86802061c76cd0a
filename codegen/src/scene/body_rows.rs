//! What energies, momentum and powers of a tree in loops are made of, where it is
//! driven or has lateral offsets.

use super::forces::value;
use super::link_constants::{half, product};
use super::offsets::is_lateral;
use super::places::has_places;
use super::{Link, Quantity, Scene};

/// The numbers of each body, in the order in which the runtime's `Bodies` takes
/// them, exact where no parameter is involved. SI units.
pub fn body_rows(scene: &Scene) -> Vec<[Quantity; 12]> {
    let links = scene.links.iter();
    links.map(|link| body_row(&scene.gravity, link)).collect()
}

/// Whether the energies of a scene in loops are those of bodies: a drive, an offset
/// or a place of its own asks for it.
pub fn has_bodies(scene: &Scene) -> bool {
    let beside = || scene.drive.is_some() || is_lateral(scene) || has_places(scene);
    scene.requests.energies && beside()
}

/// Whether `f64` can hold them all, where the code has them.
pub(super) fn bodies_fit(scene: &Scene) -> bool {
    !has_bodies(scene) || body_rows(scene).iter().flatten().all(Quantity::is_finite)
}

fn body_row(gravity: &Quantity, link: &Link) -> [Quantity; 12] {
    let (com, pivot) = (&link.com, &link.pivot);
    let moment = product([&link.mass, &com.along]);
    let lateral = product([&link.mass, &com.lateral]);
    let inertia = Quantity::sum([
        link.inertia.clone(),
        product([&moment, &com.along]),
        product([&lateral, &com.lateral]),
    ]);
    [
        half(&link.mass),
        moment.clone(),
        lateral.clone(),
        half(&inertia),
        pivot.along.clone(),
        pivot.lateral.clone(),
        product([gravity, &link.mass]),
        product([gravity, &moment]),
        product([gravity, &lateral]),
        half(&value(&link.spring)),
        value(&link.friction),
        value(&link.drag),
    ]
}
