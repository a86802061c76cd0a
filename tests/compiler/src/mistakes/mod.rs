//! Descriptions with a mistake, at least one for each message of the front end.

mod asked;
mod gradient;
mod normal_form;
mod tree;
mod values;

/// The name of a golden and the source with the mistake.
pub type Mistake = (&'static str, &'static str);

/// All of them.
pub fn mistakes() -> impl Iterator<Item = Mistake> {
    [
        tree::MISTAKES,
        values::MISTAKES,
        asked::MISTAKES,
        gradient::MISTAKES,
        normal_form::MISTAKES,
    ]
    .into_iter()
    .flatten()
    .copied()
}
