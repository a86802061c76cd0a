//! Reading lists, and what stands between their members, past mistakes.

use proc_macro2::{Delimiter, Ident, Spacing, Span, TokenStream, TokenTree};
use syn::ext::IdentExt as _;
use syn::parse::{ParseStream, Parser as _};
use syn::{Token, token};

use crate::report::{Diagnostic, Faults, SyntaxMessage};

/// The readable members of a list.
pub(super) struct List<T> {
    /// The members that could be read.
    pub(super) members: Vec<T>,
    /// True if the list has an unreadable member too.
    pub(super) damaged: bool,
}

impl<T> Default for List<T> {
    fn default() -> Self {
        Self {
            members: Vec::new(),
            damaged: false,
        }
    }
}

/// Reads members with commas between them, and after a mistake goes on behind
/// the next comma.
pub(super) fn list<T>(
    tokens: (TokenStream, Span),
    report: &mut Faults,
    member: impl FnMut(ParseStream<'_>, &mut Faults) -> Result<T, ListFault>,
) -> List<T> {
    let mut reader = MemberReader {
        members: Vec::new(),
        member,
    };
    let damaged = read_members(tokens, report, &mut reader);
    List {
        members: reader.members,
        damaged,
    }
}

/// Members of one type.
struct MemberReader<T, F> {
    members: Vec<T>,
    member: F,
}

/// Reads members of a type that only it knows: the way through a list is compiled once.
trait ReadMembers {
    fn read(&mut self, input: ParseStream<'_>, report: &mut Faults) -> Result<(), ListFault>;

    /// Takes back what was read last.
    fn drop_last(&mut self);
}

impl<T, F> ReadMembers for MemberReader<T, F>
where
    F: FnMut(ParseStream<'_>, &mut Faults) -> Result<T, ListFault>,
{
    fn read(&mut self, input: ParseStream<'_>, report: &mut Faults) -> Result<(), ListFault> {
        self.members.push((self.member)(input, report)?);
        Ok(())
    }

    fn drop_last(&mut self) {
        self.members.pop();
    }
}

/// Returns true if a member could not be read.
fn read_members(
    (tokens, end): (TokenStream, Span),
    report: &mut Faults,
    reader: &mut dyn ReadMembers,
) -> bool {
    let mut damaged = false;
    let read = |input: ParseStream<'_>| {
        while !input.is_empty() {
            let outcome = reader.read(input, report).and_then(|()| {
                if input.is_empty() || input.peek(Token![,]) {
                    return Ok(());
                }
                reader.drop_last();
                match next_name(input) {
                    Some(before) => {
                        let message = SyntaxMessage::MissingComma { before };
                        Err(Diagnostic::new(input.span(), message).into())
                    }
                    None => Err(expected(input, "`,`")),
                }
            });
            if let Err(fault) = outcome {
                damaged = true;
                report.push(fault.placed(end));
            }
            while !input.is_empty() && !input.peek(Token![,]) {
                input.parse::<TokenTree>()?;
            }
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        Ok(())
    };
    if let Err(error) = read.parse2(tokens) {
        damaged = true;
        report.error(error.span(), SyntaxMessage::Ended { what: "`,`" });
    }
    damaged
}

/// Parses all of `tokens`, which end at `end`.
pub(super) fn parse_all<T>(
    tokens: (TokenStream, Span),
    parse: impl FnOnce(ParseStream<'_>) -> Result<T, ListFault>,
) -> Result<T, ListFault> {
    let (mut parse, mut value) = (Some(parse), None);
    let end = tokens.1;
    read_all(tokens, &mut |input| {
        value = parse.take().map(|parse| parse(input)).transpose()?;
        Ok(())
    })?;
    value.ok_or_else(|| ListFault::AtEnd("a value").placed(end).into())
}

/// [`parse_all`] for values of a type that only `parse` knows.
fn read_all(
    (tokens, end): (TokenStream, Span),
    parse: &mut dyn FnMut(ParseStream<'_>) -> Result<(), ListFault>,
) -> Result<(), ListFault> {
    let mut outcome = None;
    let read = |input: ParseStream<'_>| {
        let parsed = parse(input).and_then(|()| {
            if input.is_empty() {
                Ok(())
            } else {
                Err(expected(input, "an operator or `)`"))
            }
        });
        outcome = Some(parsed);
        // The mistake is in `outcome`; syn is not to add to it.
        input.parse::<TokenStream>().map(|_| ())
    };
    match (read.parse2(tokens), outcome) {
        (Ok(()), Some(outcome)) => outcome.map_err(|fault| fault.placed(end).into()),
        _ => Err(ListFault::AtEnd("a value").placed(end).into()),
    }
}

/// The tokens in the given delimiters, and the place where they end.
pub(super) fn group(
    input: ParseStream<'_>,
    delimiter: Delimiter,
    what: &'static str,
) -> Result<(TokenStream, Span), ListFault> {
    input
        .step(|cursor| match cursor.group(delimiter) {
            Some((inside, span, rest)) => Ok(((inside.token_stream(), span.close()), rest)),
            None => Err(cursor.error("")),
        })
        .map_err(|_| expected(input, what))
}

/// A name; keywords are refused later, with a message of their own.
pub(super) fn identifier(input: ParseStream<'_>, what: &'static str) -> Result<Ident, ListFault> {
    Ident::parse_any(input).map_err(|_| expected(input, what))
}

/// Takes a punctuation mark.
pub(super) fn take<T: syn::parse::Parse>(
    input: ParseStream<'_>,
    what: &'static str,
) -> Result<(), ListFault> {
    match input.parse::<T>() {
        Ok(_) => Ok(()),
        Err(_) => Err(expected(input, what)),
    }
}

/// Name that comes next, if one does.
pub(super) fn next_name(input: ParseStream<'_>) -> Option<String> {
    let name = Ident::parse_any(&input.fork()).ok()?;
    Some(name.to_string())
}

/// Refuses a `:` where a value should follow a name.
pub(super) fn colon(name: &Ident, input: ParseStream<'_>) -> Result<(), ListFault> {
    if !input.peek(Token![:]) {
        return Ok(());
    }
    let name = name.to_string();
    Err(Diagnostic::new(input.span(), SyntaxMessage::Colon { name }).into())
}

/// Refuses other brackets than those that should come.
pub(super) fn brackets(
    input: ParseStream<'_>,
    what: &'static str,
    wanted: &'static str,
) -> Result<(), ListFault> {
    let round = wanted == "( )";
    let wrong = if round {
        input.peek(token::Bracket)
    } else {
        input.peek(token::Paren)
    };
    if !wrong && !input.peek(token::Brace) {
        return Ok(());
    }
    Err(Diagnostic::new(input.span(), SyntaxMessage::Brackets { what, wanted }).into())
}

/// The next token is not `what` it should be.
pub(super) fn expected(input: ParseStream<'_>, what: &'static str) -> ListFault {
    if input.is_empty() {
        ListFault::AtEnd(what)
    } else {
        let found = found(input);
        Diagnostic::new(input.span(), SyntaxMessage::Expected { what, found }).into()
    }
}

/// The next token as a message shows it: marks together with what they belong to.
pub(super) fn found(input: ParseStream<'_>) -> String {
    let mut text = String::new();
    for token in input.cursor().token_stream() {
        let goes_on = matches!(
            &token,
            TokenTree::Punct(mark) if mark.as_char() == '-' || mark.spacing() == Spacing::Joint
        );
        match &token {
            TokenTree::Group(group) => match group.delimiter() {
                Delimiter::Parenthesis => text.push_str("( )"),
                Delimiter::Bracket => text.push_str("[ ]"),
                Delimiter::Brace => text.push_str("{ }"),
                Delimiter::None => text.push_str(&group.stream().to_string()),
            },
            token => text.push_str(&token.to_string()),
        }
        if !goes_on {
            break;
        }
    }
    shortened(text)
}

/// A text as far as a message shows it.
pub(super) fn shortened(text: String) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// Why a member of a list could not be read.
pub(super) enum ListFault {
    /// The list ended where this should have followed. Only who opened the list
    /// knows the place.
    AtEnd(&'static str),
    /// Something is wrong at a known place.
    Found(Diagnostic),
}

impl ListFault {
    /// The error, where the list ends at `end`.
    fn placed(self, end: Span) -> Diagnostic {
        match self {
            Self::AtEnd(what) => Diagnostic::new(end, SyntaxMessage::Ended { what }),
            Self::Found(diagnostic) => diagnostic,
        }
    }
}

impl From<Diagnostic> for ListFault {
    fn from(diagnostic: Diagnostic) -> Self {
        Self::Found(diagnostic)
    }
}
