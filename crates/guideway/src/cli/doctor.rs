//! `guideway doctor`: the parts of this computer that Guideway depends on, for the report of a
//! fault, with a remedy where one is missing.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use guideway::compose::system_font;
use guideway::layout::{UserError, shown_path};
use guideway_bench::Machine;
use serde::Serialize;

use super::error::Exit;
use super::output::Output;
use super::{text, view};

/// Variables of the environment that change what Guideway does. Their values hold no secrets.
const VARIABLES: [&str; 12] = [
    "CLICOLOR_FORCE",
    "DBUS_SESSION_BUS_ADDRESS",
    "DISPLAY",
    "LANG",
    "LC_ALL",
    "NO_COLOR",
    "RAYON_NUM_THREADS",
    "VK_DRIVER_FILES",
    "VK_ICD_FILENAMES",
    "WAYLAND_DISPLAY",
    "WGPU_BACKEND",
    "XDG_STATE_HOME",
];

/// Scripts with a letter of each. The embedded fonts draw Latin, Greek and Cyrillic.
const SCRIPTS: [(&str, char); 6] = [
    ("Arabic", 'ع'),
    ("Chinese", '中'),
    ("Devanagari", 'क'),
    ("Japanese", 'あ'),
    ("Korean", '한'),
    ("Thai", 'ก'),
];

#[derive(Serialize)]
struct Findings {
    machine: Machine,
    /// Features of this build beyond the command.
    features: Vec<&'static str>,
    program: Option<String>,
    window: Option<String>,
    /// Graphics adapters with their drivers; null in a build without the feature `gpu`.
    adapters: Option<Vec<String>>,
    methods: Vec<MethodState>,
    /// Scripts that a picture of names may need, and whether a font draws them.
    scripts: Vec<Script>,
    folders: Vec<Folder>,
    environment: Vec<Variable>,
    advice: Vec<String>,
}

#[derive(Serialize)]
struct MethodState {
    name: &'static str,
    device: Option<String>,
    why_not: Option<String>,
}

#[derive(Serialize)]
struct Script {
    name: &'static str,
    has_font: bool,
}

#[derive(Serialize)]
struct Folder {
    purpose: &'static str,
    path: String,
    /// Why no file can be written there, or null.
    problem: Option<String>,
}

#[derive(Serialize)]
struct Variable {
    name: &'static str,
    value: String,
}

pub(crate) fn run(out: &Output) -> Result<Exit, UserError> {
    let findings = find();
    out.report("doctor", &findings, || shown(&findings))?;
    Ok(Exit::Clean)
}

fn find() -> Findings {
    let window = view::find();
    let methods = guideway::methods().into_iter().map(|method| MethodState {
        name: method.info.name,
        device: method.unavailable.is_none().then_some(method.info.device),
        why_not: method.unavailable,
    });
    let variables = VARIABLES.into_iter().filter_map(|name| {
        let value: OsString = env::var_os(name)?;
        Some(Variable {
            name,
            value: value.to_string_lossy().into_owned(),
        })
    });
    let scripts = SCRIPTS.into_iter().map(|(name, letter)| Script {
        name,
        has_font: system_font(letter).is_some(),
    });
    let mut findings = Findings {
        machine: Machine::here(),
        features: features(),
        program: env::current_exe().ok().map(|path| shown_path(&path)),
        window: window.map(|path| shown_path(&path)),
        adapters: guideway::graphics_adapters(),
        methods: methods.collect(),
        scripts: scripts.collect(),
        folders: vec![
            folder("this folder", env::current_dir().ok()),
            folder("temporary files", Some(env::temp_dir())),
        ],
        environment: variables.collect(),
        advice: Vec::new(),
    };
    findings.advice = advice(&findings);
    findings
}

/// The scripts with a font, or those without.
fn names_of(scripts: &[Script], has_font: bool) -> String {
    let named = scripts.iter().filter(|script| script.has_font == has_font);
    named
        .map(|script| script.name)
        .collect::<Vec<_>>()
        .join(", ")
}

fn features() -> Vec<&'static str> {
    let all = [("gpu", cfg!(feature = "gpu")), ("gl", cfg!(feature = "gl"))];
    let on = all.into_iter().filter(|(_, is_on)| *is_on);
    on.map(|(name, _)| name).collect()
}

/// Writes a file into the folder and removes it.
fn folder(purpose: &'static str, path: Option<PathBuf>) -> Folder {
    let problem = match &path {
        None => Some("the system does not name it".to_owned()),
        Some(path) => tempfile::tempfile_in(path)
            .err()
            .map(|error| error.to_string()),
    };
    Folder {
        purpose,
        path: shown_path(path.as_deref().unwrap_or(Path::new(""))),
        problem,
    }
}

/// Remedies for parts that are missing.
fn advice(findings: &Findings) -> Vec<String> {
    let mut advice = Vec::new();
    if findings.window.is_none() {
        advice.push(
            "The window is not installed: `cargo install --path crates/guideway-window`".to_owned(),
        );
    }
    if findings.adapters.as_ref().is_some_and(Vec::is_empty) {
        advice.push("No graphics adapter; `cpu` draws without. Method `gpu` says more".to_owned());
    }
    let without = names_of(&findings.scripts, false);
    if !without.is_empty() {
        advice.push(format!(
            "No font draws {without}: names in them become boxes; install one, such as Noto"
        ));
    }
    for Folder {
        purpose,
        path,
        problem,
    } in &findings.folders
    {
        if let Some(problem) = problem {
            advice.push(format!(
                "No file can be written to {path} ({purpose}): {problem}"
            ));
        }
    }
    advice
}

fn shown(findings: &Findings) -> String {
    let mut lines: Vec<(String, String)> = Vec::new();
    let mut add = |name: &str, value: String| lines.push((name.to_owned(), value));
    let machine = &findings.machine;
    let features = match findings.features.is_empty() {
        true => "no methods on graphics devices".to_owned(),
        false => format!("features {}", findings.features.join(", ")),
    };
    let build = format!("{} ({}), {features}", machine.guideway, machine.profile);
    add("guideway", build);
    let missing = || "not found".to_owned();
    add("command", findings.program.clone().unwrap_or_else(missing));
    add("window", findings.window.clone().unwrap_or_else(missing));
    add("system", machine.os.clone());
    let memory = machine.memory_bytes.map(text::bytes).unwrap_or_default();
    let cpu = machine.cpu.clone().unwrap_or_else(|| "unknown".to_owned());
    add(
        "processor",
        format!("{cpu}, {} threads, {memory}", machine.cores),
    );
    for adapter in findings.adapters.iter().flatten() {
        add("adapter", adapter.clone());
    }
    for MethodState {
        name,
        device,
        why_not,
    } in &findings.methods
    {
        let state = match (device, why_not) {
            (_, Some(reason)) => format!("does not run: {reason}"),
            (device, None) => device.clone().unwrap_or_default(),
        };
        add(name, state);
    }
    add("fonts", names_of(&findings.scripts, true));
    for folder in &findings.folders {
        let state = folder.problem.as_deref().unwrap_or("can be written");
        add(folder.purpose, format!("{}: {state}", folder.path));
    }
    for Variable { name, value } in &findings.environment {
        add(name, value.clone());
    }
    let width = lines.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let rows = lines
        .iter()
        .map(|(name, value)| format!("{name:<width$}  {value}\n"));
    let mut text: String = rows.collect();
    if !findings.advice.is_empty() {
        text += "\n";
    }
    for advice in &findings.advice {
        text += &format!("{advice}\n");
    }
    text
}
