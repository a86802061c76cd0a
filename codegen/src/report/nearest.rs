//! Suggestions for misspelt names.

/// Returns the element of `known` that needs the fewest changed, missing, added or swapped letters
/// to become `name`, or `None` if all need more than a third of its letters. Time O(letters² ·
/// known).
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let longest = 1 + name.chars().count() / 3;
    known
        .iter()
        .map(|&candidate| (strsim::osa_distance(name, candidate), candidate))
        .filter(|&(distance, _)| distance <= longest)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}
