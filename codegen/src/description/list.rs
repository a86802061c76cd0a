//! Parsing of lists and of the tokens between their members. Parsing continues after a mistake.

use proc_macro2::{Delimiter, Ident, Spacing, Span, TokenStream, TokenTree};
use syn::ext::IdentExt as _;
use syn::parse::{ParseStream, Parser as _};
use syn::{Token, token};

use crate::report::{Diagnostic, Faults, SyntaxMessage};

/// The members of a list that could be parsed.
pub(super) struct List<T> {
    /// The members that could be parsed.
    pub(super) members: Vec<T>,
    /// True if at least one member could not be parsed.
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

/// Parses members separated by commas. After a mistake, parsing continues after the next comma.
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

/// Parses members of one type and collects them.
struct MemberReader<T, F> {
    members: Vec<T>,
    member: F,
}

/// Parser of list members whose type the caller does not know, so that the loop over a list is
/// compiled only once.
trait ReadMembers {
    fn read(&mut self, input: ParseStream<'_>, report: &mut Faults) -> Result<(), ListFault>;

    /// Removes the last member again.
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

/// Parses all members of a list. Returns true if a member could not be parsed.
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
                report.push(fault.with_span(end));
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

/// Parses `tokens` to their end, which is at the span `end`.
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
    value.ok_or_else(|| ListFault::AtEnd("a value").with_span(end).into())
}

/// Does the work of [`parse_all`]; the closure keeps the value, so that this function is compiled
/// only once.
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
        // The mistake is in `outcome`. Consume the rest, so that syn does not report it a second
        // time.
        input.parse::<TokenStream>().map(|_| ())
    };
    match (read.parse2(tokens), outcome) {
        (Ok(()), Some(outcome)) => outcome.map_err(|fault| fault.with_span(end).into()),
        _ => Err(ListFault::AtEnd("a value").with_span(end).into()),
    }
}

/// Parses a group with the given delimiters; returns its tokens and the span of the closing
/// delimiter.
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

/// Parses a name. Keywords are accepted here; a later stage refuses them with a clearer message.
pub(super) fn identifier(input: ParseStream<'_>, what: &'static str) -> Result<Ident, ListFault> {
    Ident::parse_any(input).map_err(|_| expected(input, what))
}

/// Parses a punctuation mark.
pub(super) fn take<T: syn::parse::Parse>(
    input: ParseStream<'_>,
    what: &'static str,
) -> Result<(), ListFault> {
    match input.parse::<T>() {
        Ok(_) => Ok(()),
        Err(_) => Err(expected(input, what)),
    }
}

/// Returns the next token if it is a name, without consuming it.
pub(super) fn next_name(input: ParseStream<'_>) -> Option<String> {
    let name = Ident::parse_any(&input.fork()).ok()?;
    Some(name.to_string())
}

/// Returns an error if `:` follows a name that a value should follow.
pub(super) fn colon(name: &Ident, input: ParseStream<'_>) -> Result<(), ListFault> {
    if !input.peek(Token![:]) {
        return Ok(());
    }
    let name = name.to_string();
    Err(Diagnostic::new(input.span(), SyntaxMessage::Colon { name }).into())
}

/// Returns an error if the next token opens brackets of the wrong kind.
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

/// Returns the error that the next token is not the expected one, which `what` names.
pub(super) fn expected(input: ParseStream<'_>, what: &'static str) -> ListFault {
    if input.is_empty() {
        ListFault::AtEnd(what)
    } else {
        let found = found(input);
        Diagnostic::new(input.span(), SyntaxMessage::Expected { what, found }).into()
    }
}

/// Returns the next token as a message shows it: punctuation together with the tokens that belong
/// to it.
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

/// Shortens a text for a message.
pub(super) fn shortened(text: String) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// Reason why a member of a list could not be parsed.
pub(super) enum ListFault {
    /// The list ended where the token with this name was expected. Only the caller that opened the
    /// list knows the span of its end.
    AtEnd(&'static str),
    /// A mistake at a known span.
    Found(Diagnostic),
}

impl ListFault {
    /// Returns the error with its span, given the span of the end of the list.
    fn with_span(self, end: Span) -> Diagnostic {
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
