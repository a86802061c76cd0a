//! Positions of points of the links, their derivatives by the angle, and their velocities.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::DerivedFrame;
use super::print::latex_name;
use crate::functions::LINK_PROPERTIES;
use crate::scene::{LinkId, Offset};

/// A point of a link relative to the pivot of that link: x to the side and y upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativePosition {
    /// Coordinates (x, y), in m.
    pub position: [Expr; 2],
    /// Derivatives of (x, y) with respect to the link's angle, in m.
    pub lever: [Expr; 2],
    /// Velocity of the point relative to the pivot, in m/s.
    pub velocity: [Expr; 2],
}

/// Points of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPositions {
    /// Pivot of the link, on its parent; `None` for the root.
    pub pivot: Option<RelativePosition>,
    /// Centre of mass of the link.
    pub centre: RelativePosition,
    /// End of the link.
    pub end: RelativePosition,
    /// Properties of the link, in the order of [`Link::properties`](crate::scene::Link).
    pub properties: [Expr; LINK_PROPERTIES.len()],
}

/// Letters and words for one kind of points.
struct Letters {
    code: &'static str,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
}

const PIVOT: Letters = Letters {
    code: "pivot",
    text: "ℓ",
    latex: "\\ell",
    meaning: "the pivot",
};
const CENTRE: Letters = Letters {
    code: "centre",
    text: "r",
    latex: "r",
    meaning: "the centre of mass",
};
const END: Letters = Letters {
    code: "end",
    text: "λ",
    latex: "\\lambda",
    meaning: "the end",
};

impl Derivation<'_> {
    /// Returns (x, y) of a point at the given distances along and across a link; y points against
    /// the direction of links of angle 0.
    pub(super) fn point_at(
        &self,
        along: &Formula,
        across: &Formula,
        angle: SymbolId,
    ) -> [Formula; 2] {
        let cos = Formula::symbol(self.cos(angle));
        let sin = Formula::symbol(self.sin(angle));
        [
            &(along * &sin) + &(across * &cos),
            &(across * &sin) - &(along * &cos),
        ]
    }

    /// Converts a component between the y axis of the equations and the upward direction, in either
    /// direction.
    pub(super) fn upwards(&self, component: Formula) -> Formula {
        match self.scene.stands() {
            true => -component,
            false => component,
        }
    }

    pub(super) fn positions(&mut self, frame: &DerivedFrame) -> Vec<LinkPositions> {
        let links = 0..self.scene.links.len();
        let positions = links.map(|index| {
            let link = &self.scene.links[index];
            let centre = self.position(CENTRE, index, &link.com, index, frame);
            LinkPositions {
                pivot: link
                    .parent
                    .map(|LinkId(parent)| self.position(PIVOT, index, &link.pivot, parent, frame)),
                end: match link.end == link.com {
                    true => centre.clone(),
                    false => self.position(END, index, &link.end, index, frame),
                },
                centre,
                properties: link
                    .properties()
                    .map(|quantity| self.quantity(quantity).cancelled(&self.symbols)),
            }
        });
        positions.collect()
    }

    /// Derives the position of a point on a link; `owner` names the point.
    fn position(
        &mut self,
        letters: Letters,
        owner: usize,
        offset: &Offset,
        link: usize,
        frame: &DerivedFrame,
    ) -> RelativePosition {
        let (orbit, angle) = (self.orbit_name(owner), frame.coordinates[link]);
        let carrier = self.orbit_name(link);
        let Letters {
            code,
            text,
            latex,
            meaning,
        } = letters;
        let mut constant = |way: &str, mark: &str, tex: &str, value| {
            let value = self.quantity(value);
            self.constant(
                &format!("{way}_{code}_{orbit}"),
                &format!("{text}{mark}_{orbit}"),
                &format!("{latex}{tex}_{{\\mathrm{{{}}}}}", latex_name(&orbit)),
                &format!("place of {meaning} of `{orbit}`, {way} `{carrier}`"),
                "m",
                value,
            )
        };
        let along = constant("along", "", "", &offset.along);
        let across = constant("across", "⊥", "^{\\perp}", &offset.lateral);
        let [x, y] = self.point_at(&along, &across, angle);
        let position = [x, self.upwards(y)];
        let lever = position.each_ref().map(|value| self.partial(value, angle));
        let omega = Formula::symbol(frame.velocities[link]);
        let velocity = lever.each_ref().map(|slope| (slope * &omega).expand());
        let plain = |formulas: [Formula; 2]| formulas.map(|formula| self.expr(&formula));
        RelativePosition {
            position: plain(position),
            lever: plain(lever),
            velocity: plain(velocity),
        }
    }
}
