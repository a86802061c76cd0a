//! Identification of the files that a run reads by their content. Checkpoints, shards and records
//! are valid only for the same content.

use std::fmt::{self, Display, Formatter};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::owned::hexadecimal;

/// JSON key, in the record of a run, of the list of files that the run has read.
pub(super) const INPUTS: &str = "inputs";

/// Longest text that is stored as a whole, in bytes.
const MOST_TEXT: usize = 1 << 16;

/// Largest number of blocks of lines whose checksums are stored.
const MOST_BLOCKS: usize = 256;

/// Longest part of a line that a message shows, in characters.
const MOST_SHOWN: usize = 60;

/// A file that a run has read, or a text in place of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Name, as it was given.
    name: String,
    /// SHA-256 digest of the content, as hexadecimal digits.
    sha256: String,
    content: Content,
}

/// Content of a file, as far as it is needed to find the first line that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Content {
    /// The whole text.
    Text(String),
    /// Checksums of blocks of lines.
    Blocks(Blocks),
}

/// Checksums of blocks of lines.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Blocks {
    /// Number of lines in each block; the last block may have fewer.
    lines: usize,
    /// CRC-32 checksum and length in bytes of each block.
    checksums: Vec<(u32, u64)>,
}

/// First difference between two contents of the same file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputDifference {
    name: String,
    first: FirstDifference,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum FirstDifference {
    /// Number of the line, and its text before and now; `None` after the end of the file.
    Line(usize, [Option<String>; 2]),
    /// Numbers of the first and the last line of a block that differs.
    Block(usize, usize),
}

impl Input {
    /// Creates the identification of a text that was read.
    pub fn of_text(name: &str, text: &str) -> Self {
        let content = match text.len() <= MOST_TEXT {
            true => Content::Text(text.to_owned()),
            false => Content::Blocks(Blocks::of_bytes(text.as_bytes())),
        };
        let sha256 = hexadecimal(Sha256::new_with_prefix(text));
        let name = name.to_owned();
        Self {
            name,
            sha256,
            content,
        }
    }

    /// Creates the identification of a file. Returns `None` for a pipe or a device, which can be
    /// read only once.
    ///
    /// # Errors
    /// The system's error.
    pub fn of_file(path: &Path) -> io::Result<Option<Self>> {
        // A file that the user names is opened as any program opens it.
        if !std::fs::metadata(path)?.is_file() {
            return Ok(None);
        }
        let mut file = File::open(path)?;
        let name = path.display().to_string();
        let mut start = Vec::new();
        let most = MOST_TEXT as u64 + 1;
        (&mut file).take(most).read_to_end(&mut start)?;
        if start.len() <= MOST_TEXT
            && let Ok(text) = std::str::from_utf8(&start)
        {
            return Ok(Some(Self::of_text(&name, text)));
        }
        let (mut hasher, mut blocks) = (Sha256::new(), BlockBuilder::new());
        let mut bytes = start;
        while !bytes.is_empty() {
            hasher.update(&bytes);
            blocks.add(&bytes);
            bytes.clear();
            (&mut file).take(most).read_to_end(&mut bytes)?;
        }
        Ok(Some(Self {
            name,
            sha256: hexadecimal(hasher),
            content: Content::Blocks(blocks.finish()),
        }))
    }

    /// Name, as it was given.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the first difference between this input and `now`, the same file read later; `None`
    /// if they are equal.
    pub fn difference(&self, now: &Self) -> Option<InputDifference> {
        if self.sha256 == now.sha256 {
            return None;
        }
        let first = match (&self.content, &now.content) {
            (Content::Text(a), Content::Text(b)) => differing_line(a, b),
            (a, b) => a.blocks().difference(b.blocks()),
        };
        let name = now.name.clone();
        Some(InputDifference { name, first })
    }

    /// Returns the first difference between two lists of inputs, compared by name.
    pub(super) fn first_difference(before: &[Self], now: &[Self]) -> Option<InputDifference> {
        before.iter().find_map(|before| {
            let now = now.iter().find(|now| now.name == before.name)?;
            before.difference(now)
        })
    }
}

/// Returns the first line that differs; line ends count too.
fn differing_line(before: &str, now: &str) -> FirstDifference {
    let (mut before, mut now) = (before.split('\n'), now.split('\n'));
    for line in 1.. {
        let pair = [before.next(), now.next()];
        if pair[0] != pair[1] || pair[0].is_none() {
            return FirstDifference::Line(line, pair.map(|text| text.map(shown)));
        }
    }
    FirstDifference::Line(0, [None, None])
}

/// Returns the beginning of a line, for messages.
fn shown(line: &str) -> String {
    let line = line.trim();
    match line.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}

impl Content {
    fn blocks(&self) -> Blocks {
        match self {
            Self::Text(text) => Blocks::of_bytes(text.as_bytes()),
            Self::Blocks(blocks) => blocks.clone(),
        }
    }
}

impl Blocks {
    fn of_bytes(bytes: &[u8]) -> Self {
        let mut builder = BlockBuilder::new();
        builder.add(bytes);
        builder.finish()
    }

    /// Joins each two blocks.
    fn double(&mut self) {
        self.lines *= 2;
        let pairs = self.checksums.chunks(2);
        self.checksums = pairs.map(joined).collect();
    }

    fn difference(mut self, mut other: Self) -> FirstDifference {
        while self.lines < other.lines {
            self.double();
        }
        while other.lines < self.lines {
            other.double();
        }
        let pairs = self.checksums.iter().zip(&other.checksums);
        let equal = pairs.take_while(|(a, b)| a == b).count();
        FirstDifference::Block(equal * self.lines + 1, (equal + 1) * self.lines)
    }
}

/// Returns checksum and length of several consecutive blocks together.
fn joined(blocks: &[(u32, u64)]) -> (u32, u64) {
    let mut all = Hasher::new();
    for (checksum, length) in blocks {
        all.combine(&Hasher::new_with_initial_len(*checksum, *length));
    }
    let length = blocks.iter().map(|(_, length)| length).sum();
    (all.finalize(), length)
}

/// Computes the checksums of blocks of lines from bytes that arrive in pieces.
struct BlockBuilder {
    blocks: Blocks,
    block: Hasher,
    /// Numbers of lines and bytes in the incomplete block.
    lines: usize,
    length: u64,
}

impl BlockBuilder {
    fn new() -> Self {
        Self {
            blocks: Blocks {
                lines: 1,
                checksums: Vec::new(),
            },
            block: Hasher::new(),
            lines: 0,
            length: 0,
        }
    }

    fn add(&mut self, bytes: &[u8]) {
        for piece in bytes.split_inclusive(|byte| *byte == b'\n') {
            self.block.update(piece);
            self.length += piece.len() as u64;
            if piece.ends_with(b"\n") {
                self.lines += 1;
                if self.lines == self.blocks.lines {
                    self.end_block();
                }
            }
        }
    }

    fn end_block(&mut self) {
        let block = std::mem::replace(&mut self.block, Hasher::new());
        let block = (block.finalize(), std::mem::take(&mut self.length));
        self.blocks.checksums.push(block);
        self.lines = 0;
        if self.blocks.checksums.len() == 2 * MOST_BLOCKS {
            self.blocks.double();
        }
    }

    fn finish(mut self) -> Blocks {
        if self.length > 0 {
            self.end_block();
        }
        self.blocks
    }
}

impl Display for InputDifference {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = &self.name;
        match &self.first {
            FirstDifference::Line(line, [Some(before), Some(now)]) => {
                write!(
                    f,
                    "`{name}` has changed: line {line} was `{before}` and is `{now}`"
                )
            }
            FirstDifference::Line(line, [Some(before), None]) => {
                write!(
                    f,
                    "`{name}` has changed: line {line} was `{before}` and is gone"
                )
            }
            FirstDifference::Line(line, [None, now]) => {
                let now = now.as_deref().unwrap_or_default();
                write!(f, "`{name}` has changed: line {line} is new, `{now}`")
            }
            FirstDifference::Block(first, last) if first == last => {
                write!(
                    f,
                    "`{name}` has changed: line {first} is the first that differs"
                )
            }
            FirstDifference::Block(first, last) => write!(
                f,
                "`{name}` has changed: the first line that differs is one of {first} to {last}"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Input, MOST_TEXT};

    fn message(before: &str, now: &str) -> Option<String> {
        let input = |text| Input::of_text("tree.txt", text);
        let difference = input(before).difference(&input(now));
        difference.map(|difference| difference.to_string())
    }

    #[test]
    fn the_first_line_that_differs_is_named() {
        assert_eq!(message("a\nb\nc\n", "a\nb\nc\n"), None);
        for (before, now, reported) in [
            ("a\nb\nc\n", "a\nB\nc\n", "line 2 was `b` and is `B`"),
            ("a\nb", "a\nb\nc", "line 3 is new, `c`"),
            ("a\nb\nc", "a\nb", "line 3 was `c` and is gone"),
            ("a\n", "a", "line 2 was `` and is gone"),
            ("", "x", "line 1 was `` and is `x`"),
        ] {
            let message = message(before, now).unwrap();
            assert_eq!(message, format!("`tree.txt` has changed: {reported}"));
        }
    }

    /// Checks that for longer files a block of lines is reported that contains the changed line.
    #[test]
    fn of_long_files_the_lines_are_narrowed_down() {
        for lines in [10_000, 12_345, 70_000] {
            let text = |changed: usize| {
                let line = |line| match line == changed {
                    true => "another line\n".to_owned(),
                    false => format!("{line}, {line}\n"),
                };
                (1..=lines).map(line).collect::<String>()
            };
            let before = text(0);
            assert!(before.len() > MOST_TEXT);
            for changed in [1, 257, lines / 2, lines] {
                let message = message(&before, &text(changed)).unwrap();
                let numbers = message.split(' ').filter_map(|word| word.parse().ok());
                let numbers: Vec<usize> = numbers.collect();
                let [first, last] = numbers[..] else {
                    panic!("{message}");
                };
                assert!((first..=last).contains(&changed), "{message}");
                assert!(last - first < lines / 50, "{message}");
            }
        }
    }

    #[test]
    fn a_file_has_the_digest_of_its_text() {
        let path = std::env::temp_dir().join(format!("input-{}", std::process::id()));
        let name = path.display().to_string();
        for text in ["", "short\n", &"0.1,0.2\n".repeat(40_000)] {
            std::fs::write(&path, text).unwrap();
            let read = Input::of_file(&path).unwrap().unwrap();
            assert_eq!(read, Input::of_text(&name, text));
        }
        std::fs::write(&path, b"\xff\n\xfe").unwrap();
        let before = Input::of_file(&path).unwrap().unwrap();
        std::fs::write(&path, b"\xff\n\xfd").unwrap();
        let now = Input::of_file(&path).unwrap().unwrap();
        let difference = before.difference(&now).unwrap().to_string();
        assert!(difference.ends_with("line 2 is the first that differs"));
        std::fs::remove_file(&path).unwrap();
    }
}
