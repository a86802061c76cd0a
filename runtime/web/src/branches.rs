//! Adds a branch to, or removes one from, the text of a description.

use std::ops::Range;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use wasm_bindgen::prelude::wasm_bindgen;

/// A link in a text: `name(properties) [children] * copies`, in which the shape, the children and
/// the copies are optional.
struct Written {
    name: String,
    /// The whole text.
    place: Range<usize>,
    /// Name of the shape, if there is one.
    shape: Option<String>,
    properties: Range<usize>,
    children: Option<(Range<usize>, Vec<Written>)>,
    /// The text `* number` of the copies, and the number.
    copies: Option<(Range<usize>, usize)>,
}

impl Written {
    /// Returns all links at the top level of a list of tokens.
    fn all(tokens: TokenStream) -> Vec<Self> {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let (mut rest, mut links) = (&tokens[..], Vec::new());
        while let Some((_, behind)) = rest.split_first() {
            rest = match Self::read(rest) {
                Some((link, behind)) => {
                    links.push(link);
                    behind
                }
                None => behind,
            };
        }
        links
    }

    /// Reads the link at the beginning of the tokens; returns it and the remaining tokens.
    fn read(tokens: &[TokenTree]) -> Option<(Self, &[TokenTree])> {
        let (TokenTree::Ident(name), rest) = tokens.split_first()? else {
            return None;
        };
        let (shape, rest) = match rest {
            [TokenTree::Punct(colon), TokenTree::Ident(shape), rest @ ..]
                if colon.as_char() == ':' =>
            {
                (Some(shape.to_string()), rest)
            }
            rest => (None, rest),
        };
        let (properties, rest) = group(rest, Delimiter::Parenthesis)?;
        let (children, rest) = match group(rest, Delimiter::Bracket) {
            Some((children, rest)) => {
                let links = Self::all(children.stream());
                (Some((children.span().byte_range(), links)), rest)
            }
            None => (None, rest),
        };
        let (copies, rest) = match rest {
            [
                TokenTree::Punct(star),
                TokenTree::Literal(count),
                behind @ ..,
            ] if star.as_char() == '*' => {
                let place = star.span().byte_range().start..count.span().byte_range().end;
                match count.to_string().parse() {
                    Ok(count) => (Some((place, count)), behind),
                    Err(_) => (None, rest),
                }
            }
            rest => (None, rest),
        };
        let properties = properties.span().byte_range();
        let mut end = properties.end;
        if let Some((place, _)) = &children {
            end = place.end;
        }
        if let Some((place, _)) = &copies {
            end = place.end;
        }
        let link = Self {
            name: name.to_string(),
            place: name.span().byte_range().start..end,
            shape,
            properties,
            children,
            copies,
        };
        Some((link, rest))
    }

    fn children(&self) -> &[Self] {
        self.children.as_ref().map_or(&[], |(_, links)| links)
    }

    /// Finds a link by its name, and its parent.
    fn find<'a>(links: &'a [Self], above: Option<&'a Self>, name: &str) -> Option<Found<'a>> {
        links.iter().find_map(|link| match link.name == name {
            true => Some(Found { link, above }),
            false => Self::find(link.children(), Some(link), name),
        })
    }

    fn is_rule(&self) -> bool {
        self.shape.as_deref() == Some("generations")
    }
}

struct Found<'a> {
    link: &'a Written,
    above: Option<&'a Written>,
}

fn group(tokens: &[TokenTree], delimiter: Delimiter) -> Option<(&Group, &[TokenTree])> {
    match tokens.split_first()? {
        (TokenTree::Group(group), rest) if group.delimiter() == delimiter => Some((group, rest)),
        _ => None,
    }
}

fn replaced(text: &str, place: Range<usize>, by: &str) -> String {
    let mut text = text.to_owned();
    text.replace_range(place, by);
    text
}

/// Changes a text at the link with this name in the tree, which is the name in the text followed by
/// the numbers of the copies.
fn changed(
    text: &str,
    name: &str,
    change: impl FnOnce(&str, Found<'_>) -> Result<String, String>,
) -> Result<String, String> {
    let tokens: TokenStream = text.parse().map_err(|_| "the description has a mistake")?;
    let links = Written::all(tokens);
    let mut written = name;
    loop {
        if let Some(found) = Written::find(&links, None, written) {
            return match found.link.is_rule() {
                true => {
                    Err("a tree by rule has its branches by `branching` and `count`".to_owned())
                }
                false => change(text, found),
            };
        }
        written = match written.rsplit_once('_') {
            Some((stem, _)) => stem,
            None => return Err(format!("there is no link `{name}` in the text")),
        };
    }
}

/// Returns the description with one more branch on a link: another copy of its last child or, if it
/// has no child, a child like itself.
///
/// # Errors
/// Fails if the text does not contain the link, or if the tree is given by a rule.
#[wasm_bindgen]
pub fn with_branch(text: &str, name: &str) -> Result<String, String> {
    changed(text, name, |text, Found { link, .. }| {
        let Some(child) = link.children().last() else {
            let end = link.properties.end;
            let place = link
                .children
                .as_ref()
                .map_or(end..end, |(place, _)| place.clone());
            let shape = link
                .shape
                .as_ref()
                .map_or_else(String::new, |shape| format!(": {shape}"));
            let like = text.get(link.properties.clone()).unwrap_or_default();
            let name = &link.name;
            return Ok(replaced(
                text,
                place,
                &format!(" [{name}_twig{shape}{like}]"),
            ));
        };
        Ok(match &child.copies {
            Some((place, count)) => replaced(text, place.clone(), &format!("* {}", count + 1)),
            None => replaced(text, child.place.end..child.place.end, " * 2"),
        })
    })
}

/// Returns the description with one branch less: with one copy less of the link or, if there is
/// only one, without the link and its descendants.
///
/// # Errors
/// Fails if the text does not contain the link, if the tree is given by a rule, or if the link is
/// the root.
#[wasm_bindgen]
pub fn without_branch(text: &str, name: &str) -> Result<String, String> {
    changed(text, name, |text, Found { link, above }| {
        let (Some(above), whole) = (above, link.place.clone()) else {
            return Err("all links hang from the root".to_owned());
        };
        match &link.copies {
            Some((place, count)) if *count > 2 => {
                Ok(replaced(text, place.clone(), &format!("* {}", count - 1)))
            }
            Some((place, 2)) => {
                let kept = text.get(..place.start).unwrap_or_default().trim_end().len();
                Ok(replaced(text, kept..place.end, ""))
            }
            _ => match &above.children {
                Some((place, links)) if links.len() == 1 => {
                    let kept = text.get(..place.start).unwrap_or_default().trim_end().len();
                    Ok(replaced(text, kept..place.end, ""))
                }
                _ => {
                    let behind = text.get(whole.end..).unwrap_or_default();
                    let space = behind.len() - behind.trim_start().len();
                    let comma = usize::from(behind.trim_start().starts_with(','));
                    Ok(replaced(
                        text,
                        whole.start..whole.end + (space + 1) * comma,
                        "",
                    ))
                }
            },
        }
    })
}
