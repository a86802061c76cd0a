//! The catalogue of messages: all that the front end has to say to a user.

use super::nearest::nearest;

/// A mistake in a description.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Message {
    /// Another token should stand here.
    Expected {
        /// The token that should.
        what: &'static str,
    },
    /// `:` where a value follows.
    Colon {
        /// Name of the value.
        name: String,
    },
    /// Brackets of the wrong kind.
    Brackets {
        /// Contents of the brackets.
        what: &'static str,
        /// The right ones.
        wanted: &'static str,
    },
    /// Two members of a list without a comma between them.
    MissingComma {
        /// The second one.
        before: String,
    },
    /// A unit behind a number.
    Unit {
        /// The unit, as far as its first name.
        unit: String,
    },
    /// A name of something else as a parameter, as in `joint = prismatic`.
    Lookalike {
        /// The name.
        name: String,
        /// Kind of thing that it names.
        kind: Lookalike,
    },
    /// A value that is infinite or no number.
    NotFinite {
        /// As written.
        name: String,
    },
    /// The list ends too early.
    Ended {
        /// The missing token.
        what: &'static str,
    },
    /// Brackets or parentheses nested too deeply.
    Nesting {
        /// Deepest nesting allowed.
        limit: usize,
    },
    /// The attribute stands on something else than a struct.
    NotAStruct,
    /// The struct has fields.
    StructFields {
        /// The struct.
        name: String,
    },
    /// The struct has generic parameters.
    StructGenerics {
        /// The struct.
        name: String,
    },
    /// An unknown setting of the scene.
    UnknownEntry {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// No gravity.
    MissingGravity,
    /// No link.
    EmptyTree,
    /// A second link at the top level.
    SecondRoot {
        /// The first root.
        first: String,
    },
    /// Several copies of the root.
    RootCopies,
    /// A property or setting given twice.
    DuplicateProperty {
        /// The property.
        name: String,
    },
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
    /// A name that is no declared parameter.
    UndeclaredParameter {
        /// Text as written.
        name: String,
        /// The declared one that is spelt most alike.
        nearest: Option<String>,
    },
    /// A declared parameter that no value names.
    UnusedParameter {
        /// The parameter.
        name: String,
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
    /// A value below zero that must not be.
    Negative {
        /// Name of it, as in "mass of `child`".
        what: String,
        /// The value.
        value: String,
    },
    /// A value that must be above zero.
    NotPositive {
        /// Name of it, as in "length of `child`".
        what: String,
        /// The value.
        value: String,
    },
    /// A link that can turn without kinetic energy.
    Singular {
        /// The link.
        link: String,
    },
    /// No copies.
    ZeroCopies,
    /// A way to write code that is none.
    NotACode,
    /// Code in loops for something that it does not do.
    NoLoops {
        /// Name of it, as in "`emit(modes)`".
        what: String,
    },
    /// More links than can be expanded, of a rule whose code cannot be loops.
    TooManyForUnrolled {
        /// Name of it, as in "`emit(modes)`".
        what: String,
        /// The limit.
        limit: usize,
    },
    /// More links than can be expanded.
    TooManyLinks {
        /// The limit.
        limit: usize,
    },
    /// More pairs of a link and one above it than can be written out.
    TooManyPairs {
        /// Number of pairs.
        pairs: usize,
        /// The limit.
        limit: usize,
    },
    /// Formulas longer than the derivation goes on with.
    TooManyTerms {
        /// The limit.
        limit: u64,
    },
    /// More values in the code than are written.
    TooManyValues {
        /// The limit.
        limit: usize,
    },
    /// A divisor that is zero.
    DivisionByZero,
    /// A literal that is no plain decimal number.
    NotDecimal {
        /// Text as written.
        text: String,
    },
    /// A number that no `f64` can hold.
    NumberRange,
    /// A number with too many digits to go on exactly.
    NumberLength,
    /// An exponent that is no small whole number.
    Exponent,
    /// A power of a power without parentheses.
    ChainedPower,
    /// A function in a value.
    FunctionCall {
        /// The function.
        name: String,
    },
    /// A function in the drive that does not exist.
    DriveFunction {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// `drive()` without a torque or a motion.
    EmptyDrive,
    /// A part of the drive that does not exist.
    UnknownDrive {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// A divisor in the drive that depends on time.
    TimeDivisor,
    /// `t` where nothing depends on time.
    TimeOutsideDrive,
    /// A mathematical constant without exact value.
    NotExact {
        /// The name.
        name: String,
        /// Its value in digits.
        digits: &'static str,
    },
    /// An output that does not exist.
    UnknownRequest {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// A way to solve that does not exist.
    UnknownSolve {
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
    /// `each(...)` where there are no copies.
    EachWithoutCopies,
    /// `each(...)` in a generation rule.
    EachInRule {
        /// The rule.
        link: String,
    },
    /// `each(...)` with more or fewer values than copies.
    EachCount {
        /// The link.
        link: String,
        /// Number of copies.
        copies: usize,
        /// Number of values.
        values: usize,
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
    /// Too high a power of parameters.
    Degree {
        /// Highest power allowed.
        limit: u32,
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
    /// A reduction that names no link of the description.
    UnknownNode {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<String>,
    },
    /// Small differences of copies in phase where there are none.
    NoTransverse,
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
    /// A product of masses and lengths that no `f64` can hold.
    ConstantRange {
        /// The constant.
        name: String,
    },
    /// The derivation could not be run.
    Algebra(String),
}

/// Kind of thing for which a name is taken where it stands as a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lookalike {
    /// A type of joint.
    Joint,
    /// A function.
    Function,
    /// An angle or its rate.
    Motion,
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

impl Message {
    /// A property or setting given twice.
    pub fn duplicate_property(name: &impl ToString) -> Self {
        Self::DuplicateProperty {
            name: name.to_string(),
        }
    }

    /// An unknown setting of the scene.
    pub fn unknown_entry(name: String) -> Self {
        let nearest = nearest(
            &name,
            &[
                "gravity",
                "crate",
                "solve",
                "code",
                "parameters",
                "drive",
                "emit",
                "observe",
                "in_phase",
                "locked",
                "prescribed",
            ],
        );
        Self::UnknownEntry { name, nearest }
    }
}
