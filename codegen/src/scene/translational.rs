//! Translational spring-dampers: straight springs, power-law forces and dampers between points of
//! links, and guys (the same between a link and the ground).

use std::collections::BTreeMap;

use super::link_pairs::{PairRun, SpringDamperEnds};
use super::{DescribedLinePotential, Layout, Link, LinkId, Offset, Quantity, Scene};

/// Potential energy as a function of the distance between two points, and a viscous damper along
/// the line between them.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedTranslationalSpringDamper {
    /// The clause in words, for messages, as in `between(a, b)`.
    pub what: String,
    /// End points of the line.
    pub ends: LineEnds,
    /// Terms of the line's potential energy.
    pub potentials: Vec<DescribedLinePotential>,
    /// Viscous friction coefficient c of the damper, in N s/m.
    pub friction: Quantity,
}

/// End points of a straight spring.
#[derive(Debug, Clone, PartialEq)]
pub enum LineEnds {
    /// Points on links: on two links, or on every two copies of a node that hang from the same
    /// link.
    Links(SpringDamperEnds, [Offset; 2]),
    /// A point of a link, and a fixed point (x, y) in m, measured from the root's pivot with y
    /// upwards.
    Guy(LinkId, Offset, [Quantity; 2]),
}

impl DescribedTranslationalSpringDamper {
    /// Returns the word for the forces in messages: "spring", or "repulsion" if there is no spring.
    pub fn noun(&self) -> &'static str {
        DescribedLinePotential::noun(&self.potentials)
    }

    /// Returns the forces with their clause, as in "straight spring `between(a, b)`".
    pub fn in_words(&self) -> String {
        let straight = match self.noun() {
            "spring" => "straight ",
            _ => "",
        };
        format!("{straight}{} `{}`", self.noun(), self.what)
    }

    /// Returns the components of the two end points.
    pub fn end_components(&self) -> [&Quantity; 4] {
        match &self.ends {
            LineEnds::Links(_, [first, second]) => {
                [&first.along, &first.lateral, &second.along, &second.lateral]
            }
            LineEnds::Guy(_, at, [x, y]) => [&at.along, &at.lateral, x, y],
        }
    }
}

/// The vector between two points, as a sum over the links that rotate it.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLine {
    /// Index of the spring in [`Scene::translational`].
    pub spring_damper: usize,
    /// Links that hold the end points: the first, and the second unless that end is on the ground.
    pub links: Vec<LinkId>,
    /// Vectors r_i in the frame of each link, in m. The line is d = d₀ + Σ R(θ_i) r_i, with the
    /// rotation R by the link's angle.
    pub arms: Vec<(LinkId, Offset)>,
    /// Constant part d₀ in m: the x component, and the component opposite to the direction of links
    /// of angle 0.
    pub offset: [Quantity; 2],
}

/// Lines of straight springs between consecutive links that have the same constants, numbered as in
/// [`PairRun`].
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLineRun {
    /// The first line of the run.
    pub first: SpringLine,
    /// Number of lines. In each line, all link indices are larger by one than in the line before.
    pub count: usize,
}

impl SpringLineRun {
    /// Returns all lines of the run.
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
    /// Returns true if no angle changes the length: fewer than two parts of the line rotate
    /// independently.
    pub fn is_rigid(&self) -> bool {
        let is_fixed = self.offset.iter().all(Quantity::is_zero);
        self.arms.len() < 1 + usize::from(is_fixed)
    }
}

/// Arms of a line, with the links that rotate them.
type Arms = Vec<(LinkId, Offset)>;

/// A link on the path from a point to the root.
struct Step<'s> {
    link: usize,
    /// The child through which the path comes; `None` for the link that holds the point.
    via: Option<usize>,
    /// The point of the link from which the path starts or at which that child hangs.
    offset: &'s Offset,
}

impl Scene {
    /// Returns the lines of all straight springs, with indices of links in the whole tree.
    pub fn lines(&self) -> Vec<SpringLine> {
        let runs = self.line_runs().into_iter();
        runs.flat_map(SpringLineRun::lines).collect()
    }

    /// Returns the lines of [`lines`](Self::lines) in runs. Copies of a rule share their pivot, so
    /// that a line between them has no arms of other links.
    pub fn line_runs(&self) -> Vec<SpringLineRun> {
        let mut runs = Vec::new();
        for (spring_damper, own) in self.translational.iter().enumerate() {
            match &own.ends {
                LineEnds::Links(ends, points) => {
                    let mut before: Option<([usize; 2], Arms)> = None;
                    for PairRun {
                        first: links,
                        count,
                    } in self.pair_runs(ends)
                    {
                        let repeated = before
                            .as_ref()
                            .and_then(|(others, arms)| self.same_arms(arms, *others, links));
                        let arms = repeated.unwrap_or_else(|| {
                            let [first, second] = [0, 1].map(|end| (links[end], &points[end]));
                            self.arms(first, Some(second))
                        });
                        let first = SpringLine {
                            spring_damper,
                            links: links.map(LinkId).to_vec(),
                            arms: arms.clone(),
                            offset: [Quantity::zero(), Quantity::zero()],
                        };
                        before = Some((links, arms));
                        runs.push(SpringLineRun { first, count });
                    }
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

    /// Returns the arms of a line between two `links` if they are those of a line between the same
    /// points of the two links `others`: if all four hang from the same place. `None` if they may
    /// differ.
    fn same_arms(&self, arms: &Arms, others: [usize; 2], links: [usize; 2]) -> Option<Arms> {
        let place = |link| {
            let (link, parent) = self.link_and_parent(link)?;
            Some((parent?, &link.pivot))
        };
        // Arms are in the order of their links.
        if (others[0] < others[1]) != (links[0] < links[1]) {
            return None;
        }
        let hung = place(others[0])?;
        let mut all = [others[1], links[0], links[1]].into_iter();
        if !all.all(|link| place(link) == Some(hung)) {
            return None;
        }
        let moved = arms.iter().map(|(LinkId(link), arm)| {
            let end = others.iter().position(|other| other == link)?;
            Some((LinkId(links[end]), arm.clone()))
        });
        moved.collect()
    }

    /// Returns a link of the whole tree and the index of its parent. Copy c under link i of a
    /// generation of n links has the number c n + i in the next generation.
    fn link_and_parent(&self, index: usize) -> Option<(&Link, Option<usize>)> {
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

    /// Returns the path from a point of a link to the root, as the links on it.
    fn path_to_root<'s>(&'s self, (link, at): (usize, &'s Offset)) -> Vec<Step<'s>> {
        let (mut next, mut via, mut offset) = (Some(link), None, at);
        let mut steps = Vec::new();
        while let Some(link) = next {
            steps.push(Step { link, via, offset });
            let Some((own, parent)) = self.link_and_parent(link) else {
                break;
            };
            (via, offset, next) = (Some(link), &own.pivot, parent);
        }
        steps
    }

    /// Returns the arms of the line from the first point to the second one, or to the ground: those
    /// on the second point's path to the root minus those on the first point's path. The common
    /// part of the paths cancels.
    fn arms(&self, first: (usize, &Offset), second: Option<(usize, &Offset)>) -> Arms {
        let mut ways = [
            self.path_to_root(first),
            second.map_or_else(Vec::new, |second| self.path_to_root(second)),
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
