//! Messages about a description: its links and their names.

use super::{Problem, listed, problem, suggest};

/// A mistake in a description: its links and their names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TreeMessage {
    /// No link.
    EmptyTree,
    /// A second link at the top level.
    SecondRoot {
        /// The first root.
        first: String,
    },
    /// Several copies of the root.
    RootCopies,
    /// A name that already means something else.
    DuplicateName {
        /// The name.
        name: String,
    },
    /// A keyword, or a name that the emitted code uses.
    ReservedName {
        /// The name.
        name: String,
    },
    /// A name that is no snake-case identifier.
    NotSnakeCase {
        /// Text as written.
        name: String,
        /// Text as it could be written.
        suggestion: Option<String>,
    },
    /// A shape that is not in the table.
    UnknownShape {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
        /// All shapes.
        known: Vec<&'static str>,
    },
    /// A property that the body does not have.
    UnknownProperty {
        /// Text as written.
        name: String,
        /// The body: "a link", "a `rod`".
        body: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
        /// All properties of the body.
        known: Vec<&'static str>,
    },
    /// A property that the body needs.
    MissingProperty {
        /// The property.
        name: &'static str,
        /// Name of the link.
        link: String,
        /// The body: "a link", "a `rod`".
        body: String,
    },
    /// Children without a place to hang.
    MissingJoint {
        /// The link that they hang from.
        link: String,
    },
    /// `at` on the root.
    RootPivot,
    /// A rest angle without a spring.
    RestWithoutSpring {
        /// The link.
        link: String,
    },
    /// A width of friction without a law that has one.
    IdleWidth {
        /// The link.
        link: String,
    },
    /// Drag of a locked link with another width than that of the link that holds it.
    LockedWidth {
        /// The link.
        link: String,
    },
    /// Children of a generation rule.
    RuleChildren,
    /// A pair where a single value is needed.
    NotAPoint {
        /// The property.
        name: String,
    },
    /// Not a whole number of at least 1.
    NotACount {
        /// The property.
        name: String,
    },
    /// Not the name of a shape.
    NotAShape,
    /// A link that can turn without kinetic energy.
    Singular {
        /// The link.
        link: String,
    },
    /// No copies.
    ZeroCopies,
    /// A reduction that names no link of the description.
    UnknownNode {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<String>,
    },
    /// Copies that should move alike where there are none.
    NothingInPhase {
        /// The link, or `all`.
        name: String,
    },
    /// A clause of prescribed links without any.
    NothingPrescribed,
    /// The root as a joint that does not move.
    LockedRoot,
    /// A generation of a tree in loops as a joint that does not move.
    LockedGeneration {
        /// The link.
        link: String,
    },
    /// Friction or a spring in a joint that does not move.
    IdleJoint {
        /// The link.
        link: String,
        /// The property.
        property: &'static str,
    },
    /// The angle of a joint that does not move is no number of radians.
    LockedAngle,
}

impl TreeMessage {
    /// The message in words.
    pub(super) fn problem(&self) -> Problem {
        use TreeMessage as M;
        match self {
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
            M::IdleWidth { link } => problem(
                format!("`{link}` has a width of friction, but nothing that it smooths"),
                "viscous friction has no width",
                "add `coulomb = ...` in N m or `quadratic = ...` in N m s², or leave `width` out",
            ),
            M::LockedWidth { link } => problem(
                format!("drag of `{link}` has another width than that of the link it is locked to"),
                "two widths for one link",
                "give both links the same `width`",
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
            M::UnknownNode { name, nearest } => problem(
                format!("no link is called `{name}`"),
                "not a link of this description",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => "write the name of a link of the description".to_owned(),
                },
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
        }
    }
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
