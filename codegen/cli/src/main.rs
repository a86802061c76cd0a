//! Expands `#[branched_pendulum(...)]` in a source file.
//!
//! This is for builds that cannot or may not run the derivation: commit the output, build it
//! against `branched-pendulum` without its feature `macros`, and let `cargo branched-pendulum
//! check` report when it is outdated.

mod arguments;
mod diagnostics;
mod source;

use arguments::{Action, Arguments, Output, Source, Stage};
use branched_pendulum_codegen::{Language, Stages, layout, program, stages_without, translate};
use clap::Parser;
use proc_macro2::TokenStream;
use quote::ToTokens;
use source::{Finder, replace};
use std::ffi::OsString;
use std::fs::File;
use std::io::{self, ErrorKind, IsTerminal, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use syn::visit::Visit;

fn main() -> ExitCode {
    match run(&Arguments::parse_from(words()).action) {
        Ok(code) => code,
        Err(message) => {
            // Ignored: the reader of a pipe may have closed it.
            let _ = writeln!(io::stderr(), "{}", message.trim_end());
            ExitCode::FAILURE
        }
    }
}

/// Returns the command-line arguments, without the name of the subcommand that Cargo passes.
fn words() -> impl Iterator<Item = OsString> {
    let words = std::env::args_os().enumerate();
    words.filter_map(|(place, word)| (place != 1 || word != "branched-pendulum").then_some(word))
}

/// Destination of the output.
enum Destination<'a> {
    Written(Option<&'a Path>),
    Compared(&'a Path),
}

fn run(action: &Action) -> Result<ExitCode, String> {
    let (given, stage, emit, destination) = match action {
        Action::Expand { source, output } => {
            (source, None, None, Destination::Written(output.as_deref()))
        }
        Action::Check {
            source,
            committed,
            emit,
        } => (source, None, *emit, Destination::Compared(committed)),
        Action::Stage { stage, source } => (source, Some(*stage), None, Destination::Written(None)),
        Action::Emit {
            emit,
            source,
            output,
        } => (
            source,
            None,
            Some(*emit),
            Destination::Written(output.as_deref()),
        ),
    };
    deliver(&destination, &text(given, stage, emit)?)
}

/// Produces the requested text for a source file.
fn text(given: &Source, stage: Option<Stage>, emit: Option<Output>) -> Result<String, String> {
    let path = given.path.display().to_string();
    let source = read(&given.path)?;
    let error = |range, title: &str| diagnostics::one(&path, &source, range, title, is_styled());
    let finder = find(&path, &source)?;
    let mut replacements = finder.edits;
    let mut shown = String::new();
    for found in finder.found {
        let stages = stages_without(given.without, found.attribute, found.item);
        let stages = stages.map_err(|(report, _)| {
            diagnostics::all(&path, &source, &found.range, &report, is_styled())
        })?;
        let Stages {
            description,
            scene,
            mechanics,
            program,
            ..
        } = &stages;
        let item = &description.item;
        let refuse = |title: &str, code: &str| {
            error(found.range.clone(), title) + "\nhelp: write `code = " + code + "`"
        };
        let written_in = |language: Language| {
            let title = "code in loops cannot be translated to other languages";
            translate(language, scene, program).ok_or_else(|| refuse(title, "unrolled"))
        };
        match (stage, emit) {
            (Some(stage), _) => shown += &show(&stages, stage),
            (None, Some(Output::C)) => shown += &written_in(Language::C)?,
            (None, Some(Output::Numpy)) => shown += &written_in(Language::Numpy)?,
            (None, Some(Output::Julia)) => shown += &written_in(Language::Julia)?,
            (None, Some(Output::Latex)) => {
                shown += &branched_pendulum_codegen::emit::latex_document(
                    item, scene, mechanics, program,
                );
            }
            (None, Some(Output::Equations)) => {
                let title = "only code in loops contains the equations of a single link";
                let equations = branched_pendulum_codegen::emit::link_equations(
                    item, scene, mechanics, program,
                );
                let equations = equations.ok_or_else(|| refuse(title, "loops"))?;
                replacements.push((found.range, format_tokens(equations)?));
            }
            (None, None) => {
                let items = with_lints_allowed(stages.tokens().clone());
                replacements.push((found.range, format_tokens(items)?));
            }
        }
    }
    if stage.is_none() && matches!(emit, None | Some(Output::Equations)) {
        shown = replace(&source, replacements, &given.path);
    }
    Ok(shown)
}

/// Finds the structs with the attribute; an error if the source has none.
fn find(path: &str, source: &str) -> Result<Finder, String> {
    let file = syn::parse_file(source).map_err(|wrong| {
        let (range, title) = (wrong.span().byte_range(), wrong.to_string());
        diagnostics::one(path, source, range, &title, is_styled())
    })?;
    let mut finder = Finder::default();
    finder.visit_file(&file);
    if finder.found.is_empty() {
        let title = format!("{path}: no struct with #[branched_pendulum(...)]");
        return Err(format!("error: {title}"));
    }
    Ok(finder)
}

/// Returns true if messages are coloured: the terminal supports it and the user has not disabled
/// it.
fn is_styled() -> bool {
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    io::stderr().is_terminal()
        && set("NO_COLOR").is_none()
        && set("TERM").is_some_and(|terminal| terminal != "dumb")
}

fn read(path: &Path) -> Result<String, String> {
    let mut text = String::new();
    let read = match path.to_str() {
        Some("-") => io::stdin().read_to_string(&mut text).map(|_| text),
        _ => std::fs::read_to_string(path),
    };
    read.map_err(|error| format!("error: cannot read {}: {error}", path.display()))
}

/// Writes the file that the user names: it is replaced as a whole, or stays as it was. A link, a pipe or a device is
/// refused.
fn write(path: &Path, text: &str) -> Result<(), String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let part = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let failed = |error: io::Error| format!("error: cannot write {}: {error}", path.display());
    if std::fs::symlink_metadata(path).is_ok_and(|data| !data.is_file()) {
        return Err(failed(io::Error::other("it is not a regular file")));
    }
    // Exclusive: nothing else had this name.
    let mut file = File::create_new(&part).map_err(failed)?;
    let written = file.write_all(text.as_bytes());
    drop(file);
    let placed = written.and_then(|()| std::fs::rename(&part, path));
    placed.map_err(|error| {
        let _ = std::fs::remove_file(&part);
        failed(error)
    })
}

fn deliver(destination: &Destination<'_>, text: &str) -> Result<ExitCode, String> {
    match destination {
        Destination::Written(Some(path)) => write(path, text)?,
        Destination::Compared(path) => {
            let committed = read(path)?;
            if committed != text {
                let pairs = committed.lines().zip(text.lines());
                let line = pairs.take_while(|(a, b)| a == b).count() + 1;
                let path = path.display();
                let message = format!(
                    "{path}:{line}: stale: differs from the present expansion from this line on\n\
                     help: write it again with `expand --output {path}`"
                );
                let _ = writeln!(io::stderr(), "{message}");
                return Ok(ExitCode::from(3));
            }
        }
        Destination::Written(None) => {
            // Ignored: the reader of a pipe may have closed it.
            let mut out = io::stdout().lock();
            match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
                Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                    return Err(format!("error: cannot write: {error}"));
                }
                _ => {}
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn show(stages: &Stages, stage: Stage) -> String {
    match stage {
        Stage::Description => stages.description.to_string(),
        Stage::Scene => stages.scene.to_string(),
        Stage::Mechanics => stages.mechanics.to_string(),
        Stage::Program => stages.program.to_string(),
        Stage::Passes => program::worth(&stages.scene, &stages.mechanics),
    }
}

fn format_tokens(tokens: TokenStream) -> Result<String, String> {
    layout(tokens)
        .map(|text| text.trim_end().to_owned())
        .map_err(|error| {
            format!("error: the emitted code is not valid Rust (a bug of this tool): {error}")
        })
}

/// Adds attributes that allow the lints which the compiler does not apply to the output of a macro:
/// lints of style, and of items that no other code uses.
fn with_lints_allowed(tokens: TokenStream) -> TokenStream {
    let Ok(mut file) = syn::parse2::<syn::File>(tokens.clone()) else {
        return tokens;
    };
    for item in &mut file.items {
        let attributes = match item {
            syn::Item::Const(own) => &mut own.attrs,
            syn::Item::Fn(own) => &mut own.attrs,
            syn::Item::Impl(own) => &mut own.attrs,
            syn::Item::Static(own) => &mut own.attrs,
            syn::Item::Struct(own) => &mut own.attrs,
            syn::Item::Type(own) => &mut own.attrs,
            _ => continue,
        };
        attributes.push(syn::parse_quote!(
            #[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
        ));
    }
    file.into_token_stream()
}
