//! The messages in words. Every one says what is wrong and what to write
//! instead.

use super::Message;
use super::message::{Lookalike, UnequalUse};

/// A message in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Statement of the mistake that stands on its own.
    pub text: String,
    /// Mistake in the marked tokens.
    pub label: String,
    /// Correction to write instead.
    pub hint: String,
}

impl Message {
    /// The message in words.
    pub fn problem(&self) -> Problem {
        use Message as M;
        match self {
            M::Expected { what } => problem(
                format!("expected {what}"),
                "something else stands here",
                OUTLINE,
            ),
            M::Ended { what } => {
                problem(format!("expected {what}"), "missing before this", OUTLINE)
            }
            M::Colon { name } => problem(
                format!("`:` behind `{name}`"),
                "a value follows `=`",
                format!("write `{name} = ...`; `:` stands between a link and its shape only"),
            ),
            M::Brackets { what, wanted } => problem(
                format!("{what} in the wrong brackets"),
                format!("{what} stand in `{wanted}`"),
                "write `parent(mass = 0.1, ...) [ child(...), ... ]`",
            ),
            M::MissingComma { before } => problem(
                format!("no comma before `{before}`"),
                "the next member of the list",
                format!("write `, {before}`"),
            ),
            M::Unit { unit } => problem(
                format!("the unit `{unit}` behind a number"),
                "units are not written",
                "write the number alone, in SI units: kg, m, s and what is formed of them",
            ),
            M::Lookalike { name, kind } => {
                let (what, hint) = match kind {
                    Lookalike::Joint => (
                        "a type of joint",
                        "links turn about pivots, and `joint` is a distance in m; for other \
                         joints see `docs/limits.md`",
                    ),
                    Lookalike::Function => (
                        "a function",
                        "give a parameter another name; values have no functions, drives have \
                         `sin(...)` and `cos(...)`",
                    ),
                    Lookalike::Motion => (
                        "an angle or a velocity",
                        "properties do not change with the motion: `friction` and `drag` are \
                         coefficients, and `docs/limits.md` has other forces; give a parameter \
                         another name",
                    ),
                };
                problem(
                    format!("`{name}` as a parameter"),
                    format!("reads like {what}"),
                    hint,
                )
            }
            M::NotFinite { name } => problem(
                format!("`{name}` is not a finite number"),
                "no value of a pendulum",
                "write a number, or the name of a parameter",
            ),
            M::Nesting { limit } => problem(
                format!("more than {limit} levels of brackets"),
                "too deep",
                "write long chains by rule: `chain: generations(count = 100, ...)`",
            ),
            M::NotAStruct => problem(
                "the attribute stands on something else than a struct",
                "not a struct",
                "put it on a struct without fields: `pub struct Pendulum;`",
            ),
            M::StructFields { name } => problem(
                format!("struct `{name}` has fields"),
                "must be without fields",
                format!("write `struct {name};`, the fields follow from the description"),
            ),
            M::StructGenerics { name } => problem(
                format!("struct `{name}` is generic"),
                "must be without parameters",
                format!("write `struct {name};`, its functions are generic over the scalar"),
            ),
            M::UnknownEntry { name, nearest } => problem(
                format!("unknown setting `{name}`"),
                "not a setting of the scene",
                suggest(
                    nearest,
                    "settings are `gravity = ...`, `crate = ...`, `solve = ...`, `code = ...`, \
                     `parameters(...)`, `drive(...)`, `emit(...)`, `observe(...)`",
                ),
            ),
            M::MissingGravity => problem(
                "gravity is missing",
                "described without `gravity`",
                "write `gravity = 9.80665`, in m/s²",
            ),
            M::EmptyTree => problem(
                "there is no link",
                "has nothing that could swing",
                "write one, as in `bob: point(mass = 0.1, length = 0.3)`",
            ),
            M::SecondRoot { first } => problem(
                "there is more than one root",
                format!("hangs beside `{first}`"),
                format!(
                    "a description is one tree: hang it from a link, as in `{first}(...) [ ... ]`, \
                     or give it an attribute of its own; for pendulums that act on each other \
                     otherwise see `docs/limits.md`"
                ),
            ),
            M::RootCopies => problem(
                "the root has several copies",
                "copies of the root do not act on each other",
                "leave out the multiplicity and run the model several times",
            ),
            M::DuplicateProperty { name } => problem(
                format!("`{name}` is given twice"),
                "given before",
                "keep one of them",
            ),
            M::DuplicateName { name } => problem(
                format!("the name `{name}` is taken"),
                "second use of the name",
                "links, copies `name_1`, `name_2`, ..., groups, parameters and observables need \
                   names of their own",
            ),
            M::ReservedName { name } => problem(
                format!("the name `{name}` is reserved"),
                "used by Rust or by the emitted code",
                match name.starts_with(|first: char| first.is_ascii_uppercase()) {
                    true => format!("choose another, as in `My{name}`"),
                    false => format!("choose another, as in `my_{name}`"),
                },
            ),
            M::NotSnakeCase { name, suggestion } => problem(
                format!("`{name}` is not a snake-case name"),
                "becomes part of names in the emitted code",
                match suggestion {
                    Some(suggestion) => format!("write `{suggestion}`"),
                    None => "use letters a to z, digits and single underscores, a letter first"
                        .to_owned(),
                },
            ),
            M::UnknownShape {
                name,
                nearest,
                known,
            } => problem(
                format!("unknown shape `{name}`"),
                "not a shape",
                suggest(nearest, &format!("shapes are {}", listed(known))),
            ),
            M::UnknownProperty {
                name,
                body,
                nearest,
                known,
            } => problem(
                format!("{body} has no property `{name}`"),
                "unknown property",
                suggest(nearest, &format!("{body} has {}", listed(known))),
            ),
            M::MissingProperty { name, link, body } => problem(
                format!("`{link}` has no `{name}`"),
                "property missing",
                format!("{body} needs it: write `{name} = ...`{}", unit_note(name)),
            ),
            M::MissingJoint { link } => problem(
                format!("`{link}` does not say where its children hang"),
                "no `joint`",
                "write `joint = ...`, the distance from its pivot in m, or give each child \
                   an `at = ...`",
            ),
            M::RootPivot => problem(
                "the root does not hang from a link",
                "`at` is a place on the parent",
                "leave it out: the root's pivot is the origin",
            ),
            M::RestWithoutSpring { link } => problem(
                format!("`{link}` has a rest angle, but no spring"),
                "nothing is at rest here",
                "add `spring = ...`, the spring's stiffness in N m, or leave `rest` out",
            ),
            M::UndeclaredParameter { name, nearest } => problem(
                format!("`{name}` is not declared"),
                "not in `parameters(...)`",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => format!("add `{name}` to `parameters(...)`, or write a number"),
                },
            ),
            M::UnusedParameter { name } => problem(
                format!("the parameter `{name}` is never used"),
                "no value names it",
                "leave it out of `parameters(...)`, or use it",
            ),
            M::RuleChildren => problem(
                "a generation rule has no other children",
                "the rule makes all children",
                "leave out the brackets, or write the tree link by link",
            ),
            M::NotAPoint { name } => problem(
                format!("`{name}` is a single value"),
                "a pair",
                "only `com`, `joint` and `at` can be pairs `(along, lateral)`",
            ),
            M::NotACount { name } => problem(
                format!("`{name}` is not a whole number of at least 1"),
                "not a count",
                format!("write a literal: `{name} = 3`"),
            ),
            M::NotAShape => problem(
                "`shape` is not the name of a shape",
                "not a name",
                "write `shape = rod`",
            ),
            M::Negative { what, value } => problem(
                format!("{what} is negative"),
                format!("this is {value}"),
                "write a value that is zero or above",
            ),
            M::NotPositive { what, value } => problem(
                format!("{what} is not positive"),
                format!("this is {value}"),
                "write a value above zero",
            ),
            M::Singular { link } => problem(
                format!("`{link}` can turn without kinetic energy"),
                "makes the mass matrix singular",
                "give it mass away from its pivot or a moment of inertia",
            ),
            M::ZeroCopies => problem(
                "zero copies",
                "leaves no link",
                "write `* 1` or more, or leave the link out",
            ),
            M::NotACode => problem(
                "`code` is neither `loops` nor `unrolled`",
                "not a way to write code",
                "write `code = loops`, `code = unrolled`, or nothing: large trees get loops",
            ),
            M::NoLoops { what } => problem(
                format!("no loops with {what}"),
                "this cannot be in loops",
                "leave `code = loops` out, or what it does not go with; loops compute \
                 accelerations and energies",
            ),
            M::TooManyForUnrolled { what, limit } => problem(
                format!("more than {limit} links with {what}"),
                "too many to be written out",
                "leave that out: loops over generations compute accelerations and energies \
                 of any number of links; or use fewer generations or branches",
            ),
            M::TooManyLinks { limit } => problem(
                format!("more than {limit} links"),
                "too many with this one",
                "use fewer generations, branches or copies",
            ),
            M::TooManyPairs { pairs, limit } => problem(
                format!(
                    "a tree too large to be written out: {pairs} pairs of a link and one above"
                ),
                format!("at most {limit} pairs"),
                "large trees get loops where accelerations and energies alone are asked for; or \
                 use fewer links or shorter chains",
            ),
            M::TooManyTerms { limit } => problem(
                "formulas too long to be derived",
                format!("more than {limit} terms"),
                "ask for less at once: lower orders, fewer outputs, simpler observables, or a \
                 smaller tree",
            ),
            M::TooManyValues { limit } => problem(
                "code too long to be written",
                format!("more than {limit} values"),
                "ask for less at once: fewer outputs or forms, lower orders, or a smaller tree",
            ),
            M::DivisionByZero => problem(
                "division by zero",
                "this is zero",
                "write a divisor other than zero",
            ),
            M::NotDecimal { text } => problem(
                format!("`{text}` is not a decimal number"),
                "cannot be read",
                "write digits as in `0.27` or `1.88e-3`, without suffix; units are SI",
            ),
            M::NumberRange => problem(
                "a number is too large or too small",
                "no `f64` can hold it",
                "magnitudes go from 5e-324 to 1.7e308; units are SI",
            ),
            M::NumberLength => problem(
                "too many digits",
                "too long for exact arithmetic",
                "round it: 17 digits are all that an `f64` keeps",
            ),
            M::Exponent => problem(
                "the exponent is not a whole number",
                "not an exponent",
                "write a literal, as in `length^2` or `length^-1`",
            ),
            M::Degree { limit } => problem(
                "the power of parameters is too high",
                "makes too many factors",
                format!("powers of parameters go up to {limit}"),
            ),
            M::ChainedPower => problem(
                "a power of a power",
                "ambiguous",
                "write parentheses: `(a^2)^3`",
            ),
            M::FunctionCall { name } => problem(
                format!("`{name}(...)`: values have no functions"),
                "values are made of `+ - * / ^`",
                "compute it beforehand and write the digits, or make it a parameter",
            ),
            M::DriveFunction { name, nearest } => problem(
                format!("unknown function `{name}`"),
                "not a function of a drive",
                suggest(
                    nearest,
                    "functions are `sin(...)` and `cos(...)`, of angles in rad",
                ),
            ),
            M::EmptyDrive => problem(
                "the drive is empty",
                "drives nothing",
                "write `drive(torque = ...)`, or the motion of the root's pivot, \
                   `drive(x = ..., y = ...)`",
            ),
            M::UnknownDrive { name, nearest } => problem(
                format!("unknown part `{name}` of the drive"),
                "not a part of the drive",
                suggest(
                    nearest,
                    "parts are `torque`, on the root in N m, and `x` and `y`, of its pivot in m",
                ),
            ),
            M::TimeDivisor => problem(
                "division by a function",
                "may vanish at some time",
                "divide by numbers and parameters only, so that the drive is finite at all times",
            ),
            M::TimeOutsideDrive => problem(
                "`t` is the time",
                "does not depend on time",
                "only `drive(...)` does; give a parameter another name",
            ),
            M::NotExact { name, digits } => problem(
                format!("`{name}` has no exact value"),
                "not a rational number",
                format!("write as many digits as needed: `{digits}`"),
            ),
            M::UnknownRequest { name, nearest } => problem(
                format!("unknown output `{name}`"),
                "cannot be emitted",
                suggest(
                    nearest,
                    "outputs are `energies`, `momenta`, `modes`, `symmetric`, `transfer(...)`, \
                     `budget(...)`, `taylor`; accelerations are always there",
                ),
            ),
            M::UnknownSolve { name, nearest } => problem(
                format!("unknown way to solve `{name}`"),
                "no way to solve for the accelerations",
                suggest(
                    nearest,
                    "`factorization` or `recursion`; without `solve` the one of fewer operations",
                ),
            ),
            M::DuplicateRequest { name } => problem(
                format!("`{name}` is asked for twice"),
                "asked for before",
                "keep one of them",
            ),
            M::RequestForms { name } => problem(
                format!("`{name}` has no forms"),
                "takes no parentheses",
                format!("write `{name}` alone"),
            ),
            M::UnknownForm { name, nearest } => problem(
                format!("unknown form `{name}` of the transfer"),
                "not a form",
                suggest(nearest, "forms are `angle = 1`, `amplitude = 2`, `exact`"),
            ),
            M::NoForm => problem(
                "no form of the transfer is chosen",
                "empty",
                "write `transfer` for all forms, or choose: `transfer(exact)`",
            ),
            M::UnknownBudgetForm { name, nearest } => problem(
                format!("unknown form `{name}` of the budget"),
                "not a form",
                suggest(
                    nearest,
                    "forms are `canonical`, `parseval`, `velocity`, `rest`, `matrix`, \
                     `angle = 1`, `amplitude = 4`",
                ),
            ),
            M::NoBudgetForm => problem(
                "no form of the budget is chosen",
                "empty",
                "write `budget` for all exact forms, or choose: `budget(parseval)`",
            ),
            M::NoSmallSector => problem(
                "no sector is named as small",
                "empty",
                "write `small(child_d)` with names of sectors, or leave it out to count all \
                 differences as small",
            ),
            M::SmallWithoutOrder => problem(
                "`small` needs an order",
                "nothing is expanded in it",
                "write `budget(amplitude = 4, small(...))`, or leave it out: other forms are exact",
            ),
            M::UnknownSector {
                name,
                nearest,
                known,
            } => problem(
                format!("unknown sector `{name}`"),
                "not a sector of differences",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => format!("sectors are `{known}`"),
                },
            ),
            M::UnknownNode { name, nearest } => problem(
                format!("no link is called `{name}`"),
                "not a link of this description",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => "write the name of a link of the description".to_owned(),
                },
            ),
            M::NoTransverse => problem(
                "`transverse` needs copies that move in phase",
                "nothing moves in phase",
                "add `in_phase(all)`, or `in_phase(child)` with a link that has copies",
            ),
            M::NothingInPhase { name } => problem(
                format!("nothing to move alike: `{name}` has no copies"),
                "no copies",
                "leave it out, or write copies as in `child(...) * 2`",
            ),
            M::NothingPrescribed => problem(
                "`prescribed()` names no link",
                "no link",
                "write the links whose motion is handed over, as in `prescribed(arm)`",
            ),
            M::LockedRoot => problem(
                "the root cannot be locked",
                "hangs from the ground",
                "describe the links below it as the tree, each tree by itself",
            ),
            M::LockedGeneration { link } => problem(
                format!("`{link}` cannot be locked in a tree that is taken through loops"),
                "a generation of a rule",
                "write `code = unrolled` among the properties of the rule",
            ),
            M::IdleJoint { link, property } => problem(
                format!("{property} of `{link}` does nothing in a joint that does not move"),
                "locked",
                format!("leave out {property}, or the lock"),
            ),
            M::LockedAngle => problem(
                "the angle of a locked joint is not a number of radians between -7 and 7",
                "not such a number",
                "write the angle to the link above in radians, as in `locked(arm, 0.3)`",
            ),
            M::BudgetOrder { form } => problem(
                format!("`{form}` has no order"),
                "takes no value",
                format!("write `{form}` alone"),
            ),
            M::ExactOrder => problem(
                "the exact transfer has no order",
                "takes no value",
                "write `exact` alone",
            ),
            M::AngleOrder => problem(
                "order of the angles not available",
                "orders are 1 to 8",
                "write `angle = 1` for the form of the paper, or use `exact`",
            ),
            M::AmplitudeOrder => problem(
                "order of the amplitude not available",
                "orders are 2 to 8",
                "write `amplitude = 2` for the quadratic form, or use `exact`",
            ),
            M::NoSiblings { request } => problem(
                format!("`{request}` needs identical siblings"),
                "no link has copies",
                "write `child(...) * 2`: links that merely have equal numbers do not count",
            ),
            M::EachWithoutCopies => problem(
                "`each(...)` where there are no copies",
                "one value is enough here",
                "write the value alone, or copies behind the link: \
                   `child(mass = each(0.105, 0.106), ...) * 2`",
            ),
            M::EachInRule { link } => problem(
                format!("`each(...)` in the generation rule `{link}`"),
                "all links of a generation are equal",
                "write the generations out, each link with its children in `[ ]`",
            ),
            M::EachCount {
                link,
                copies,
                values,
            } => problem(
                format!("`each(...)` needs {copies} values for the {copies} copies of `{link}`"),
                format!("{values} of them here"),
                "write one value for each copy, as in `each(0.105, 0.106)` for two",
            ),
            M::UnequalCopies { node, wanted } => {
                let (what, hint) = match wanted {
                    UnequalUse::Order => (
                        "truncated forms of W need equal copies",
                        "write `transfer(exact)`, which splits W into growth and forcing",
                    ),
                    UnequalUse::Budget => (
                        "sectors of unequal copies have no budget",
                        "write `transfer(exact)` for copies without children, or `observe(...)` \
                           for energies of your own",
                    ),
                    UnequalUse::Reduction => (
                        "`in_phase` and `locked` need a tree of equal copies",
                        "leave this out, or `each(...)`",
                    ),
                };
                problem(what, format!("the copies of `{node}` differ"), hint)
            }
            M::LateralTransfer { link } => problem(
                format!("`transfer` needs the centre of mass of `{link}` on its axis"),
                "a lateral centre of mass among the copies",
                "measure the copies' angles from the line through pivot and centre of mass: \
                   `com = 0.05` instead of `com = (0.04, 0.03)`",
            ),
            M::UnknownSymbol {
                name,
                nearest,
                example,
            } => problem(
                format!("unknown symbol `{name}`"),
                "means nothing in this scene",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => format!(
                        "observables are made of angles as `theta_{example}`, velocities as \
                         `omega_{example}`, momenta as `p_{example}`, `kinetic_energy`, \
                         `potential_energy`, `gravity`, parameters and the model's constants"
                    ),
                },
            ),
            M::AmbiguousSymbol { name } => problem(
                format!("`{name}` means two things"),
                "a parameter, and a symbol of the mechanics",
                "give the parameter another name",
            ),
            M::UnknownFunction { name, known } => problem(
                format!("unknown function `{name}`"),
                "not a function of observables",
                format!("functions are {}", listed(known)),
            ),
            M::FunctionTaken { name, function } => problem(
                format!("there is a function `{function}` already"),
                format!("`{name}` would emit it again"),
                format!("choose another name, as in `my_{name}`"),
            ),
            M::ConstantRange { name } => problem(
                format!("the constant `{name}` of the model is too large or too small"),
                "no `f64` can hold a constant of this scene",
                "masses, lengths and gravity multiply: write values in SI units",
            ),
            M::Algebra(reason) => problem(
                "the mechanics could not be derived",
                reason.as_str(),
                "commit the expansion made by the tool `branched-pendulum` where the derivation cannot run",
            ),
            M::NestedGroups { group } => problem(
                format!(
                    "`transfer` needs siblings without children, the copies of `{group}` \
                         have some"
                ),
                "tree not supported",
                "for this tree ask for `budget(canonical, amplitude = 4)`, which knows sectors of \
                   any size; `transfer` is for trees whose copied links are leaves",
            ),
        }
    }
}

/// Outline of an attribute, for tokens out of place.
const OUTLINE: &str = "an attribute looks like `gravity = 9.80665, parent(mass = 0.1, com = 0.1, \
     inertia = 0, joint = 0.3) [child: rod(mass = 0.1, length = 0.2) * 2], emit(energies)`";

fn problem(text: impl Into<String>, label: impl Into<String>, hint: impl Into<String>) -> Problem {
    Problem {
        text: text.into(),
        label: label.into(),
        hint: hint.into(),
    }
}

/// The name that was probably meant, or else what there is.
fn suggest(nearest: &Option<&'static str>, otherwise: &str) -> String {
    match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => otherwise.to_owned(),
    }
}

/// Names with commas between them.
fn listed(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// The unit of a property, where it has one.
fn unit_note(name: &str) -> &'static str {
    match name {
        "mass" | "bob_mass" => ", in kg",
        "inertia" => ", in kg m² about the centre of mass",
        "com" => ", in m from its pivot",
        "length" | "width" | "radius" => ", in m",
        _ => "",
    }
}
