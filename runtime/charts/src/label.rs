use crate::font::Font;

/// Characters with a special meaning.
const MARKS: &str = "_^{}\\";

/// Vertical position of a run of text relative to the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Line,
    Sub,
    Super,
}

impl Level {
    /// Returns the font size of raised or lowered text, relative to text on the line.
    pub(crate) const fn size(self) -> f64 {
        match self {
            Self::Line => 1.0,
            Self::Sub | Self::Super => 0.72,
        }
    }

    /// Returns the downward shift of the baseline, relative to the font size of the line.
    pub(crate) const fn drop(self) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Sub => 0.2,
            Self::Super => -0.36,
        }
    }
}

/// Text at one level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) level: Level,
    pub(crate) text: String,
}

/// One line of text with raised and lowered parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Label {
    pub(crate) runs: Vec<Run>,
}

impl Label {
    /// Parses the markup described in the module documentation; every text is valid.
    pub(crate) fn parse(markup: &str) -> Self {
        let mut label = Self::default();
        let mut rest = markup;
        while let Some(character) = rest.chars().next() {
            rest = &rest[character.len_utf8()..];
            let level = match character {
                '_' => Level::Sub,
                '^' => Level::Super,
                '\\' => {
                    let escaped = rest.chars().next();
                    let literal = escaped.filter(|c| MARKS.contains(*c));
                    rest = &rest[literal.map_or(0, char::len_utf8)..];
                    label.push(Level::Line, literal.unwrap_or('\\'));
                    continue;
                }
                other => {
                    label.push(Level::Line, other);
                    continue;
                }
            };
            match script(rest) {
                Some((inside, after)) => {
                    inside.chars().for_each(|c| label.push(level, c));
                    rest = after;
                }
                None => label.push(Level::Line, character),
            }
        }
        label
    }

    /// Adds a character. Control characters become spaces; characters that XML does not allow
    /// become the replacement character.
    fn push(&mut self, level: Level, character: char) {
        let character = match character {
            '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
            c if c.is_control() => ' ',
            c => c,
        };
        match self.runs.last_mut() {
            Some(run) if run.level == level => run.text.push(character),
            _ => self.runs.push(Run {
                level,
                text: character.into(),
            }),
        }
    }

    /// The text without its levels.
    pub(crate) fn plain(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns the width in px at a font size in px.
    pub(crate) fn width(&self, font: &Font, size: f64) -> f64 {
        let em: f64 = self.characters().map(|(l, c)| em_width(font, l, c)).sum();
        em * size
    }

    fn characters(&self) -> impl Iterator<Item = (Level, char)> {
        self.runs
            .iter()
            .flat_map(|run| run.text.chars().map(|c| (run.level, c)))
    }

    /// Breaks the text at spaces, and a too long word at any character, so that no line is wider
    /// than `width` px. An empty label has no lines.
    pub(crate) fn wrap(&self, font: &Font, size: f64, width: f64) -> Vec<Self> {
        let mut lines: Vec<Self> = Vec::new();
        let mut line = Self::default();
        let mut line_width = 0.0;
        for word in self.words() {
            let mut space = em_width(font, Level::Line, ' ') * size;
            let word_width = word.width(font, size);
            if !line.is_empty() && line_width + space + word_width > width {
                lines.push(std::mem::take(&mut line));
            }
            if line.is_empty() {
                (line_width, space) = (0.0, 0.0);
            } else {
                line.push(Level::Line, ' ');
            }
            line_width += space;
            for (level, character) in word.characters() {
                let step = em_width(font, level, character) * size;
                if !line.is_empty() && line_width + step > width {
                    lines.push(std::mem::take(&mut line));
                    line_width = 0.0;
                }
                line.push(level, character);
                line_width += step;
            }
        }
        if !line.is_empty() {
            lines.push(line);
        }
        lines
    }

    /// Splits the text at spaces that are neither raised nor lowered.
    fn words(&self) -> Vec<Self> {
        let mut words = vec![Self::default()];
        for (level, character) in self.characters() {
            if level == Level::Line && character == ' ' {
                words.push(Self::default());
            } else if let Some(word) = words.last_mut() {
                word.push(level, character);
            }
        }
        words.retain(|word| !word.is_empty());
        words
    }
}

/// Returns a label that shows `text` as it is, with all its characters.
///
/// # Examples
/// ```
/// assert_eq!(branched_pendulum_charts::verbatim("left_arm"), r"left\_arm");
/// ```
#[must_use]
pub fn verbatim(text: &str) -> String {
    let mut label = String::with_capacity(text.len());
    for character in text.chars() {
        if MARKS.contains(character) {
            label.push('\\');
        }
        label.push(character);
    }
    label
}

/// Splits the text after a `_` or `^` into the part that is lowered or raised and the remainder.
fn script(rest: &str) -> Option<(&str, &str)> {
    if let Some(group) = rest.strip_prefix('{') {
        return group.split_once('}');
    }
    let first = rest.chars().next().filter(|c| !c.is_whitespace())?;
    Some(rest.split_at(first.len_utf8()))
}

fn em_width(font: &Font, level: Level, character: char) -> f64 {
    font.advance(character) * level.size()
}

/// Returns the width in px of the widest of several lines.
pub(crate) fn widest(lines: &[Label], font: &Font, size: f64) -> f64 {
    lines
        .iter()
        .map(|line| line.width(font, size))
        .fold(0.0, f64::max)
}
