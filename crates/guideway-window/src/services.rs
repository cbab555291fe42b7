//! Files, pictures and render methods for the window.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use etcetera::BaseStrategy;
use guideway::cli::window;
use guideway::compose::{
    Backdrop, FloorPlan, Picture, SweptAreas, VectorFormat, Viewport, draw_swept_areas,
};
use guideway::envelope::EnvelopeSource;
use guideway::formats::{Progress, Target, read_file};
use guideway::layout::{Layout, UserError, shown_path};
use guideway::scene::{Frame, Method, Shading, View, elapsed_ms};
#[cfg(feature = "gpu")]
use guideway_viewer::wgpu;
use guideway_viewer::{
    AppServices, FileFormat, FileQuestion, Job, LoadStage, LostPart, MethodChoice,
    PendingFileAnswer, PictureRequest, Saved,
};

use crate::{file_dialog, project_file, save};

/// The services of the program.
pub(crate) struct FileServices {
    /// Start of the program, if it prints how long files take.
    timed_since: Option<Instant>,
    /// True if state, such as recent files and journals, outlives the run.
    keeps_state: bool,
}

impl FileServices {
    /// The services for a person at a window.
    pub(crate) fn for_window(prints_timings: bool) -> Self {
        Self {
            timed_since: prints_timings.then(Instant::now),
            keeps_state: true,
        }
    }

    /// The services for a measurement, which leaves no state behind.
    pub(crate) fn for_measurement() -> Self {
        Self {
            timed_since: None,
            keeps_state: false,
        }
    }
}

impl AppServices for FileServices {
    fn read_layout(&self, path: &Path, job: &Job) -> Result<Layout, UserError> {
        let progress = JobProgress(job);
        let layout = read_file(path, &window::read_options(Some(&progress)));
        layout.map_err(|error| window::explain_image(path, error.into()))
    }

    fn example_site(&self) -> Result<Layout, UserError> {
        window::example_site()
    }

    fn check_save_in_place(&self, layout: &Layout, file: &Path) -> Result<(), UserError> {
        save::check_in_place(layout, file)
    }

    fn save_layout(
        &self,
        layout: &Layout,
        path: &Path,
        accepts: &dyn Fn(&[LostPart]) -> bool,
    ) -> Result<Saved, UserError> {
        save::save(layout, path, accepts)
    }

    fn read_project(&self, path: &Path) -> Result<String, UserError> {
        project_file::read(path)
    }

    fn write_project(&self, path: &Path, text: &str) -> Result<(), UserError> {
        window::save_file(path, text.as_bytes())
    }

    fn layout_formats(&self) -> Vec<FileFormat> {
        let with_extensions = Target::ALL.iter().filter(|t| !t.extensions().is_empty());
        let format = |target: &Target| FileFormat {
            name: target.name().to_owned(),
            extensions: target
                .extensions()
                .iter()
                .map(|extension| extension.trim_start_matches('.').to_owned())
                .collect(),
        };
        with_extensions.map(format).collect()
    }

    fn ask_for_file(&self, question: &FileQuestion) -> Option<PendingFileAnswer> {
        file_dialog::ask(question)
    }

    fn read_floor_plan(&self, plan: &str) -> Result<FloorPlan, UserError> {
        window::read_floor_plan(plan)
    }

    fn render(&self, request: &PictureRequest, method: &str) -> Result<Frame, UserError> {
        let method = self.start_method(method)?;
        let progress = JobProgress(&Job::default());
        let (frame, _) = picture(request).render_frame(&*method, &progress)?;
        Ok(frame)
    }

    fn export_png(
        &self,
        request: &PictureRequest,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError> {
        let method = self.start_method(method)?;
        picture(request).save_png(&*method, path, &JobProgress(job))?;
        Ok(())
    }

    fn export_vector(
        &self,
        request: &PictureRequest,
        format: VectorFormat,
        path: &Path,
    ) -> Result<(), UserError> {
        picture(request).save_vector(format, path)?;
        Ok(())
    }

    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Frame, UserError> {
        Ok(draw_swept_areas(layout, rows, vehicle, view)?)
    }

    fn methods(&self) -> Vec<MethodChoice> {
        let listed = guideway::methods().into_iter().map(|method| MethodChoice {
            name: method.info.name.to_owned(),
            summary: method.info.summary.to_owned(),
            unavailable: method.unavailable,
        });
        let mut choices: Vec<MethodChoice> = listed.collect();
        let best = guideway::live_method();
        choices.sort_by_key(|choice| choice.name != best);
        choices
    }

    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError> {
        Ok(guideway::method(name)?)
    }

    #[cfg(feature = "gpu")]
    fn choose_adapter(
        &self,
        adapters: &[wgpu::Adapter],
        can_present: &dyn Fn(&wgpu::Adapter) -> bool,
    ) -> Result<wgpu::Adapter, String> {
        guideway::Gpu::choose(adapters, can_present).map_err(|error| error.to_string())
    }

    #[cfg(feature = "gpu")]
    fn device_descriptor(
        &self,
        adapter: &wgpu::Adapter,
    ) -> Option<wgpu::DeviceDescriptor<'static>> {
        Some(guideway::Gpu::descriptor(adapter))
    }

    #[cfg(feature = "gpu")]
    fn share_device(&self, adapter: &wgpu::Adapter, device: &wgpu::Device, queue: &wgpu::Queue) {
        guideway::share_device(guideway::Gpu::shared(
            adapter,
            device.clone(),
            queue.clone(),
        ));
    }

    fn on_stage(&self, stage: LoadStage, file: &Path) {
        let Some(since) = self.timed_since else {
            return;
        };
        let stage = match stage {
            LoadStage::Read => "read",
            LoadStage::Shown => "shown",
            LoadStage::Editable => "ready to be edited",
            LoadStage::Checked => "checked",
        };
        let (ms, file) = (elapsed_ms(since), shown_path(file));
        // Standard error may be closed.
        let _ = writeln!(io::stderr(), "{ms:.0} ms: {file} is {stage}");
    }

    fn keeps_journals(&self) -> bool {
        self.keeps_state
    }

    fn locale(&self) -> Option<String> {
        let names = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter();
        let mut values = names.filter_map(|name| std::env::var(name).ok());
        values.find(|value| !value.is_empty())
    }

    fn state_folder(&self) -> Option<PathBuf> {
        if !self.keeps_state {
            return None;
        }
        let folders = etcetera::choose_base_strategy().ok()?;
        let folder = folders.state_dir().unwrap_or_else(|| folders.data_dir());
        Some(folder.join("guideway"))
    }
}

/// The picture of a request, with a legend if its colors have one.
fn picture(request: &PictureRequest) -> Picture {
    let swept = request.swept.as_ref();
    let mut picture = Picture::new(Arc::clone(&request.scene), request.view.size());
    picture.viewport = Viewport::of(&request.view);
    picture.style = request.style;
    picture.opacity = request.opacity;
    picture.backdrop = Backdrop {
        floor_plan: request.floor_plan.clone(),
        floor_plan_fade: 1.0 - request.floor_plan_opacity,
        lines: request.grid.clone(),
        swept: swept.map(|swept| SweptAreas {
            vehicle: swept.vehicle,
            rows: Some(swept.rows.clone()),
        }),
        others: request.others.clone(),
    };
    picture.overlay = request.marks.clone();
    // Levels and counts of density are explained too.
    let has_density = request.style.shading != Shading::Color;
    let has_colors = has_density || request.scene.legend().is_some();
    picture.decorations.has_legend = has_colors && request.has_legend;
    picture.decorations.px_per_point = Some(request.px_per_point);
    picture
}

/// A job of the window as the progress of readers and pictures.
struct JobProgress<'a>(&'a Job);

impl Progress for JobProgress<'_> {
    fn advance(&self, done: u64, total: u64) {
        self.0.advance(done, total);
    }

    fn cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::NewPath;
    use guideway::scene::density::ToneMap;
    use guideway::scene::{DrawList, FrameSize, LineRule, Scene, SceneOptions, Style};
    use guideway::spline::{Point, Runs};

    use super::*;

    /// A line across a picture of 1,200 x 900 pixels.
    fn request(shading: Shading) -> PictureRequest {
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 0.0));
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            id: "aisle",
            runs: &runs,
            ..NewPath::default()
        });
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap();
        let size = FrameSize::new(1200, 900).unwrap();
        PictureRequest {
            scene: Arc::new(scene),
            opacity: 1.0,
            others: Vec::new(),
            view: View::new(size, Point::new(6.0, 0.0), 20.0).unwrap(),
            px_per_point: 2.0,
            style: Style {
                // The widths of a screen with two pixels per point.
                line_rule: LineRule::default().scaled(2.0),
                shading,
                ..Style::default()
            },
            floor_plan: None,
            floor_plan_opacity: 1.0,
            swept: None,
            grid: DrawList::default(),
            marks: DrawList::default(),
            has_legend: true,
        }
    }

    fn svg(request: &PictureRequest) -> String {
        let mut bytes = Vec::new();
        let fail = |_| unreachable!("memory takes all bytes");
        let written = picture(request).write_vector(VectorFormat::Svg, &mut bytes, fail);
        written.unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn opened_file_named_like_an_image_is_told_as_none() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("plan.png");
        std::fs::write(&file, b"\n \xED6\xBE\nlevels:\n\xFE\xD3").unwrap();
        let services = FileServices::for_measurement();
        let error = services.read_layout(&file, &Job::default()).err().unwrap();
        let text = error.to_string();
        assert!(text.contains("cannot read the image"), "{text}");
        assert!(!text.contains("UTF-8"), "{text}");
    }

    #[test]
    fn jpeg_is_read_as_a_floor_plan() {
        let plan = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../guideway-formats/src/raster/halves.jpg@px-per-m=2,offset=0,0"
        );
        let plan = FileServices::for_measurement().read_floor_plan(plan);
        let plan = plan.unwrap();
        assert!(matches!(plan, FloorPlan::Image(_)));
        let size_m = plan.bounds().unwrap().size();
        assert_eq!((size_m.x, size_m.y), (8.0, 4.0));
    }

    #[test]
    fn opacity_of_the_paths_is_that_of_the_request() {
        let mut request = request(Shading::Color);
        assert!(!svg(&request).contains("<g opacity"));
        request.opacity = 0.5;
        assert!(svg(&request).contains("<g opacity=\"0.500\""));
    }

    #[test]
    fn vector_pictures_have_the_widths_of_the_screen() {
        let request = request(Shading::Color);
        let rule = request.style.line_rule;
        let width_px = 2.0 * rule.radius_px(None, request.view.px_per_m());
        let text = svg(&request);
        let width = format!("stroke-width=\"{width_px}\"");
        assert!(text.contains(&width), "{width}: {text}");
        assert!(!text.contains("paths per pixel"));
    }

    #[test]
    fn density_has_its_scale_in_all_exports() {
        let request = request(Shading::Density(ToneMap::Log));
        assert!(request.scene.legend().is_none(), "no column is shown");
        assert!(svg(&request).contains("paths per pixel"));
        let without = PictureRequest {
            has_legend: false,
            ..request.clone()
        };
        assert!(!svg(&without).contains("paths per pixel"));
        let has_legend = |has_legend: bool| {
            let mut picture = picture(&request);
            picture.decorations.has_legend &= has_legend;
            let cpu = guideway::method("cpu").unwrap();
            let progress = JobProgress(&Job::default());
            picture.render_frame(&*cpu, &progress).unwrap().0
        };
        assert!(has_legend(true).pixels() != has_legend(false).pixels());
    }
}
