//! [`RenderArgs`]: the arguments of `Layout.render`, and [`PyPicture`]: the picture, as pixels, PNG
//! or SVG.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use guideway::compose::{
    ComposeError, Decorations, NoProgress, Picture, VectorFormat, Viewport, suitable_widths,
};
use guideway::cpu::Cpu;
use guideway::layout::Layout;
use guideway::scene::{ColorBy, Frame, FrameSize, Scene, SceneOptions, View};
use guideway::spline::{Bounds, Point};
use guideway::{SaveError, save_png_by, write_png_by};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{bad_argument, exception};

/// The arguments of `Layout.render`.
pub(crate) struct RenderArgs {
    pub(crate) size: (u32, u32),
    pub(crate) view: Option<(f64, f64, f64, f64)>,
    pub(crate) color_by: Option<String>,
    pub(crate) level: Option<String>,
    pub(crate) site: bool,
    pub(crate) title: Option<String>,
}

impl RenderArgs {
    /// The picture of a layout that they describe; `plain` gives its scene without options.
    pub(crate) fn picture(
        &self,
        layout: &Arc<Layout>,
        plain: impl FnOnce() -> PyResult<Arc<Scene>>,
    ) -> PyResult<Picture> {
        let scene = match (&self.color_by, &self.level) {
            (None, None) => plain()?,
            _ => {
                let color_by = self.color_by.clone();
                let options = SceneOptions {
                    color_by: color_by.map(|column| ColorBy { column }),
                    level: self.level.clone(),
                    ..SceneOptions::default()
                };
                let scene = Scene::new(Arc::clone(layout), &options);
                Arc::new(scene.map_err(exception)?)
            }
        };
        let (width, height) = self.size;
        let size = FrameSize::new(width, height).map_err(exception)?;
        let mut picture = Picture::new(scene, size);
        if self.site {
            let title = self.title.clone();
            picture.decorations = Decorations {
                title,
                ..Decorations::site("")
            };
        }
        picture.decorations.has_legend = self.color_by.is_some();
        if let Some((min_x, min_y, max_x, max_y)) = self.view {
            let corners = [Point::new(min_x, min_y), Point::new(max_x, max_y)];
            let bounds = Bounds::of_points(corners);
            let view = View::fit(size, bounds).map_err(exception)?;
            picture.viewport = Viewport::of(&view);
        }
        let view = picture.view().map_err(exception)?;
        let is_all_shown = self.view.is_none();
        picture.style.line_rule = suitable_widths(layout, &view, is_all_shown);
        Ok(picture)
    }
}

/// A picture of a layout. Jupyter shows it by itself.
#[pyclass(frozen, name = "Picture", module = "guideway")]
pub(crate) struct PyPicture {
    picture: Picture,
    frame: Frame,
    drawn: u64,
}

impl PyPicture {
    pub(crate) fn render(py: Python<'_>, picture: Picture) -> PyResult<Self> {
        let rendered = py.detach(|| picture.render_frame(&Cpu, &NoProgress));
        let (frame, rendered) = rendered.map_err(exception)?;
        Ok(Self {
            picture,
            frame,
            drawn: rendered.report.drawn,
        })
    }

    fn png_bytes(&self) -> PyResult<Vec<u8>> {
        let header = self.picture.png_header().map_err(exception)?;
        let mut bytes = Vec::new();
        write_png_by(&mut bytes, self.frame.size(), &header, fail, |sink| {
            sink(&self.frame)
        })?;
        Ok(bytes)
    }
}

/// An error of a stream into memory: it ran out.
fn fail(error: io::Error) -> PyErr {
    bad_argument(error.to_string(), "Choose a smaller picture")
}

#[pymethods]
impl PyPicture {
    /// Width in pixels.
    #[getter]
    fn width(&self) -> u32 {
        self.frame.size().width()
    }

    /// Height in pixels.
    #[getter]
    fn height(&self) -> u32 {
        self.frame.size().height()
    }

    /// Number of edges that the picture shows.
    #[getter]
    fn drawn(&self) -> u64 {
        self.drawn
    }

    /// The pixels as a NumPy array of shape (height, width, 4): red, green, blue, alpha, 0 to 255.
    fn numpy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let numpy = py.import("numpy")?;
        let bytes = PyBytes::new(py, self.frame.bytes());
        let flat = numpy.call_method1("frombuffer", (bytes, "uint8"))?;
        flat.call_method1("reshape", ((self.height(), self.width(), 4),))
    }

    /// The picture as the bytes of a PNG file.
    pub(crate) fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| self.png_bytes())?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The picture as SVG text, with exact curves.
    fn svg(&self, py: Python<'_>) -> PyResult<String> {
        let bytes = py.detach(|| {
            let mut bytes = Vec::new();
            let save_error = |problem| {
                let path = PathBuf::from("memory");
                ComposeError::Save(SaveError { path, problem })
            };
            let written = self
                .picture
                .write_vector(VectorFormat::Svg, &mut bytes, save_error);
            written.map(|_| bytes)
        });
        let bytes = bytes.map_err(exception)?;
        String::from_utf8(bytes).map_err(|error| {
            bad_argument(
                error.to_string(),
                "Correct the names in the layout to be UTF-8",
            )
        })
    }

    /// Saves the picture as PNG, SVG or PDF, by the extension. The file appears whole or not at
    /// all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let extension = path
            .extension()
            .map(|own| own.to_string_lossy().to_lowercase());
        py.detach(|| match extension.as_deref() {
            Some("png") => {
                let header = self.picture.png_header().map_err(exception)?;
                let size = self.frame.size();
                let saved =
                    save_png_by::<_, ComposeError>(&path, size, &header, |sink| sink(&self.frame));
                saved.map_err(exception)
            }
            Some(own @ ("svg" | "pdf")) => {
                let format = match own {
                    "svg" => VectorFormat::Svg,
                    _ => VectorFormat::Pdf,
                };
                let saved = self.picture.save_vector(format, &path);
                saved.map(drop).map_err(exception)
            }
            _ => Err(bad_argument(
                format!("{}: no picture has this extension", path.display()),
                "Use .png, .svg or .pdf",
            )),
        })
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.png(py)
    }

    fn __repr__(&self) -> String {
        let (width, height) = (self.width(), self.height());
        format!(
            "<Picture of {width} x {height} pixels, {} edges>",
            self.drawn
        )
    }
}
