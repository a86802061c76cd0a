//! The verdict in words and numbers, with the causes that were found.

use std::fmt::Write;

use serde_json::{Value, json};

use super::super::arguments::Arguments;
use super::super::report::percent;
use super::super::subject::Names;
use super::super::verdict::Verdict;
use super::{CauseSearch, told};

impl Verdict {
    /// The verdict in words, with what a search for causes found where the budget fails.
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
            if !search.leaps.is_empty() {
                let leaps = told(&search.leaps);
                let _ = writeln!(text, "  The motion leaps {leaps}: look at these pictures.");
            }
            let tried = match search.tried.is_empty() {
                true => "The".to_owned(),
                false => format!(
                    "None of the usual causes closes it ({}): the",
                    search.tried.join(", ")
                ),
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
            "causes": search.map(|search| search.closing.iter().map(|cause| {
                json!({ "cause": cause.words, "option": cause.option })
            }).collect::<Vec<_>>()),
            "tried": search.map(|search| &search.tried),
        })
    }
}
