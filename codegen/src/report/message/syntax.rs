//! Messages about a description: its tokens, the struct and the settings.

use super::{Problem, suggest};
use crate::report::SceneSetting;

messages! {
    /// A mistake in a description: its tokens, the struct and the settings.
    SyntaxMessage as Syntax:

    /// Text that has no tokens of Rust.
    NoTokens => (
        "unreadable text",
        "no token starts here, or brackets do not match",
        "write a description as in `gravity = 9.80665, rod: rod(mass = 1, length = 1)`",
    ),
    /// Another token should stand here.
    Expected { what: &'static str, found: String } => (
        format!("expected {what}"),
        format!("`{found}` stands here"),
        format!("in place of `{found}` write {what}"),
    ),
    /// Neither a link nor a setting.
    NotAnEntry { found: String } => (
        "expected a link or a setting",
        format!("`{found}` stands here"),
        format!(
            "write a link as in `rod: rod(mass = 0.2, length = 1)`, of which copies stand behind \
             it, as in `child(...) * 2`; settings are {}",
            SceneSetting::listed(),
        ),
    ),
    /// A description between quotes.
    Quoted => (
        "the description is a string",
        "quotes",
        "write its tokens without quotes: `gravity = 9.80665, rod: rod(mass = 0.2, length = 1)`",
    ),
    /// A name without anything behind it.
    LoneName { name: String } => (
        format!("`{name}` stands alone"),
        "neither a link nor a setting",
        format!("write a link with its shape, as in `{name}: rod(mass = 0.2, length = 1)`"),
    ),
    /// `=` between a link and its shape.
    LinkByEquals { link: String, shape: String } => (
        format!("`=` between the link `{link}` and its shape"),
        "`:` stands here",
        format!("write `{link}: {shape}(...)`"),
    ),
    /// A number of copies that is no whole number.
    NotCopies { found: String } => (
        "the number of copies is not a whole number",
        format!("`{found}` stands here"),
        "write a literal, as in `child(...) * 2`: the number of links is part of the code",
    ),
    /// `:` where a value follows.
    Colon { name: String } => (
        format!("`:` behind `{name}`"),
        "a value follows `=`",
        format!("write `{name} = ...`; `:` stands between a link and its shape only"),
    ),
    /// Brackets of the wrong kind.
    Brackets { what: &'static str, wanted: &'static str } => (
        format!("{what} in the wrong brackets"),
        format!("{what} stand in `{wanted}`"),
        "write `parent(mass = 0.1, ...) [ child(...), ... ]`",
    ),
    /// Two members of a list without a comma between them.
    MissingComma { before: String } => (
        format!("no comma before `{before}`"),
        "the next member of the list",
        format!("write `, {before}`"),
    ),
    /// A unit behind a number.
    Unit { unit: String } => (
        format!("the unit `{unit}` behind a number"),
        "units are not written",
        "write the number alone, in SI units: kg, m, s and what is formed of them",
    ),
    /// The list ends too early.
    Ended { what: &'static str } => (
        format!("expected {what}"),
        "missing before this",
        format!("write {what}"),
    ),
    /// Brackets or parentheses nested too deeply.
    Nesting { limit: usize } => (
        format!("more than {limit} levels of brackets"),
        "too deep",
        "write long chains by rule: `chain: generations(count = 100, ...)`",
    ),
    /// The attribute stands on something else than a struct.
    NotAStruct => (
        "the attribute stands on something else than a struct",
        "not a struct",
        "put it on a struct without fields: `pub struct Pendulum;`",
    ),
    /// The struct has fields.
    StructFields { name: String } => (
        format!("struct `{name}` has fields"),
        "must be without fields",
        format!("write `struct {name};`, the fields follow from the description"),
    ),
    /// The struct has generic parameters.
    StructGenerics { name: String } => (
        format!("struct `{name}` is generic"),
        "must be without parameters",
        format!("write `struct {name};`, its functions are generic over the scalar"),
    ),
    /// `Default` among the derives of a struct of which the attribute writes it.
    DefaultDerived => (
        "`Default` is derived, and the attribute writes it too",
        "written by the attribute",
        "leave it out of `derive(...)`: a model without parameters is `Default`; every model is \
         `Clone`, `Debug` and `PartialEq`, and `Copy` unless its code is loops, derived or not",
    ),
    /// `Default` among the derives of a struct with parameters.
    DefaultOfParameters => (
        "`Default` is derived for a model with parameters",
        "would set masses and lengths to zero",
        "leave it out of `derive(...)`, and build the model with `new` from its parameters",
    ),
    /// `Copy` among the derives of a struct whose code is loops.
    CopyInLoops => (
        "`Copy` is derived for a model whose code is loops",
        "holds its constants on the heap",
        "leave it out of `derive(...)`, or ask for `code = unrolled`; `Clone` is there",
    ),
    /// An unknown setting of the scene.
    UnknownEntry { name: String, nearest: Option<&'static str> } => (
        format!("unknown setting `{name}`"),
        "not a setting of the scene",
        suggest(nearest, format!("settings are {}", SceneSetting::listed())),
    ),
    /// A setting with parentheses in place of `=`, or the other way round.
    SettingForm { setting: &'static SceneSetting } => (
        format!("expected `{}` behind `{}`", setting.mark(), setting.name),
        "something else stands there",
        format!("write it as in `{}`", setting.example),
    ),
    /// No gravity.
    MissingGravity => (
        "gravity is missing",
        "described without `gravity`",
        "write `gravity = 9.80665`, in m/s²",
    ),
    /// A property or setting given twice.
    DuplicateProperty { name: String } => (
        format!("`{name}` is given twice"),
        "given before",
        "keep one of them",
    ),
    /// A way to write code that is none.
    NotACode => (
        "`code` is neither `loops` nor `unrolled`",
        "not a way to write code",
        "write `code = loops`, `code = unrolled`, or nothing: large trees get loops",
    ),
    /// A way to solve that does not exist.
    UnknownSolve { name: String, nearest: Option<&'static str> } => (
        format!("unknown way to solve `{name}`"),
        "no way to solve for the accelerations",
        suggest(
            nearest,
            "`factorization` or `recursion`; without `solve` the one of fewer operations",
        ),
    ),
}

impl SyntaxMessage {
    /// A property or setting given twice.
    pub fn duplicate_property(name: &impl ToString) -> Self {
        Self::DuplicateProperty {
            name: name.to_string(),
        }
    }

    /// An unknown setting of the scene.
    pub fn unknown_entry(name: String) -> Self {
        let nearest = SceneSetting::nearest(&name).map(|setting| setting.name);
        Self::UnknownEntry { name, nearest }
    }
}
