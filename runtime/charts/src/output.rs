//! Charts as documents and files.

use std::fs;
use std::path::Path;

use crate::arrange;
use crate::compose;
use crate::description::Chart;
use crate::error::ChartError;
use crate::font::Font;
use crate::{pdf, png, svg};

/// Size of a px in mm, if no width in mm is set.
const UNIT: f64 = 25.4 / 96.0;

impl Chart {
    /// Renders the chart as a self-contained SVG document.
    ///
    /// # Errors
    /// Every variant of [`ChartError`] but `Encode` and `Io`.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        let font = Font::embedded()?;
        let drawing = compose::draw(self, &arrange::arrange(self, &font)?);
        Ok(svg::document(&drawing, self.unit))
    }

    /// Renders the chart as the bytes of a PDF file of one page.
    ///
    /// # Errors
    /// Every variant of [`ChartError`] but `Encode` and `Io`.
    pub fn to_pdf(&self) -> Result<Vec<u8>, ChartError> {
        let font = Font::embedded()?;
        let drawing = compose::draw(self, &arrange::arrange(self, &font)?);
        Ok(pdf::document(&drawing, &font, self.unit.unwrap_or(UNIT)))
    }

    /// Renders the chart as the bytes of an RGBA PNG file with `scale` pixels per px.
    ///
    /// # Errors
    /// Every variant of [`ChartError`] but `Io`.
    pub fn to_png(&self) -> Result<Vec<u8>, ChartError> {
        let font = Font::embedded()?;
        let drawing = compose::draw(self, &arrange::arrange(self, &font)?);
        png::encode(&drawing, &font, self.scale, self.unit.unwrap_or(UNIT))
    }

    /// Writes the result of [`Chart::to_svg`] to a file, which is overwritten.
    ///
    /// # Errors
    /// As [`Chart::to_svg`], and [`ChartError::Io`].
    pub fn write_svg(&self, path: impl AsRef<Path>) -> Result<(), ChartError> {
        write(path.as_ref(), self.to_svg()?.as_bytes())
    }

    /// Writes the result of [`Chart::to_png`] to a file, which is overwritten.
    ///
    /// # Errors
    /// As [`Chart::to_png`], and [`ChartError::Io`].
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), ChartError> {
        write(path.as_ref(), &self.to_png()?)
    }

    /// Writes the result of [`Chart::to_pdf`] to a file, which is overwritten.
    ///
    /// # Errors
    /// As [`Chart::to_pdf`], and [`ChartError::Io`].
    pub fn write_pdf(&self, path: impl AsRef<Path>) -> Result<(), ChartError> {
        write(path.as_ref(), &self.to_pdf()?)
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), ChartError> {
    fs::write(path, bytes).map_err(|source| ChartError::Io {
        path: path.to_path_buf(),
        source,
    })
}
