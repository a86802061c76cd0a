//! Constants of links as numbers: the quantities of a description for given parameters, in about
//! 106 bits, so that results computed from them are rounded only once.

use std::cell::RefCell;

use branched_pendulum::ParameterError;
use branched_pendulum::emitted::{
    LinkBody, free_link, require_downward, require_finite, require_magnitude, require_non_negative,
    require_positive, require_upward,
};
use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum_codegen::scene::{
    self, FrictionContact, Layout, Link, LinkId, Magnitudes, NEGLIGIBLE, Offset, PairRun,
    PassiveTorques, Quantity, QuantityAtom, RationalExpression, Scene, Sign,
};

use crate::error::TreeError;

/// Constants of a link, in SI units. Points are given by their components along the link and across
/// it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LinkNumbers<S = Double> {
    pub(crate) parent: Option<usize>,
    pub(crate) mass: S,
    pub(crate) inertia: S,
    pub(crate) com: [S; 2],
    pub(crate) pivot: [S; 2],
    pub(crate) end: [S; 2],
    pub(crate) passive: PassiveTorques<S>,
}

impl<S> LinkNumbers<S> {
    /// Converts all numbers with `convert`.
    pub(crate) fn map<R>(self, convert: impl Fn(S) -> R) -> LinkNumbers<R>
    where
        S: Copy,
    {
        LinkNumbers {
            parent: self.parent,
            mass: convert(self.mass),
            inertia: convert(self.inertia),
            com: self.com.map(&convert),
            pivot: self.pivot.map(&convert),
            end: self.end.map(&convert),
            passive: self.passive.map(|own| convert(*own)),
        }
    }
}

/// The value of a quantity.
pub(crate) fn value<S: Scalar>(quantity: &Quantity, parameters: &[S]) -> S {
    evaluate(quantity, &|atom| match atom {
        QuantityAtom::Exact(exact) => {
            let (high, low) = exact.to_parts();
            S::from_parts(high, low)
        }
        QuantityAtom::Parameter(id) => match parameters.get(id.0) {
            Some(&value) => value,
            None => S::from_f64(f64::NAN),
        },
    })
}

/// Evaluates quantities of which many are equal, as those of springs between copies are: the last
/// different ones are computed only once.
pub(crate) struct RepeatedValues<'p, S> {
    parameters: &'p [S],
    known: RefCell<Vec<(Quantity, S)>>,
}

impl<'p, S: Scalar> RepeatedValues<'p, S> {
    /// Number of quantities whose values are kept.
    const KEPT: usize = 8;

    /// Creates an evaluator for these values of the parameters.
    pub(crate) fn new(parameters: &'p [S]) -> Self {
        let known = RefCell::default();
        Self { parameters, known }
    }

    /// Returns the value of a quantity.
    pub(crate) fn value(&self, quantity: &Quantity) -> S {
        let mut known = self.known.borrow_mut();
        if let Some((_, value)) = known.iter().find(|(own, _)| own == quantity) {
            return *value;
        }
        let value = value(quantity, self.parameters);
        if known.len() == Self::KEPT {
            known.remove(0);
        }
        known.push((quantity.clone(), value));
        value
    }
}

/// Returns the value of an expression, given the values of its atoms (parameters).
pub(crate) fn evaluate<A, S: Scalar>(
    expression: &RationalExpression<A>,
    atom: &impl Fn(&A) -> S,
) -> S {
    let (zero, one) = (S::from_f64(0.0), S::from_f64(1.0));
    let at = |part: &RationalExpression<A>| evaluate(part, atom);
    match expression {
        RationalExpression::Atom(own) => atom(own),
        RationalExpression::Sum(parts) => parts.iter().fold(zero, |sum, part| sum + at(part)),
        RationalExpression::Product(parts) => parts.iter().fold(one, |all, part| all * at(part)),
        RationalExpression::Quotient(above, below) => at(above) / at(below),
        RationalExpression::Power(base, exponent) => {
            let power = power(at(base), exponent.unsigned_abs());
            match *exponent < 0 {
                true => one / power,
                false => power,
            }
        }
        RationalExpression::Negative(value) => -at(value),
    }
}

/// A power, by squares.
fn power<S: Scalar>(base: S, exponent: u32) -> S {
    let (mut result, mut square, mut rest) = (S::from_f64(1.0), base, exponent);
    while rest > 0 {
        if rest % 2 == 1 {
            result = result * square;
        }
        rest /= 2;
        // The square behind the last one may be infinite.
        if rest > 0 {
            square = square * square;
        }
    }
    result
}

/// Checks that the parameters satisfy the conditions of a description, such as positive masses.
pub(crate) fn check(scene: &Scene, parameters: &[Double]) -> Result<(), TreeError> {
    for (parameter, value) in scene.parameters.iter().zip(parameters) {
        let what = || format!("parameter `{}`", parameter.name);
        require(what, value.high(), Sign::Any)?;
    }
    for requirement in &scene.requirements {
        let value = value(&requirement.quantity, parameters).high();
        require(|| requirement.what.clone(), value, requirement.sign)?;
        let Magnitudes {
            least,
            largest,
            text,
        } = requirement.magnitudes;
        let checked = require_magnitude("", value, [least, largest], text);
        let what = || requirement.describe_value(&scene.parameters);
        checked.map_err(|error| refusal(what(), &error))?;
    }
    Ok(())
}

fn require(what: impl Fn() -> String, value: f64, sign: Sign) -> Result<(), TreeError> {
    let check = match sign {
        Sign::Any => require_finite,
        Sign::Hanging => require_downward,
        Sign::Standing => require_upward,
        Sign::NonNegative => require_non_negative,
        Sign::Positive => require_positive,
    };
    check("", value).map_err(|error| refusal(what(), &error))
}

fn refusal(what: String, error: &ParameterError) -> TreeError {
    TreeError::Value {
        what,
        value: error.value,
        requirement: error.requirement,
    }
}

/// Returns the links of a scene, parents before children. For a tree described by generations these
/// are all links of the whole tree.
///
/// # Errors
/// [`TreeError`] if a number is not finite, or if a link can turn without kinetic energy.
pub(crate) fn links(scene: &Scene, parameters: &[Double]) -> Result<Vec<LinkNumbers>, TreeError> {
    let own = scene.links.iter().map(|link| numbers(link, parameters));
    let own: Vec<LinkNumbers> = own.collect();
    for (link, numbers) in scene.links.iter().zip(&own) {
        for (name, value) in named(numbers) {
            require(|| format!("{name} of `{}`", link.name), value, Sign::Any)?;
        }
    }
    let bodies: Vec<LinkBody> = own.iter().map(body).collect();
    if let Some(link) = free_link(&bodies, NEGLIGIBLE).and_then(|index| scene.links.get(index)) {
        return Err(TreeError::Value {
            what: format!(
                "moment of inertia of `{}` about its pivot, in some configuration,",
                link.name
            ),
            value: 0.0,
            requirement: "positive",
        });
    }
    Ok(of_whole_tree(scene, &own))
}

/// Returns the constants of the links for parameters that are not checked.
pub(crate) fn links_as_given<S: Scalar>(scene: &Scene, parameters: &[S]) -> Vec<LinkNumbers<S>> {
    let own = scene.links.iter().map(|link| numbers(link, parameters));
    of_whole_tree(scene, &own.collect::<Vec<_>>())
}

fn of_whole_tree<S: Scalar>(scene: &Scene, own: &[LinkNumbers<S>]) -> Vec<LinkNumbers<S>> {
    let places = link_copies(scene).into_iter();
    let links = places.filter_map(|LinkCopy { link, parent, .. }| {
        let numbers = *own.get(link)?;
        Some(LinkNumbers { parent, ..numbers })
    });
    links.collect()
}

/// A link of the whole tree, and the link of the scene that it is a copy of.
pub(crate) struct LinkCopy {
    /// Index of the link in the scene.
    pub(crate) link: usize,
    /// Index of the parent in the whole tree; `None` for the root.
    pub(crate) parent: Option<usize>,
    /// Number of the link among the copies under the same parent, counted from 1; `None` if there
    /// is only one.
    pub(crate) copy: Option<usize>,
}

/// Returns the links of the whole tree. If the scene has one link per generation, these are its
/// copies, in the order of rule-based trees: copy c under link i of a generation of n links is
/// number c n + i of the next one.
pub(crate) fn link_copies(scene: &Scene) -> Vec<LinkCopy> {
    let links = scene.links.iter().enumerate();
    let Layout::Generations { branching, .. } = scene.layout else {
        let places = links.map(|(link, own)| LinkCopy {
            link,
            parent: own.parent.map(|LinkId(parent)| parent),
            copy: None,
        });
        return places.collect();
    };
    let mut places: Vec<LinkCopy> = Vec::new();
    let (mut above, mut count) = (0, 1);
    for (link, _) in links {
        let start = places.len();
        let copies = if link == 0 { 1 } else { branching };
        places.extend((0..copies * count).map(|index| LinkCopy {
            link,
            parent: (link > 0).then_some(above + index % count),
            copy: (copies > 1).then_some(index / count + 1),
        }));
        (above, count) = (start, copies * count);
    }
    places
}

/// Returns the names of the links, in the same order. The name of a copy ends with its number and
/// the numbers of the copies that it hangs from.
pub(crate) fn names(scene: &Scene) -> Vec<String> {
    let mut suffixes: Vec<String> = Vec::new();
    let names = link_copies(scene).into_iter().map(|place| {
        let above = place.parent.and_then(|parent| suffixes.get(parent));
        let mut suffix = above.cloned().unwrap_or_default();
        if let Some(copy) = place.copy {
            suffix.push_str(&format!("_{copy}"));
        }
        let stem = scene.links.get(place.link).map(|link| link.name.as_str());
        let name = format!("{}{suffix}", stem.unwrap_or_default());
        suffixes.push(suffix);
        name
    });
    names.collect()
}

/// Returns the springs and friction between links of a scene that are not parent and child, for
/// parameters that are not checked. Of each run of consecutive identical ones it returns the first,
/// and their number.
pub(crate) fn spring_dampers<S: Scalar>(
    scene: &Scene,
    parameters: &[S],
) -> Vec<(SpringDamper<S>, usize)> {
    let mut found = Vec::new();
    for spring_damper in &scene.spring_dampers {
        let passive = spring_damper
            .torques
            .map(|quantity| value(quantity, parameters));
        let law = passive.law(FrictionContact::Joint);
        let is_viscous = spring_damper.torques.is_viscous();
        let runs = scene.pair_runs(&spring_damper.ends).into_iter();
        found.extend(runs.map(|PairRun { first, count }| {
            let first = SpringDamper {
                links: first,
                spring: passive.spring,
                rest: passive.rest,
                friction: passive.friction,
                law: (!is_viscous).then(|| self::law(*law)),
            };
            (first, count)
        }));
    }
    found
}

/// Converts a friction law of a scene to the type used at run time.
pub(crate) fn law<S: Scalar>(law: scene::FrictionLaw<S>) -> FrictionLaw<S> {
    FrictionLaw::of_constants(law.into_constants())
}

fn numbers<S: Scalar>(link: &Link, parameters: &[S]) -> LinkNumbers<S> {
    let at = |quantity: &Quantity| value(quantity, parameters);
    let point = |offset: &Offset| [at(&offset.along), at(&offset.lateral)];
    LinkNumbers {
        parent: link.parent.map(|LinkId(parent)| parent),
        mass: at(&link.mass),
        inertia: at(&link.inertia),
        com: point(&link.com),
        pivot: point(&link.pivot),
        end: point(&link.end),
        passive: link.passive.map(at),
    }
}

fn named(link: &LinkNumbers) -> impl Iterator<Item = (String, f64)> {
    let LinkNumbers {
        parent: _,
        mass,
        inertia,
        com,
        pivot,
        end,
        passive,
    } = link;
    let own = [
        ("mass", mass),
        ("inertia", inertia),
        ("centre of mass", &com[0]),
        ("centre of mass", &com[1]),
        ("pivot", &pivot[0]),
        ("pivot", &pivot[1]),
        ("end", &end[0]),
        ("end", &end[1]),
        ("friction", &passive.friction),
        ("drag", &passive.drag),
        ("spring", &passive.spring),
        ("rest", &passive.rest),
    ];
    let own = own.map(|(name, value)| (name.to_owned(), value.high()));
    let laws = FrictionContact::ALL.into_iter().flat_map(|place| {
        let constants = scene::FrictionLaw::NAMES.into_constants().into_iter();
        let values = passive.law(place).each_ref().into_constants();
        let own = constants.zip(values);
        own.map(move |(constant, value)| (constant.in_words(place), value.high()))
    });
    own.into_iter().chain(laws)
}

fn body(link: &LinkNumbers) -> LinkBody {
    LinkBody {
        what: "",
        parent: link.parent,
        mass: link.mass.high(),
        inertia: link.inertia.high(),
        com: link.com.map(Double::high),
        pivot: link.pivot.map(Double::high),
    }
}
