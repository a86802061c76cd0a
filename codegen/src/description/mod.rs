//! The description as written: the grammar of the attribute, with source
//! positions.
//!
//! ```text
//! attribute   = [ entry { "," entry } [ "," ] ]
//! entry       = "crate" "=" path
//!             | "gravity" "=" expression
//!             | "solve" "=" name
//!             | "code" "=" name
//!             | "emit" "(" [ request { "," request } [ "," ] ] ")"
//!             | "parameters" "(" [ name { "," name } [ "," ] ] ")"
//!             | "drive" "(" [ property { "," property } [ "," ] ] ")"
//!             | "observe" "(" [ observable { "," observable } [ "," ] ] ")"
//!             | "in_phase" "(" [ name { "," name } [ "," ] ] ")"
//!             | "locked" "(" name "," expression ")"
//!             | "prescribed" "(" name { "," name } [ "," ] ")"
//!             | ( "between" | "siblings" | "guy" ) "(" name { "," name } { "," property } [ "," ] ")"
//!             | link
//! link        = name [ ":" shape ] "(" [ property { "," property } [ "," ] ] ")"
//!               [ "[" [ link { "," link } [ "," ] ] "]" ] [ "*" integer ]
//! property    = name "=" value
//! value       = point | "each" "(" point { "," point } [ "," ] ")"
//! point       = expression | "(" expression "," expression ")"
//! request     = name [ "(" [ form { "," form } [ "," ] ] ")" ]
//! form        = name [ "=" integer | "(" [ name { "," name } [ "," ] ] ")" ]
//! observable  = name "=" expression
//!
//! expression  = term { ( "+" | "-" ) term }
//! term        = factor { ( "*" | "/" ) factor }
//! factor      = [ "-" ] power
//! power       = primary [ "^" ( [ "-" ] integer | "(" [ "-" ] integer ")" ) ]
//! primary     = decimal | name | function | "(" expression ")"
//! function    = name "(" expression ")"
//! ```
//!
//! Unlike in Rust, `^` is a power and binds tightest: `-a^2` is `-(a^2)`. A
//! `decimal` is read exactly; a `name` is a parameter of the model, the same
//! name being the same parameter everywhere; where `parameters(...)` declares them, no
//! other name is one. In observables a `name` is a symbol
//! of the scene (an angle, a velocity, a momentum, a parameter, a constant of the
//! model), and only they and drives have functions. A pair is a point of a link,
//! `(along, lateral)`; a single value there means `(along, 0)`. Copies of a link may differ:
//! `each(...)` holds a value for each. Which properties,
//! requests, symbols and functions there are, and what they mean, is the
//! business of [`scene`](crate::scene); this module knows their shape only.

mod expression;
mod item;
mod list;
mod misread;
mod parse;
mod properties;
mod requests;
mod source;
mod text;

use proc_macro2::{Ident, Span, TokenStream};

pub use expression::{Expression, ExpressionKind};
pub use parse::parse;
pub use source::parse_text;

/// The name of time in `drive(...)`, s.
pub const TIME: &str = "t";

/// An attribute and the struct it stands on.
#[derive(Debug, Clone)]
pub struct Description {
    /// The struct.
    pub item: StructItem,
    /// The value of `crate = ...`.
    pub crate_path: Option<CratePath>,
    /// `gravity = ...`, m/s².
    pub gravity: Option<Property>,
    /// `solve = ...`: the two names.
    pub solve: Option<(Ident, Ident)>,
    /// `code = ...`: the two names.
    pub code: Option<(Ident, Ident)>,
    /// `parameters(...)`.
    pub parameters: Option<ParameterClause>,
    /// `drive(...)`.
    pub drive: Option<DriveClause>,
    /// The links at the top level; a right description has one.
    pub roots: Vec<Node>,
    /// Members of `emit(...)`.
    pub requests: Vec<Request>,
    /// Members of `observe(...)`.
    pub observables: Vec<ObservableClause>,
    /// `in_phase(...)` and `locked(...)`.
    pub reductions: Reductions,
    /// `prescribed(...)`, each by itself.
    pub prescribed: Vec<PrescribedClause>,
    /// `between(...)`, `siblings(...)` and `guy(...)`, each by itself.
    pub spring_dampers: Vec<SpringDamperClause>,
    /// True if part of it was unreadable, which is reported already: anything
    /// that is missing may have stood there.
    pub damaged: bool,
}

/// Links whose motion the caller states.
#[derive(Debug, Clone)]
pub struct PrescribedClause {
    /// The word `prescribed`.
    pub name: Ident,
    /// The links.
    pub links: Vec<Ident>,
    /// True if part of it was unreadable, which is reported already.
    pub damaged: bool,
}

/// A spring and friction between links, or between a link and the ground.
#[derive(Debug, Clone)]
pub struct SpringDamperClause {
    /// The word `between`, `siblings` or `guy`.
    pub name: Ident,
    /// The links, or the node whose copies are meant.
    pub links: Vec<Ident>,
    /// Properties of the spring and of the friction.
    pub properties: Vec<Property>,
    /// True if part of it was unreadable, which is reported already.
    pub damaged: bool,
}

/// Words of spring-damper clauses: between two links, between the copies of a node, and between a
/// link and the ground.
pub(crate) const BETWEEN: &str = "between";
pub(crate) const SIBLINGS: &str = "siblings";
pub(crate) const GUY: &str = "guy";

impl SpringDamperClause {
    /// Returns true if what acts is straight, along the line between two points.
    pub fn is_straight(&self) -> bool {
        self.name == GUY || self.gives("at") || self.gives("repulsion")
    }

    /// Returns true if it has a property of that name.
    pub fn gives(&self, name: &str) -> bool {
        self.properties
            .iter()
            .any(|property| property.key() == name)
    }
}

/// Links that get no coordinate of their own.
#[derive(Debug, Clone, Default)]
pub struct Reductions {
    /// Nodes whose copies move alike.
    pub in_phase: Vec<Ident>,
    /// Links whose joint does not move.
    pub locked: Vec<LockedClause>,
}

impl Reductions {
    /// Returns true if every link keeps its coordinate.
    pub fn is_empty(&self) -> bool {
        self.in_phase.is_empty() && self.locked.is_empty()
    }
}

/// A joint that does not move.
#[derive(Debug, Clone)]
pub struct LockedClause {
    /// The link.
    pub link: Ident,
    /// Angle of the link to the one that it hangs from, rad.
    pub angle: Expression,
}

impl Description {
    /// The names that stand where values do, each once, in the order written:
    /// the parameters of the model.
    pub fn parameter_names(&self) -> Vec<Ident> {
        let mut names: Vec<Ident> = Vec::new();
        let mut visit = |name: &Ident| {
            if !names.contains(name) {
                names.push(name.clone());
            }
        };
        if let Some(gravity) = &self.gravity {
            gravity.value.for_each_name(&mut visit);
        }
        for root in &self.roots {
            root.for_each_name(&mut visit);
        }
        // In a drive, `t` is the time.
        let mut visit_drive = |name: &Ident| {
            if name != TIME {
                visit(name);
            }
        };
        for part in self.drive.iter().flat_map(|drive| &drive.parts) {
            part.value.for_each_name(&mut visit_drive);
        }
        for property in self.spring_dampers.iter().flat_map(|own| &own.properties) {
            property.value.for_each_name(&mut visit);
        }
        names
    }
}

/// Path of the runtime crate in the user's crate: `::branched_pendulum`, or
/// what `crate = ...` says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CratePath {
    /// True if the path starts with `::`.
    pub global: bool,
    /// The names between the `::`, as written.
    pub segments: Vec<String>,
}

impl Default for CratePath {
    fn default() -> Self {
        Self {
            global: true,
            segments: vec!["branched_pendulum".to_owned()],
        }
    }
}

/// The struct under the attribute: what survives of it in the expansion.
#[derive(Debug, Clone)]
pub struct StructItem {
    /// Other attributes of the struct, doc comments included.
    pub attrs: Vec<OuterAttribute>,
    /// Visibility of the struct.
    pub vis: TokenStream,
    /// Name of the struct.
    pub ident: Ident,
    /// The item as it was given, to be repeated where nothing else can be
    /// emitted.
    pub tokens: TokenStream,
}

/// An attribute of the struct: repeated, and not understood.
#[derive(Debug, Clone)]
pub struct OuterAttribute {
    /// Name of the attribute, where it is one word.
    pub name: Option<Ident>,
    /// All of it.
    pub tokens: TokenStream,
}

/// The declaration of all parameters.
#[derive(Debug, Clone)]
pub struct ParameterClause {
    /// The declared names.
    pub names: Vec<Ident>,
    /// True if part of it was unreadable, which is reported already.
    pub damaged: bool,
}

/// The motion and the torque that are imposed from outside.
#[derive(Debug, Clone)]
pub struct DriveClause {
    /// The word `drive`.
    pub name: Ident,
    /// Members of the parentheses.
    pub parts: Vec<Property>,
    /// True if part of it was unreadable, which is reported already.
    pub damaged: bool,
}

/// A link, or a rule for several.
#[derive(Debug, Clone)]
pub struct Node {
    /// Name of the link or of the rule.
    pub name: Ident,
    /// Word behind the colon: a shape, or `generations`.
    pub shape: Option<Ident>,
    /// Members of the parentheses.
    pub properties: Vec<Property>,
    /// Members of the brackets.
    pub children: Vec<Node>,
    /// Number behind the `*`.
    pub copies: Option<Multiplicity>,
    /// True if part of it was unreadable, which is reported already: anything
    /// that is missing may have stood there.
    pub damaged: bool,
}

impl Node {
    /// Returns true if this link or one below it was unreadable in part.
    pub fn is_damaged(&self) -> bool {
        self.damaged || self.children.iter().any(Node::is_damaged)
    }

    fn for_each_name(&self, visit: &mut impl FnMut(&Ident)) {
        // The shape and the code of a rule are names, but no values.
        let values = self
            .properties
            .iter()
            .filter(|p| p.name != "shape" && p.name != "code");
        for property in values {
            property.value.for_each_name(visit);
        }
        for child in &self.children {
            child.for_each_name(visit);
        }
    }
}

/// The number of copies of a link.
#[derive(Debug, Clone, Copy)]
pub struct Multiplicity {
    /// The number; `u32::MAX` for all larger ones.
    pub count: u32,
    /// Place of the number.
    pub span: Span,
}

/// A name and its value.
#[derive(Debug, Clone)]
pub struct Property {
    /// The law in whose parentheses it stands, as in `friction(coulomb = 0.1)`.
    pub within: Option<Ident>,
    /// The name.
    pub name: Ident,
    /// The value.
    pub value: Value,
}

impl Property {
    /// Name with the parentheses that it stands in; `friction` for the short form and
    /// the long one, `friction(viscous = c)`.
    pub fn key(&self) -> String {
        let name = &self.name;
        match &self.within {
            Some(law) if name == "viscous" => law.to_string(),
            Some(law) => format!("{law}({name})"),
            None => name.to_string(),
        }
    }
}

/// The value of a property.
#[derive(Debug, Clone)]
pub enum Value {
    /// A single value.
    Single(Expression),
    /// A point, `(along, lateral)`.
    Pair(Expression, Expression),
    /// A value for each copy, `each(first, second)`.
    Each {
        /// The values, in the order of the copies.
        values: Vec<Value>,
        /// Place of the word `each`.
        span: Span,
    },
}

impl Value {
    /// Calls `visit` with every name in the value, in the order written.
    pub fn for_each_name(&self, visit: &mut impl FnMut(&Ident)) {
        match self {
            Self::Single(value) => value.for_each_name(visit),
            Self::Pair(along, lateral) => {
                along.for_each_name(visit);
                lateral.for_each_name(visit);
            }
            Self::Each { values, .. } => values.iter().for_each(|v| v.for_each_name(visit)),
        }
    }
}

/// A quantity of the user's own.
#[derive(Debug, Clone)]
pub struct ObservableClause {
    /// Name of the quantity.
    pub name: Ident,
    /// Definition of the quantity.
    pub value: Expression,
}

/// Something to emit.
#[derive(Debug, Clone)]
pub struct Request {
    /// Name of the output.
    pub name: Ident,
    /// Members of its parentheses; `None` without parentheses.
    pub forms: Option<Vec<RequestForm>>,
    /// True if some of the forms were unreadable, which is reported already.
    pub damaged: bool,
}

/// A form of a requested output.
#[derive(Debug, Clone)]
pub struct RequestForm {
    /// Name of the form.
    pub name: Ident,
    /// Number behind the `=`.
    pub value: Option<Multiplicity>,
    /// The names in its parentheses.
    pub members: Option<Vec<Ident>>,
}
