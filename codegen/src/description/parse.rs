//! Tokens to [`Description`].
//!
//! A mistake costs the list member it stands in: reading goes on after the next
//! comma of the same list, so that one missing `=` does not hide what follows.

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use syn::parse::ParseStream;
use syn::{Token, token};

use super::expression::{EACH_WHOLE, literal};
use super::list::{
    List, ListFault, brackets, colon, expected, group, identifier, list, parse_all, take,
};
use super::{
    Description, DriveClause, Expression, LockedClause, Multiplicity, Node, ObservableClause,
    ParameterClause, PrescribedClause, Property, Reductions, Request, RequestForm, StructItem,
    Value,
};
use crate::report::{Diagnostic, Message, Report};

/// Deepest nesting of brackets and parentheses. A chain of more links is what
/// `generations` is for.
const MAX_NESTING: usize = 64;

/// Reads an attribute and the struct that it stands on.
///
/// `attribute` holds the tokens between the parentheses of the attribute,
/// `item` all tokens of the item under it. Mistakes go to `report`; what could
/// be read is returned all the same, and `None` only where the item is no
/// struct.
pub fn parse(
    attribute: TokenStream,
    item: TokenStream,
    report: &mut Report,
) -> Option<Description> {
    let entries = if let Some(span) = deepest(&attribute) {
        report.error(span, Message::Nesting { limit: MAX_NESTING });
        List {
            members: Vec::new(),
            damaged: true,
        }
    } else {
        // The last token stands where the attribute ends.
        let last = attribute.clone().into_iter().last();
        let end = last.map_or_else(Span::call_site, |last| last.span());
        list((attribute, end), report, entry)
    };
    let mut description = Description {
        item: parse_item(item, report)?,
        crate_path: None,
        gravity: None,
        solve: None,
        code: None,
        parameters: None,
        drive: None,
        roots: Vec::new(),
        requests: Vec::new(),
        observables: Vec::new(),
        reductions: Reductions::default(),
        prescribed: Vec::new(),
        damaged: entries.damaged,
    };
    let (mut emits, mut observes) = (0, 0);
    for entry in entries.members {
        match entry {
            Member::Crate(name, path) => {
                if description.crate_path.replace(path).is_some() {
                    report.error(name.span(), Message::duplicate_property(&name));
                }
            }
            Member::Gravity(property) => {
                let span = property.name.span();
                let message = Message::duplicate_property(&property.name);
                if description.gravity.replace(property).is_some() {
                    report.error(span, message);
                }
            }
            Member::Solve(name, value) => {
                let (span, message) = (name.span(), Message::duplicate_property(&name));
                if description.solve.replace((name, value)).is_some() {
                    report.error(span, message);
                }
            }
            Member::Code(name, value) => {
                let (span, message) = (name.span(), Message::duplicate_property(&name));
                if description.code.replace((name, value)).is_some() {
                    report.error(span, message);
                }
            }
            Member::Parameters(name, clause) => {
                if description.parameters.replace(clause).is_some() {
                    report.error(name.span(), Message::duplicate_property(&name));
                }
            }
            Member::Drive(drive) => {
                let span = drive.name.span();
                let message = Message::duplicate_property(&drive.name);
                match &mut description.drive {
                    None => description.drive = Some(drive),
                    Some(first) => {
                        report.error(span, message);
                        first.parts.extend(drive.parts);
                        first.damaged |= drive.damaged;
                    }
                }
            }
            Member::Emit(name, requests) => {
                emits += 1;
                if emits > 1 {
                    report.error(name.span(), Message::duplicate_property(&name));
                }
                description.requests.extend(requests);
            }
            Member::Observe(name, observables) => {
                observes += 1;
                if observes > 1 {
                    report.error(name.span(), Message::duplicate_property(&name));
                }
                description.observables.extend(observables);
            }
            Member::InPhase(nodes) => description.reductions.in_phase.extend(nodes),
            Member::Locked(clause) => description.reductions.locked.push(clause),
            Member::Prescribed(clause) => description.prescribed.push(clause),
            Member::Link(node) => description.roots.push(node),
        }
    }
    Some(description)
}

/// A token below [`MAX_NESTING`] groups, if there is one. Looks without
/// recursion, so that parsing afterwards may recurse.
fn deepest(tokens: &TokenStream) -> Option<Span> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(level) = open.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) if open.len() > MAX_NESTING => return Some(group.span()),
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(_) => {}
            None => {
                open.pop();
            }
        }
    }
    None
}

/// Types that emitted models name without a path: their type parameter, and
/// primitive ones.
const RESERVED_TYPES: [&str; 5] = ["T", "f64", "usize", "bool", "str"];

impl StructItem {
    /// Returns true if the struct is called as a type that the code of a model names.
    pub fn is_reserved(&self) -> bool {
        RESERVED_TYPES.iter().any(|name| self.ident == name)
    }
}

/// Reads the struct.
fn parse_item(tokens: TokenStream, report: &mut Report) -> Option<StructItem> {
    if deepest(&tokens).is_some() {
        report.error(Span::call_site(), Message::NotAStruct);
        return None;
    }
    let first = tokens.clone().into_iter().next();
    let Ok(item) = syn::parse2::<syn::ItemStruct>(tokens.clone()) else {
        let span = first.map_or_else(Span::call_site, |token| token.span());
        report.error(span, Message::NotAStruct);
        return None;
    };
    let name = item.ident.to_string();
    if !item.fields.is_empty() {
        report.error(
            item.ident.span(),
            Message::StructFields { name: name.clone() },
        );
    }
    if !item.generics.params.is_empty() || item.generics.where_clause.is_some() {
        let name = name.clone();
        report.error(item.ident.span(), Message::StructGenerics { name });
    }
    let item = StructItem {
        attrs: item.attrs,
        vis: item.vis,
        ident: item.ident,
        tokens,
    };
    if item.is_reserved() {
        report.error(item.ident.span(), Message::ReservedName { name });
    }
    Some(item)
}

/// A member of the attribute.
enum Member {
    Crate(Ident, syn::Path),
    Gravity(Property),
    Solve(Ident, Ident),
    Code(Ident, Ident),
    Parameters(Ident, ParameterClause),
    Drive(DriveClause),
    Emit(Ident, Vec<Request>),
    Observe(Ident, Vec<ObservableClause>),
    InPhase(Vec<Ident>),
    Locked(LockedClause),
    Prescribed(PrescribedClause),
    Link(Node),
}

fn entry(input: ParseStream<'_>, report: &mut Report) -> Result<Member, ListFault> {
    let name = identifier(
        input,
        "a link, `gravity`, `drive`, `emit`, `observe` or `crate`",
    )?;
    if input.peek(Token![=]) {
        return assignment(name, input);
    }
    let is_setting = ["gravity", "crate", "solve", "code"]
        .iter()
        .any(|setting| name == setting);
    if is_setting {
        colon(&name, input)?;
    }
    if name == "emit" {
        let requests = group(input, Delimiter::Parenthesis, "`(` and what to emit")?;
        return Ok(Member::Emit(name, list(requests, report, request).members));
    }
    if name == "parameters" && declares(input) {
        let names = group(input, Delimiter::Parenthesis, "`(` and names")?;
        let names = list(names, report, |input, _| identifier(input, "a name"));
        let clause = ParameterClause {
            names: names.members,
            damaged: names.damaged,
        };
        return Ok(Member::Parameters(name, clause));
    }
    if name == "drive" && !input.peek(Token![:]) {
        let parts = group(
            input,
            Delimiter::Parenthesis,
            "`(` and what drives the tree",
        )?;
        let parts = list(parts, report, property);
        return Ok(Member::Drive(DriveClause {
            name,
            parts: parts.members,
            damaged: parts.damaged,
        }));
    }
    if name == "observe" {
        let observables = group(input, Delimiter::Parenthesis, "`(` and what to observe")?;
        let observables = list(observables, report, observable);
        return Ok(Member::Observe(name, observables.members));
    }
    if name == "in_phase" {
        let nodes = group(input, Delimiter::Parenthesis, "`(` and links")?;
        let node = |input: ParseStream<'_>, _: &mut Report| {
            identifier(input, "a link with copies, or `all`")
        };
        return Ok(Member::InPhase(list(nodes, report, node).members));
    }
    if name == "locked" {
        let inside = group(input, Delimiter::Parenthesis, "`(`, a link and an angle")?;
        let clause = parse_all(inside, |input| {
            let link = identifier(input, "a link, as in `locked(arm, 0.3)`")?;
            take::<Token![,]>(input, "`,` and an angle in rad, as in `locked(arm, 0.3)`")?;
            let angle = Expression::parse(input)?;
            Ok(LockedClause { link, angle })
        })?;
        return Ok(Member::Locked(clause));
    }
    if name == "prescribed" && declares(input) {
        let links = group(input, Delimiter::Parenthesis, "`(` and links")?;
        let links = list(links, report, |input, _| identifier(input, "a link"));
        return Ok(Member::Prescribed(PrescribedClause {
            name,
            links: links.members,
            damaged: links.damaged,
        }));
    }
    if name == "gravity" || name == "crate" {
        return Err(expected(input, "`=` and a value"));
    }
    node(name, input, report).map(Member::Link)
}

/// Returns true if parentheses without values follow: a link may be called
/// `parameters` too.
fn declares(input: ParseStream<'_>) -> bool {
    match input.cursor().group(Delimiter::Parenthesis) {
        Some((inside, ..)) => {
            let value = inside.ident().and_then(|(_, rest)| rest.punct());
            value.is_none_or(|(mark, _)| mark.as_char() != '=')
        }
        None => false,
    }
}

/// `crate = path`, `gravity = value`, `solve = name` or `code = name`, after the
/// name.
fn assignment(name: Ident, input: ParseStream<'_>) -> Result<Member, ListFault> {
    if name == "crate" {
        take::<Token![=]>(input, "`=`")?;
        let path = syn::Path::parse_mod_style(input)
            .map_err(|_| expected(input, "the path of a crate, as in `::branched_pendulum`"))?;
        return Ok(Member::Crate(name, path));
    }
    if name == "gravity" {
        return property_value(name, input).map(Member::Gravity);
    }
    if name == "solve" {
        take::<Token![=]>(input, "`=`")?;
        let value = identifier(input, "`factorization` or `recursion`")?;
        return Ok(Member::Solve(name, value));
    }
    if name == "code" {
        take::<Token![=]>(input, "`=`")?;
        let value = identifier(input, "`loops` or `unrolled`")?;
        return Ok(Member::Code(name, value));
    }
    let message = Message::unknown_entry(name.to_string());
    Err(Diagnostic::new(name.span(), message).into())
}

/// A link, after its name.
fn node(name: Ident, input: ParseStream<'_>, report: &mut Report) -> Result<Node, ListFault> {
    let shape = if input.peek(Token![:]) {
        take::<Token![:]>(input, "`:`")?;
        Some(identifier(input, "a shape, as in `rod`")?)
    } else {
        None
    };
    brackets(input, "properties", "( )")?;
    let properties = group(
        input,
        Delimiter::Parenthesis,
        "`(` and the properties of the link",
    )?;
    let properties = list(properties, report, property);
    brackets(input, "children", "[ ]")?;
    let children = if input.peek(token::Bracket) {
        let children = group(input, Delimiter::Bracket, "`[` and the children")?;
        list(children, report, |input, report| {
            let name = identifier(input, "a link, as in `child(mass = 0.1, ...)`")?;
            node(name, input, report)
        })
    } else {
        List::default()
    };
    let copies = if input.peek(Token![*]) {
        take::<Token![*]>(input, "`*`")?;
        Some(whole_number(input, "a whole number, the number of copies")?)
    } else {
        None
    };
    Ok(Node {
        name,
        shape,
        damaged: properties.damaged || children.damaged,
        properties: properties.members,
        children: children.members,
        copies,
    })
}

fn property(input: ParseStream<'_>, _: &mut Report) -> Result<Property, ListFault> {
    let name = identifier(input, "a property, as in `mass = 0.1`")?;
    property_value(name, input)
}

/// A property, after its name.
fn property_value(name: Ident, input: ParseStream<'_>) -> Result<Property, ListFault> {
    colon(&name, input)?;
    take::<Token![=]>(input, "`=` and a value")?;
    let value = match each(input) {
        Some((span, values)) => Value::Each {
            values: parse_all(values, |input| {
                let mut values = vec![point(input)?];
                while !input.is_empty() {
                    take::<Token![,]>(input, "`,`")?;
                    if !input.is_empty() {
                        values.push(point(input)?);
                    }
                }
                Ok(values)
            })?,
            span,
        },
        None => point(input)?,
    };
    if matches!(value, Value::Each { .. }) && !input.is_empty() && !input.peek(Token![,]) {
        return Err(expected(input, EACH_WHOLE));
    }
    Ok(Property { name, value })
}

/// A single value or a pair.
fn point(input: ParseStream<'_>) -> Result<Value, ListFault> {
    match pair(input) {
        Some(pair) => parse_all(pair, |input| {
            let along = Expression::parse(input)?;
            take::<Token![,]>(input, "`,`")?;
            let lateral = Expression::parse(input)?;
            Ok(Value::Pair(along, lateral))
        }),
        None => Expression::parse(input).map(Value::Single),
    }
}

/// Takes `each` and its parentheses: the place of the word, and the tokens in them.
fn each(input: ParseStream<'_>) -> Option<(Span, (TokenStream, Span))> {
    input
        .step(|cursor| match cursor.ident() {
            Some((word, rest)) if word == "each" => match rest.group(Delimiter::Parenthesis) {
                Some((inside, span, rest)) => {
                    let tokens = (inside.token_stream(), span.close());
                    Ok(((word.span(), tokens), rest))
                }
                None => Err(cursor.error("")),
            },
            _ => Err(cursor.error("")),
        })
        .ok()
}

/// Takes parentheses with a comma in them.
fn pair(input: ParseStream<'_>) -> Option<(TokenStream, Span)> {
    let is_comma = |token: TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    input
        .step(|cursor| match cursor.group(Delimiter::Parenthesis) {
            Some((inside, span, rest)) if inside.token_stream().into_iter().any(is_comma) => {
                Ok(((inside.token_stream(), span.close()), rest))
            }
            _ => Err(cursor.error("")),
        })
        .ok()
}

fn request(input: ParseStream<'_>, report: &mut Report) -> Result<Request, ListFault> {
    let name = identifier(input, "an output, as in `energies`")?;
    let forms = if input.peek(token::Paren) {
        let forms = group(input, Delimiter::Parenthesis, "`(`")?;
        Some(list(forms, report, form))
    } else {
        None
    };
    Ok(Request {
        name,
        damaged: forms.as_ref().is_some_and(|forms| forms.damaged),
        forms: forms.map(|forms| forms.members),
    })
}

fn observable(input: ParseStream<'_>, _: &mut Report) -> Result<ObservableClause, ListFault> {
    let name = identifier(input, "an observable, as in `height = cos(theta_bob)`")?;
    take::<Token![=]>(input, "`=` and an expression")?;
    let value = Expression::parse(input)?;
    Ok(ObservableClause { name, value })
}

fn form(input: ParseStream<'_>, report: &mut Report) -> Result<RequestForm, ListFault> {
    let name = identifier(input, "`angle = 1`, `amplitude = 2` or `exact`")?;
    let value = if input.peek(Token![=]) {
        take::<Token![=]>(input, "`=`")?;
        Some(whole_number(input, "a whole number, the order")?)
    } else {
        None
    };
    let members = if value.is_none() && input.peek(token::Paren) {
        let names = group(input, Delimiter::Parenthesis, "`(`")?;
        let member = |input: ParseStream<'_>, _: &mut Report| identifier(input, "a sector");
        Some(list(names, report, member).members)
    } else {
        None
    };
    Ok(RequestForm {
        name,
        value,
        members,
    })
}

/// A whole number; all beyond `u32` count as `u32::MAX`.
fn whole_number(input: ParseStream<'_>, what: &'static str) -> Result<Multiplicity, ListFault> {
    let span = input.span();
    let fault = || Diagnostic::new(span, Message::Expected { what }).into();
    let digits = literal(input, what)?.replace('_', "");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(fault());
    }
    let count = digits.parse().unwrap_or(u32::MAX);
    Ok(Multiplicity { count, span })
}
