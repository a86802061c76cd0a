//! Messages about the outputs that a description requests.

use super::{Problem, listed, suggest};

messages! {
    /// A mistake in the outputs that a description requests.
    OutputMessage as Output:

    /// The requested output does not exist.
    UnknownRequest { name: String, nearest: Option<&'static str> } => (
        format!("unknown output `{name}`"),
        "not an output",
        suggest(
            nearest,
            "outputs are `energies`, `momenta`, `modes`, `positions`, `forces`, `symmetric`, \
             `transfer(...)`, `budget(...)`, `transverse`, `small(...)`, `normal_form`, `taylor`, \
             `inverse_dynamics`, `gradient(...)`; \
             accelerations are always emitted",
        ),
    ),
    /// An output is requested twice.
    DuplicateRequest { name: String } => (
        format!("`{name}` is given twice"),
        "already given",
        "keep one of them",
    ),
    /// Parentheses follow an output that has no forms.
    RequestForms { name: String } => (
        format!("`{name}` takes no forms"),
        "takes no parentheses",
        format!("write `{name}` alone"),
    ),
    /// The requested form of the energy budget does not exist.
    UnknownBudgetForm { name: String, nearest: Option<&'static str> } => (
        format!("unknown form `{name}` of the budget"),
        "not a form of the budget",
        suggest(
            nearest,
            "forms are `canonical`, `parseval`, `velocity`, `rest`, `matrix`, `scales`, \
             `angle = 1`, `amplitude = 4`",
        ),
    ),
    /// Energies of sectors are requested, but a spring between links couples sectors (independent
    /// sets of symmetric coordinates).
    CoupledSectors { what: String } => (
        format!("the spring of `{what}` couples sectors, whose energies are requested"),
        "no sector has a separate energy",
        "write `siblings(NODE, spring = ...)`, which puts springs between all copies of a node \
         under one link, or define an energy yourself by `observe(...)`",
    ),
    /// The requested output cannot include the forces of this straight spring.
    StraightSpring { line: String, noun: &'static str, request: &'static str, cause: NoChord } => (
        format!("`{request}` cannot include the {line}"),
        cause.label(),
        format!(
            "`{request}` supports straight springs of zero rest length, without friction, between \
             the same point of all copies of a node under one link, as in \
             `siblings(NODE, at = ..., spring = ...)`; leave `{request}` out, write a torsion \
             spring without `at`, or compute the {noun}'s forces yourself with \
             `emit(positions, forces)`"
        ),
    ),
    /// A budget by scale (by generation) is requested for a tree with a straight spring.
    StraightSpringByScale { line: String, noun: &'static str } => (
        format!("`budget(scales)` cannot include the {line}"),
        "its length depends on several scales",
        format!(
            "leave `scales` out, write a torsion spring between siblings, without `at`, or compute \
             the {noun}'s forces yourself with `emit(positions, forces)`"
        ),
    ),
    /// `scales` is combined with a form of the budget that code in loops does not compute.
    BesideScales => (
        "`scales` can be combined with `parseval` only",
        "cannot be combined with `scales`",
        "write `budget(parseval, scales)`, and request other forms for a separate model",
    ),
    /// Budgets by scale are requested for a tree whose code is not loops over generations.
    ScalesWithoutRule => (
        "`budget(scales)` needs a whole tree described by one rule, in loops",
        "no loops over generations of several copies here",
        "describe the whole tree as `generations(count = 5, branching = 2, ...)` with equal \
         copies, without `code = unrolled`, `in_phase` and `locked`; for other trees write \
         `budget(parseval, matrix)`, which gives energies by sector; with `open = 1` only trees at \
         run time have a budget by scale",
    ),
    /// The parentheses of `budget()` contain no form.
    NoBudgetForm => (
        "`budget()` names no form",
        "empty",
        "write `budget` for all exact forms, or name some: `budget(parseval)`",
    ),
    /// The parentheses of `gradient()` contain no function.
    NoGradient => (
        "`gradient()` names no function",
        "empty",
        "write `gradient` for derivatives of all emitted functions that have them, or name some: \
         `gradient(accelerations, energies)`",
    ),
    /// A function of which derivatives are requested does not exist.
    UnknownGradient { name: String, nearest: Option<&'static str> } => (
        format!("`gradient` does not know `{name}`"),
        "not a function with derivatives",
        suggest(
            nearest,
            "derivatives exist of `accelerations`, `energies`, `transfer` and of each observable \
             of `observe(...)`, by its name",
        ),
    ),
    /// An order or parentheses follow a function of which derivatives are requested.
    GradientForms { name: String } => (
        format!("`gradient({name})` takes neither an order nor further parentheses"),
        "takes a name alone",
        format!("write `gradient({name})`; derivatives exist of every requested form"),
    ),
    /// Derivatives of the energy transfer are requested, but the transfer is not.
    GradientOfNoTransfer => (
        "`gradient(transfer)` needs the transfer itself",
        "no transfer is requested",
        "add `transfer` to the outputs, as in `emit(transfer(exact), gradient(transfer))`",
    ),
    /// The parentheses of `small()` contain no sector.
    NoSmallSector => (
        "`small()` names no sector",
        "empty",
        "write `small(child_d)` with names of sectors, or leave it out to count all \
         differences as small",
    ),
    /// A budget without truncated forms contains `small(...)`.
    SmallWithoutOrder => (
        "`small(...)` needs a truncated form of the budget",
        "no form here is truncated",
        "write `budget(amplitude = 4, small(...))`, or leave `small` out: other forms are exact",
    ),
    /// The scene has no sector of this name.
    UnknownSector { name: String, nearest: Option<String>, known: String } => (
        format!("unknown sector `{name}`"),
        "not a sector of differences",
        suggest(nearest, format!("sectors are `{known}`")),
    ),
    /// A form of the budget that takes no value is given one.
    BudgetOrder { form: String } => (
        format!("`{form}` takes no order"),
        "takes no value",
        format!("write `{form}` alone"),
    ),
    /// The requested form of the transfer does not exist.
    UnknownForm { name: String, nearest: Option<&'static str> } => (
        format!("unknown form `{name}` of the transfer"),
        "not a form of the transfer",
        suggest(nearest, "forms are `angle = 1`, `amplitude = 2`, `exact`"),
    ),
    /// The parentheses of `transfer()` contain no form.
    NoForm => (
        "`transfer()` names no form",
        "empty",
        "write `transfer` for all forms, or name some: `transfer(exact)`",
    ),
    /// The exact transfer is given an order: `exact = ...`.
    ExactOrder => (
        "the exact transfer takes no order",
        "takes no value",
        "write `exact` alone",
    ),
    /// The requested order in the difference angles is not available.
    AngleOrder => (
        "this order in the difference angles is not available",
        "expected an order from 1 to 8",
        "write `angle = 1` for the paper's form, or use `exact`",
    ),
    /// The requested order in the amplitude is not available.
    AmplitudeOrder => (
        "this order in the amplitude is not available",
        "expected an order from 2 to 8",
        "write `amplitude = 2` for the quadratic form, or use `exact`",
    ),
    /// Symmetric coordinates are requested for a tree without identical siblings.
    NoSiblings { request: String } => (
        format!("`{request}` needs identical siblings"),
        "no link has copies",
        "write copies as in `child(...) * 2`; links that merely have equal values do not count",
    ),
    /// The request requires equal copies, but the values of these copies differ.
    UnequalCopies { node: String, wanted: UnequalUse } => (
        wanted.refusal(),
        format!("the copies of `{node}` differ"),
        wanted.hint(),
    ),
    /// The transfer is requested between identical siblings that have children.
    NestedGroups { group: String } => (
        format!("`transfer` needs siblings without children: the copies of `{group}` have some"),
        "these copies have children",
        "write `budget(canonical, amplitude = 4)`, which supports sectors of any size; `transfer` \
         is for trees whose copied links are leaves",
    ),
    /// The transfer is requested between siblings whose centre of mass lies off their axis.
    LateralTransfer { link: String } => (
        format!("`transfer` needs the centre of mass of `{link}` on its axis"),
        "the centre of mass is off the axis",
        "measure the copies' angles from the line through pivot and centre of mass: write \
         `com = 0.05` instead of `com = (0.04, 0.03)`",
    ),
    /// The normal form is requested for a tree for which it has no closed form.
    NoNormalForm { cause: String } => (
        "`normal_form` has no formulas for this tree",
        cause.clone(),
        "formulas exist for one link, for a chain of two, and for a link with equal copies of \
         another one, with springs in their pivots only; for other trees compute numbers at run \
         time by `analysis::normal_form::NormalForm`, from a model with `emit(energies)`",
    ),
    /// A name in an observable is unknown.
    UnknownSymbol { name: String, nearest: Option<String>, example: String } => (
        format!("unknown symbol `{name}`"),
        "unknown in this scene",
        suggest(
            nearest,
            format!(
                "observables can use angles as `theta_{example}`, velocities as \
                 `omega_{example}`, momenta as `p_{example}`, `kinetic_energy`, \
                 `potential_energy`, `gravity`, parameters and the model's constants"
            ),
        ),
    ),
    /// A name in an observable is both a parameter and a symbol of the mechanics.
    AmbiguousSymbol { name: String } => (
        format!("the name `{name}` is ambiguous"),
        "both a parameter and a symbol of the mechanics",
        "give the parameter another name",
    ),
    /// An observable calls an unknown function.
    UnknownFunction { name: String, known: Vec<&'static str> } => (
        format!("unknown function `{name}`"),
        "not a function of observables",
        format!("functions are {}", listed(known)),
    ),
    /// The function that an observable would emit exists already.
    FunctionTaken { name: String, function: String } => (
        format!("the function `{function}` exists already"),
        format!("`{name}` would emit it again"),
        format!("choose another name, as in `my_{name}`"),
    ),
    /// Small differences between copies are requested, but no copies move in phase.
    NoTransverse { request: &'static str } => (
        format!("`{request}` needs copies that move in phase"),
        "no copies move in phase",
        "add `in_phase(all)`, or `in_phase(child)` with a link that has copies",
    ),
    /// The requested output has to be derived for one tree, but this tree is described at run time.
    NotAtRunTime { what: String } => (
        format!("`{what}` is not available for a tree described at run time"),
        "needs a derivation for this tree",
        "leave it out, or let the attribute `#[branched_pendulum(...)]` compile this tree",
    ),
}

/// Reason why the equations of the sectors cannot include a straight spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoChord {
    /// The line ends on the ground instead of a second link.
    Guy,
    /// The line's energy follows another law than that of a spring.
    Repulsion,
    /// The spring has a rest length.
    Rest,
    /// There is a damper along the line.
    Damper,
    /// The links are not copies of one node under one link.
    OtherLinks,
    /// The points differ between the two copies, or the copies do not hang from one pivot.
    OtherPlaces,
    /// The spring does not connect all pairs of the copies under the link.
    SomeCopies,
}

impl NoChord {
    fn label(self) -> &'static str {
        match self {
            Self::Guy => "ends on the ground",
            Self::Repulsion => "repels or attracts by a power of the distance",
            Self::Rest => "has a rest length",
            Self::Damper => "has a damper",
            Self::OtherLinks => "not between copies under one link",
            Self::OtherPlaces => "not between the same point of copies on one pivot",
            Self::SomeCopies => "not equal between every two of the copies",
        }
    }
}

/// Requests that require equal copies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnequalUse {
    /// A truncated form of the transfer.
    Order,
    /// The energy budget of sectors.
    Budget,
    /// Copies that move in phase, or locked joints.
    Reduction,
}

impl UnequalUse {
    fn refusal(self) -> &'static str {
        match self {
            Self::Order => "truncated forms of the transfer need equal copies",
            Self::Budget => "a budget of sectors needs equal copies",
            Self::Reduction => "`in_phase` and `locked` need a tree of equal copies",
        }
    }

    fn hint(self) -> &'static str {
        match self {
            Self::Order => {
                "write `transfer(exact)`, which splits the transfer into growth and forcing"
            }
            Self::Budget => {
                "write `transfer(exact)` for copies without children, or define energies yourself \
                 by `observe(...)`"
            }
            Self::Reduction => "leave this or `each(...)` out",
        }
    }
}
