//! Runs `share`: reads the files as every command does, and writes them into the page.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway::compose::ComposeError;
use guideway::layout::{UserError, shown_path};
use guideway::scene::{ColorBy, Scene, SceneOptions};
use serde_json::json;

use super::args::Args;
use super::fonts;
use super::page::{PageContent, SharedLook, page as make_page};
use crate::cli::error::{Exit, usage_error};
use crate::cli::input::{self, Input, check_output};
use crate::cli::layout_output::exact_arrow;
use crate::cli::output::{Output, is_stdout, print, save};
use crate::cli::picture_file::stem;
use crate::cli::{floor_plan, stdout, text};

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let output = match &args.output {
        Some(output) => output.clone(),
        None => default_name(&args.inputs[0].path)?,
    };
    if !is_stdout(&output) && !is_page(&output) {
        return Err(usage_error(
            format!("{}: a page is an HTML file", shown_path(&output)),
            format!("Name it {}", shown_path(&output.with_extension("html"))),
        ));
    }
    let content = Content {
        inputs: &args.inputs,
        floor_plan: args.floor_plan.as_ref(),
        title: args.title.as_deref(),
    };
    write(&content, &output, &args.look(), out)
}

/// Returns `true` if the extension of a file says that it is a page.
pub(crate) fn is_page(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    extension.eq_ignore_ascii_case("html") || extension.eq_ignore_ascii_case("htm")
}

/// The content of a page.
pub(crate) struct Content<'a> {
    /// The files of the layout.
    pub(crate) inputs: &'a [Input],
    pub(crate) floor_plan: Option<&'a Input>,
    /// `None` for the name of the first file.
    pub(crate) title: Option<&'a str>,
}

/// Writes layout files into a page.
///
/// # Errors
/// When a file cannot be read, the page cannot show what is asked for, or the output fails.
pub(crate) fn write(
    page: &Content<'_>,
    output: &Path,
    look: &SharedLook,
    out: &Output,
) -> Result<Exit, UserError> {
    let inputs = page.inputs;
    if look.center.is_some() != look.px_per_m.is_some() {
        return Err(usage_error(
            "--center and --scale make a view of a page together",
            "Give both, such as `--center 12.5,-3 --scale 40`, or neither",
        ));
    }
    let files = inputs.iter().chain(page.floor_plan);
    match is_stdout(output) {
        true => stdout::check(out, None)?,
        false => check_output(files.map(|input| input.path.as_path()), output)?,
    }
    let plan = page.floor_plan.map(|plan| floor_plan::pack(plan, out));
    let plan = plan.transpose()?;
    let (layout, read_ms) = input::read_all(inputs, out)?;
    let layout = Arc::new(layout);
    // Names of levels and columns are checked here, and not by the one who opens the page.
    let options = SceneOptions {
        color_by: look.color_by.clone().map(|column| ColorBy { column }),
        level: look.level.clone(),
        ..SceneOptions::default()
    };
    Scene::new(Arc::clone(&layout), &options)?;
    if let Some(vehicle) = look.envelope {
        let any = vehicle.require_any(&layout);
        any.map_err(|reason| ComposeError::NoEnvelope { reason })?;
    }
    let progress = out.progress("packing");
    let first = &inputs[0].path;
    let name = file_name(first);
    // Arrow holds everything, and the engine of the page reads nothing else.
    let bytes = exact_arrow(&layout, first)?;
    let title = page.title;
    let title = title.unwrap_or_else(|| name.split('.').next().unwrap_or_default());
    let content = PageContent {
        layout: &bytes,
        provenance: &layout.provenance,
        plan: plan.as_ref(),
        fonts: fonts::needed(&layout, title),
    };
    let page = make_page(&name, title, look, &content)?;
    let pack_ms = progress.finish();
    match is_stdout(output) {
        true => print(&page)?,
        false => save(output, &page)?,
    }
    let body = json!({
        "output": output.to_string_lossy(),
        "title": title,
        "bytes": page.len(),
        "paths": layout.paths.len(),
        "ms": { "read": read_ms, "pack": pack_ms, "total": read_ms + pack_ms },
    });
    out.beside(Some(output)).report("share", &body, || {
        format!(
            "{}: {} in {:.1} MB, which a browser opens without a server\n",
            shown_path(output),
            text::counted(layout.paths.len() as u64, "path"),
            page.len() as f64 / 1e6
        )
    })?;
    Ok(Exit::Clean)
}

/// The name of the layout's file in the page: `site.arrow` for `halls/site.lif.json`.
fn file_name(layout_file: &Path) -> String {
    let name = layout_file.file_name().unwrap_or_default();
    format!("{}.arrow", stem(&name.to_string_lossy()))
}

/// The name of the page of a layout file: `site.html` for `halls/site.lif.json`.
fn default_name(layout_file: &Path) -> Result<PathBuf, UserError> {
    let name = layout_file.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let page = PathBuf::from(match stem(&name) {
        "" | "-" => "layout.html".to_owned(),
        stem => format!("{stem}.html"),
    });
    match page.exists() {
        true => Err(usage_error(
            format!("{} exists", shown_path(&page)),
            format!("Name the page; `-o {}` replaces it", shown_path(&page)),
        )),
        false => Ok(page),
    }
}
