//! Search for the first row of numbers in a table.

use super::cell::Entry;
use super::error::ReadErrorKind;
use super::format::{Format, TextLine, begins_as_number};
use super::place::Place;

/// Number of lines that are read to distinguish columns of numbers from columns of text.
const SAMPLE: usize = 2000;

/// Returns the index of the first row: the first line that has a number or nothing in every column
/// of numbers. A line directly above it with as many cells that also begins with a number is a row
/// with a mistake.
pub(crate) fn first_row(lines: &[TextLine], format: Format) -> Option<usize> {
    let is_text = columns_of_text(lines, format);
    let is_row = |line: &TextLine| {
        let mut entries = line.cells.iter().zip(0..).map(|(cell, column)| {
            let entry = format.entry(cell);
            let stands_aside = entry == Entry::Text && is_text.get(column) == Some(&true);
            if stands_aside { Entry::Missing } else { entry }
        });
        let numbers = entries.clone().filter(|entry| entry.is_number()).count();
        line.cells.len() >= 2 && numbers >= 1 && entries.all(|entry| entry != Entry::Text)
    };
    let mut first = lines.iter().position(is_row)?;
    let lead = is_text.iter().position(|text| !text).unwrap_or_default();
    let width = lines[first].cells.len();
    while let Some(above) = first.checked_sub(1)
        && let line = &lines[above]
        && line.cells.len() == width
        && format.entry(&line.cells[lead.min(width - 1)]).is_number()
    {
        first = above;
    }
    Some(first)
}

/// Returns, for each column, true if it contains text: of the lines with at least two numbers, the
/// majority has text there.
fn columns_of_text(lines: &[TextLine], format: Format) -> Vec<bool> {
    let mut votes: Vec<i64> = Vec::new();
    for line in lines.iter().take(SAMPLE) {
        let entries: Vec<Entry<'_>> = line.cells.iter().map(|c| format.entry(c)).collect();
        if entries.iter().filter(|entry| entry.is_number()).count() < 2 {
            continue;
        }
        votes.resize(votes.len().max(entries.len()), 0);
        for (votes, entry) in votes.iter_mut().zip(entries) {
            *votes += match entry {
                Entry::Text => 1,
                Entry::Number { .. } | Entry::Infinite => -1,
                Entry::Missing => 0,
            };
        }
    }
    votes.into_iter().map(|votes| votes > 0).collect()
}

/// Returns the error if no line is a row of numbers: its position is the first cell that looks like
/// a number but is none, in the first line with the most cells that begin like numbers.
pub(crate) fn no_rows(lines: &[TextLine], format: Format) -> (ReadErrorKind, Option<Place>) {
    let meant = |line: &TextLine| {
        let cells = line.cells.iter().filter(|cell| begins_as_number(cell));
        cells.count()
    };
    let several = lines.iter().filter(|line| line.cells.len() >= 2);
    // The first of the best.
    let best = several.rev().max_by_key(|line| meant(line));
    let best = best.filter(|line| meant(line) > 0);
    let culprit = best.and_then(|line| {
        let mut cells = line.cells.iter().enumerate();
        let is_text = |cell: &str| format.entry(cell) == Entry::Text;
        let (index, cell) = cells.find(|(_, cell)| is_text(cell))?;
        Some((Place::cell(line.number, index, None), cell.clone()))
    });
    match culprit {
        Some((place, text)) => (ReadErrorKind::Number { text }, Some(place)),
        None => (ReadErrorKind::NoNumbers, None),
    }
}
