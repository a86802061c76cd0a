//! One run of a program: its printed text, the files that it writes, and the record of both.

use std::cell::{Cell, RefCell};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use branched_pendulum_charts::{Chart, ChartError, Film};
use branched_pendulum_data::{Column, CsvError, CsvWriter};
use serde_json::{Map, Value};

use super::figures::{Figures, TimeSpan};
use super::files::{Ledger, Part, SharedLedger, locked};
use super::input::Input;
use super::interruption::Interruption;
use super::legible::legible;
use super::lock::FolderLock;
use super::progress::Progress;
use super::record::{Record, earlier};
use super::sealed::RunIdentity;

pub use super::record::{Ended, RECORD};
use crate::failure::Failure;

/// Names of the options that determine how a run is computed, which part of it, and how it is
/// drawn, but not its results.
const MANNER: [&str; 6] = [
    "shard",
    "merge",
    "threads",
    "checkpoint",
    "figure-width",
    "show",
];

/// One run of a program.
#[derive(Debug)]
pub struct Job {
    pub(super) record: Arc<Mutex<Record>>,
    pub(super) ledger: SharedLedger,
    pub(super) progress: Arc<Mutex<Progress>>,
    pub(super) interruption: Arc<Interruption>,
    folder: Option<PathBuf>,
    /// Settings of charts.
    figures: Figures,
    /// Files that were read by the run which this one repeats.
    recorded: Vec<Input>,
    /// True if the standard output has been closed by its reader.
    closed: Cell<bool>,
    /// Buffer for the printed text, which tests read instead of the standard output.
    kept: Option<RefCell<String>>,
}

impl Job {
    /// Starts a run whose results are written into `folder`. The folder is created before the
    /// computation, so that an error does not waste the work.
    ///
    /// # Errors
    /// [`Failure::Folder`]; [`Failure::Busy`] if another run is writing there.
    pub fn start(
        program: &str,
        folder: Option<PathBuf>,
        arguments: Map<String, Value>,
    ) -> Result<Self, Failure> {
        let (mut made, mut lock) = (false, None);
        let mut ledger = Ledger::default();
        if let Some(path) = &folder {
            made = !path.exists();
            let source = |source| Failure::Folder {
                path: path.clone(),
                source,
            };
            if path.is_file() {
                return Err(source(io::Error::other("it is a file")));
            }
            fs::create_dir_all(path).map_err(source)?;
            let taken = FolderLock::take(path, program)?;
            let earlier = earlier(path).map_err(|source| Failure::File {
                path: path.join(RECORD),
                source,
            })?;
            ledger = Ledger::new(&taken, earlier);
            lock = Some(taken);
        }
        let ledger = SharedLedger::new(Mutex::new(ledger));
        let record = Record {
            program: program.to_owned(),
            folder: folder.clone(),
            made,
            lock,
            arguments,
            inputs: Vec::new(),
            report: Map::new(),
            closed: false,
        };
        Ok(Self {
            record: Arc::new(Mutex::new(record)),
            ledger,
            progress: Arc::default(),
            interruption: Arc::default(),
            folder,
            figures: Figures::default(),
            recorded: Vec::new(),
            closed: Cell::new(false),
            kept: None,
        })
    }

    /// Sets how charts are drawn from now on.
    pub fn with_figures(self, figures: Figures) -> Self {
        Self { figures, ..self }
    }

    /// Compares the files that are read from now on with those that a recorded run has read.
    pub fn with_recorded(self, recorded: Vec<Input>) -> Self {
        Self { recorded, ..self }
    }

    /// Records a file that the run reads; its content is part of the identity of the run.
    ///
    /// # Errors
    /// [`Failure::Changed`] if the run repeats another one that read a different content.
    pub fn input(&self, input: Input) -> Result<(), Failure> {
        let mut same = self.recorded.iter();
        let same = same.find(|recorded| recorded.name() == input.name());
        if let Some(difference) = same.and_then(|recorded| recorded.difference(&input)) {
            return Err(Failure::Changed { difference });
        }
        let mut record = locked(&self.record);
        if !record.inputs.contains(&input) {
            record.inputs.push(input);
        }
        Ok(())
    }

    /// Records the file at `path` as one that the run reads.
    ///
    /// # Errors
    /// [`Failure::Changed`]; [`Failure::Unread`].
    pub fn input_file(&self, path: &Path) -> Result<(), Failure> {
        let input = Input::of_file(path).map_err(|source| Failure::Unread {
            path: path.to_path_buf(),
            source,
        })?;
        input.map_or(Ok(()), |input| self.input(input))
    }

    /// Returns the time span that charts over time show, if one is requested.
    pub fn shown(&self) -> Option<TimeSpan> {
        self.figures.shown
    }

    /// Starts a run for a test, which prints nothing.
    ///
    /// # Errors
    /// [`Failure::Folder`].
    pub fn quiet(folder: &Path) -> Result<Self, Failure> {
        let mut job = Self::start("test", Some(folder.to_path_buf()), Map::new())?;
        job.kept = Some(RefCell::default());
        Ok(job)
    }

    /// Prints text, in which numbers that are not finite are replaced by words. If the reader
    /// closes the pipe, the run continues if it writes files, but prints no more.
    ///
    /// # Errors
    /// [`Failure::Print`], or [`Failure::Closed`] if the run writes no files.
    pub fn print(&self, text: &str) -> Result<(), Failure> {
        let text: &str = &legible(text);
        if let Some(kept) = &self.kept {
            kept.borrow_mut().push_str(text);
            return Ok(());
        }
        if self.closed.get() {
            return Ok(());
        }
        let write = || {
            let mut out = io::stdout().lock();
            out.write_all(text.as_bytes()).and_then(|()| out.flush())
        };
        match locked(&self.progress).suspend(write) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed.set(true);
                match self.folder {
                    Some(_) => Ok(()),
                    None => Err(Failure::Closed),
                }
            }
            result => result.map_err(Failure::Print),
        }
    }

    /// Returns the text that a run of a test would have printed.
    pub fn printed(&self) -> String {
        let kept = self.kept.as_ref();
        kept.map_or(String::new(), |kept| kept.borrow().clone())
    }

    /// Starts to show the progress of `parts` parts.
    pub fn progress(&self, parts: usize) -> Progress {
        let progress = Progress::new(parts);
        *locked(&self.progress) = progress.clone();
        progress
    }

    /// Lets the program handle Ctrl-C from now on, because there are results to write. The first
    /// one does not end the run, but makes [`is_interrupted`](Self::is_interrupted) return true, so
    /// that the program can stop its work and write them. A second one ends the run.
    pub fn take_interruption(&self) {
        self.interruption.take();
    }

    /// Returns true if Ctrl-C has been pressed and the program handles it.
    pub fn is_interrupted(&self) -> bool {
        self.interruption.signal().is_some()
    }

    /// Adds a value to the record of the run.
    pub fn report(&self, name: &str, value: impl Into<Value>) {
        let mut record = locked(&self.record);
        record.report.insert(name.to_owned(), value.into());
    }

    /// Returns the folder of results, if there is one.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Returns the identity of the run, independent of the part that this process computes.
    pub fn identity(&self) -> RunIdentity {
        let record = locked(&self.record);
        let mut arguments = record.arguments.clone();
        arguments.retain(|name, _| !MANNER.contains(&name.as_str()));
        RunIdentity {
            program: record.program.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            arguments: Value::Object(arguments).to_string(),
            inputs: record.inputs.clone(),
        }
    }

    /// Writes a file of results, if there is a folder for them.
    ///
    /// # Errors
    /// [`Failure::File`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let written = Part::create(folder, name, &self.ledger).and_then(|mut part| {
            part.write_all(bytes)?;
            part.finish()
        });
        written.map_err(|source| Failure::File {
            path: folder.join(name),
            source,
        })
    }

    /// Writes a table of results; `rows` writes its rows.
    ///
    /// # Errors
    /// [`Failure::File`] or [`Failure::Csv`].
    pub fn csv(
        &self,
        name: &str,
        columns: &[Column],
        rows: impl FnOnce(&mut CsvWriter<Part>) -> Result<(), CsvError>,
    ) -> Result<(), Failure> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let path = folder.join(name);
        let failed = |source| Failure::File {
            path: path.clone(),
            source,
        };
        let part = Part::create(folder, name, &self.ledger).map_err(failed)?;
        let mut writer = CsvWriter::new(part, &path, columns)?;
        rows(&mut writer)?;
        let empty = writer.empty_cells();
        writer.finish()?.finish().map_err(failed)?;
        if empty > 0 {
            let mut record = locked(&self.record);
            let cells = record
                .report
                .entry("empty_cells")
                .or_insert(serde_json::json!({}));
            cells[name] = serde_json::json!({
                "count": empty,
                "reason": "no finite number follows from the data there",
            });
        }
        Ok(())
    }

    /// Draws a chart as SVG, PNG and PDF; `name` has no extension. If nothing of a series can be
    /// drawn, the chart is left out, and a sentence is printed.
    ///
    /// # Errors
    /// [`Failure::Chart`] or [`Failure::File`].
    pub fn chart(&self, name: &str, chart: &Chart) -> Result<(), Failure> {
        if self.folder.is_none() {
            return Ok(());
        }
        let chart = self.figures.of(chart);
        let svg = match chart.to_svg() {
            Err(empty @ ChartError::NothingToDraw { .. }) => {
                return self.print(&format!("No chart `{name}`: {empty}.\n"));
            }
            drawn => drawn?,
        };
        self.write(&format!("{name}.svg"), svg.as_bytes())?;
        self.write(&format!("{name}.pdf"), &chart.to_pdf()?)?;
        self.write(&format!("{name}.png"), &chart.to_png()?)
    }

    /// Draws a chart whose x axis is time in s, restricted to the requested time span.
    ///
    /// # Errors
    /// As [`chart`](Self::chart); [`Failure::Lacking`] if it has no values in that span.
    pub fn chart_over_time(&self, name: &str, chart: &Chart) -> Result<(), Failure> {
        self.chart(name, &self.figures.over_time(chart)?)
    }

    /// Returns an error if a time span is requested although, because of `option`, no chart is over
    /// time.
    ///
    /// # Errors
    /// [`Failure::Lacking`].
    pub fn has_no_time_charts(&self, option: &str) -> Result<(), Failure> {
        match self.figures.shown {
            None => Ok(()),
            Some(_) => Err(Failure::Lacking {
                what: format!("`{option}` draws no chart against time: leave out `--show`"),
            }),
        }
    }

    /// Writes a film as SVG and as animated PNG; `name` has no extension.
    ///
    /// # Errors
    /// [`Failure::Chart`] or [`Failure::File`].
    pub fn film(&self, name: &str, film: &Film) -> Result<(), Failure> {
        if self.folder.is_none() {
            return Ok(());
        }
        self.write(&format!("{name}.svg"), film.to_svg()?.as_bytes())?;
        self.write(&format!("{name}.png"), &film.to_png()?)
    }

    /// Returns the names of the complete files, in the order in which they were written.
    pub fn files(&self) -> Vec<String> {
        locked(&self.ledger).files.clone()
    }

    /// Returns true if the standard output has been closed by its reader.
    pub fn is_closed(&self) -> bool {
        self.closed.get()
    }

    /// Writes the record of the run and, if the run finished, prints the list of files. Returns a
    /// sentence about the files; `None` for a run without a folder.
    ///
    /// # Errors
    /// [`Failure::File`] or [`Failure::Print`].
    pub fn end(&self, ended: &Ended) -> Result<Option<String>, Failure> {
        locked(&self.progress).clear();
        let left = locked(&self.record).close(ended, &mut locked(&self.ledger))?;
        if let (Ended::Finished, Some(folder)) = (ended, &self.folder) {
            let mut text = String::from("Files written:\n");
            for file in self.files() {
                text.push_str(&format!("  {}\n", folder.join(file).display()));
            }
            self.print(&text)?;
        }
        Ok(left)
    }
}
