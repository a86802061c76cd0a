//! Messages about a description: its links and their names.

use super::{Problem, listed, suggest};

messages! {
    /// A mistake in a description: its links and their names.
    TreeMessage as Tree:

    /// No link.
    EmptyTree => (
        "there is no link",
        "has nothing that could swing",
        "write one, as in `bob: point(mass = 0.1, length = 0.3)`",
    ),
    /// A second link at the top level.
    SecondRoot { first: String } => (
        "there is more than one root",
        format!("hangs beside `{first}`"),
        format!(
            "a description is one tree: hang it from a link, as in `{first}(...) [ ... ]`, \
             or give it an attribute of its own; for pendulums that act on each other \
             otherwise see `docs/limits.md`"
        ),
    ),
    /// Several copies of the root.
    RootCopies => (
        "the root has several copies",
        "copies of the root do not act on each other",
        "leave out the multiplicity and run the model several times",
    ),
    /// A name that already means something else.
    DuplicateName { name: String } => (
        format!("the name `{name}` is taken"),
        "second use of the name",
        "links, copies `name_1`, `name_2`, ..., groups, parameters and observables need \
           names of their own",
    ),
    /// A keyword, or a name that the emitted code uses.
    ReservedName { name: String } => (
        format!("the name `{name}` is reserved"),
        "used by Rust or by the emitted code",
        match name.starts_with(|first: char| first.is_ascii_uppercase()) {
            true => format!("choose another, as in `My{name}`"),
            false => format!("choose another, as in `my_{name}`"),
        },
    ),
    /// A name that is no snake-case identifier.
    NotSnakeCase { name: String, suggestion: Option<String> } => (
        format!("`{name}` is not a snake-case name"),
        "becomes part of names in the emitted code",
        match suggestion {
            Some(suggestion) => format!("write `{suggestion}`"),
            None => "use letters a to z, digits and single underscores, a letter first"
                .to_owned(),
        },
    ),
    /// A shape that is not in the table.
    UnknownShape { name: String, nearest: Option<&'static str>, known: Vec<&'static str> } => (
        format!("unknown shape `{name}`"),
        "not a shape",
        suggest(nearest, format!("shapes are {}", listed(known))),
    ),
    /// A shape where the name of a link stands.
    ShapeWithoutName { shape: &'static str } => (
        format!("the shape `{shape}` without the name of a link"),
        "a shape",
        format!("write a name before the shape: `{shape}: {shape}(...)`"),
    ),
    /// A property that only shapes have, on a link without one.
    ShapeForgotten { link: String, property: &'static str, shape: &'static str } => (
        format!("`{link}` has a `{property}`, but no shape"),
        "no shape",
        format!(
            "write a shape behind the name, as in `{link}: {shape}(...)`; without one a link has \
             `mass`, `com` and `inertia`"
        ),
    ),
    /// A property that the body does not have.
    UnknownProperty {
        name: String,
        body: String,
        nearest: Option<&'static str>,
        known: Vec<&'static str>,
    } => (
        format!("{body} has no property `{name}`"),
        "unknown property",
        suggest(nearest, format!("{body} has {}", listed(known))),
    ),
    /// A property that the body needs.
    MissingProperty { name: &'static str, link: String, body: String } => (
        format!("`{link}` has no `{name}`"),
        "property missing",
        format!("{body} needs it: write `{name} = ...`{}", unit_note(name)),
    ),
    /// Children without a place to hang.
    MissingJoint { link: String } => (
        format!("`{link}` does not say where its children hang"),
        "no `joint`",
        "write `joint = ...`, the distance from its pivot in m, or give each child \
           an `at = ...`",
    ),
    /// `at` on the root.
    RootPivot => (
        "the root does not hang from a link",
        "`at` is a place on the parent",
        "leave it out: the root's pivot is the origin",
    ),
    /// A rest angle, or a length at rest, without a spring.
    RestWithoutSpring { link: String, unit: &'static str } => (
        match *unit {
            "N/m" => format!("`{link}` has a length at rest, but no spring"),
            _ => format!("`{link}` has a rest angle, but no spring"),
        },
        "nothing is at rest here",
        format!("add `spring = ...`, the spring's stiffness in {unit}, or leave `rest` out"),
    ),
    /// A width of friction without a law that has one.
    IdleWidth { link: String } => (
        format!("`{link}` has a width of friction, but nothing that it smooths"),
        "viscous friction has no width",
        "add `coulomb = ...` in N m or `quadratic = ...` in N m s², or leave `width` out",
    ),
    /// Drag of a locked link with another width than that of the link that holds it.
    LockedWidth { link: String } => (
        format!("drag of `{link}` has another width than that of the link it is locked to"),
        "two widths for one link",
        "give both links the same `width`",
    ),
    /// Children of a generation rule.
    RuleChildren => (
        "a generation rule has no other children",
        "the rule makes all children",
        "leave out the brackets, or write the tree link by link",
    ),
    /// A pair where a single value is needed.
    NotAPoint { name: String } => (
        format!("`{name}` is a single value"),
        "a pair",
        "only `com`, `joint` and `at` can be pairs `(along, lateral)`",
    ),
    /// Not a whole number of at least 1.
    NotACount { name: String } => (
        format!("`{name}` is not a whole number of at least 1"),
        "not a count",
        format!("write a literal: `{name} = 3`"),
    ),
    /// Not the name of a shape.
    NotAShape => (
        "`shape` is not the name of a shape",
        "not a name",
        "write `shape = rod`",
    ),
    /// A link that can turn without kinetic energy.
    Singular { link: String } => (
        format!("`{link}` can turn without kinetic energy"),
        "makes the mass matrix singular",
        "give it mass away from its pivot or a moment of inertia",
    ),
    /// No copies.
    ZeroCopies => (
        "zero copies",
        "leaves no link",
        "write `* 1` or more, or leave the link out",
    ),
    /// A reduction that names no link of the description.
    UnknownNode { name: String, nearest: Option<String> } => (
        format!("no link is called `{name}`"),
        "not a link of this description",
        suggest(nearest, "write the name of a link of the description"),
    ),
    /// Copies that should move alike where there are none.
    NothingInPhase { name: String } => (
        format!("nothing to move alike: `{name}` has no copies"),
        "no copies",
        "leave it out, or write copies as in `child(...) * 2`",
    ),
    /// A clause of prescribed links without any.
    NothingPrescribed => (
        "`prescribed()` names no link",
        "no link",
        "write the links whose motion is handed over, as in `prescribed(arm)`",
    ),
    /// A spring or friction between links beside copies in phase.
    SpringDamperInPhase { what: String } => (
        format!("`{what}` beside `in_phase(...)`"),
        "a link in phase stands for several",
        "leave `in_phase(...)` out: copies that start in phase stay so; what acts between the \
         copies of a node, `siblings(...)`, goes with it",
    ),
    /// Copies of a node beside links that do not move in their joints.
    SiblingsBesideLock { what: String } => (
        format!("`{what}` beside `locked(...)`"),
        "copies of locked links hang from one link",
        "write `between(a, b, ...)` for each two copies",
    ),
    /// Not two links between which something acts.
    NotTwoLinks => (
        "`between(...)` does not name two links",
        "not two links",
        "write two links, then what acts between them, as in `between(left, right, spring = 0.1)`",
    ),
    /// Not one node whose copies something acts between.
    NotOneNode => (
        "`siblings(...)` does not name one node",
        "not one node",
        "write the node, then what acts between its copies, as in `siblings(child, spring = 0.1)`",
    ),
    /// A node without copies.
    NoSiblings { name: String } => (
        format!("`{name}` has no copies"),
        "no siblings",
        "write copies as in `child(...) * 2`, or `between(a, b, ...)` for links of other names",
    ),
    /// A spring-damper with neither spring nor friction.
    IdleSpringDamper { what: String } => (
        format!("`{what}` has neither spring nor friction"),
        "nothing acts",
        "write `spring = ...` in N m or `friction = ...` in N m s behind the links",
    ),
    /// A line along which nothing acts.
    IdleStraightSpring { what: String } => (
        format!("`{what}` has neither spring nor friction"),
        "nothing acts",
        "write `spring = ...` in N/m, `friction = ...` in N s/m, or `repulsion = ...` and its \
         `exponent = ...` behind the links",
    ),
    /// A power of the distance without a law that has one.
    IdleExponent { what: String } => (
        format!("`{what}` has an exponent, but no repulsion"),
        "a power of no law",
        "add `repulsion = ...`, the strength A of the energy A/ℓⁿ at the distance ℓ, or leave \
         `exponent` out",
    ),
    /// A power of the distance that no law has.
    NotAnExponent { what: String, largest: u32 } => (
        format!("the exponent of `{what}` is not a whole number from 1 to {largest}"),
        "not such a number",
        "write the power n of the energy A/ℓⁿ at the distance ℓ as a number, as in \
         `repulsion = 1e-5, exponent = 3` for dipoles across the plane",
    ),
    /// Points of a straight spring that are not one for each link.
    NotTwoPoints { what: String } => (
        format!("`each(...)` does not name a point of each link of `{what}`"),
        "not a point for each link",
        "write `at = 0.3` for the same place on all links, or in `between(a, b, ...)` \
         `at = each(0.3, 0.2)`: a distance along `a`, then one along `b`",
    ),
    /// A guy that is tied to no place.
    NotAPeg => (
        "`to` is not a place",
        "not a pair",
        "write `to = (0.4, 0)`: x and y in m from the root's pivot, y upwards",
    ),
    /// Not one link that a guy holds.
    NotOneLink => (
        "`guy(...)` does not name one link",
        "not one link",
        "write the link, then what holds it, as in \
         `guy(mast, at = 0.3, to = (0.4, 0), spring = 60, rest = 0.5)`",
    ),
    /// A straight spring beside links that do not move by themselves.
    StraightSpringInReduction { what: String, noun: &'static str, reduction: &'static str } => (
        format!("`{what}` between points beside `{reduction}(...)`"),
        "no points of links that are merged",
        format!(
            "leave `{reduction}(...)` out, or hand over the {noun}'s forces by \
             `emit(positions, forces)`"
        ),
    ),
    /// A guy beside a pivot that the drive moves.
    GuyBesideMotion { what: String } => (
        format!("`{what}` beside a drive that moves the pivot"),
        "the peg stays where it is",
        "leave `x` and `y` out of `drive(...)`, or hand over the guy's force by \
         `emit(positions, forces)`",
    ),
    /// A straight spring between points that keep their distance.
    RigidLine { what: String } => (
        format!("the points of `{what}` keep their distance"),
        "nothing stretches",
        "write another `at = ...`: no angle moves these points against each other",
    ),
    /// The root as a joint that does not move.
    LockedRoot => (
        "the root cannot be locked",
        "hangs from the ground",
        "describe the links below it as the tree, each tree by itself",
    ),
    /// A generation of a tree in loops as a joint that does not move.
    LockedGeneration { link: String } => (
        format!("`{link}` cannot be locked in a tree that is taken through loops"),
        "a generation of a rule",
        "write `code = unrolled` among the properties of the rule",
    ),
    /// Friction or a spring in a joint that does not move.
    IdleJoint { link: String, property: &'static str } => (
        format!("{property} of `{link}` does nothing in a joint that does not move"),
        "locked",
        format!("leave out {property}, or the lock"),
    ),
    /// The angle of a joint that does not move is no number of radians.
    LockedAngle => (
        "the angle of a locked joint is not a number of radians between -7 and 7",
        "not such a number",
        "write the angle to the link above in radians, as in `locked(arm, 0.3)`",
    ),
}

/// The unit of a property, where it has one.
fn unit_note(name: &str) -> &'static str {
    match name {
        "mass" | "bob_mass" => ", in kg",
        "exponent" => ", the power n of the energy A/ℓⁿ at the distance ℓ",
        "inertia" => ", in kg m² about the centre of mass",
        "com" => ", in m from its pivot",
        "length" | "width" | "radius" => ", in m",
        _ => "",
    }
}
