//! Layout of emitted docs: prose and formulas of bounded width.

use proc_macro2::TokenStream;
use quote::quote;

/// Width at which prose of emitted docs is wrapped, in characters.
const WIDTH: usize = 80;

/// Breaks a formula into lines of bounded width, before the signs of its sum. It breaks within
/// parentheses only if that is not enough.
pub(super) fn broken(formula: &str) -> Vec<String> {
    let fits = |lines: &Vec<String>| lines.iter().all(|line| line.chars().count() <= WIDTH + 4);
    let outermost = broken_within(formula, 0);
    if fits(&outermost) {
        return outermost;
    }
    broken_within(formula, 1)
}

/// Breaks a formula into lines before signs that are nested in at most `most` parentheses.
fn broken_within(formula: &str, most: i32) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut depth = 0_i32;
    let mut term = String::new();
    let mut flush = |term: &mut String, line: &mut String| {
        if !line.is_empty() && line.chars().count() + term.chars().count() > WIDTH {
            lines.push(std::mem::replace(line, "    ".into()));
            line.push_str(term.trim_start());
        } else {
            line.push_str(term);
        }
        term.clear();
    };
    for word in formula.split_inclusive(' ') {
        if depth <= most && matches!(word.trim_end(), "+" | "−") {
            flush(&mut term, &mut line);
        }
        for letter in word.chars() {
            depth += i32::from(letter == '(') - i32::from(letter == ')');
        }
        term.push_str(word);
    }
    flush(&mut term, &mut line);
    lines.push(line);
    lines
        .iter()
        .map(|line| line.trim_end().to_owned())
        .collect()
}

/// Converts lines to doc comments; prose is wrapped, blocks are not.
pub(super) fn doc_lines(lines: &[String]) -> TokenStream {
    let mut wrapped: Vec<String> = Vec::new();
    let mut in_block = false;
    for line in lines {
        let fence = line.starts_with("```");
        in_block ^= fence;
        if fence || in_block {
            wrapped.push(line.clone());
            continue;
        }
        let mut current = String::new();
        for word in line.split(' ') {
            let full = current.chars().count() + word.chars().count() >= WIDTH;
            // A sign at the start of a line would begin a list.
            if full && !current.is_empty() && !matches!(word, "+" | "-" | "*") {
                wrapped.push(std::mem::take(&mut current));
            }
            if !current.is_empty() {
                current.push(' ');
            }
            current.push_str(word);
        }
        wrapped.push(current);
    }
    let lines = wrapped.iter().map(|line| {
        let line = if line.is_empty() {
            String::new()
        } else {
            format!(" {line}")
        };
        quote!(#[doc = #line])
    });
    quote!(#(#lines)*)
}
