//! The pipeline on one page: from the tokens of an attribute to the tokens of its expansion.

use std::cell::OnceCell;

use crate::description::{self, CratePath, Description};
use crate::emit;
use crate::invocation;
use crate::mechanics::{self, AlgebraError, Mechanics};
use crate::program::{self, Pass, Program};
use crate::report::{Diagnostic, Faults, SizeMessage, SyntaxMessage, ValueMessage};
use crate::scene::{self, Scene};
use proc_macro2::{Span, TokenStream};
use quote::quote;

/// Results of all stages for one attribute.
#[derive(Debug)]
pub struct Stages {
    /// The attribute as written.
    pub description: Description,
    /// The validated tree.
    pub scene: Scene,
    /// The mechanics derived for the tree.
    pub mechanics: Mechanics,
    /// The code to emit, as a flat list of operations.
    pub program: Program,
    tokens: OnceCell<TokenStream>,
}

impl Stages {
    /// Returns the emitted tokens. They are written at the first call: a program that is only
    /// evaluated or shown is not.
    pub fn tokens(&self) -> &TokenStream {
        let Self {
            description,
            scene,
            mechanics,
            program,
            tokens,
        } = self;
        tokens.get_or_init(|| emit::emit(&description.item, scene, mechanics, program))
    }
}

/// Runs all stages on the tokens of an attribute and of the struct to which it is attached.
///
/// # Errors
/// The collected errors of the description, together with tokens to emit instead of an expansion:
/// the errors, and stubs that keep an editor from reporting further ones.
pub fn stages(attribute: TokenStream, item: TokenStream) -> Result<Stages, (Faults, TokenStream)> {
    stages_without(None, attribute, item)
}

/// Runs all stages like [`stages`], but leaves out one of the optimisation passes over programs, to
/// measure what that pass gains.
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
    if description.crate_path.is_none()
        && let Some(name) = invocation::renamed_runtime()
    {
        report.error(Span::call_site(), SyntaxMessage::RenamedCrate { name });
    }
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
    // No stage below can fail: a broken invariant is a bug of the compiler.
    debug_assert_eq!(program.verify(), Ok(()));
    Ok(Stages {
        description,
        scene,
        mechanics,
        program,
        tokens: OnceCell::new(),
    })
}

/// Expands the attribute. Returns tokens in every case: on errors they are `compile_error!` calls
/// and stubs.
pub fn expand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    match stages(attribute, item) {
        Ok(stages) => stages.tokens().clone(),
        Err((_, tokens)) => tokens,
    }
}

/// Builds the message about a failed derivation. If an observable caused the failure, the message
/// points to it.
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
        // A stub would cause further errors.
        let item = &description.item.tokens;
        return (report, quote!(#errors #item));
    }
    let path = description.crate_path.clone();
    let path = path.or_else(|| {
        invocation::renamed_runtime().map(|name| CratePath {
            global: true,
            segments: vec![name],
        })
    });
    let runtime = emit::runtime_path(&path.unwrap_or_default());
    let stub = emit::stub(description, &runtime);
    (report, quote!(#errors #stub))
}
