//! Messages about the tokens of a description, the struct and the settings.

use super::{Problem, suggest};
use crate::report::SceneSetting;

messages! {
    /// A mistake in the tokens of a description, the struct or the settings.
    SyntaxMessage as Syntax:

    /// The text cannot be split into Rust tokens.
    NoTokens => (
        "the text cannot be split into Rust tokens",
        "invalid token, or unbalanced brackets",
        "write a description as in `gravity = 9.80665, rod: rod(mass = 1, length = 1)`",
    ),
    /// Another token was expected.
    Expected { what: &'static str, found: String } => (
        format!("expected {what}, found `{found}`"),
        "unexpected",
        format!("write {what}"),
    ),
    /// The member is neither a link nor a setting.
    NotAnEntry { found: String } => (
        format!("expected a link or a setting, found `{found}`"),
        "neither a link nor a setting",
        format!(
            "write a link as in `rod: rod(mass = 0.2, length = 1)`, with a number of copies as in \
             `child(...) * 2`, or a setting: {}",
            SceneSetting::listed(),
        ),
    ),
    /// The description is a string literal.
    Quoted => (
        "the description is a string literal",
        "in quotes",
        "remove the quotes: `gravity = 9.80665, rod: rod(mass = 0.2, length = 1)`",
    ),
    /// Nothing follows a name.
    LoneName { name: String } => (
        format!("`{name}` is neither a link nor a setting"),
        "a name alone",
        format!("write a link with its shape, as in `{name}: rod(mass = 0.2, length = 1)`"),
    ),
    /// `=` instead of `:` between a link and its shape.
    LinkByEquals { link: String, shape: String } => (
        format!("expected `:` between the link `{link}` and its shape, found `=`"),
        "expected `:`",
        format!("write `{link}: {shape}(...)`"),
    ),
    /// The number of copies is not a whole number.
    NotCopies { found: String } => (
        format!("the number of copies is not a whole number: `{found}`"),
        "expected a whole number",
        "write a number, as in `child(...) * 2`: the number of links is fixed in the code",
    ),
    /// `:` instead of `=` before a value.
    Colon { name: String } => (
        format!("expected `=` after `{name}`, found `:`"),
        "expected `=`",
        format!("write `{name} = ...`; `:` separates only a link and its shape"),
    ),
    /// A list has brackets of the wrong kind.
    Brackets { what: &'static str, wanted: &'static str } => (
        format!("the {what} are in the wrong brackets"),
        format!("expected `{wanted}`"),
        "write `parent(mass = 0.1, ...) [ child(...), ... ]`",
    ),
    /// The comma between two members of a list is missing.
    MissingComma { before: String } => (
        format!("missing comma before `{before}`"),
        "the next member of the list",
        format!("write `, {before}`"),
    ),
    /// A unit follows a number.
    Unit { unit: String } => (
        format!("a number is followed by the unit `{unit}`"),
        "units are not written",
        "write the number alone, in SI units: kg, m, s and units derived from them",
    ),
    /// A list ends before the expected token.
    Ended { what: &'static str } => (
        format!("expected {what}, found the end of the list"),
        "ends here",
        format!("write {what}"),
    ),
    /// Brackets or parentheses nested too deeply.
    Nesting { limit: usize } => (
        format!("brackets are nested more than {limit} levels deep"),
        "too deep",
        "describe a long chain by a rule: `chain: generations(count = 100, ...)`",
    ),
    /// The runtime crate has another name in this package.
    RenamedCrate { name: String } => (
        format!("the crate `branched_pendulum` is called `{name}` here"),
        "the emitted code needs the name of the crate",
        format!("write `crate = ::{name}` into the attribute"),
    ),
    /// The attribute is not on a struct.
    NotAStruct => (
        "the attribute is not on a struct",
        "not a struct",
        "put it on a struct without fields: `pub struct Pendulum;`",
    ),
    /// The struct has fields.
    StructFields { name: String } => (
        format!("struct `{name}` has fields"),
        "expected a struct without fields",
        format!("write `struct {name};`: the attribute generates the fields"),
    ),
    /// The struct has generic parameters or a where clause.
    StructGenerics { name: String } => (
        format!("struct `{name}` is generic"),
        "expected a struct without generic parameters",
        format!("write `struct {name};`: its functions are generic over the scalar type"),
    ),
    /// `Default` is derived for a struct for which the attribute implements it.
    DefaultDerived => (
        "`Default` is derived, but the attribute implements it already",
        "implemented by the attribute",
        "remove it from `derive(...)`: a model without parameters is `Default`; every model is \
         `Clone`, `Debug` and `PartialEq`, and `Copy` unless its code is loops, derived or not",
    ),
    /// `Default` is derived for a struct with parameters.
    DefaultOfParameters => (
        "`Default` is derived for a model with parameters",
        "would set masses and lengths to zero",
        "remove it from `derive(...)`, and create the model from its parameters with `new`",
    ),
    /// `Copy` is derived for a struct whose code is loops.
    CopyInLoops => (
        "`Copy` is derived for a model whose code is loops",
        "this model stores its constants on the heap",
        "remove it from `derive(...)` and use `Clone`, or write `code = unrolled`",
    ),
    /// The scene has no setting of this name.
    UnknownEntry { name: String, nearest: Option<&'static str> } => (
        format!("unknown setting `{name}`"),
        "not a setting of the scene",
        suggest(nearest, format!("settings are {}", SceneSetting::listed())),
    ),
    /// A setting has parentheses instead of `=`, or `=` instead of parentheses.
    SettingForm { setting: &'static SceneSetting } => (
        format!("expected `{}` after `{}`", setting.mark(), setting.name),
        "found something else",
        format!("write it as in `{}`", setting.example),
    ),
    /// The description does not set gravity.
    MissingGravity => (
        "gravity is missing",
        "no `gravity` in this description",
        "write `gravity = 9.80665`, in m/s²",
    ),
    /// A property or setting is given twice.
    DuplicateProperty { name: String } => (
        format!("`{name}` is given twice"),
        "already given",
        "keep one of them",
    ),
    /// The value of `code` is neither `loops` nor `unrolled`.
    NotACode => (
        "`code` is neither `loops` nor `unrolled`",
        "unknown value",
        "write `code = loops` or `code = unrolled`, or leave it out: large trees get loops",
    ),
    /// The value of `solve` is not a method of solving for the accelerations.
    UnknownSolve { name: String, nearest: Option<&'static str> } => (
        format!("unknown value `{name}` of `solve`"),
        "not a method of solving for the accelerations",
        suggest(
            nearest,
            "write `solve = factorization` or `solve = recursion`, or leave it out: the method \
             with fewer operations is chosen",
        ),
    ),
}

impl SyntaxMessage {
    /// Creates the message that a property or setting is given twice.
    pub fn duplicate_property(name: &impl ToString) -> Self {
        Self::DuplicateProperty {
            name: name.to_string(),
        }
    }

    /// Creates the message that a setting is unknown, with the most similar known name.
    pub fn unknown_entry(name: String) -> Self {
        let nearest = SceneSetting::nearest(&name).map(|setting| setting.name);
        Self::UnknownEntry { name, nearest }
    }
}
