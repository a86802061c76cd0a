//! End points of straight springs.

use branched_pendulum_codegen::scene::{LineEnds, LinkId, Offset, Quantity};

use crate::numbers::RepeatedValues;
use crate::tree::PendulumTree;

/// One of the two points between which a straight spring acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinePoint {
    /// A point of a link.
    Link {
        /// Index of the link.
        link: usize,
        /// Position of the point on the link, along it and across it, in m.
        at: [f64; 2],
    },
    /// A point that does not move: x, and y upwards, relative to the root's pivot, in m.
    Ground([f64; 2]),
}

impl PendulumTree<f64> {
    /// Returns the end points of the straight springs, one pair for each of
    /// [`translational_spring_dampers`](Self::translational_spring_dampers).
    pub fn line_points(&self) -> Vec<[LinePoint; 2]> {
        let scene = &self.description().scene;
        let values = RepeatedValues::new(self.described.values());
        let at = |quantity: &Quantity| values.value(quantity);
        let on = |own: &Offset| [at(&own.along), at(&own.lateral)];
        let lines = scene.lines().into_iter().filter_map(|line| {
            let own = scene.translational.get(line.spring_damper)?;
            let mut links = line.links.iter().map(|LinkId(link)| *link);
            let mut point = |own: &Offset| {
                let (link, at) = (links.next()?, on(own));
                Some(LinePoint::Link { link, at })
            };
            Some(match &own.ends {
                LineEnds::Links(_, [one, other]) => [point(one)?, point(other)?],
                LineEnds::Guy(_, own, peg) => {
                    [point(own)?, LinePoint::Ground(peg.each_ref().map(at))]
                }
            })
        });
        lines.collect()
    }
}
