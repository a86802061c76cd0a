//! Parser from tokens to a [`Description`].
//!
//! A mistake costs only the list member that contains it: parsing continues after the next comma of
//! the same list, so that one missing `=` does not hide later mistakes.

use proc_macro2::{Delimiter, Ident, Span, TokenStream};
use syn::ext::IdentExt as _;
use syn::parse::ParseStream;
use syn::{Token, token};

use super::expression::whole_number;
use super::item::{MAX_NESTING, deepest, parse_item};
use super::list::{
    List, ListFault, brackets, colon, expected, found, group, identifier, list, parse_all, take,
};
use super::misread::{lone_name, not_a_link, not_an_entry, shape_by_equals};
use super::properties;
use super::requests::{observable, request};
use super::{
    BETWEEN, CratePath, Description, DriveClause, Expression, GUY, LockedClause, Node,
    ObservableClause, ParameterClause, PrescribedClause, Property, Reductions, Request, SIBLINGS,
    SpringDamperClause, StructItem,
};
use crate::report::{Diagnostic, Faults, SceneSetting, SyntaxMessage};

/// Parses an attribute and the struct to which it is attached.
///
/// `attribute` holds the tokens between the parentheses of the attribute, `item` all tokens of the
/// item below it. Mistakes are added to `report`, and the parts that could be parsed are returned.
/// Returns `None` only if the item is not a struct.
pub fn parse(
    attribute: TokenStream,
    item: TokenStream,
    report: &mut Faults,
) -> Option<Description> {
    let item = parse_item(item, report)?;
    Some(parse_attribute(attribute, item, report))
}

/// Parses the attribute of a struct that has been parsed already.
pub(super) fn parse_attribute(
    attribute: TokenStream,
    item: StructItem,
    report: &mut Faults,
) -> Description {
    let entries = if let Some(span) = deepest(&attribute) {
        report.error(span, SyntaxMessage::Nesting { limit: MAX_NESTING });
        List {
            members: Vec::new(),
            damaged: true,
        }
    } else {
        // Errors at the end of the attribute get the span of its last token.
        let last = attribute.clone().into_iter().last();
        let end = last.map_or_else(Span::call_site, |last| last.span());
        list((attribute, end), report, entry)
    };
    let mut description = Description {
        item,
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
        spring_dampers: Vec::new(),
        damaged: entries.damaged,
    };
    gather(entries.members, &mut description, report);
    description
}

/// Sorts the members of an attribute into the fields of the description.
fn gather(members: Vec<Member>, description: &mut Description, report: &mut Faults) {
    let (mut emits, mut observes) = (0, 0);
    for member in members {
        match member {
            Member::Crate(name, path) => once(&mut description.crate_path, path, &name, report),
            Member::Gravity(property) => {
                let name = property.name.clone();
                once(&mut description.gravity, property, &name, report);
            }
            Member::Solve(name, value) => {
                once(&mut description.solve, (name.clone(), value), &name, report);
            }
            Member::Code(name, value) => {
                once(&mut description.code, (name.clone(), value), &name, report);
            }
            Member::Parameters(name, clause) => {
                once(&mut description.parameters, clause, &name, report);
            }
            Member::Drive(drive) => {
                let span = drive.name.span();
                let message = SyntaxMessage::duplicate_property(&drive.name);
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
                    report.error(name.span(), SyntaxMessage::duplicate_property(&name));
                }
                description.requests.extend(requests);
            }
            Member::Observe(name, observables) => {
                observes += 1;
                if observes > 1 {
                    report.error(name.span(), SyntaxMessage::duplicate_property(&name));
                }
                description.observables.extend(observables);
            }
            Member::InPhase(nodes) => description.reductions.in_phase.extend(nodes),
            Member::Locked(clause) => description.reductions.locked.push(clause),
            Member::Prescribed(clause) => description.prescribed.push(clause),
            Member::SpringDamper(clause) => description.spring_dampers.push(clause),
            Member::Link(node) => description.roots.push(node),
        }
    }
}

/// Stores a setting. If it is given several times, reports this and keeps the last one.
fn once<T>(place: &mut Option<T>, value: T, name: &Ident, report: &mut Faults) {
    if place.replace(value).is_some() {
        report.error(name.span(), SyntaxMessage::duplicate_property(name));
    }
}

/// A member of the attribute, of any kind.
enum Member {
    Crate(Ident, CratePath),
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
    SpringDamper(SpringDamperClause),
    Link(Node),
}

fn entry(input: ParseStream<'_>, report: &mut Faults) -> Result<Member, ListFault> {
    let name = Ident::parse_any(input).map_err(|_| not_an_entry(input))?;
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
        let parts = list(parts, report, properties::property);
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
        let node = |input: ParseStream<'_>, _: &mut Faults| {
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
    let is_spring_damper = [BETWEEN, SIBLINGS, GUY].iter().any(|word| name == word);
    if is_spring_damper && declares(input) {
        return spring_damper(name, input, report).map(Member::SpringDamper);
    }
    if name == "gravity" || name == "crate" {
        return Err(expected(input, "`=` and a value"));
    }
    match not_a_link(&name, input) {
        Some(fault) => Err(fault),
        None => node(name, input, report).map(Member::Link),
    }
}

/// Parses a spring-damper clause: links, then properties.
fn spring_damper(
    name: Ident,
    input: ParseStream<'_>,
    report: &mut Faults,
) -> Result<SpringDamperClause, ListFault> {
    let parts = group(input, Delimiter::Parenthesis, "`(` and links")?;
    let (mut links, mut damaged) = (Vec::new(), false);
    let parts = list(parts, report, |input, report| {
        let is_link = match input.cursor().ident() {
            Some((_, rest)) => {
                rest.eof() || rest.punct().is_some_and(|(mark, _)| mark.as_char() == ',')
            }
            None => false,
        };
        if is_link {
            links.push(identifier(input, "a link")?);
            return Ok(Vec::new());
        }
        let one = properties::properties(input, report)?;
        damaged |= one.damaged;
        Ok(one.members)
    });
    Ok(SpringDamperClause {
        name,
        damaged: damaged || parts.damaged,
        links,
        properties: parts.members.into_iter().flatten().collect(),
    })
}

/// Returns true if the next token is a pair of parentheses without values. This distinguishes the
/// setting `parameters(...)` from a link with that name.
fn declares(input: ParseStream<'_>) -> bool {
    match input.cursor().group(Delimiter::Parenthesis) {
        Some((inside, ..)) => {
            let value = inside.ident().and_then(|(_, rest)| rest.punct());
            value.is_none_or(|(mark, _)| mark.as_char() != '=')
        }
        None => false,
    }
}

/// Parses the rest of `crate = path`, `gravity = value`, `solve = name` or `code = name`, after the
/// name.
fn assignment(name: Ident, input: ParseStream<'_>) -> Result<Member, ListFault> {
    if name == "crate" {
        take::<Token![=]>(input, "`=`")?;
        return path(input).map(|path| Member::Crate(name, path));
    }
    if name == "gravity" {
        return properties::property_value(name, input).map(Member::Gravity);
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
    let message = match SceneSetting::named(&name.to_string()) {
        Some(setting) => SyntaxMessage::SettingForm { setting },
        None => match shape_by_equals(&name, input) {
            Some(fault) => return Err(fault),
            None => SyntaxMessage::unknown_entry(name.to_string()),
        },
    };
    Err(Diagnostic::new(name.span(), message).into())
}

/// Parses a path: names separated by `::`, with an optional `::` at its beginning.
fn path(input: ParseStream<'_>) -> Result<CratePath, ListFault> {
    const WHAT: &str = "the path of a crate, as in `::branched_pendulum`";
    let segment = || {
        let is_path_word = input.peek(Token![crate])
            || input.peek(Token![self])
            || input.peek(Token![Self])
            || input.peek(Token![super]);
        match is_path_word || input.peek(syn::Ident) {
            true => Ok(identifier(input, WHAT)?.to_string()),
            false => Err(expected(input, WHAT)),
        }
    };
    let global = input.peek(Token![::]);
    if global {
        take::<Token![::]>(input, WHAT)?;
    }
    let mut segments = vec![segment()?];
    while input.peek(Token![::]) {
        take::<Token![::]>(input, WHAT)?;
        segments.push(segment()?);
    }
    Ok(CratePath { global, segments })
}

/// Parses a link, after its name.
fn node(name: Ident, input: ParseStream<'_>, report: &mut Faults) -> Result<Node, ListFault> {
    let misread = lone_name(&name, input).or_else(|| shape_by_equals(&name, input));
    if let Some(fault) = misread {
        return Err(fault);
    }
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
    let mut damaged = false;
    let properties = list(properties, report, |input, report| {
        let one = properties::properties(input, report)?;
        damaged |= one.damaged;
        Ok(one.members)
    });
    damaged |= properties.damaged;
    brackets(input, "children", "[ ]")?;
    let children = if input.peek(token::Bracket) {
        let children = group(input, Delimiter::Bracket, "`[` and the children")?;
        list(children, report, |input, report| {
            let name = identifier(input, "a link, as in `child(mass = 0.1, ...) * 2`")?;
            node(name, input, report)
        })
    } else {
        List::default()
    };
    let copies = if input.peek(Token![*]) {
        take::<Token![*]>(input, "`*`")?;
        let (span, found) = (input.span(), found(input));
        let copies = whole_number(input, "a whole number, the number of copies");
        Some(copies.map_err(|fault| match fault {
            ListFault::Found(_) => Diagnostic::new(span, SyntaxMessage::NotCopies { found }).into(),
            ended => ended,
        })?)
    } else {
        None
    };
    Ok(Node {
        name,
        shape,
        damaged: damaged || children.damaged,
        properties: properties.members.into_iter().flatten().collect(),
        children: children.members,
        copies,
    })
}
