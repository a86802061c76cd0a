//! Formatting of emitted tokens as readable source text.

use proc_macro2::TokenStream;

/// Longest line, in characters.
const WIDTH: usize = 89;

/// Formats emitted tokens as source text. Items, and the functions of an `impl`, are separated by
/// blank lines.
///
/// # Errors
/// An error if the tokens are not a Rust file; the tokens that [`crate::expand`] returns always are
/// one.
pub fn layout(tokens: TokenStream) -> syn::Result<String> {
    let file = syn::parse2(tokens)?;
    Ok(spaced(&prettyplease::unparse(&file)))
}

/// Puts blank lines between items.
fn spaced(text: &str) -> String {
    let mut spaced = String::with_capacity(text.len() + text.len() / 32);
    let mut before = "";
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if is_apart(before, line) {
            spaced.push('\n');
        }
        before = line;
        if is_open_pattern(line) {
            let mut whole = line.to_owned();
            while !whole.contains(']') {
                let Some(next) = lines.next() else {
                    break;
                };
                whole.push(' ');
                whole.push_str(next.trim());
            }
            push_pattern(&mut spaced, &whole);
        } else {
            spaced.push_str(line);
            spaced.push('\n');
        }
    }
    spaced
}

/// Returns true if `line` begins a new item and `before` ends the previous one, so that a blank
/// line belongs between them.
fn is_apart(before: &str, line: &str) -> bool {
    let (outer, item) = unindented(line);
    let (inner, end) = unindented(before);
    let ended = end == "}" || (end.ends_with(';') && !end.starts_with("//"));
    if outer != inner || !ended {
        return false;
    }
    // Indented by at most four columns are the items of a file or of an `impl`. Deeper items,
    // within functions, get a blank line only if they have docs.
    if outer > 4 {
        return item.starts_with("///");
    }
    let begins = |words: &[&str], text: &str| words.iter().any(|word| text.starts_with(word));
    let lines = ["const ", "type ", "use "];
    if begins(&lines, end) && begins(&lines, item) {
        return false;
    }
    begins(&lines, item)
        || begins(
            &["///", "#[", "pub ", "pub(", "fn ", "impl", "struct "],
            item,
        )
}

/// Returns true if `line` opens a slice pattern that goes on over several lines. (An array
/// expression over several lines has no element on its first line.)
fn is_open_pattern(line: &str) -> bool {
    let pattern = line.trim_start();
    let pattern = pattern.strip_prefix("let ").unwrap_or(pattern);
    let elements = pattern.strip_prefix('[');
    elements.is_some_and(|elements| !elements.is_empty() && !elements.contains(']'))
}

/// Writes `let [a, b, …] = value;` with the elements on several lines.
fn push_pattern(text: &mut String, pattern: &str) {
    let (indent, _) = unindented(pattern);
    let (start, elements) = pattern.split_once('[').unwrap_or((pattern, ""));
    let (elements, end) = elements.split_once(']').unwrap_or((elements, ""));
    let (outer, inner) = (" ".repeat(indent), " ".repeat(indent + 4));
    let mut line = inner.clone();
    text.push_str(&format!("{start}[\n"));
    let elements = elements.split(", ").filter(|element| !element.is_empty());
    for element in elements {
        if line.len() + element.len() > WIDTH {
            text.push_str(line.trim_end());
            text.push('\n');
            line.clone_from(&inner);
        }
        line.push_str(element);
        line.push_str(", ");
    }
    text.push_str(line.trim_end());
    text.push_str(&format!("\n{outer}]{end}\n"));
}

fn unindented(line: &str) -> (usize, &str) {
    let text = line.trim_start();
    (line.len() - text.len(), text)
}
