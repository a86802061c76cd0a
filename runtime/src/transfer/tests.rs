use super::SymmetricTree;
use crate::sectors::{Sector, SectorCoordinate};
use alloc::borrow::ToOwned;
use alloc::vec;
use alloc::vec::Vec;

fn sector(links: &[usize]) -> Sector {
    let coordinate = |link: &usize| SectorCoordinate::new("theta".to_owned(), vec![(*link, 1.0)]);
    Sector::new(
        "in_phase".to_owned(),
        links.iter().map(coordinate).collect(),
    )
}

#[test]
fn trees_without_links_are_refused() {
    let all: [(&[Sector], &[Vec<usize>]); 5] = [
        (&[], &[]),
        (&[sector(&[])], &[]),
        (&[sector(&[0])], &[]),
        (&[sector(&[]), sector(&[])], &[]),
        (&[], &[vec![0]]),
    ];
    for (sectors, nodes) in all {
        let tree = SymmetricTree::<f64>::with_unequal_copies::<f64>(&[], 9.81, sectors, nodes);
        assert!(tree.is_none());
        assert!(SymmetricTree::<f64>::new::<f64>(&[], 9.81, sectors).is_none());
    }
}
