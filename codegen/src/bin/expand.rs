//! Expands `#[branched_pendulum(...)]` in a source file.
//!
//! For builds that cannot or may not run the derivation: commit the output,
//! build it against `branched-pendulum` without its feature `macros`, and let
//! `--check` tell when it is stale.

use branched_pendulum_codegen::program::Pass;
use branched_pendulum_codegen::{Stages, layout, program, stages_without};
use proc_macro2::TokenStream;
use quote::ToTokens;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use syn::spanned::Spanned;
use syn::visit::Visit;

const HELP: &str = "\
Expands the attribute #[branched_pendulum(...)] in a Rust source file.

Usage: expand [OPTIONS] SOURCE

  SOURCE            Rust file with attributed structs
  --out FILE        write the expanded source to FILE (default: standard output)
  --check FILE      compare with FILE; exit with 1 where it is stale
  --stage STAGE     show a stage instead of code: description, scene, mechanics
                    or program; or what the passes over programs are worth: passes
  --without PASS    leave out a pass over programs, to compare: sharing, folding,
                    signs, angle-addition, common-factors, choice, fusing, order or
                    splitting
  -h, --help        this text

Everything but the attributed structs is copied as it stands; imports of the
attribute itself are left out.
";

fn main() -> ExitCode {
    match run() {
        Ok(code) => code,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

struct Arguments {
    source: PathBuf,
    out: Option<PathBuf>,
    check: Option<PathBuf>,
    stage: Option<String>,
    without: Option<Pass>,
}

const STAGES: [&str; 5] = ["description", "scene", "mechanics", "program", "passes"];

fn arguments() -> Result<Option<Arguments>, String> {
    let (mut source, mut out, mut check) = (None, None, None);
    let (mut stage, mut without) = (None, None);
    let mut words = std::env::args_os().skip(1);
    while let Some(word) = words.next() {
        let mut value = |option: &str| {
            words
                .next()
                .ok_or_else(|| format!("error: {option} needs a value; see --help"))
        };
        match word.to_str() {
            Some("-h" | "--help") => return Ok(None),
            Some("--out") => out = Some(PathBuf::from(value("--out")?)),
            Some("--check") => check = Some(PathBuf::from(value("--check")?)),
            Some("--stage") => {
                let name = value("--stage")?.to_string_lossy().into_owned();
                if !STAGES.contains(&name.as_str()) {
                    let known = STAGES.join(", ");
                    return Err(format!("error: no stage `{name}`; stages are {known}"));
                }
                stage = Some(name);
            }
            Some("--without") => {
                let name = value("--without")?.to_string_lossy().into_owned();
                let Some(pass) = Pass::named(&name) else {
                    let known = Pass::ALL.map(Pass::name).join(", ");
                    return Err(format!("error: no pass `{name}`; passes are {known}"));
                };
                without = Some(pass);
            }
            Some(option) if option.starts_with('-') => {
                return Err(format!("error: unknown option `{option}`; see --help"));
            }
            _ if source.is_none() => source = Some(PathBuf::from(word)),
            _ => return Err("error: more than one source file; see --help".into()),
        }
    }
    if out.is_some() && check.is_some() {
        return Err("error: --out and --check exclude each other".into());
    }
    let source = source.ok_or("error: no source file; see --help")?;
    Ok(Some(Arguments {
        source,
        out,
        check,
        stage,
        without,
    }))
}

fn run() -> Result<ExitCode, String> {
    let Some(arguments) = arguments()? else {
        print!("{HELP}");
        return Ok(ExitCode::SUCCESS);
    };
    let path = &arguments.source;
    let source = read(path)?;
    let file = syn::parse_file(&source).map_err(|error| {
        let at = error.span().start();
        format!("{}:{}:{}: {error}", path.display(), at.line, at.column + 1)
    })?;
    let mut finder = Finder::default();
    finder.visit_file(&file);
    if finder.found.is_empty() {
        return Err(format!(
            "{}: no struct with #[branched_pendulum(...)]",
            path.display()
        ));
    }
    let mut replacements = finder.edits;
    let mut shown = String::new();
    for found in finder.found {
        let stages = stages_without(arguments.without, found.attribute, found.item).map_err(
            |(report, _)| {
                let text = report.render(&source);
                format!("{}:\n{text}", path.display())
            },
        )?;
        match arguments.stage.as_deref() {
            Some(stage) => shown.push_str(&show(&stages, stage)),
            None => replacements.push((found.range, format_tokens(&stages)?)),
        }
    }
    if arguments.stage.is_none() {
        shown = replace(&source, replacements, path);
    }
    deliver(&arguments, &shown)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn deliver(arguments: &Arguments, text: &str) -> Result<ExitCode, String> {
    if let Some(path) = &arguments.out {
        std::fs::write(path, text)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    } else if let Some(path) = &arguments.check {
        let committed = read(path)?;
        if committed != text {
            let line = committed
                .lines()
                .zip(text.lines())
                .take_while(|(a, b)| a == b)
                .count()
                + 1;
            eprintln!(
                "{} is stale from line {line} on; write it anew with --out",
                path.display()
            );
            return Ok(ExitCode::from(1));
        }
    } else {
        use std::io::{ErrorKind, Write};
        let written = std::io::stdout().write_all(text.as_bytes());
        // Whoever reads a pipe may have read enough.
        if let Err(error) = written
            && error.kind() != ErrorKind::BrokenPipe
        {
            return Err(format!("cannot write: {error}"));
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn show(stages: &Stages, stage: &str) -> String {
    match stage {
        "description" => stages.description.to_string(),
        "scene" => stages.scene.to_string(),
        "mechanics" => stages.mechanics.to_string(),
        "passes" => program::worth(&stages.scene, &stages.mechanics),
        _ => stages.program.to_string(),
    }
}

fn format_tokens(stages: &Stages) -> Result<String, String> {
    layout(stages.tokens.clone())
        .map(|text| text.trim_end().to_owned())
        .map_err(|error| format!("the emitted code is no Rust (a bug of this tool): {error}"))
}

/// An attributed struct: what the macro would receive, and where it stands.
struct AttributedStruct {
    attribute: TokenStream,
    item: TokenStream,
    range: Range<usize>,
}

#[derive(Default)]
struct Finder {
    found: Vec<AttributedStruct>,
    edits: Vec<(Range<usize>, String)>,
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        let position = item.attrs.iter().position(|attribute| {
            attribute
                .path()
                .segments
                .last()
                .is_some_and(|segment| segment.ident == "branched_pendulum")
        });
        if let Some(position) = position {
            let mut item = item.clone();
            let range = item.span().byte_range();
            let attribute = match item.attrs.remove(position).meta {
                syn::Meta::List(list) => list.tokens,
                _ => TokenStream::new(),
            };
            self.found.push(AttributedStruct {
                attribute,
                item: item.into_token_stream(),
                range,
            });
        }
    }

    /// `use branched_pendulum::branched_pendulum;` names what is not there
    /// without the feature `macros`; `use branched_pendulum::prelude::*;` may
    /// have served the attribute alone.
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let mut tree = &item.tree;
        let mut last = None;
        while let syn::UseTree::Path(path) = tree {
            last = Some(&path.ident);
            tree = &path.tree;
        }
        let range = item.span().byte_range();
        match tree {
            syn::UseTree::Name(name) if name.ident == "branched_pendulum" => {
                self.edits.push((range, String::new()));
            }
            syn::UseTree::Glob(_) if last.is_some_and(|name| name == "prelude") => {
                let allow = "#[allow(unused_imports)]\n".to_owned();
                self.edits.push((range.start..range.start, allow));
            }
            _ => {}
        }
    }
}

fn replace(source: &str, mut replacements: Vec<(Range<usize>, String)>, path: &Path) -> String {
    replacements.sort_by_key(|(range, _)| range.start);
    let name = path.file_name().map_or_else(
        || path.display().to_string(),
        |n| n.to_string_lossy().into_owned(),
    );
    let mut text = format!(
        "// Expanded from {name} by `expand` of branched-pendulum-codegen {}. Do not edit.\n",
        env!("CARGO_PKG_VERSION")
    );
    let mut at = 0;
    for (range, replacement) in replacements {
        text.push_str(source.get(at..range.start).unwrap_or_default());
        text.push_str(&replacement);
        at = range.end;
        // A region that is left out takes its line along.
        let rest = source.get(at..).unwrap_or_default();
        if replacement.is_empty() && rest.starts_with('\n') {
            at += 1;
        }
    }
    text.push_str(source.get(at..).unwrap_or_default());
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}
