//! Tables that cannot be read as they are, because their angles jump.

use branched_pendulum_data::{ReadErrorKind, Table};

use super::super::arguments::Arguments;
use super::super::source::Source;
use super::change::Change;
use super::readings::{lost, units};
use crate::Failure;
use crate::measured_file::MeasuredLinks;

/// Adds to the error of a table whose angles jump the options with which it can be read: without
/// rows in which a dot was lost, or with another unit. Returns other errors unchanged.
pub fn with_remedy(
    error: Failure,
    table: &Table,
    arguments: &Arguments,
    hung: &MeasuredLinks,
) -> Failure {
    let Failure::Reading(refused) = &error else {
        return error;
    };
    let ReadErrorKind::Jumps { name, .. } = &*refused.kind else {
        return error;
    };
    let file = &arguments.measured;
    let mut changes: Vec<Change> = Vec::new();
    match file.is_of_dots(table) {
        true => changes.extend(lost(table, file)),
        false => changes.extend(units(table, file, std::slice::from_ref(name))),
    }
    let is_read = |change: &Change| {
        let arguments = Arguments {
            measured: change.file.clone(),
            ..arguments.clone()
        };
        Source::read(table, &arguments, hung).is_ok()
    };
    match changes.into_iter().find(is_read) {
        None => error,
        Some(change) => Failure::Lacking {
            what: format!(
                "the measurements could not be read: {refused}; help: write `{}`: {}",
                change.options.join(" "),
                change.words
            ),
        },
    }
}
