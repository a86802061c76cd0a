//! Parser of the members of `emit(...)` and `observe(...)`.

use proc_macro2::Delimiter;
use syn::parse::ParseStream;
use syn::{Token, token};

use super::expression::whole_number;
use super::list::{ListFault, group, identifier, list, take};
use super::{Expression, ObservableClause, Request, RequestForm};
use crate::report::Faults;

pub(super) fn request(input: ParseStream<'_>, report: &mut Faults) -> Result<Request, ListFault> {
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

pub(super) fn observable(
    input: ParseStream<'_>,
    _: &mut Faults,
) -> Result<ObservableClause, ListFault> {
    let name = identifier(input, "an observable, as in `height = cos(theta_bob)`")?;
    take::<Token![=]>(input, "`=` and an expression")?;
    let value = Expression::parse(input)?;
    Ok(ObservableClause { name, value })
}

fn form(input: ParseStream<'_>, report: &mut Faults) -> Result<RequestForm, ListFault> {
    let name = identifier(input, "`angle = 1`, `amplitude = 2` or `exact`")?;
    let value = if input.peek(Token![=]) {
        take::<Token![=]>(input, "`=`")?;
        Some(whole_number(input, "a whole number, the order")?)
    } else {
        None
    };
    let members = if value.is_none() && input.peek(token::Paren) {
        let names = group(input, Delimiter::Parenthesis, "`(`")?;
        let member = |input: ParseStream<'_>, _: &mut Faults| identifier(input, "a sector");
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
