//! The pipeline on one page: from the tokens of an attribute to those of its expansion.

use crate::description::{self, Description};
use crate::emit;
use crate::mechanics::{self, AlgebraError, Mechanics};
use crate::program::{self, Pass, Program};
use crate::report::{Diagnostic, Faults, SizeMessage, ValueMessage};
use crate::scene::{self, Scene};
use proc_macro2::{Span, TokenStream};
use quote::quote;

/// Everything that the stages produce for one attribute.
#[derive(Debug)]
pub struct Stages {
    /// The attribute as written.
    pub description: Description,
    /// The validated tree.
    pub scene: Scene,
    /// The mechanics that were derived for it.
    pub mechanics: Mechanics,
    /// The code to write, as a flat program.
    pub program: Program,
    /// The emitted tokens.
    pub tokens: TokenStream,
}

/// Runs all stages on an attribute's tokens and the item it stands on.
///
/// # Errors
/// The collected errors of the description, with the tokens that stand in for
/// the item: its errors, and stubs so that an editor shows no others.
pub fn stages(attribute: TokenStream, item: TokenStream) -> Result<Stages, (Faults, TokenStream)> {
    stages_without(None, attribute, item)
}

/// As [`stages`], but without one of the passes over programs, to see the worth
/// of that one.
///
/// # Errors
/// The errors of [`stages`].
pub fn stages_without(
    off: Option<Pass>,
    attribute: TokenStream,
    item: TokenStream,
) -> Result<Stages, (Faults, TokenStream)> {
    let mut report = Faults::new();
    let Some(description) = description::parse(attribute, item.clone(), &mut report) else {
        let errors = report.to_compile_errors();
        return Err((report, quote!(#errors #item)));
    };
    let Some(scene) = scene::resolve(&description, &mut report) else {
        return Err(refuse(&description, report));
    };

    let mechanics = match mechanics::derive(&scene) {
        Ok(mechanics) => mechanics,
        Err(error) => {
            report.push(underivable(&description, &error));
            return Err(refuse(&description, report));
        }
    };
    let Ok(program) = program::lower(off, &scene, &mechanics) else {
        let limit = program::MOST_VALUES;
        report.error(Span::call_site(), SizeMessage::TooManyValues { limit });
        return Err(refuse(&description, report));
    };
    if let Some(name) = program.unrepresentable_constant() {
        let name = name.to_owned();
        report.error(Span::call_site(), ValueMessage::ConstantRange { name });
        return Err(refuse(&description, report));
    }
    // After this line nothing fails: a broken invariant is a bug.
    debug_assert_eq!(program.verify(), Ok(()));
    let tokens = emit::emit(&description.item, &scene, &mechanics, &program);
    Ok(Stages {
        description,
        scene,
        mechanics,
        program,
        tokens,
    })
}

/// Expands the attribute. Always gives tokens: on errors, `compile_error!`
/// calls and stubs.
pub fn expand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    match stages(attribute, item) {
        Ok(stages) => stages.tokens,
        Err((_, tokens)) => tokens,
    }
}

/// The message about a failed derivation, at the observable that is at fault if
/// one is.
fn underivable(description: &Description, error: &AlgebraError) -> Diagnostic {
    if let AlgebraError::DivisionByZero { observable } = error
        && let Some(found) = description
            .observables
            .iter()
            .find(|written| written.name == observable)
    {
        return Diagnostic::new(found.value.span, ValueMessage::DivisionByZero);
    }
    let message = match error {
        AlgebraError::TooManyTerms => SizeMessage::TooManyTerms {
            limit: mechanics::MOST_TERMS,
        },
        _ => SizeMessage::Algebra {
            reason: error.to_string(),
        },
    };
    Diagnostic::new(Span::call_site(), message)
}

fn refuse(description: &Description, report: Faults) -> (Faults, TokenStream) {
    let errors = report.to_compile_errors();
    if description.item.is_reserved() {
        // A stub would add errors.
        let item = &description.item.tokens;
        return (report, quote!(#errors #item));
    }
    let runtime = emit::runtime_path(&description.crate_path.clone().unwrap_or_default());
    let stub = emit::stub(description, &runtime);
    (report, quote!(#errors #stub))
}
