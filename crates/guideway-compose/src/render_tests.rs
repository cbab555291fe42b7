//! Tests that strips of a picture add up to the picture rendered at once, with every layer.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use guideway_cpu::Cpu;
use guideway_formats::{ReadOptions, raster, read_file};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, ColorBy, DrawList, Preparation, Prepared, Rgba, Scene, SceneOptions, Shading, Strip,
    Style, TextLine,
};
use guideway_spline::Point;

use super::*;
use crate::{Backdrop, Decorations, FloorPlan, KeptMethod, OtherScene, SweptAreas, VectorFormat};

/// Method `cpu` with another limit on the pixels per strip.
struct InStrips(usize);

struct PreparedInStrips(usize, Box<dyn Prepared>);

impl Method for InStrips {
    fn info(&self) -> MethodInfo {
        Cpu.info()
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let cpu = Cpu.prepare(scene, budget)?;
        Ok(Box::new(PreparedInStrips(self.0, cpu)))
    }
}

impl Prepared for PreparedInStrips {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.1.render(view, style, cancel, frame)
    }

    fn strip_pixels(&self) -> usize {
        self.0
    }

    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.1.render_strip(strip, style, cancel, frame)
    }

    fn preparation(&self) -> &Preparation {
        self.1.preparation()
    }
}

fn site(options: &SceneOptions) -> Arc<Scene> {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../guideway/examples/site.lif.json"
    );
    let layout = read_file(path.as_ref(), &ReadOptions::default()).unwrap();
    Arc::new(Scene::new(Arc::new(layout), options).unwrap())
}

/// All pixels, the number of strips, and the report.
fn rendered(strip_pixels: usize, picture: &Picture) -> (Vec<[u8; 4]>, usize, Report) {
    let (mut pixels, mut strips) = (Vec::new(), 0);
    let mut sink = |frame: &Frame| {
        pixels.extend_from_slice(frame.pixels());
        strips += 1;
        Ok(())
    };
    let method = InStrips(strip_pixels);
    let rendered = picture.render(&method, &NoProgress, &mut sink).unwrap();
    (pixels, strips, rendered.report)
}

/// A bar and a name across the border of two strips.
fn shapes() -> DrawList {
    let mut list = DrawList::default();
    let red = Rgba::opaque(255, 0, 0);
    list.fill_rectangle(red, Point::new(100.0, 30.5), Point::new(110.0, 300.0));
    list.texts.push(TextLine {
        text: "a name".into(),
        left_middle_px: Point::new(200.0, 64.0),
        angle_rad: 0.0,
        anchor: 0.0,
        char_width_px: 9.0,
        color: red,
        halo: Rgba::WHITE,
    });
    list
}

fn size() -> FrameSize {
    FrameSize::new(500, 400).unwrap()
}

fn plain() -> Picture {
    let mut picture = Picture::new(site(&SceneOptions::default()), size());
    picture.overlay = shapes();
    picture
}

fn decorated() -> Picture {
    let by_speed = SceneOptions {
        color_by: Some(ColorBy {
            column: "maxSpeed".into(),
        }),
        ..SceneOptions::default()
    };
    let mut picture = Picture::new(site(&by_speed), size());
    picture.decorations = Decorations::site("Site");
    picture
}

fn density() -> Picture {
    let mut picture = plain();
    picture.style.shading = Shading::Density(ToneMap::Equalized);
    picture
}

fn with_backdrop() -> Picture {
    let scene = site(&SceneOptions::default());
    let mut picture = plain();
    picture.backdrop = Backdrop {
        floor_plan: Some(FloorPlan::Paths(Arc::clone(&scene), KeptMethod::default())),
        lines: shapes(),
        swept: Some(SweptAreas {
            vehicle: guideway_envelope::EnvelopeSource::Vehicle(guideway_envelope::Body::vehicle(
                2.0, 1.2, 1.0,
            )),
            rows: Some(vec![0, 2]),
        }),
        others: vec![OtherScene {
            scene,
            line_rule: picture.style.line_rule,
            opacity: 0.5,
        }],
        ..Backdrop::default()
    };
    picture
}

#[test]
fn strips_add_up_to_the_picture_rendered_at_once() {
    for picture in [decorated(), density(), with_backdrop()] {
        let (whole, strips, report) = rendered(usize::MAX, &picture);
        assert_eq!((strips, whole.len()), (1, 500 * 400));
        let (parts, strips, of_parts) = rendered(0, &picture);
        assert_eq!(strips, 7);
        assert!(parts == whole);
        assert_eq!(
            (
                of_parts.drawn,
                of_parts.culled,
                of_parts.lines,
                of_parts.notes
            ),
            (report.drawn, report.culled, report.lines, report.notes)
        );
    }
}

#[test]
fn svg_has_all_layers_and_the_letters_of_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    let mut picture = decorated();
    picture.decorations.title = Some("Zürich Süd – Αθήνα".into());
    let rendered = picture.save_svg(&path).unwrap();
    assert!(rendered.report.drawn > 0);
    let svg = std::fs::read_to_string(path).unwrap();
    for part in [
        "Zürich Süd – Αθήνα",
        "\"grid\"",
        "\"marks\"",
        "\"legend\"",
        "\"scale bar\"",
    ] {
        assert!(svg.contains(part), "{part}");
    }
}

#[test]
fn swept_areas_of_no_path_are_an_error() {
    let mut picture = plain();
    picture.backdrop.swept = Some(SweptAreas {
        vehicle: guideway_envelope::EnvelopeSource::File,
        rows: None,
    });
    let error = picture.render_frame(&Cpu, &NoProgress).unwrap_err();
    assert!(matches!(error, ComposeError::NoEnvelope { .. }), "{error}");
}

#[test]
fn density_stands_out_from_dark_paper_above_other_layers_too() {
    let colors = |lines: DrawList| {
        let mut picture = density();
        picture.style.background = Rgba::opaque(0x18, 0x18, 0x1a);
        picture.backdrop.lines = lines;
        let (_, rendered) = picture.render_frame(&Cpu, &NoProgress).unwrap();
        rendered.report.density.unwrap().scale.unwrap().colors
    };
    assert_eq!(colors(shapes()), colors(DrawList::default()));
    let mut light = density();
    light.backdrop.lines = shapes();
    let (_, rendered) = light.render_frame(&Cpu, &NoProgress).unwrap();
    let of_light = rendered.report.density.unwrap().scale.unwrap().colors;
    assert_ne!(colors(shapes()), of_light);
}

/// The density of a line and its legend, as an image in both formats; the image is as sharp as
/// print.
#[test]
fn density_is_an_image_with_its_legend_in_svg_and_pdf() {
    let folder = tempfile::tempdir().unwrap();
    let mut picture = density();
    picture.decorations.has_legend = true;
    let (svg, pdf) = (folder.path().join("a.svg"), folder.path().join("a.pdf"));
    let rendered = picture.save_svg(&svg).unwrap();
    assert_eq!(rendered.report.drawn, rendered.report.total);
    let text = std::fs::read_to_string(&svg).unwrap();
    assert!(text.contains("paths per pixel"), "{text}");
    let data = text.split("data:image/png;base64,").nth(1).unwrap();
    let png = STANDARD.decode(data.split('"').next().unwrap()).unwrap();
    let image = raster::read_bytes(png, "a.png").unwrap();
    assert_eq!(image.width as u32, 4 * size().width());
    // No curve is left beside the image, which would show through it.
    let mut curves = plain();
    curves.overlay = DrawList::default();
    let of = |picture: &Picture| {
        let mut bytes = Vec::new();
        let fail = |_| unreachable!("memory takes all bytes");
        picture
            .write_vector(VectorFormat::Svg, &mut bytes, fail)
            .unwrap();
        String::from_utf8(bytes).unwrap().matches("<path").count()
    };
    let mut shaded = density();
    shaded.overlay = DrawList::default();
    assert_eq!((of(&curves) > 0, of(&shaded)), (true, 0));
    picture.save_vector(VectorFormat::Pdf, &pdf).unwrap();
    let bytes = std::fs::read(&pdf).unwrap();
    let has = |part: &[u8]| bytes.windows(part.len()).any(|bytes| bytes == part);
    assert!(has(b"/Image") && has(b"/SMask"));
}

/// A faded scene has the same pixels on top and below another one that is not seen.
#[test]
fn faded_paths_mix_with_the_background_in_all_formats() {
    let mut picture = plain();
    picture.overlay = DrawList::default();
    let pixels = |picture: &Picture| {
        let (frame, _) = picture.render_frame(&Cpu, &NoProgress).unwrap();
        frame.pixels().to_vec()
    };
    let opaque = pixels(&picture);
    assert!(opaque.iter().any(|pixel| pixel[0] < 50));
    let mut faded = picture.clone();
    faded.opacity = 0.25;
    let mut below = picture.clone();
    below.opacity = 0.0;
    below.backdrop.others = vec![OtherScene {
        scene: Arc::clone(&picture.scene),
        line_rule: picture.style.line_rule,
        opacity: 0.25,
    }];
    for picture in [&faded, &below] {
        for (faded, opaque) in pixels(picture).iter().zip(&opaque) {
            for (faded, opaque) in faded.iter().zip(opaque) {
                let expected = 255.0 - 0.25 * (255.0 - f64::from(*opaque));
                assert!((f64::from(*faded) - expected).abs() <= 2.0);
            }
        }
        let written = |picture: &Picture, format| {
            let mut bytes = Vec::new();
            let fail = |_| unreachable!("memory takes all bytes");
            picture.write_vector(format, &mut bytes, fail).unwrap();
            String::from_utf8_lossy(&bytes).into_owned()
        };
        for (format, state) in [
            (VectorFormat::Svg, "opacity=\"0.250\""),
            (VectorFormat::Pdf, "/ca 0.25"),
        ] {
            assert!(written(picture, format).contains(state), "{format:?}");
        }
    }
}
