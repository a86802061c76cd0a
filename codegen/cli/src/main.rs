//! Expands `#[branched_pendulum(...)]` in a source file.
//!
//! For builds that cannot or may not run the derivation: commit the output,
//! build it against `branched-pendulum` without its feature `macros`, and let
//! `--check` tell when it is stale.

mod arguments;
mod diagnostics;
mod source;

use arguments::{Arguments, Output, Stage};
use branched_pendulum_codegen::{
    Language, Stages, emit, layout, program, stages_without, translate,
};
use clap::Parser;
use source::{Finder, replace};
use std::io::{self, ErrorKind, IsTerminal, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use syn::visit::Visit;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(code) => code,
        Err(message) => {
            // Nobody may be left to read it.
            let _ = writeln!(io::stderr(), "{}", message.trim_end());
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<ExitCode, String> {
    let path = arguments.source.display().to_string();
    let source = read(&arguments.source)?;
    let error = |range, title: &str| diagnostics::one(&path, &source, range, title, is_styled());
    let file = syn::parse_file(&source)
        .map_err(|wrong| error(wrong.span().byte_range(), &wrong.to_string()))?;
    let mut finder = Finder::default();
    finder.visit_file(&file);
    if finder.found.is_empty() {
        let title = format!("{path}: no struct with #[branched_pendulum(...)]");
        return Err(format!("error: {title}"));
    }
    let mut replacements = finder.edits;
    let mut shown = String::new();
    for found in finder.found {
        let stages = stages_without(arguments.without, found.attribute, found.item);
        let stages = stages.map_err(|(report, _)| {
            diagnostics::all(&path, &source, &found.range, &report, is_styled())
        })?;
        match (arguments.stage, arguments.emit) {
            (Some(stage), _) => shown.push_str(&show(&stages, stage)),
            (None, Some(output)) => {
                let written = translated(&stages, output);
                shown.push_str(&written.ok_or_else(|| {
                    let title = "loops have no functions in other languages";
                    error(found.range, title) + "\nhelp: write `code = unrolled`"
                })?);
            }
            (None, None) => replacements.push((found.range, format_tokens(&stages)?)),
        }
    }
    if arguments.stage.is_none() && arguments.emit.is_none() {
        shown = replace(&source, replacements, &arguments.source);
    }
    deliver(arguments, &shown)
}

/// Colours on a terminal that shows them, to a user who wants them.
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

/// Writes a file that is whole or absent.
fn write(path: &Path, text: &str) -> Result<(), String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let part = path.with_file_name(format!(".{name}.part"));
    let written = std::fs::write(&part, text).and_then(|()| std::fs::rename(&part, path));
    written.map_err(|error| {
        let _ = std::fs::remove_file(&part);
        format!("error: cannot write {}: {error}", path.display())
    })
}

fn deliver(arguments: &Arguments, text: &str) -> Result<ExitCode, String> {
    if let Some(path) = &arguments.output {
        write(path, text)?;
    } else if let Some(path) = &arguments.check {
        let committed = read(path)?;
        if committed != text {
            let pairs = committed.lines().zip(text.lines());
            let line = pairs.take_while(|(a, b)| a == b).count() + 1;
            let path = path.display();
            let message = format!("{path}:{line}: stale from here on; write it anew with --output");
            let _ = writeln!(io::stderr(), "{message}");
            return Ok(ExitCode::from(3));
        }
    } else {
        // Whoever reads a pipe may have read enough.
        let mut out = io::stdout().lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                return Err(format!("error: cannot write: {error}"));
            }
            _ => {}
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

/// The functions in another language; `None` where they are loops.
fn translated(stages: &Stages, output: Output) -> Option<String> {
    let Stages {
        description,
        scene,
        mechanics,
        program,
        ..
    } = stages;
    let language = match output {
        Output::C => Language::C,
        Output::Numpy => Language::Numpy,
        Output::Julia => Language::Julia,
        Output::Latex => {
            let item = &description.item;
            return Some(emit::latex_document(item, scene, mechanics, program));
        }
    };
    translate(language, scene, program)
}

fn format_tokens(stages: &Stages) -> Result<String, String> {
    layout(stages.tokens.clone())
        .map(|text| text.trim_end().to_owned())
        .map_err(|error| {
            format!("error: the emitted code is no Rust (a bug of this tool): {error}")
        })
}
