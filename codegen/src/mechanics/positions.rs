//! Positions of points of the links, what they change by with the angle, and the
//! velocity that comes of it.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::DerivedFrame;
use super::print::latex_name;
use crate::functions::LINK_PROPERTIES;
use crate::scene::{LinkId, Offset};

/// A point of a link, from the pivot of that link: x to the side, y upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativePosition {
    /// x, y.
    pub position: [Expr; 2],
    /// Their derivatives by the link's angle.
    pub lever: [Expr; 2],
    /// Their rates.
    pub velocity: [Expr; 2],
}

/// The points of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPositions {
    /// Pivot of the link, on the parent; none of the root.
    pub pivot: Option<RelativePosition>,
    /// Centre of mass of the link.
    pub centre: RelativePosition,
    /// End of the link.
    pub end: RelativePosition,
    /// The properties of the link, in the order of [`Link::properties`](crate::scene::Link).
    pub properties: [Expr; LINK_PROPERTIES.len()],
}

/// Letters and words of a kind of points.
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
    /// (x, y) of a point at these distances along and across a link, y against the direction
    /// of links of angle 0.
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

    /// A component along y of the equations, upwards; or one upwards, along that y.
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

    /// A point that `owner` names, on a link.
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
