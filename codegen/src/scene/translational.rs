//! Translational spring-dampers: straight springs, forces by a power of the distance and dampers
//! between points of links, and guys from a link to the ground.

use std::collections::BTreeMap;

use super::link_pairs::{PairRun, SpringDamperEnds};
use super::{DescribedLinePotential, Layout, Link, LinkId, Offset, Quantity, Scene};

/// What stores energy by the length of the line between two points, and a viscous damper along it.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedTranslationalSpringDamper {
    /// The clause in words, as in `between(a, b)`.
    pub what: String,
    /// The points.
    pub ends: LineEnds,
    /// Terms of the energy that the line stores.
    pub potentials: Vec<DescribedLinePotential>,
    /// Viscous friction c of the damper, N s/m.
    pub friction: Quantity,
}

/// The points between which a straight spring is.
#[derive(Debug, Clone, PartialEq)]
pub enum LineEnds {
    /// Points of links: of two, or of all copies of a node under one link, two by two.
    Links(SpringDamperEnds, [Offset; 2]),
    /// A point of a link, and a place x, y that does not move, from the root's pivot, y upwards.
    Guy(LinkId, Offset, [Quantity; 2]),
}

impl DescribedTranslationalSpringDamper {
    /// What acts along the line: a "spring", or a "repulsion" alone.
    pub fn noun(&self) -> &'static str {
        DescribedLinePotential::noun(&self.potentials)
    }

    /// The same with its clause, as in "straight spring `between(a, b)`".
    pub fn in_words(&self) -> String {
        let straight = match self.noun() {
            "spring" => "straight ",
            _ => "",
        };
        format!("{straight}{} `{}`", self.noun(), self.what)
    }

    /// Components of the points.
    pub fn places(&self) -> [&Quantity; 4] {
        match &self.ends {
            LineEnds::Links(_, [first, second]) => {
                [&first.along, &first.lateral, &second.along, &second.lateral]
            }
            LineEnds::Guy(_, at, [x, y]) => [&at.along, &at.lateral, x, y],
        }
    }
}

/// The line between two points, in the links that turn it.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLine {
    /// Index of the spring in [`Scene::translational`].
    pub spring_damper: usize,
    /// The links that the points are on: the first one, and the second one unless it is the
    /// ground.
    pub links: Vec<LinkId>,
    /// Arms r_i of the line d = d₀ + Σ R(θ_i) r_i.
    pub arms: Vec<(LinkId, Offset)>,
    /// d₀: x, and y against the direction of links of angle 0.
    pub offset: [Quantity; 2],
}

/// Lines of the same constants side by side, as [`PairRun`].
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLineRun {
    /// The first line.
    pub first: SpringLine,
    /// Number of lines, each with the links behind those of the one before.
    pub count: usize,
}

impl SpringLineRun {
    /// All lines.
    fn lines(self) -> impl Iterator<Item = SpringLine> {
        let Self { first, count } = self;
        (0..count).map(move |place| {
            let mut own = first.clone();
            let arms = own.arms.iter_mut().map(|(link, _)| link);
            for LinkId(link) in own.links.iter_mut().chain(arms) {
                *link += place;
            }
            own
        })
    }
}

impl SpringLine {
    /// Returns true if no angle changes the length: of less than two parts that turn by
    /// themselves.
    pub fn is_rigid(&self) -> bool {
        let is_fixed = self.offset.iter().all(Quantity::is_zero);
        self.arms.len() < 1 + usize::from(is_fixed)
    }
}

/// A link on the way from a point to the root.
struct Step<'s> {
    link: usize,
    /// The link below, whose pivot counts.
    via: Option<usize>,
    /// The point of the link where the way goes on.
    offset: &'s Offset,
}

impl Scene {
    /// The lines of all straight springs, whose links are those of the whole tree.
    pub fn lines(&self) -> Vec<SpringLine> {
        let runs = self.line_runs().into_iter();
        runs.flat_map(SpringLineRun::lines).collect()
    }

    /// The same in runs. Copies of a rule share their pivot: a line between them has no arms of
    /// other links.
    pub fn line_runs(&self) -> Vec<SpringLineRun> {
        let mut runs = Vec::new();
        for (spring_damper, own) in self.translational.iter().enumerate() {
            match &own.ends {
                LineEnds::Links(ends, [first, second]) => {
                    let pairs = self.pair_runs(ends).into_iter();
                    runs.extend(pairs.map(
                        |PairRun {
                             first: [a, b],
                             count,
                         }| SpringLineRun {
                            first: SpringLine {
                                spring_damper,
                                links: vec![LinkId(a), LinkId(b)],
                                arms: self.arms((a, first), Some((b, second))),
                                offset: [Quantity::zero(), Quantity::zero()],
                            },
                            count,
                        },
                    ));
                }
                LineEnds::Guy(LinkId(link), at, [x, y]) => runs.push(SpringLineRun {
                    first: SpringLine {
                        spring_damper,
                        links: vec![LinkId(*link)],
                        arms: self.arms((*link, at), None),
                        offset: [
                            x.clone(),
                            match self.stands() {
                                true => y.clone().negative(),
                                false => y.clone(),
                            },
                        ],
                    },
                    count: 1,
                }),
            }
        }
        runs
    }

    /// A link of the whole tree, and the index of its parent there. Copy c under link i of a
    /// generation of n links is number c n + i of the next one.
    fn place(&self, index: usize) -> Option<(&Link, Option<usize>)> {
        let Layout::Generations { branching, .. } = self.layout else {
            let link = self.links.get(index)?;
            return Some((link, link.parent.map(|LinkId(parent)| parent)));
        };
        let (mut start, mut above, mut count): (usize, Option<[usize; 2]>, usize) = (0, None, 1);
        for link in &self.links {
            if index < start.saturating_add(count) {
                let parent = above.map(|[first, count]| first + (index - start) % count);
                return Some((link, parent));
            }
            above = Some([start, count]);
            start = start.saturating_add(count);
            count = count.saturating_mul(branching);
        }
        None
    }

    /// The steps from a point of a link to the root.
    fn way<'s>(&'s self, (link, at): (usize, &'s Offset)) -> Vec<Step<'s>> {
        let (mut next, mut via, mut offset) = (Some(link), None, at);
        let mut steps = Vec::new();
        while let Some(link) = next {
            steps.push(Step { link, via, offset });
            let Some((own, parent)) = self.place(link) else {
                break;
            };
            (via, offset, next) = (Some(link), &own.pivot, parent);
        }
        steps
    }

    /// Arms of the line from the first point to the second one, or to the ground: those of the
    /// second one's way less those of the first one's, as far as the ways are two.
    fn arms(
        &self,
        first: (usize, &Offset),
        second: Option<(usize, &Offset)>,
    ) -> Vec<(LinkId, Offset)> {
        let mut ways = [
            self.way(first),
            second.map_or_else(Vec::new, |second| self.way(second)),
        ];
        while let [Some(a), Some(b)] = ways.each_ref().map(|way| way.last())
            && a.via.is_some()
            && (a.link, a.via) == (b.link, b.via)
        {
            ways.iter_mut().for_each(|way| {
                way.pop();
            });
        }
        let [first, second] = ways;
        let mut arms: BTreeMap<usize, [Option<&Offset>; 2]> = BTreeMap::new();
        for (side, way) in [first, second].into_iter().enumerate() {
            for Step { link, offset, .. } in way {
                arms.entry(link).or_default()[side] = Some(offset);
            }
        }
        let arms = arms.into_iter().map(|(link, [first, second])| {
            let component = |of: fn(&Offset) -> &Quantity| match (first.map(of), second.map(of)) {
                (Some(first), Some(second)) if first == second => Quantity::zero(),
                (first, second) => {
                    let first = first.map(|first| first.clone().negative());
                    Quantity::sum(second.cloned().into_iter().chain(first))
                }
            };
            let arm = Offset {
                along: component(|offset| &offset.along),
                lateral: component(|offset| &offset.lateral),
            };
            (LinkId(link), arm)
        });
        arms.filter(|(_, arm)| !(arm.along.is_zero() && arm.lateral.is_zero()))
            .collect()
    }
}
