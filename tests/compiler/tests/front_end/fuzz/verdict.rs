//! Properties that the expansion of any description must have.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

use branched_pendulum_codegen::report::{Faults, Message, SizeMessage};
use branched_pendulum_codegen::stages;
use proc_macro2::TokenStream;
use syn::{Fields, ImplItem, Item, Type};

/// Result of one expansion.
pub(crate) enum Verdict {
    /// A model.
    Expanded,
    /// Messages of ours.
    Refused,
    /// Neither: what is wrong, in words.
    Broken(String),
}

/// Expands a description and looks at what comes out; with the processor time of the expansion.
pub(crate) fn judge(attribute: &TokenStream, item: &TokenStream) -> (Verdict, Duration) {
    let start = processor_time();
    let expanded = catch_unwind(AssertUnwindSafe(|| {
        stages(attribute.clone(), item.clone()).map(|stages| stages.tokens().clone())
    }));
    let time = processor_time().saturating_sub(start);
    (verdict(expanded, item), time)
}

fn verdict(
    expanded: std::thread::Result<Result<TokenStream, (Faults, TokenStream)>>,
    item: &TokenStream,
) -> Verdict {
    let (refused, tokens) = match expanded {
        Ok(Ok(tokens)) => (false, tokens),
        Ok(Err((report, tokens))) => {
            let diagnostics = report.diagnostics();
            let derivation = diagnostics.iter().find_map(|found| match &found.message {
                Message::Size(SizeMessage::Algebra { reason }) => Some(reason),
                _ => None,
            });
            if let Some(reason) = derivation {
                return Verdict::Broken(format!("the derivation failed: {reason}"));
            }
            if diagnostics.is_empty() {
                return Verdict::Broken("refused without a message".into());
            }
            (true, tokens)
        }
        Err(_) => return Verdict::Broken("panicked".into()),
    };
    let file = match syn::parse2::<syn::File>(tokens) {
        Ok(file) => file,
        // The item stands in its own output where it is no struct.
        Err(_) if refused && syn::parse2::<syn::ItemStruct>(item.clone()).is_err() => {
            return Verdict::Refused;
        }
        Err(error) => return Verdict::Broken(format!("the output is no Rust: {error}")),
    };
    match repeated(&file) {
        Some(name) => Verdict::Broken(format!("`{name}` is defined twice")),
        None if refused => Verdict::Refused,
        None => Verdict::Expanded,
    }
}

/// A method, field or argument that has the name of another: rustc would say so
/// below our messages.
fn repeated(file: &syn::File) -> Option<String> {
    let mut methods = BTreeSet::new();
    for item in &file.items {
        match item {
            Item::Impl(block) if block.trait_.is_none() => {
                let Type::Path(model) = &*block.self_ty else {
                    continue;
                };
                let model = model.path.segments.last()?.ident.to_string();
                for item in &block.items {
                    let ImplItem::Fn(method) = item else { continue };
                    let name = method.sig.ident.to_string();
                    if !methods.insert((model.clone(), name.clone())) {
                        return Some(name);
                    }
                }
            }
            Item::Struct(item) => {
                let Fields::Named(fields) = &item.fields else {
                    continue;
                };
                let mut names = BTreeSet::new();
                for field in &fields.named {
                    let name = field.ident.as_ref()?.to_string();
                    if !names.insert(name.clone()) {
                        return Some(name);
                    }
                }
            }
            _ => {}
        }
    }
    None
}

/// Processor time of this process so far; the time of the clock where the system
/// does not say it.
pub(crate) fn processor_time() -> Duration {
    // Ticks in user and system mode are the 14th and 15th fields, the 12th and 13th
    // behind the program's name in parentheses; a tick is 10 ms.
    let ticks = std::fs::read_to_string("/proc/self/stat")
        .ok()
        .and_then(|text| {
            let fields = text.rsplit_once(')')?.1.split_whitespace();
            let ticks: Option<Vec<u64>> = fields.skip(11).take(2).map(|n| n.parse().ok()).collect();
            Some(ticks?.iter().sum::<u64>())
        });
    match ticks {
        Some(ticks) => Duration::from_millis(10 * ticks),
        None => std::time::SystemTime::UNIX_EPOCH
            .elapsed()
            .unwrap_or_default(),
    }
}

/// Most memory that this process has held so far, in bytes, where the system says it.
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}
