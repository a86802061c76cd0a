//! One run of a program: what it prints, the files that it leaves, and the
//! record of both.

use std::cell::{Cell, RefCell};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use branched_pendulum_charts::{Chart, Film};
use branched_pendulum_data::{Column, CsvError, CsvWriter};
use serde_json::{Map, Value, json};

use super::figures::{Figures, TimeSpan};
use super::files::{CHECKPOINT, Ledger, Part, SharedLedger, locked, replace};
use super::interruption::Interruption;
use super::lock::FolderLock;
use super::progress::Progress;
use super::sealed::RunIdentity;
use crate::failure::Failure;

/// Name of the record of a run.
pub const RECORD: &str = "run.json";

/// Options that say how a run is computed, which part of it, and how it is drawn, but not what.
const MANNER: [&str; 6] = [
    "shard",
    "merge",
    "threads",
    "checkpoint",
    "figure-width",
    "show",
];

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Everything is there.
    Finished,
    /// Ctrl-C, or the system's request to end.
    Interrupted,
    /// A failure, in its own words.
    Failed(String),
}

/// The record of a run, beside its results: who ran, with which arguments, how
/// it ended, and which files it left. The arguments are what `--repeat` reads.
#[derive(Debug)]
pub(super) struct Record {
    pub(super) program: String,
    folder: Option<PathBuf>,
    /// True if the folder was not there before.
    made: bool,
    /// No other run writes into the folder until the record is written.
    lock: Option<FolderLock>,
    arguments: Map<String, Value>,
    report: Map<String, Value>,
    closed: bool,
}

impl Record {
    /// Takes away what is half written, and writes the record beside the files
    /// that are complete; without any, takes an empty folder away that was made
    /// for them. Returns a sentence about what is there, none for a run without a
    /// folder. A record that is closed stays as it is.
    ///
    /// No file begins or takes its name meanwhile: the ledger is the caller's.
    pub(super) fn close(
        &mut self,
        ended: &Ended,
        ledger: &mut Ledger,
    ) -> Result<Option<String>, Failure> {
        for part in ledger.parts.drain(..) {
            let _ = fs::remove_file(part);
        }
        let Some(folder) = &self.folder else {
            return Ok(None);
        };
        let mut files = ledger.files.clone();
        files.retain(|file| file != RECORD);
        let goes_on = folder.join(CHECKPOINT).exists();
        if files.is_empty() && !goes_on {
            self.lock = None;
            if self.made {
                let _ = fs::remove_dir(folder);
            }
            return Ok(Some("no file was finished".to_owned()));
        }
        let shown = folder.display();
        let left = match files.len() {
            _ if goes_on => format!("the same command goes on from the checkpoint in {shown}"),
            1 => format!("1 file is in {shown}"),
            count => format!("{count} files are in {shown}"),
        };
        if std::mem::replace(&mut self.closed, true) {
            return Ok(Some(left));
        }
        let ended = match ended {
            Ended::Finished => "finished".to_owned(),
            Ended::Interrupted => "interrupted".to_owned(),
            Ended::Failed(message) => format!("failed: {message}"),
        };
        let record = json!({
            "program": self.program,
            "version": env!("CARGO_PKG_VERSION"),
            "system": format!("{} {}", std::env::consts::ARCH, std::env::consts::OS),
            "arguments": self.arguments,
            "report": self.report,
            "ended": ended,
            "files": files,
        });
        let path = folder.join(RECORD);
        replace(&path, format!("{record:#}\n").as_bytes())
            .map_err(|source| Failure::File { path, source })?;
        ledger.files.push(RECORD.to_owned());
        self.lock = None;
        Ok(Some(left))
    }
}

/// One run of a program.
#[derive(Debug)]
pub struct Job {
    pub(super) record: Arc<Mutex<Record>>,
    pub(super) ledger: SharedLedger,
    pub(super) progress: Arc<Mutex<Progress>>,
    pub(super) interruption: Arc<Interruption>,
    folder: Option<PathBuf>,
    /// What is asked of charts.
    figures: Figures,
    /// Nobody reads the standard output any more.
    closed: Cell<bool>,
    /// Text that tests read in place of the standard output.
    kept: Option<RefCell<String>>,
}

impl Job {
    /// Starts a run whose results go into `folder`, which is made with those
    /// above it unless it is there: before the work, so that a folder that
    /// cannot be made costs none.
    ///
    /// # Errors
    /// [`Failure::Folder`]; [`Failure::Busy`] while another run writes there.
    pub fn start(
        program: &str,
        folder: Option<PathBuf>,
        arguments: Map<String, Value>,
    ) -> Result<Self, Failure> {
        let (mut made, mut lock) = (false, None);
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
            lock = Some(FolderLock::take(path, program)?);
        }
        let ledger = SharedLedger::default();
        let record = Record {
            program: program.to_owned(),
            folder: folder.clone(),
            made,
            lock,
            arguments,
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
            closed: Cell::new(false),
            kept: None,
        })
    }

    /// Draws charts like that from now on.
    pub fn with_figures(self, figures: Figures) -> Self {
        Self { figures, ..self }
    }

    /// Time that charts over time show, where it was asked for.
    pub fn shown(&self) -> Option<TimeSpan> {
        self.figures.shown
    }

    /// A run of a test, which prints nothing.
    ///
    /// # Errors
    /// [`Failure::Folder`].
    pub fn quiet(folder: &Path) -> Result<Self, Failure> {
        let mut job = Self::start("test", Some(folder.to_path_buf()), Map::new())?;
        job.kept = Some(RefCell::default());
        Ok(job)
    }

    /// Prints text. A reader that closes the pipe has read enough: the run goes
    /// on for the sake of its files, and prints no more.
    ///
    /// # Errors
    /// [`Failure::Print`], or [`Failure::Closed`] where there are no files.
    pub fn print(&self, text: &str) -> Result<(), Failure> {
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

    /// Text that a run of a test would have printed.
    pub fn printed(&self) -> String {
        let kept = self.kept.as_ref();
        kept.map_or(String::new(), |kept| kept.borrow().clone())
    }

    /// Shows the progress of `parts` parts from now on.
    pub fn progress(&self, parts: usize) -> Progress {
        let progress = Progress::new(parts);
        *locked(&self.progress) = progress.clone();
        progress
    }

    /// Takes Ctrl-C from now on, when there are results to write: it ends the run no more,
    /// but [`is_interrupted`](Self::is_interrupted) says that it came, for a program that
    /// then stops its work and writes them. A second one ends the run.
    pub fn take_interruption(&self) {
        self.interruption.take();
    }

    /// Returns true where Ctrl-C came that the program takes.
    pub fn is_interrupted(&self) -> bool {
        self.interruption.signal().is_some()
    }

    /// Puts a value into the record.
    pub fn report(&self, name: &str, value: impl Into<Value>) {
        let mut record = locked(&self.record);
        record.report.insert(name.to_owned(), value.into());
    }

    /// The folder of results, if there is one.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Identity of the run, whichever part of it this process does.
    pub fn identity(&self) -> RunIdentity {
        let record = locked(&self.record);
        let mut arguments = record.arguments.clone();
        arguments.retain(|name, _| !MANNER.contains(&name.as_str()));
        RunIdentity {
            program: record.program.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            arguments: Value::Object(arguments).to_string(),
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

    /// Writes a table of results whose rows `rows` gives to a writer.
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
        writer.finish()?.finish().map_err(failed)
    }

    /// Draws a chart as SVG, PNG and PDF; `name` has no extension.
    ///
    /// # Errors
    /// [`Failure::Chart`] or [`Failure::File`].
    pub fn chart(&self, name: &str, chart: &Chart) -> Result<(), Failure> {
        if self.folder.is_none() {
            return Ok(());
        }
        let chart = self.figures.of(chart);
        self.write(&format!("{name}.svg"), chart.to_svg()?.as_bytes())?;
        self.write(&format!("{name}.pdf"), &chart.to_pdf()?)?;
        self.write(&format!("{name}.png"), &chart.to_png()?)
    }

    /// Draws a chart whose x axis is time in s, over the time that was asked for.
    ///
    /// # Errors
    /// As [`chart`](Self::chart); [`Failure::Lacking`] where it has nothing of that time.
    pub fn chart_over_time(&self, name: &str, chart: &Chart) -> Result<(), Failure> {
        self.chart(name, &self.figures.over_time(chart)?)
    }

    /// Refuses a time to be shown where no chart is over time, because of that option.
    ///
    /// # Errors
    /// [`Failure::Lacking`].
    pub fn has_no_time_charts(&self, option: &str) -> Result<(), Failure> {
        match self.figures.shown {
            None => Ok(()),
            Some(_) => Err(Failure::Lacking {
                what: format!("no chart of `{option}` is over time: leave out `--show`"),
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

    /// Names of the files that are complete, in the order of writing.
    pub fn files(&self) -> Vec<String> {
        locked(&self.ledger).files.clone()
    }

    /// Returns true where nobody reads the standard output any more.
    pub fn is_closed(&self) -> bool {
        self.closed.get()
    }

    /// Writes the record and, after a run that finished, prints the list of
    /// files. Returns a sentence about them, none for a run without a folder.
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
