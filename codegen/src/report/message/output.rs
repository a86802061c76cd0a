//! Messages about a description: the outputs that it asks for.

use super::{Problem, listed, problem, suggest};

/// A mistake in a description: the outputs that it asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OutputMessage {
    /// An output that does not exist.
    UnknownRequest {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// An output asked for twice.
    DuplicateRequest {
        /// The output or form.
        name: String,
    },
    /// Parentheses after an output without forms.
    RequestForms {
        /// The output.
        name: String,
    },
    /// A form of the budget that does not exist.
    UnknownBudgetForm {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// A form of the budget beside `scales` that loops do not have.
    BesideScales,
    /// Budgets by scale of a tree that is not in loops over generations.
    ScalesWithoutRule,
    /// `budget()` without any form.
    NoBudgetForm,
    /// `small` without sectors.
    NoSmallSector,
    /// `small(...)` in a budget without truncated forms.
    SmallWithoutOrder,
    /// A sector that the scene does not have.
    UnknownSector {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<String>,
        /// All that there are.
        known: String,
    },
    /// A form of the budget that takes no value.
    BudgetOrder {
        /// The form.
        form: String,
    },
    /// A form of the transfer that does not exist.
    UnknownForm {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// `transfer()` without a form.
    NoForm,
    /// `exact = ...`.
    ExactOrder,
    /// An order of the difference angles that is not derived.
    AngleOrder,
    /// An order of the amplitude that is not derived.
    AmplitudeOrder,
    /// Symmetric coordinates without identical siblings.
    NoSiblings {
        /// The output.
        request: String,
    },
    /// An output that holds between equal copies only.
    UnequalCopies {
        /// Node whose copies differ.
        node: String,
        /// The output.
        wanted: UnequalUse,
    },
    /// Transfer between identical siblings that have children.
    NestedGroups {
        /// The first such group.
        group: String,
    },
    /// Transfer between siblings whose centre of mass lies off their axis.
    LateralTransfer {
        /// The first such link.
        link: String,
    },
    /// A name in an observable that means nothing.
    UnknownSymbol {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<String>,
        /// One link's angle, as an example.
        example: String,
    },
    /// A name in an observable that means two things.
    AmbiguousSymbol {
        /// The name.
        name: String,
    },
    /// A function in an observable that does not exist.
    UnknownFunction {
        /// Text as written.
        name: String,
        /// All functions.
        known: Vec<&'static str>,
    },
    /// An observable that would emit a function which exists already.
    FunctionTaken {
        /// The observable.
        name: String,
        /// The function.
        function: String,
    },
    /// Small differences of copies in phase where there are none.
    NoTransverse {
        /// `transverse` or `small`.
        request: &'static str,
    },
    /// An output that is derived for one tree, of a tree that is described at run time.
    NotAtRunTime {
        /// The output.
        what: String,
    },
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

impl OutputMessage {
    /// The message in words.
    pub(super) fn problem(&self) -> Problem {
        use OutputMessage as M;
        match self {
            M::UnknownRequest { name, nearest } => problem(
                format!("unknown output `{name}`"),
                "cannot be emitted",
                suggest(
                    nearest,
                    "outputs are `energies`, `momenta`, `modes`, `symmetric`, `transfer(...)`, \
                     `budget(...)`, `taylor`; accelerations are always there",
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
            M::UnknownBudgetForm { name, nearest } => problem(
                format!("unknown form `{name}` of the budget"),
                "not a form",
                suggest(
                    nearest,
                    "forms are `canonical`, `parseval`, `velocity`, `rest`, `matrix`, `scales`, \
                     `angle = 1`, `amplitude = 4`",
                ),
            ),
            M::BesideScales => problem(
                "budgets by scale are those of Parseval's energies alone",
                "not beside `scales`",
                "write `budget(parseval, scales)`, and other forms in a model of their own",
            ),
            M::ScalesWithoutRule => problem(
                "budgets by scale are for trees by rule, in loops",
                "no loops over generations of several copies here",
                "describe the whole tree as `generations(count = 5, branching = 2, ...)` with equal \
                 copies, without `code = unrolled`, `in_phase` and `locked`; other trees have \
                 `budget(parseval, matrix)` by sector",
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
            M::BudgetOrder { form } => problem(
                format!("`{form}` has no order"),
                "takes no value",
                format!("write `{form}` alone"),
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
            M::NestedGroups { group } => problem(
                format!(
                    "`transfer` needs siblings without children, the copies of `{group}` \
                         have some"
                ),
                "tree not supported",
                "for this tree ask for `budget(canonical, amplitude = 4)`, which knows sectors of \
                   any size; `transfer` is for trees whose copied links are leaves",
            ),
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
            M::NoTransverse { request } => problem(
                format!("`{request}` needs copies that move in phase"),
                "nothing moves in phase",
                "add `in_phase(all)`, or `in_phase(child)` with a link that has copies",
            ),
            M::NotAtRunTime { what } => problem(
                format!("no `{what}` at run time"),
                "has to be derived for this tree",
                "leave it out, or let the attribute `#[branched_pendulum(...)]` compile this tree",
            ),
        }
    }
}
