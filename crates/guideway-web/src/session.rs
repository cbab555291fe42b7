//! [`Session`]: one layout that is open, and what the page does with it.

use std::io;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use guideway::compose::{
    ComposeError, FloorPlan, KeptMethod, MarkedRoute, NoProgress, Picture, VectorFormat, Viewport,
    suitable_widths,
};
use guideway::document::{Index, pick_element};
use guideway::formats::{Parts, Progress, ReadOptions, read_parts};
use guideway::layout::{Layout, Severity, UserError};
use guideway::network::{Route, RouteOptions, Router};
use guideway::scene::density::ToneMap;
use guideway::scene::{LineRule, Scene, Shading, View};
use guideway::spline::Point;
use guideway::{SaveError, write_png_by};
use serde_json::{Value, json};

use crate::answers;
use crate::elements;
use crate::floor_plan;
#[cfg(feature = "files")]
use crate::history::History;
use crate::look::{Look, RouteEnds, SceneKey, Shade, usage, vehicle};

/// Paths among which the one under the pointer is sought.
const MAX_CANDIDATES: usize = 100_000;

/// A layout that is open in a page.
pub struct Session {
    pub(crate) name: String,
    pub(crate) layout: Arc<Layout>,
    #[cfg(feature = "files")]
    pub(crate) history: History,
    index: OnceLock<Arc<Index>>,
    scene: Option<(SceneKey, Arc<Scene>)>,
    method: KeptMethod,
    floor_plan: Option<FloorPlan>,
    /// The widths that suit the last view.
    widths: Option<SuitedWidths>,
    /// The view and the widths of the last picture, for hit tests.
    shown: Option<(View, LineRule)>,
}

/// The widths of lines in a view.
#[derive(Clone, Copy)]
struct SuitedWidths {
    view: View,
    is_all_shown: bool,
    rule: LineRule,
}

/// A picture: pixels, and what they show as JSON.
#[derive(Debug)]
pub struct Drawn {
    /// R, G, B, A of each pixel, row by row from the top.
    pub rgba: Vec<u8>,
    /// View, account of all paths, notes, legend.
    pub report: String,
}

impl Session {
    /// Opens a file, whose bytes stay outside; the content decides the format. Error texts call it
    /// `name`. The finished share goes to `progress`.
    ///
    /// # Errors
    /// When the command would refuse the file too.
    pub fn open(name: &str, file: &dyn Parts, progress: &dyn Progress) -> Result<Self, UserError> {
        let options = ReadOptions {
            progress: Some(progress),
            ..ReadOptions::default()
        };
        Ok(Self {
            name: name.to_owned(),
            layout: Arc::new(read_parts(name, file, &options)?),
            #[cfg(feature = "files")]
            history: History::default(),
            index: OnceLock::new(),
            scene: None,
            method: KeptMethod::default(),
            floor_plan: None,
            widths: None,
            shown: None,
        })
    }

    /// Says which format the layout had before it traveled as Arrow: lines of a drawing are drawn
    /// finer than ways, and have no arrows.
    pub fn set_origin(&mut self, format: &str, version: &str) {
        let provenance = &mut Arc::make_mut(&mut self.layout).provenance;
        format.clone_into(&mut provenance.format);
        version.clone_into(&mut provenance.format_version);
    }

    /// Sets the floor plan: the bytes of an image with its `placement`, which is JSON, or those of
    /// a layout or a drawing with `null` in its place. Error texts call it `name`.
    ///
    /// # Errors
    /// When the bytes cannot be read, or the placement is none.
    pub fn set_floor_plan(
        &mut self,
        name: &str,
        bytes: Vec<u8>,
        placement: &str,
    ) -> Result<(), UserError> {
        self.floor_plan = Some(floor_plan::read(name, bytes, placement)?);
        self.widths = None;
        Ok(())
    }

    /// Checks that a vehicle, such as `2x1.2`, has swept areas in this layout.
    ///
    /// # Errors
    /// When the text describes no vehicle, or no path has an area.
    pub fn check_envelope(&self, text: &str) -> Result<(), UserError> {
        let any = vehicle(text)?.require_any(&self.layout);
        any.map_err(|reason| ComposeError::NoEnvelope { reason }.into())
    }

    /// Extent, counts, levels, vehicle types, columns and formats to save in, as JSON. The length
    /// is left out: see [`Self::length_m`].
    pub fn info(&self) -> String {
        let mut info = guideway::json::counts(&self.layout);
        info["name"] = json!(self.name);
        if cfg!(not(feature = "files")) {
            info["targets"] = json!([]);
        }
        info.to_string()
    }

    /// Length of the curves of at most `count` rows of paths from `first` on, in meters. A page
    /// asks for some rows at a time, after its first picture: all take 0.8 s for a million paths.
    pub fn length_m(&self, first: usize, count: usize) -> f64 {
        let all = self.layout.paths.len();
        let end = first.saturating_add(count).min(all);
        guideway::json::length_m(&self.layout, first.min(end)..end)
    }

    /// The findings about the layout, at most `most` of them, and how many there are, as JSON.
    pub fn check(&self, most: usize) -> String {
        let found = guideway::check(&self.layout);
        let mut sorted: Vec<_> = found.iter().collect();
        sorted.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        let shown = sorted.iter().take(most);
        let shown: Vec<Value> = shown
            .map(|finding| answers::finding(&self.layout, finding))
            .collect();
        let count = |severity| found.count_at_least(severity);
        json!({
            "errors": count(Severity::Error),
            "warnings": count(Severity::Warning) - count(Severity::Error),
            "all": count(Severity::Info),
            "findings": shown,
        })
        .to_string()
    }

    /// Draws a picture, which `look` describes in JSON.
    ///
    /// # Errors
    /// When the look names what the layout does not have, or the view is out of range.
    pub fn render(&mut self, look: &str) -> Result<Drawn, UserError> {
        let (mut look, mut picture) = self.picture(look)?;
        if look.shade == Shade::Auto {
            look.shade = Shade::Color;
            if picture.is_crowded(&self.method, &NoProgress)? {
                look.shade = Shade::Density;
                picture.style.shading = Shading::Density(ToneMap::Log);
                picture.decorations.has_legend = true;
                // The legend may take a part of the view.
                picture.viewport = look.viewport()?;
            }
        }
        let (frame, rendered) = picture.render_frame(&self.method, &NoProgress)?;
        self.shown = Some((rendered.view, picture.style.line_rule));
        let is_density = look.shade == Shade::Density;
        Ok(Drawn {
            rgba: frame.bytes().to_vec(),
            report: answers::report(&picture, &rendered, is_density).to_string(),
        })
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// See [`Self::render`].
    pub fn png(&mut self, look: &str) -> Result<Vec<u8>, UserError> {
        let (_, picture) = self.picture(look)?;
        let (size, header) = (picture.viewport.size, picture.png_header()?);
        let mut bytes = Vec::new();
        let failed = |problem| ComposeError::Save(memory_error(problem));
        write_png_by(&mut bytes, size, &header, failed, |sink| {
            picture.render(&self.method, &NoProgress, sink)
        })?;
        Ok(bytes)
    }

    /// The picture as curves: `svg` or `pdf`. Density is an image in it.
    ///
    /// # Errors
    /// See [`Self::render`].
    pub fn curves(&mut self, look: &str, format: &str) -> Result<Vec<u8>, UserError> {
        let format = match format {
            "svg" => VectorFormat::Svg,
            "pdf" => VectorFormat::Pdf,
            other => return Err(usage(format!("no format of pictures is called `{other}`"))),
        };
        let (_, picture) = self.picture(look)?;
        let mut bytes = Vec::new();
        picture.write_vector(format, &mut bytes, |problem| memory_error(problem).into())?;
        Ok(bytes)
    }

    /// The element at a pixel of the last picture, as JSON; `null` if there is none.
    pub fn hit(&self, x: f64, y: f64, reach_px: f64) -> String {
        let (Some((view, rule)), Some((_, scene))) = (&self.shown, &self.scene) else {
            return Value::Null.to_string();
        };
        let at = Point::new(x, y);
        let place = (&**scene, self.index());
        let found = pick_element(place, *rule, view, at, reach_px, MAX_CANDIDATES);
        let found = found.map(|element| elements::summary(&self.layout, self.index(), element));
        json!(found).to_string()
    }

    /// Properties, place and outline of an element, as JSON.
    ///
    /// # Errors
    /// When the layout has no such element.
    pub fn element(&self, kind: &str, row: u32) -> Result<String, UserError> {
        let element = elements::named(&self.layout, kind, row)?;
        Ok(elements::details(&self.layout, self.index(), element).to_string())
    }

    /// Elements whose identifier contains a text, as JSON.
    pub fn find(&self, text: &str, limit: usize) -> String {
        elements::find(&self.layout, self.index(), text, limit).to_string()
    }

    /// Paths for which a condition such as `maxSpeed > 1` holds, as JSON.
    ///
    /// # Errors
    /// When the condition cannot be read.
    pub fn query(&self, text: &str, limit: usize) -> Result<String, UserError> {
        Ok(elements::query(&self.layout, self.index(), text, limit)?.to_string())
    }

    /// Points along a path from start to end, at equal distances of at most `spacing_m`, as JSON:
    /// `[{ "alongM": 0, "x": 1, "y": 2, "headingRad": 0 }, ...]`.
    ///
    /// # Errors
    /// When the path does not exist, or the distance is not above 0 or makes too many points.
    pub fn sample(&self, row: u32, spacing_m: f64) -> Result<String, UserError> {
        let samples = elements::samples(&self.layout, row, spacing_m)?;
        Ok(samples.to_string())
    }

    /// The fastest route between two stations or nodes, as JSON.
    ///
    /// # Errors
    /// When an end is unknown, or no way leads there.
    pub fn route(&self, ends: &str) -> Result<String, UserError> {
        let ends: RouteEnds = serde_json::from_str(ends)
            .map_err(|error| usage(format!("the ends of the route: {error}")))?;
        let route = self.find_route(&ends)?;
        Ok(guideway::json::route(&self.layout, &route).to_string())
    }

    /// Opens another version of the layout; returns the one before.
    #[cfg(feature = "files")]
    pub(crate) fn replace(&mut self, layout: Arc<Layout>) -> Arc<Layout> {
        (self.scene, self.widths, self.shown) = (None, None, None);
        self.index = OnceLock::new();
        std::mem::replace(&mut self.layout, layout)
    }

    fn index(&self) -> &Index {
        self.shared_index()
    }

    fn shared_index(&self) -> &Arc<Index> {
        let index = || Arc::new(Index::new(&self.layout));
        self.index.get_or_init(index)
    }

    fn find_route(&self, ends: &RouteEnds) -> Result<Route, UserError> {
        let only = self.layout.paths.vehicle_types().only_name();
        let vehicle_type = ends.vehicle_type.as_deref().or(only);
        let router = Router::new(&self.layout, vehicle_type, &RouteOptions::default())?;
        Ok(router.route(&router.place(&ends.from)?, &router.place(&ends.to)?)?)
    }

    /// The picture of a look, with the scene of the last one if that is the same.
    fn picture(&mut self, look: &str) -> Result<(Look, Picture), UserError> {
        let look = Look::parse(look)?;
        let key = look.scene_key()?;
        let kept = self.scene.take().filter(|(of, _)| *of == key);
        let scene = match kept {
            Some((_, scene)) => scene,
            None => {
                let layout = Arc::clone(&self.layout);
                Arc::new(Scene::new(layout, &key.scene_options())?)
            }
        };
        self.scene = Some((key, Arc::clone(&scene)));
        let route = look.route.as_ref().map(|ends| {
            let route = self.find_route(ends)?;
            let paths = route.rows.iter();
            Ok::<_, UserError>(MarkedRoute {
                paths: paths.map(|row| (row.path, row.is_backward)).collect(),
                from: ends.from.clone(),
                to: ends.to.clone(),
            })
        });
        let mut picture = look.picture(scene, route.transpose()?)?;
        if look.floor_plan {
            picture.backdrop.floor_plan.clone_from(&self.floor_plan);
        }
        if look.has_marks() {
            picture.index = Some(Arc::clone(self.shared_index()));
        }
        self.suit_widths(&mut picture)?;
        Ok((look, picture))
    }

    /// Suits the widths of lines to what the picture shows, and decides its view.
    fn suit_widths(&mut self, picture: &mut Picture) -> Result<(), UserError> {
        let is_all_shown = picture.viewport.px_per_m.is_none();
        let view = picture.view()?;
        let last = self
            .widths
            .filter(|last| (last.view, last.is_all_shown) == (view, is_all_shown));
        let rule = match last {
            Some(last) => last.rule,
            None => suitable_widths(&self.layout, &view, is_all_shown),
        };
        self.widths = Some(SuitedWidths {
            view,
            is_all_shown,
            rule,
        });
        picture.style.line_rule = rule;
        // Known once, it is not sought again.
        picture.viewport = Viewport::of(&view);
        Ok(())
    }
}

/// A stream into memory failed: it ran out.
fn memory_error(problem: io::Error) -> SaveError {
    SaveError {
        path: PathBuf::from("memory"),
        problem,
    }
}
