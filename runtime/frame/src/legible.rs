//! Replacement of NaN and infinity in printed text.

use std::borrow::Cow;

/// Words that are printed in place of a number that is not finite.
const UNKNOWN: &str = "(not determined)";

/// Returns the text with words in place of NaN and infinity, and with a last line that gives the
/// reason. Other text is unchanged.
pub(crate) fn legible(text: &str) -> Cow<'_, str> {
    const WORDS: [&str; 3] = ["NaN", "inf", "infinity"];
    let is_part = |c: char| c.is_alphanumeric() || "_-./\\`".contains(c);
    let mut found = Vec::new();
    for word in WORDS {
        for (start, _) in text.match_indices(word) {
            let (before, after) = (&text[..start], &text[start + word.len()..]);
            let sign = before.strip_suffix(['-', '+', '−', '±']).unwrap_or(before);
            let is_end = |rest: &str| {
                let mut rest = rest.chars();
                match (rest.next(), rest.next()) {
                    (Some('.'), next) => next.is_none_or(char::is_whitespace),
                    (next, _) => !next.is_some_and(is_part),
                }
            };
            if !sign.ends_with(is_part) && is_end(after) {
                // A minus sign belongs to the number, another to the sentence.
                let start = before.strip_suffix('-').map_or(start, str::len);
                found.push(start..text.len() - after.len());
            }
        }
    }
    if found.is_empty() {
        return Cow::Borrowed(text);
    }
    found.sort_by_key(|place| place.start);
    let mut legible = String::with_capacity(text.len());
    let mut end = 0;
    for place in found {
        legible += &text[end..place.start];
        legible += UNKNOWN;
        end = place.end;
    }
    legible += &text[end..];
    if !legible.ends_with('\n') {
        legible.push('\n');
    }
    legible += UNKNOWN;
    legible +=
        ": no finite number follows from these data, since a part of it has no size or no data.\n";
    Cow::Owned(legible)
}

#[cfg(test)]
mod tests {
    use super::legible;

    /// Checks that NaN and infinity are replaced in all kinds of sentences, but not in names and
    /// words.
    #[test]
    fn no_number_is_written_that_is_none() {
        for (text, expected) in [
            ("P to NaN % of P\n", "P to (not determined) % of P\n"),
            ("c 1.2 ± NaN N m s", "c 1.2 ± (not determined) N m s\n"),
            (
                "from -inf to inf.\n",
                "from (not determined) to (not determined).\n",
            ),
            ("(NaN, 3)\n", "((not determined), 3)\n"),
            ("x = ±inf\n", "x = ±(not determined)\n"),
        ] {
            let written = legible(text);
            let rest = written.strip_prefix(expected);
            let reason = rest.unwrap_or_else(|| panic!("{text}: {written}"));
            assert!(
                reason.starts_with("(not determined): no finite number"),
                "{reason}"
            );
        }
        for text in [
            "information of 3 links, NaNometre, inf_1, sub-inf, `NaN`\n",
            "results/NaN.csv and inf.csv\n",
            "nan.txt: 12 rows\n",
        ] {
            assert_eq!(legible(text), text);
        }
    }
}
