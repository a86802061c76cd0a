//! Messages about a description: the outputs that it asks for.

use super::{Problem, listed, suggest};

messages! {
    /// A mistake in a description: the outputs that it asks for.
    OutputMessage as Output:

    /// An output that does not exist.
    UnknownRequest { name: String, nearest: Option<&'static str> } => (
        format!("unknown output `{name}`"),
        "cannot be emitted",
        suggest(
            nearest,
            "outputs are `energies`, `momenta`, `modes`, `positions`, `forces`, `symmetric`, \
             `transfer(...)`, `budget(...)`, `transverse`, `small(...)`, `taylor`; accelerations \
             are always there",
        ),
    ),
    /// An output asked for twice.
    DuplicateRequest { name: String } => (
        format!("`{name}` is asked for twice"),
        "asked for before",
        "keep one of them",
    ),
    /// Parentheses after an output without forms.
    RequestForms { name: String } => (
        format!("`{name}` has no forms"),
        "takes no parentheses",
        format!("write `{name}` alone"),
    ),
    /// A form of the budget that does not exist.
    UnknownBudgetForm { name: String, nearest: Option<&'static str> } => (
        format!("unknown form `{name}` of the budget"),
        "not a form",
        suggest(
            nearest,
            "forms are `canonical`, `parseval`, `velocity`, `rest`, `matrix`, `scales`, \
             `angle = 1`, `amplitude = 4`",
        ),
    ),
    /// Energies of sectors that a spring between links couples.
    CoupledSectors { what: String } => (
        format!("the spring of `{what}` couples the tree's sectors"),
        "no sector has an energy by itself",
        "write `siblings(NODE, spring = ...)` for springs between all copies of a node under \
         one link, or watch an energy of your own by `observe(...)`",
    ),
    /// An output that this straight spring is not part of.
    StraightSpring { line: String, noun: &'static str, request: &'static str, cause: NoChord } => (
        format!("`{request}` beside the {line}"),
        cause.label(),
        format!(
            "of straight springs `{request}` knows those without length at rest and without \
             friction alone, between equal places of all copies of a node under one link, as in \
             `siblings(NODE, at = ..., spring = ...)`; leave `{request}` out, write a torsion \
             spring without `at`, or hand over the {noun}'s forces by `emit(positions, forces)`"
        ),
    ),
    /// A budget by scale beside a straight spring.
    StraightSpringByScale { line: String, noun: &'static str } => (
        format!("`budget(scales)` beside the {line}"),
        "a length depends on several scales",
        format!(
            "leave `scales` out, write a torsion spring between siblings, without `at`, or hand \
             over the {noun}'s forces by `emit(positions, forces)`"
        ),
    ),
    /// A form of the budget beside `scales` that loops do not have.
    BesideScales => (
        "budgets by scale are those of Parseval's energies alone",
        "not beside `scales`",
        "write `budget(parseval, scales)`, and other forms in a model of their own",
    ),
    /// Budgets by scale of a tree that is not in loops over generations.
    ScalesWithoutRule => (
        "budgets by scale are for trees by rule, in loops",
        "no loops over generations of several copies here",
        "describe the whole tree as `generations(count = 5, branching = 2, ...)` with equal \
         copies, without `code = unrolled`, `in_phase` and `locked`; other trees have \
         `budget(parseval, matrix)` by sector",
    ),
    /// `budget()` without any form.
    NoBudgetForm => (
        "no form of the budget is chosen",
        "empty",
        "write `budget` for all exact forms, or choose: `budget(parseval)`",
    ),
    /// `small` without sectors.
    NoSmallSector => (
        "no sector is named as small",
        "empty",
        "write `small(child_d)` with names of sectors, or leave it out to count all \
         differences as small",
    ),
    /// `small(...)` in a budget without truncated forms.
    SmallWithoutOrder => (
        "`small` needs an order",
        "nothing is expanded in it",
        "write `budget(amplitude = 4, small(...))`, or leave it out: other forms are exact",
    ),
    /// A sector that the scene does not have.
    UnknownSector { name: String, nearest: Option<String>, known: String } => (
        format!("unknown sector `{name}`"),
        "not a sector of differences",
        suggest(nearest, format!("sectors are `{known}`")),
    ),
    /// A form of the budget that takes no value.
    BudgetOrder { form: String } => (
        format!("`{form}` has no order"),
        "takes no value",
        format!("write `{form}` alone"),
    ),
    /// A form of the transfer that does not exist.
    UnknownForm { name: String, nearest: Option<&'static str> } => (
        format!("unknown form `{name}` of the transfer"),
        "not a form",
        suggest(nearest, "forms are `angle = 1`, `amplitude = 2`, `exact`"),
    ),
    /// `transfer()` without a form.
    NoForm => (
        "no form of the transfer is chosen",
        "empty",
        "write `transfer` for all forms, or choose: `transfer(exact)`",
    ),
    /// `exact = ...`.
    ExactOrder => (
        "the exact transfer has no order",
        "takes no value",
        "write `exact` alone",
    ),
    /// An order of the difference angles that is not derived.
    AngleOrder => (
        "order of the angles not available",
        "orders are 1 to 8",
        "write `angle = 1` for the form of the paper, or use `exact`",
    ),
    /// An order of the amplitude that is not derived.
    AmplitudeOrder => (
        "order of the amplitude not available",
        "orders are 2 to 8",
        "write `amplitude = 2` for the quadratic form, or use `exact`",
    ),
    /// Symmetric coordinates without identical siblings.
    NoSiblings { request: String } => (
        format!("`{request}` needs identical siblings"),
        "no link has copies",
        "write `child(...) * 2`: links that merely have equal numbers do not count",
    ),
    /// An output that holds between equal copies only.
    UnequalCopies { node: String, wanted: UnequalUse } => (
        wanted.refusal(),
        format!("the copies of `{node}` differ"),
        wanted.hint(),
    ),
    /// Transfer between identical siblings that have children.
    NestedGroups { group: String } => (
        format!(
            "`transfer` needs siblings without children, the copies of `{group}` \
                 have some"
        ),
        "tree not supported",
        "for this tree ask for `budget(canonical, amplitude = 4)`, which knows sectors of \
           any size; `transfer` is for trees whose copied links are leaves",
    ),
    /// Transfer between siblings whose centre of mass lies off their axis.
    LateralTransfer { link: String } => (
        format!("`transfer` needs the centre of mass of `{link}` on its axis"),
        "a lateral centre of mass among the copies",
        "measure the copies' angles from the line through pivot and centre of mass: \
           `com = 0.05` instead of `com = (0.04, 0.03)`",
    ),
    /// A name in an observable that means nothing.
    UnknownSymbol { name: String, nearest: Option<String>, example: String } => (
        format!("unknown symbol `{name}`"),
        "means nothing in this scene",
        suggest(
            nearest,
            format!(
                "observables are made of angles as `theta_{example}`, velocities as \
                 `omega_{example}`, momenta as `p_{example}`, `kinetic_energy`, \
                 `potential_energy`, `gravity`, parameters and the model's constants"
            ),
        ),
    ),
    /// A name in an observable that means two things.
    AmbiguousSymbol { name: String } => (
        format!("`{name}` means two things"),
        "a parameter, and a symbol of the mechanics",
        "give the parameter another name",
    ),
    /// A function in an observable that does not exist.
    UnknownFunction { name: String, known: Vec<&'static str> } => (
        format!("unknown function `{name}`"),
        "not a function of observables",
        format!("functions are {}", listed(known)),
    ),
    /// An observable that would emit a function which exists already.
    FunctionTaken { name: String, function: String } => (
        format!("there is a function `{function}` already"),
        format!("`{name}` would emit it again"),
        format!("choose another name, as in `my_{name}`"),
    ),
    /// Small differences of copies in phase where there are none.
    NoTransverse { request: &'static str } => (
        format!("`{request}` needs copies that move in phase"),
        "nothing moves in phase",
        "add `in_phase(all)`, or `in_phase(child)` with a link that has copies",
    ),
    /// An output that is derived for one tree, of a tree that is described at run time.
    NotAtRunTime { what: String } => (
        format!("no `{what}` at run time"),
        "has to be derived for this tree",
        "leave it out, or let the attribute `#[branched_pendulum(...)]` compile this tree",
    ),
}

/// Why sectors know nothing of a straight spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoChord {
    /// The line ends on the ground.
    Guy,
    /// Something else than a spring stores energy.
    Repulsion,
    /// The spring has a length at rest.
    Rest,
    /// There is a damper.
    Damper,
    /// The links are not copies under one link.
    OtherLinks,
    /// The points are not at the same place of both copies, or these do not hang from one pivot.
    OtherPlaces,
    /// Other copies under the link are not tied to each other likewise.
    SomeCopies,
}

impl NoChord {
    fn label(self) -> &'static str {
        match self {
            Self::Guy => "ends on the ground",
            Self::Repulsion => "repels or attracts by a power of the distance",
            Self::Rest => "has a length at rest",
            Self::Damper => "has a damper",
            Self::OtherLinks => "not between copies under one link",
            Self::OtherPlaces => "not between equal places of copies on one pivot",
            Self::SomeCopies => "not the same between every two of the copies",
        }
    }
}

/// Use of a tree that copies which differ stand against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnequalUse {
    /// An order of the transfer.
    Order,
    /// The budget of sectors.
    Budget,
    /// Copies in phase or joints that are locked.
    Reduction,
}

impl UnequalUse {
    fn refusal(self) -> &'static str {
        match self {
            Self::Order => "truncated forms of W need equal copies",
            Self::Budget => "sectors of unequal copies have no budget",
            Self::Reduction => "`in_phase` and `locked` need a tree of equal copies",
        }
    }

    fn hint(self) -> &'static str {
        match self {
            Self::Order => "write `transfer(exact)`, which splits W into growth and forcing",
            Self::Budget => {
                "write `transfer(exact)` for copies without children, or `observe(...)` for \
                 energies of your own"
            }
            Self::Reduction => "leave this out, or `each(...)`",
        }
    }
}
