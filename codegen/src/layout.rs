//! Emitted tokens as text, laid out to be read.

use proc_macro2::TokenStream;

/// Emitted tokens as formatted source text: items, and functions within an
/// `impl`, stand a blank line apart.
///
/// # Errors
/// Where the tokens are no Rust file, which those of [`crate::expand`] always are.
pub fn layout(tokens: TokenStream) -> syn::Result<String> {
    let file = syn::parse2(tokens)?;
    Ok(spaced(&prettyplease::unparse(&file)))
}

/// Puts blank lines between items.
fn spaced(text: &str) -> String {
    let mut spaced = String::with_capacity(text.len() + text.len() / 32);
    let mut before = "";
    for line in text.lines() {
        if is_apart(before, line) {
            spaced.push('\n');
        }
        spaced.push_str(line);
        spaced.push('\n');
        before = line;
    }
    spaced
}

/// Whether `line` begins an item behind one that ends with `before`.
fn is_apart(before: &str, line: &str) -> bool {
    let (outer, item) = unindented(line);
    let (inner, end) = unindented(before);
    let ended = end == "}" || (end.ends_with(';') && !end.starts_with("//"));
    if outer != inner || !ended {
        return false;
    }
    // Items stand in the file or in an `impl`; in functions those with docs.
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

fn unindented(line: &str) -> (usize, &str) {
    let text = line.trim_start();
    (line.len() - text.len(), text)
}

#[cfg(test)]
mod tests {
    use super::layout;
    use quote::quote;

    #[test]
    fn items_stand_apart_and_statements_do_not() {
        let tokens = quote! {
            struct Model { a: u8, b: u8 }
            impl Model {
                const A: u8 = 1;
                const B: u8 = 2;
                fn first() {
                    if true {
                        f();
                    }
                    #[allow(unused)]
                    let a = 1;
                }
                /// Second;
                /// not the third.
                fn second() {}
            }
        };
        let expected = "\
struct Model {
    a: u8,
    b: u8,
}

impl Model {
    const A: u8 = 1;
    const B: u8 = 2;

    fn first() {
        if true {
            f();
        }
        #[allow(unused)]
        let a = 1;
    }

    /// Second;
    /// not the third.
    fn second() {}
}
";
        assert_eq!(layout(tokens).unwrap(), expected);
    }
}
