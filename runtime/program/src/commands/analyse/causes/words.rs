//! Verdict on the energy budget in words and numbers, with the causes of a gap.

use std::fmt::Write;

use branched_pendulum_data::AngleUnit;
use serde_json::{Value, json};

use super::super::arguments::Arguments;
use super::super::report::percent;
use super::super::subject::Names;
use super::super::verdict::Verdict;
use super::{Cause, CauseSearch, stretches_in_words};

/// Causes in numbers.
fn values(causes: &[Cause]) -> Vec<Value> {
    let value =
        |own: &Cause| json!({ "cause": own.words, "option": own.option, "share": own.share });
    causes.iter().map(value).collect()
}

/// Describes an energy budget that no cause closes.
fn open(arguments: &Arguments, search: &CauseSearch) -> String {
    let mut text = String::new();
    for (index, cause) in search.partial.iter().enumerate() {
        let also = if index == 0 {
            "Most of"
        } else {
            "Even more of"
        };
        let share = percent(cause.share);
        let _ = writeln!(text, "  {also} the gap, {share} of it, goes where {cause}");
    }
    if !search.leaps.is_empty() {
        let leaps = stretches_in_words(&search.leaps);
        let _ = writeln!(text, "  The motion leaps {leaps}: look at these pictures.");
    }
    let tried = search.tried.join(", ");
    let tried = match (search.tried.is_empty(), search.partial.is_empty()) {
        (true, _) => "The".to_owned(),
        (false, true) => format!("None of the usual causes closes it ({tried}): the"),
        (false, false) => "If it does not close with this, the".to_owned(),
    };
    // By the equations the integral is not taken from picture to picture.
    let few = match arguments.model {
        true => ")",
        false => "; --model finds some that is lacking), or the pictures are too few",
    };
    let _ = writeln!(
        text,
        "  {tried} pendulum is not the assumed one with this friction (--set, --parameters{few}."
    );
    if matches!(arguments.measured.unit, Some(AngleUnit::Counts(_))) {
        text += "  An encoder may count from anywhere, each from another place: `identify` finds the \
                 offsets of links from such a file, for --parameters, and --rest takes them from a \
                 stretch at rest.\n";
    }
    text
}

impl Verdict {
    /// Describes the verdict, with the result of a search for causes if the budget does not close.
    pub fn words(
        &self,
        arguments: &Arguments,
        names: &Names,
        search: Option<&CauseSearch>,
    ) -> String {
        let energy = &names.energy;
        let (bars, allowed) = (self.bars, self.allowed);
        let Some(time) = self.fails_from else {
            return format!(
                "The energy budget closes: ∫ d{energy}/dt dt is the change of {energy} at all times, \
                 to {bars:.1} deviations ({allowed:.1} would be too many).\n"
            );
        };
        let mut text = format!(
            "The energy budget does not close: from {} s on ∫ d{energy}/dt dt is not the change \
             of {energy}, by up to {bars:.1} deviations ({allowed:.1} are too many) and {} of the \
             largest {energy}.\n",
            (1e4 * time).round() / 1e4,
            percent(self.trust.closure)
        );
        let search = search.cloned().unwrap_or_default();
        for (index, cause) in search.closing.iter().enumerate() {
            let also = if index == 0 { "" } else { " as well" };
            let _ = writeln!(text, "  It closes{also} where {cause}");
        }
        if search.closing.is_empty() {
            text += &open(arguments, &search);
        }
        text
    }

    /// The verdict in numbers.
    pub fn values(&self, search: Option<&CauseSearch>) -> Value {
        json!({
            "closes": self.closes(),
            "fails_from": self.fails_from,
            "bars": self.bars,
            "allowed_bars": self.allowed,
            "closure_of_largest": self.trust.closure,
            "causes": search.map(|search| values(&search.closing)),
            "partial_causes": search.map(|search| values(&search.partial)),
            "tried": search.map(|search| &search.tried),
        })
    }
}
