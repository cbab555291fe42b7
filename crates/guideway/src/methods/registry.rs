//! The list of all methods; starts one by its name and options.

use guideway_cpu::{Cpu, Oracle};
use guideway_layout::UserError;
use guideway_scene::{Method, MethodInfo};

#[cfg(not(feature = "gpu"))]
use super::absent::gpu;
#[cfg(not(feature = "gl"))]
use super::absent::tessellation;
use super::entry::{Entry, Implementation, MethodOption, StartError};
#[cfg(feature = "gpu")]
use super::gpu;
#[cfg(feature = "gl")]
use super::tessellation;

/// The name that selects the best method for a single picture.
pub const AUTO: &str = "auto";

/// A method, and whether it runs on this computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Available {
    /// Its name and device; the device is empty if the method does not run.
    pub info: MethodInfo,
    /// The options that may follow its name, each after a `+`.
    pub options: &'static [MethodOption],
    /// Why it does not run on this computer; `None` if it runs.
    pub unavailable: Option<String>,
}

/// Why a method was not started.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MethodError {
    /// No method has this name.
    #[error("unknown method `{requested}`; known are: {}", .known.join(", "))]
    Unknown {
        /// The requested name.
        requested: String,
        /// The known names.
        known: Vec<&'static str>,
    },
    /// The options of the method are invalid.
    #[error("method `{name}`: {problem}")]
    Option {
        /// The requested method.
        name: &'static str,
        /// The invalid option, and the valid ones.
        problem: String,
    },
    /// The method does not run on this computer, or in this build.
    #[error("method `{name}` does not run here: {reason}")]
    Unavailable {
        /// The requested method.
        name: &'static str,
        /// The missing device, driver or feature.
        reason: String,
    },
}

const CPU: Entry = Entry {
    name: "cpu",
    summary: "Fast and exact on any processor; needs no graphics hardware",
    is_general: true,
    implementation: Implementation {
        options: &[],
        start: |options| without_options(options, Cpu),
    },
};

const GPU: Entry = Entry {
    name: "gpu",
    summary: "Compute shaders, each frame from the control points; a color and a width per path",
    is_general: true,
    implementation: gpu::TILES,
};

/// Every method. [`AUTO`] selects the first general one that starts.
const ENTRIES: &[Entry] = &[
    CPU,
    Entry {
        name: "oracle",
        summary: "The slow reference for all other methods, in double precision",
        is_general: true,
        implementation: Implementation {
            options: &[],
            start: |options| without_options(options, Oracle),
        },
    },
    GPU,
    Entry {
        name: "grid",
        summary: "Thesis 4.3: tests each pixel against the lines of its grid cell; one color",
        is_general: false,
        implementation: gpu::GRID,
    },
    Entry {
        name: "tree",
        summary: "Thesis 6.1.1: tests each pixel against the lines of an AABB tree",
        is_general: false,
        implementation: gpu::TREE,
    },
    Entry {
        name: "quadtree",
        summary: "Thesis 6.3: as `tree`, by a linear quadtree that each frame builds",
        is_general: false,
        implementation: gpu::QUADTREE,
    },
    Entry {
        name: "tessellation",
        summary: "Thesis 4.2: hardware tessellation, one draw call per path; one color, 1 px wide",
        is_general: false,
        implementation: tessellation::PER_PATH,
    },
    Entry {
        name: "tessellation-compact",
        summary: "The same with a single draw call for all visible segments",
        is_general: false,
        implementation: tessellation::COMPACT,
    },
];

/// Every method, the preferred ones first. Starts each to find out whether it runs.
pub fn methods() -> Vec<Available> {
    let listed = |entry: &Entry| match (entry.implementation.start)("") {
        Ok(method) => Available {
            info: method.info(),
            options: entry.implementation.options,
            unavailable: None,
        },
        Err(StartError::Options(reason) | StartError::Unavailable(reason)) => Available {
            info: MethodInfo {
                name: entry.name,
                summary: entry.summary,
                device: String::new(),
            },
            options: entry.implementation.options,
            unavailable: Some(reason),
        },
    };
    ENTRIES.iter().map(listed).collect()
}

/// Names of all methods, available or not.
pub fn method_names() -> impl Iterator<Item = &'static str> {
    ENTRIES.iter().map(|entry| entry.name)
}

/// Name of the best method for a picture that changes all the time, as in a window: `gpu` with
/// graphics hardware, `cpu` without. For a single picture `cpu` is done before a device has
/// started, and gives the same pixels on every computer.
pub fn live_method() -> &'static str {
    match gpu::is_in_hardware() {
        true => GPU.name,
        false => CPU.name,
    }
}

/// Names and values of the limits of the graphics device that methods use; empty without one.
pub fn device_limits() -> Vec<(String, String)> {
    gpu::limits()
}

/// The graphics adapters of this computer with their drivers, hardware first. `None` in a build
/// without the feature `gpu`.
pub fn graphics_adapters() -> Option<Vec<String>> {
    gpu::adapters()
}

/// Starts a method by its name and options, such as `grid+scan+aa=subpixel`. [`AUTO`] starts the
/// best general method that runs on this computer.
///
/// # Errors
/// When the method or an option is unknown, or the method does not run on this computer.
pub fn method(spec: &str) -> Result<Box<dyn Method>, MethodError> {
    let (name, options) = spec.split_once('+').unwrap_or((spec, ""));
    if name == AUTO {
        return automatic(options);
    }
    match ENTRIES.iter().find(|entry| entry.name == name) {
        Some(entry) => start(entry, options),
        None => Err(MethodError::Unknown {
            requested: name.to_owned(),
            known: std::iter::once(AUTO).chain(method_names()).collect(),
        }),
    }
}

fn automatic(options: &str) -> Result<Box<dyn Method>, MethodError> {
    let mut unavailable = None;
    for entry in ENTRIES.iter().filter(|entry| entry.is_general) {
        match start(entry, options) {
            Err(error @ MethodError::Unavailable { .. }) => unavailable = Some(error),
            outcome => return outcome,
        }
    }
    Err(unavailable.unwrap_or_else(|| MethodError::Unknown {
        requested: AUTO.to_owned(),
        known: method_names().collect(),
    }))
}

fn start(entry: &Entry, options: &str) -> Result<Box<dyn Method>, MethodError> {
    let name = entry.name;
    (entry.implementation.start)(options).map_err(|error| match error {
        StartError::Options(problem) => MethodError::Option { name, problem },
        StartError::Unavailable(reason) => MethodError::Unavailable { name, reason },
    })
}

/// Starts a method that takes no options.
fn without_options(
    options: &str,
    method: impl Method + 'static,
) -> Result<Box<dyn Method>, StartError> {
    if options.is_empty() {
        Ok(Box::new(method))
    } else {
        Err(StartError::Options(format!(
            "unknown option `{options}`: the method takes no options"
        )))
    }
}

impl From<MethodError> for UserError {
    fn from(error: MethodError) -> Self {
        let code = match &error {
            MethodError::Unknown { .. } => "unknown-method",
            MethodError::Option { .. } => "method-option",
            MethodError::Unavailable { .. } => "method-unavailable",
        };
        Self::new(
            code,
            error.to_string(),
            "`guideway methods` lists the methods; `--method auto` selects one that runs",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn listed_methods_start_or_report_the_same_reason() {
        for listed in methods() {
            match method(listed.info.name) {
                Ok(method) => assert_eq!(method.info().name, listed.info.name),
                Err(MethodError::Unavailable { reason, .. }) => {
                    assert_eq!(Some(reason), listed.unavailable);
                }
                Err(error) => panic!("{error}"),
            }
        }
    }

    #[test]
    fn methods_accept_their_listed_options() {
        for listed in methods().iter().filter(|m| m.unavailable.is_none()) {
            for option in listed.options {
                let spec = format!("{}+{}", listed.info.name, option.name);
                assert!(method(&spec).is_ok(), "{spec}");
            }
        }
    }

    #[test]
    fn live_method_runs_on_this_computer_in_hardware() {
        let name = live_method();
        let methods = methods();
        let listed = methods.iter().find(|m| m.info.name == name).unwrap();
        assert_eq!(listed.unavailable, None);
        let is_software = listed.info.device.contains("llvmpipe");
        assert!(!is_software, "{}", listed.info.device);
    }

    #[test]
    fn auto_selects_cpu() {
        assert_eq!(method(AUTO).unwrap().info().name, "cpu");
    }

    #[test]
    fn rejects_unknown_method_and_lists_the_known_ones() {
        let error = method("gpuu").err().unwrap().to_string();
        assert!(
            error.contains("gpuu") && error.contains("auto, cpu"),
            "{error}"
        );
    }

    #[test]
    fn rejects_unknown_option() {
        let error = method("cpu+quick").err().unwrap();
        assert!(matches!(error, MethodError::Option { name: "cpu", .. }));
        assert!(error.to_string().contains("quick"), "{error}");
    }
}
