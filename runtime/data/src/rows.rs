//! Where the rows of numbers begin.

use super::cell::Entry;
use super::error::{Place, ReadErrorKind};
use super::format::{Format, TextLine, begins_as_number};

/// Lines that are looked at to tell columns of numbers from columns of text.
const SAMPLE: usize = 2000;

/// The index of the first row: the first line that has numbers or nothing in all columns of
/// numbers. A line right above it that begins with a number as well, in as many cells, is a
/// row with a mistake in it.
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

/// For each column whether it holds words: of the lines with two numbers or more, those with
/// a word there are the majority.
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

/// Number of columns: that of the first row, without empty cells at its end that end all rows
/// and the line of the names.
pub(crate) fn width(rows: &[TextLine], names: Option<&TextLine>) -> usize {
    let used = |line: &TextLine| {
        line.cells
            .iter()
            .rposition(|cell| !cell.is_empty())
            .map_or(0, |last| last + 1)
    };
    let most = rows.iter().chain(names).map(used).max().unwrap_or(0);
    let first = rows.first().map_or(0, |line| line.cells.len());
    most.min(first)
}

/// Why no line is a row: the first cell that was meant as a number and is none, of the first
/// line that has most cells that begin as numbers.
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
