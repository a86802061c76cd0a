//! Messages about the links of a description and their names.

use super::{Problem, listed, suggest};

messages! {
    /// A mistake in the links of a description or in their names.
    TreeMessage as Tree:

    /// The description has no link.
    EmptyTree => (
        "the description has no link",
        "no link here",
        "write one, as in `bob: point(mass = 0.1, length = 0.3)`",
    ),
    /// There is a second link at the top level.
    SecondRoot { first: String } => (
        "the description has more than one root",
        format!("a second root, after `{first}`"),
        format!(
            "a description is one tree: put this link below another one, as in \
             `{first}(...) [ ... ]`, or give it a separate attribute; for pendulums coupled in \
             other ways see `docs/limits.md`"
        ),
    ),
    /// The root has several copies.
    RootCopies => (
        "the root has several copies",
        "copies of the root do not act on each other",
        "leave out the number of copies, and run the model several times",
    ),
    /// A name is already used for something else.
    DuplicateName { name: String } => (
        format!("the name `{name}` is already used"),
        "second use of the name",
        "choose another name: links, copies `name_1`, `name_2`, ..., groups, parameters and \
         observables must all differ",
    ),
    /// A name is a keyword, or the emitted code uses it.
    ReservedName { name: String } => (
        format!("the name `{name}` is reserved"),
        "used by Rust or by the emitted code",
        match name.starts_with(|first: char| first.is_ascii_uppercase()) {
            true => format!("choose another, as in `My{name}`"),
            false => format!("choose another, as in `my_{name}`"),
        },
    ),
    /// A name is not a snake-case identifier.
    NotSnakeCase { name: String, suggestion: Option<String> } => (
        format!("`{name}` is not a snake-case name"),
        "becomes part of names in the emitted code",
        match suggestion {
            Some(suggestion) => format!("write `{suggestion}`"),
            None => "use letters a to z, digits and single underscores, a letter first"
                .to_owned(),
        },
    ),
    /// The shape does not exist.
    UnknownShape { name: String, nearest: Option<&'static str>, known: Vec<&'static str> } => (
        format!("unknown shape `{name}`"),
        "not a shape",
        suggest(nearest, format!("shapes are {}", listed(known))),
    ),
    /// A shape is written without the name of a link before it.
    ShapeWithoutName { shape: &'static str } => (
        format!("the shape `{shape}` has no name of a link before it"),
        "a shape",
        format!("write a name before the shape: `{shape}: {shape}(...)`"),
    ),
    /// A link without a shape has a property that only shapes have.
    ShapeForgotten { link: String, property: &'static str, shape: &'static str } => (
        format!("`{link}` has a `{property}`, but no shape"),
        "no shape",
        format!(
            "write a shape after the name, as in `{link}: {shape}(...)`; a link without a shape \
             has `mass`, `com` and `inertia`"
        ),
    ),
    /// A body of this kind has no such property.
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
    /// A required property of the body is missing.
    MissingProperty { name: &'static str, link: String, body: String } => (
        format!("`{link}` has no `{name}`"),
        "missing property",
        format!("{body} needs it: write `{name} = ...`{}", unit_note(name)),
    ),
    /// The link has children, but no position at which they hang.
    MissingJoint { link: String } => (
        format!("`{link}` has no point from which its children hang"),
        "no `joint`",
        "write `joint = ...`, the distance from its pivot in m, or give each child \
           an `at = ...`",
    ),
    /// The root has the property `at`, a position on a parent.
    RootPivot => (
        "the root has an `at`, but no parent",
        "`at` is a point on the parent",
        "leave it out: the root's pivot is the origin",
    ),
    /// A rest angle or rest length is given without a spring.
    RestWithoutSpring { link: String, unit: &'static str } => (
        match *unit {
            "N/m" => format!("`{link}` has a rest length, but no spring"),
            _ => format!("`{link}` has a rest angle, but no spring"),
        },
        "no spring to be at rest",
        format!("add `spring = ...`, the spring's stiffness in {unit}, or leave `rest` out"),
    ),
    /// A smoothing width of friction is given, but no friction law that uses one.
    IdleWidth { link: String } => (
        format!("`{link}` has a smoothing width, but no Coulomb or quadratic friction"),
        "viscous friction has no width",
        "add `coulomb = ...` in N m or `quadratic = ...` in N m s², or leave `width` out",
    ),
    /// Static friction is less than Coulomb friction.
    StaticBelowCoulomb { link: String } => (
        format!("the static friction of `{link}` is less than its Coulomb friction"),
        "less than `coulomb`",
        "write the friction at rest, which is at least the friction in motion",
    ),
    /// A static friction is given without a Stribeck rate.
    StaticWithoutRate { link: String } => (
        format!("`{link}` has static friction, but no Stribeck rate"),
        "the rate at which it falls to Coulomb friction is not given",
        "add `stribeck = ...` in rad/s: half of the excess over `coulomb` is left at this rate",
    ),
    /// A Stribeck rate is given without a static friction.
    RateWithoutStatic { link: String } => (
        format!("`{link}` has a Stribeck rate, but no static friction"),
        "no friction to fall to Coulomb friction",
        "add `static = ...` in N m, at least the Coulomb friction, or leave `stribeck` out",
    ),
    /// Drag of a locked link has a smoothing width other than that of the link that it is locked
    /// to.
    LockedWidth { link: String } => (
        format!("the drag of `{link}` has another width than the link that it is locked to"),
        "two widths for one body",
        "give both links the same `width`",
    ),
    /// A generation rule is given further children.
    RuleChildren => (
        "a generation rule cannot have other children",
        "the rule creates all children",
        "leave out the brackets, or write the tree link by link",
    ),
    /// A pair is given instead of a single value.
    NotAPoint { name: String } => (
        format!("`{name}` is a pair instead of a single value"),
        "a pair",
        "write one number; only `com`, `joint` and `at` can be pairs `(along, lateral)`",
    ),
    /// The value is not a whole number of at least 1.
    NotACount { name: String } => (
        format!("`{name}` is not a whole number of at least 1"),
        "expected a whole number",
        format!("write a number: `{name} = 3`"),
    ),
    /// `open` is given in a rule that cannot have one open branching per generation.
    OpenBranching { needs: &'static str } => (
        format!("`open` needs {needs}"),
        "one branching of each generation cannot be open here",
        "write `generations(count = 20, branching = 2, open = 1, ...)`: of each generation one \
         branching into two links is open, and all other copies move in phase",
    ),
    /// The value of `shape` is not a name.
    NotAShape => (
        "the value of `shape` is not the name of a shape",
        "expected a name",
        "write `shape = rod`",
    ),
    /// The link can turn without kinetic energy.
    Singular { link: String } => (
        format!("`{link}` can turn without kinetic energy"),
        "makes the mass matrix singular",
        "give it mass away from its pivot or a moment of inertia",
    ),
    /// The number of copies is zero.
    ZeroCopies => (
        "the number of copies is zero",
        "no link remains",
        "write `* 1` or more, or leave the link out",
    ),
    /// `in_phase`, `locked` or `prescribed` names a link that does not exist.
    UnknownNode { name: String, nearest: Option<String> } => (
        format!("no link is called `{name}`"),
        "not a link of this description",
        suggest(nearest, "write the name of a link of the description"),
    ),
    /// `in_phase` names a link without copies.
    NothingInPhase { name: String } => (
        format!("`{name}` has no copies that could move in phase"),
        "no copies",
        "leave it out, or write copies as in `child(...) * 2`",
    ),
    /// `prescribed()` names no link.
    NothingPrescribed => (
        "`prescribed()` names no link",
        "no link",
        "name the links whose motion the caller prescribes, as in `prescribed(arm)`",
    ),
    /// A spring or friction between links is combined with copies in phase.
    SpringDamperInPhase { what: String, setting: &'static str } => (
        format!("`{what}` cannot be combined with `{setting}`"),
        "a link in phase represents several links",
        format!(
            "leave `{setting}` out: copies that start in phase stay in phase; a spring between the \
             copies of a node, `siblings(...)`, can be combined with it"
        ),
    ),
    /// A spring or friction between the copies of a node is combined with locked joints.
    SiblingsBesideLock { what: String } => (
        format!("`{what}` cannot be combined with `locked(...)`"),
        "copies of locked links hang from one link",
        "write `between(a, b, ...)` for every two copies",
    ),
    /// `between(...)` does not name exactly two links.
    NotTwoLinks => (
        "`between(...)` does not name two links",
        "expected two links",
        "name two links, then the spring or friction between them, as in \
         `between(left, right, spring = 0.1)`",
    ),
    /// `siblings(...)` does not name exactly one node.
    NotOneNode => (
        "`siblings(...)` does not name one node",
        "expected one node",
        "name the node, then the spring or friction between its copies, as in \
         `siblings(child, spring = 0.1)`",
    ),
    /// `siblings(...)` names a node without copies.
    NoSiblings { name: String } => (
        format!("`{name}` has no copies"),
        "no copies",
        "write copies as in `child(...) * 2`, or `between(a, b, ...)` for links of other names",
    ),
    /// A torsion spring-damper has neither a spring nor friction.
    IdleSpringDamper { what: String } => (
        format!("`{what}` has neither spring nor friction"),
        "has no effect",
        "write `spring = ...` in N m or `friction = ...` in N m s after the links",
    ),
    /// A straight spring has neither a spring, friction nor a repulsion.
    IdleStraightSpring { what: String } => (
        format!("`{what}` has neither spring, friction nor repulsion"),
        "has no effect",
        "write `spring = ...` in N/m, `friction = ...` in N s/m, or `repulsion = ...` and its \
         `exponent = ...` after the links",
    ),
    /// An exponent is given without the repulsion that it belongs to.
    IdleExponent { what: String } => (
        format!("`{what}` has an exponent, but no repulsion"),
        "no repulsion uses it",
        "add `repulsion = ...`, the strength A of the energy A/ℓⁿ at the distance ℓ, or leave \
         `exponent` out",
    ),
    /// The exponent of a repulsion is not a whole number in the accepted range.
    NotAnExponent { what: String, largest: u32 } => (
        format!("the exponent of `{what}` is not a whole number from 1 to {largest}"),
        format!("expected a whole number from 1 to {largest}"),
        "write the power n of the energy A/ℓⁿ at the distance ℓ as a number, as in \
         `repulsion = 1e-5, exponent = 3` for dipoles across the plane",
    ),
    /// The attachment points of a straight spring do not match its links one to one.
    NotTwoPoints { what: String } => (
        format!("`each(...)` does not give one point for each link of `{what}`"),
        "expected one point for each link",
        "write `at = 0.3` for the same point of all links, or in `between(a, b, ...)` \
         `at = each(0.3, 0.2)`: a distance along `a`, then one along `b`",
    ),
    /// The fixed end of a guy is not a pair of coordinates.
    NotAPeg => (
        "`to` is not a point",
        "expected a pair",
        "write `to = (0.4, 0)`: x and y in m from the root's pivot, y upwards",
    ),
    /// `guy(...)` does not name exactly one link.
    NotOneLink => (
        "`guy(...)` does not name one link",
        "expected one link",
        "name the link, then the properties of the guy, as in \
         `guy(mast, at = 0.3, to = (0.4, 0), spring = 60, rest = 0.5)`",
    ),
    /// A straight spring is combined with copies in phase or locked joints.
    StraightSpringInReduction { what: String, noun: &'static str, reduction: &'static str } => (
        format!("`{what}` between points cannot be combined with `{reduction}`"),
        "merged links have no separate points",
        format!(
            "leave `{reduction}` out, or compute the {noun}'s forces yourself with \
             `emit(positions, forces)`"
        ),
    ),
    /// A guy is combined with a drive that moves the pivot.
    GuyBesideMotion { what: String } => (
        format!("`{what}` cannot be combined with a drive that moves the pivot"),
        "its fixed end would not move with the pivot",
        "leave `x` and `y` out of `drive(...)`, or compute the guy's force yourself with \
         `emit(positions, forces)`",
    ),
    /// A straight spring connects two points whose distance cannot change.
    RigidLine { what: String } => (
        format!("the distance between the points of `{what}` cannot change"),
        "never stretches",
        "write another `at = ...`: no angle moves these points relative to each other",
    ),
    /// The root is locked.
    LockedRoot => (
        "the root cannot be locked",
        "hangs from the ground",
        "describe the links below it as separate trees",
    ),
    /// A link of a generation rule in loops is locked.
    LockedGeneration { link: String } => (
        format!("`{link}` cannot be locked in a tree whose code is loops"),
        "a generation of a rule",
        "write `code = unrolled` among the properties of the rule",
    ),
    /// A locked joint has friction or a spring.
    IdleJoint { link: String, property: &'static str } => (
        format!("{property} of `{link}` has no effect in a locked joint"),
        "the joint is locked",
        format!("leave out {property}, or do not lock the joint"),
    ),
    /// The angle of a locked joint is not a number of radians in the accepted range.
    LockedAngle => (
        "the angle of a locked joint is not a number of radians from -7 to 7",
        "expected a number from -7 to 7",
        "write the angle relative to the parent in radians, as in `locked(arm, 0.3)`",
    ),
}

/// Returns the unit of a property, or the meaning of its value, for the end of a hint; empty if it
/// has none.
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
