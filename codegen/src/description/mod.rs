//! The description as written: grammar of the attribute, and its syntax tree with source positions.
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
//! Unlike in Rust, `^` is a power and binds tightest: `-a^2` is `-(a^2)`. A `decimal` is read
//! exactly. A `name` is a parameter of the model; equal names are the same parameter. If
//! `parameters(...)` declares parameters, every other name is an error. In observables a `name` is
//! a symbol of the scene (an angle, a velocity, a momentum, a parameter, a constant of the model).
//! Only observables and drives may contain functions. A pair is a point of a link, `(along,
//! lateral)`, in metres; a single value there means `(along, 0)`. Copies of a link may differ:
//! `each(...)` holds one value per copy. This module knows only the syntax. The module
//! [`scene`](crate::scene) defines which properties, requests, symbols and functions exist, and
//! their meaning.

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

/// Name of the time in `drive(...)`, in s.
pub const TIME: &str = "t";

/// An attribute and the struct to which it is attached.
#[derive(Debug, Clone)]
pub struct Description {
    /// The struct to which the attribute is attached.
    pub item: StructItem,
    /// The value of `crate = ...`.
    pub crate_path: Option<CratePath>,
    /// Value of `gravity = ...`, in m/s².
    pub gravity: Option<Property>,
    /// The word `solve` and its value.
    pub solve: Option<(Ident, Ident)>,
    /// The word `code` and its value.
    pub code: Option<(Ident, Ident)>,
    /// Parameters declared by `parameters(...)`.
    pub parameters: Option<ParameterClause>,
    /// Torque and motion given by `drive(...)`.
    pub drive: Option<DriveClause>,
    /// Links at the top level; a correct description has exactly one.
    pub roots: Vec<Node>,
    /// Members of `emit(...)`.
    pub requests: Vec<Request>,
    /// Quantities defined by `observe(...)`.
    pub observables: Vec<ObservableClause>,
    /// Links without coordinates, from `in_phase(...)` and `locked(...)`.
    pub reductions: Reductions,
    /// Links with prescribed motion, one entry per `prescribed(...)`.
    pub prescribed: Vec<PrescribedClause>,
    /// Springs and dampers, one entry per `between(...)`, `siblings(...)` and `guy(...)`.
    pub spring_dampers: Vec<SpringDamperClause>,
    /// True if a part of the description could not be parsed and has been reported. The missing
    /// part may have contained anything.
    pub damaged: bool,
}

/// Links whose motion is prescribed by the caller.
#[derive(Debug, Clone)]
pub struct PrescribedClause {
    /// The word `prescribed`.
    pub name: Ident,
    /// Names of the links.
    pub links: Vec<Ident>,
    /// True if a part could not be parsed and has been reported.
    pub damaged: bool,
}

/// A spring and friction between two links, between the copies of a node, or between a link and the
/// ground.
#[derive(Debug, Clone)]
pub struct SpringDamperClause {
    /// The word `between`, `siblings` or `guy`.
    pub name: Ident,
    /// The links, or the node whose copies are connected.
    pub links: Vec<Ident>,
    /// Properties of the spring and of the friction.
    pub properties: Vec<Property>,
    /// True if a part could not be parsed and has been reported.
    pub damaged: bool,
}

/// Keywords of spring-damper clauses: between two links, between the copies of a node, and between
/// a link and the ground.
pub(crate) const BETWEEN: &str = "between";
pub(crate) const SIBLINGS: &str = "siblings";
pub(crate) const GUY: &str = "guy";

impl SpringDamperClause {
    /// Returns true if the forces act along the straight line between two points.
    pub fn is_straight(&self) -> bool {
        self.name == GUY || self.gives("at") || self.gives("repulsion")
    }

    /// Returns true if the clause has a property of the given name.
    pub fn gives(&self, name: &str) -> bool {
        self.properties
            .iter()
            .any(|property| property.key() == name)
    }
}

/// Links that have no coordinate in the equations.
#[derive(Debug, Clone, Default)]
pub struct Reductions {
    /// Nodes whose copies move in phase: their angles are equal.
    pub in_phase: Vec<Ident>,
    /// Links whose joint is locked.
    pub locked: Vec<LockedClause>,
}

impl Reductions {
    /// Returns true if every link keeps its coordinate.
    pub fn is_empty(&self) -> bool {
        self.in_phase.is_empty() && self.locked.is_empty()
    }
}

/// A joint locked at a fixed angle.
#[derive(Debug, Clone)]
pub struct LockedClause {
    /// Name of the link.
    pub link: Ident,
    /// Angle between the link and its parent, in rad.
    pub angle: Expression,
}

impl Description {
    /// Returns the names in values, each once, in the order written. These are the parameters of
    /// the model.
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
        // Within a drive, `t` is the time and no parameter.
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

/// Path of the runtime crate as seen from the user's crate: `::branched_pendulum`, or the value of
/// `crate = ...`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CratePath {
    /// True if the path starts with `::`.
    pub global: bool,
    /// Identifiers between the `::`, as written.
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

/// The struct to which the attribute is attached, with everything that the expansion repeats.
#[derive(Debug, Clone)]
pub struct StructItem {
    /// Other attributes of the struct, including doc comments.
    pub attrs: Vec<OuterAttribute>,
    /// Visibility of the struct.
    pub vis: TokenStream,
    /// Name of the struct, which becomes the name of the model.
    pub ident: Ident,
    /// The unchanged item, which is emitted if there is no expansion.
    pub tokens: TokenStream,
}

/// An attribute of the struct, repeated in the expansion without being interpreted.
#[derive(Debug, Clone)]
pub struct OuterAttribute {
    /// Name of the attribute, if it is a single identifier.
    pub name: Option<Ident>,
    /// All tokens of the attribute.
    pub tokens: TokenStream,
}

/// Declaration of all parameters, from `parameters(...)`.
#[derive(Debug, Clone)]
pub struct ParameterClause {
    /// The declared names.
    pub names: Vec<Ident>,
    /// True if a part could not be parsed and has been reported.
    pub damaged: bool,
}

/// External motion and torque, from `drive(...)`.
#[derive(Debug, Clone)]
pub struct DriveClause {
    /// The word `drive`.
    pub name: Ident,
    /// Properties in the parentheses.
    pub parts: Vec<Property>,
    /// True if a part could not be parsed and has been reported.
    pub damaged: bool,
}

/// A link, or a rule that describes several links.
#[derive(Debug, Clone)]
pub struct Node {
    /// Name of the link or of the rule.
    pub name: Ident,
    /// Word after the colon: a shape, or `generations`.
    pub shape: Option<Ident>,
    /// Properties in the parentheses.
    pub properties: Vec<Property>,
    /// Children in the brackets.
    pub children: Vec<Node>,
    /// Number of copies, after the `*`.
    pub copies: Option<Multiplicity>,
    /// True if a part of the link could not be parsed and has been reported. The missing part may
    /// have contained anything.
    pub damaged: bool,
}

impl Node {
    /// Returns true if a part of this link or of a link below it could not be parsed.
    pub fn is_damaged(&self) -> bool {
        self.damaged || self.children.iter().any(Node::is_damaged)
    }

    fn for_each_name(&self, visit: &mut impl FnMut(&Ident)) {
        // The shape and the code of a rule are names, but not values.
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

/// Number of copies of a link.
#[derive(Debug, Clone, Copy)]
pub struct Multiplicity {
    /// The number; larger numbers become `u32::MAX`.
    pub count: u32,
    /// Span of the number.
    pub span: Span,
}

/// A property: a name and its value.
#[derive(Debug, Clone)]
pub struct Property {
    /// Name of the law whose parentheses contain the property, as in `friction(coulomb = 0.1)`.
    pub within: Option<Ident>,
    /// Name of the property.
    pub name: Ident,
    /// Value of the property.
    pub value: Value,
}

impl Property {
    /// Returns the name of the property, preceded by the law that contains it. The result is
    /// `friction` both for the short form and for `friction(viscous = c)`.
    pub fn key(&self) -> String {
        let name = &self.name;
        match &self.within {
            Some(law) if name == "viscous" => law.to_string(),
            Some(law) => format!("{law}({name})"),
            None => name.to_string(),
        }
    }
}

/// Value of a property.
#[derive(Debug, Clone)]
pub enum Value {
    /// A single value.
    Single(Expression),
    /// A point, `(along, lateral)`.
    Pair(Expression, Expression),
    /// One value per copy, `each(first, second)`.
    Each {
        /// The values, in the order of the copies.
        values: Vec<Value>,
        /// Span of the word `each`.
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

/// An observable: a quantity that the user defines, from `observe(...)`.
#[derive(Debug, Clone)]
pub struct ObservableClause {
    /// Name of the quantity.
    pub name: Ident,
    /// Definition of the quantity.
    pub value: Expression,
}

/// An output requested by `emit(...)`.
#[derive(Debug, Clone)]
pub struct Request {
    /// Name of the output.
    pub name: Ident,
    /// Forms in the parentheses; `None` without parentheses.
    pub forms: Option<Vec<RequestForm>>,
    /// True if some of the forms could not be parsed and have been reported.
    pub damaged: bool,
}

/// A form of a requested output.
#[derive(Debug, Clone)]
pub struct RequestForm {
    /// Name of the form, such as `exact` in `transfer(exact)`.
    pub name: Ident,
    /// Number after the `=`, such as the order in `amplitude = 2`.
    pub value: Option<Multiplicity>,
    /// Names in the parentheses.
    pub members: Option<Vec<Ident>>,
}
