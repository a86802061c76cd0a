//! Links in numbers: the quantities of a description at values of its parameters, in some
//! 106 bits, so that what is formed of them is rounded once.

use branched_pendulum::ParameterError;
use branched_pendulum::emitted::{
    LinkBody, free_link, require_downward, require_finite, require_magnitude, require_non_negative,
    require_positive, require_upward,
};
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum_codegen::scene::{
    FrictionPlace, Layout, Link, LinkId, Magnitudes, NEGLIGIBLE, Offset, PairRun, PassiveTorques,
    Quantity, QuantityAtom, RationalExpression, Scene, Sign,
};

use crate::error::TreeError;

/// A link. SI units; places are along the link and across it.
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

/// The value of an expression, given those of its atoms.
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

/// Checks what a description requires of its parameters.
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
        let what = || requirement.what_of(&scene.parameters);
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

/// The links of a scene, parents before children; in generations those of the whole tree.
///
/// # Errors
/// A number that is not finite, and a link that can turn without kinetic energy.
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
    Ok(in_places(scene, &own))
}

/// The same links, in numbers that are taken as they are.
pub(crate) fn links_as_given<S: Scalar>(scene: &Scene, parameters: &[S]) -> Vec<LinkNumbers<S>> {
    let own = scene.links.iter().map(|link| numbers(link, parameters));
    in_places(scene, &own.collect::<Vec<_>>())
}

fn in_places<S: Scalar>(scene: &Scene, own: &[LinkNumbers<S>]) -> Vec<LinkNumbers<S>> {
    let places = places(scene).into_iter();
    let links = places.filter_map(|Place { link, parent, .. }| {
        let numbers = *own.get(link)?;
        Some(LinkNumbers { parent, ..numbers })
    });
    links.collect()
}

/// A link of the whole tree.
pub(crate) struct Place {
    /// Index of the link in the scene.
    pub(crate) link: usize,
    /// The parent's index in the whole tree.
    pub(crate) parent: Option<usize>,
    /// Number of the link among the copies below the parent, from 1, where there are several.
    pub(crate) copy: Option<usize>,
}

/// The links of the whole tree. In generations these are copies of one link of each, in the
/// order of trees by rule: copy c under link i of a generation of n links is number c n + i
/// of the next one.
pub(crate) fn places(scene: &Scene) -> Vec<Place> {
    let links = scene.links.iter().enumerate();
    let Layout::Generations { branching, .. } = scene.layout else {
        let places = links.map(|(link, own)| Place {
            link,
            parent: own.parent.map(|LinkId(parent)| parent),
            copy: None,
        });
        return places.collect();
    };
    let mut places: Vec<Place> = Vec::new();
    let (mut above, mut count) = (0, 1);
    for (link, _) in links {
        let start = places.len();
        let copies = if link == 0 { 1 } else { branching };
        places.extend((0..copies * count).map(|index| Place {
            link,
            parent: (link > 0).then_some(above + index % count),
            copy: (copies > 1).then_some(index / count + 1),
        }));
        (above, count) = (start, copies * count);
    }
    places
}

/// Names of the links, in the same order: those of copies end with their own numbers and
/// those of the copies that they hang in.
pub(crate) fn names(scene: &Scene) -> Vec<String> {
    let mut suffixes: Vec<String> = Vec::new();
    let names = places(scene).into_iter().map(|place| {
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

/// Springs and friction between the links of a scene that are not parent and child, in numbers
/// that are taken as they are: of those that stand side by side the first one, and how many
/// there are.
pub(crate) fn spring_dampers<S: Scalar>(
    scene: &Scene,
    parameters: &[S],
) -> Vec<(SpringDamper<S>, usize)> {
    let mut found = Vec::new();
    for spring_damper in &scene.spring_dampers {
        let passive = spring_damper
            .torques
            .map(|quantity| value(quantity, parameters));
        let law = passive.law(FrictionPlace::Joint);
        let is_viscous = spring_damper.torques.is_viscous();
        let runs = scene.pair_runs(&spring_damper.ends).into_iter();
        found.extend(runs.map(|PairRun { first, count }| {
            let first = SpringDamper {
                links: first,
                spring: passive.spring,
                rest: passive.rest,
                friction: passive.friction,
                law: (!is_viscous).then_some([law.coulomb, law.quadratic, law.width]),
            };
            (first, count)
        }));
    }
    found
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

fn named(link: &LinkNumbers) -> [(&'static str, f64); 17] {
    let LinkNumbers {
        parent: _,
        mass,
        inertia,
        com,
        pivot,
        end,
        passive,
    } = link;
    let [joint, ground] = &passive.laws;
    [
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
        ("Coulomb friction", &joint.coulomb),
        ("quadratic friction", &joint.quadratic),
        ("width of friction", &joint.width),
        ("quadratic drag", &ground.quadratic),
        ("width of drag", &ground.width),
    ]
    .map(|(name, value)| (name, value.high()))
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
