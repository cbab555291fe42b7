#[cfg(feature = "gpu")]
mod gpu;
#[cfg(feature = "gl")]
mod tessellation;

use guideway_cpu::{Cpu, Oracle};
use guideway_scene::{Method, MethodInfo};

/// The name that stands for the best method for one picture.
pub const AUTO: &str = "auto";

/// A method of this build, and whether it runs on this computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Available {
    /// What it is called and where it runs; the device is empty when it does not run.
    pub info: MethodInfo,
    /// What may follow its name, each after a `+`.
    pub options: &'static [MethodOption],
    /// Why it does not run here, if so.
    pub why_not: Option<String>,
}

/// An option of a method, as it follows the name: `grid+scan`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodOption {
    /// What is written.
    pub name: &'static str,
    /// One line on what it changes.
    pub summary: &'static str,
}

/// Why there is no such method.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MethodError {
    /// No method has this name.
    #[error("there is no method `{asked}`; there is: {}", .known.join(", "))]
    Unknown {
        /// The name asked for.
        asked: String,
        /// Those that there are.
        known: Vec<&'static str>,
    },
    /// The method has no such option, or it makes no sense.
    #[error("method `{name}`: {what}")]
    Option {
        /// The method asked for.
        name: &'static str,
        /// What is wrong, and what there is.
        what: String,
    },
    /// The method does not run on this computer.
    #[error("method `{name}` does not run here: {why}")]
    Unavailable {
        /// The method asked for.
        name: &'static str,
        /// What is missing.
        why: String,
    },
}

/// Why a method does not start.
enum Stop {
    /// Its options make no sense.
    Options(String),
    /// The computer lacks something.
    #[cfg_attr(
        not(any(feature = "gl", feature = "gpu")),
        expect(dead_code, reason = "a processor lacks nothing")
    )]
    Missing(String),
}

struct Entry {
    name: &'static str,
    summary: &'static str,
    options: &'static [MethodOption],
    /// Whether it draws every scene as asked, so that [`AUTO`] may choose it.
    is_general: bool,
    /// Starts the method with the options after its name.
    start: fn(&str) -> Result<Box<dyn Method>, Stop>,
}

const CPU: Entry = Entry {
    name: "cpu",
    summary: "Fast and exact on any processor; needs no graphics hardware",
    options: &[],
    is_general: true,
    start: |options| without_options(options, Cpu),
};

/// Every method of this build. The first general one that starts is what [`AUTO`] stands for.
const ENTRIES: &[Entry] = &[
    CPU,
    Entry {
        name: "oracle",
        summary: "The slow judge of all other methods, in double precision",
        options: &[],
        is_general: true,
        start: |options| without_options(options, Oracle),
    },
    #[cfg(feature = "gpu")]
    gpu::TILES,
    #[cfg(feature = "gpu")]
    gpu::GRID,
    #[cfg(feature = "gl")]
    tessellation::PER_PATH,
    #[cfg(feature = "gl")]
    tessellation::COMPACT,
];

/// Every method of this build, the preferred ones first. Starts each to see whether it runs.
pub fn methods() -> Vec<Available> {
    let look = |entry: &Entry| match (entry.start)("") {
        Ok(method) => Available {
            info: method.info(),
            options: entry.options,
            why_not: None,
        },
        Err(Stop::Options(why_not) | Stop::Missing(why_not)) => Available {
            info: MethodInfo {
                name: entry.name,
                summary: entry.summary,
                device: String::new(),
            },
            options: entry.options,
            why_not: Some(why_not),
        },
    };
    ENTRIES.iter().map(look).collect()
}

/// Names of all methods of this build, whether they run here or not.
pub fn method_names() -> impl Iterator<Item = &'static str> {
    ENTRIES.iter().map(|entry| entry.name)
}

/// Name of the best method for a picture that changes all the time, as in a window: `gpu` where there is a graphics
/// device in hardware, `cpu` elsewhere. For one picture the latter is sooner done than a device is started, and the
/// same on every machine.
pub fn live_method() -> &'static str {
    #[cfg(feature = "gpu")]
    if gpu::is_in_hardware() {
        return gpu::TILES.name;
    }
    CPU.name
}

/// Starts a method by its name and options, such as `grid+scan+aa=subpixel`; [`AUTO`] starts the best that
/// runs here and draws everything as asked.
///
/// # Errors
/// When there is no such method, it has no such option, or it does not run on this computer.
pub fn method(spec: &str) -> Result<Box<dyn Method>, MethodError> {
    let (name, options) = spec.split_once('+').unwrap_or((spec, ""));
    if name == AUTO {
        return automatic(options);
    }
    match ENTRIES.iter().find(|entry| entry.name == name) {
        Some(entry) => start(entry, options),
        None => Err(MethodError::Unknown {
            asked: name.to_owned(),
            known: std::iter::once(AUTO).chain(method_names()).collect(),
        }),
    }
}

fn automatic(options: &str) -> Result<Box<dyn Method>, MethodError> {
    let mut missing = None;
    for entry in ENTRIES.iter().filter(|entry| entry.is_general) {
        match start(entry, options) {
            Err(why @ MethodError::Unavailable { .. }) => missing = Some(why),
            outcome => return outcome,
        }
    }
    Err(missing.unwrap_or_else(|| MethodError::Unknown {
        asked: AUTO.to_owned(),
        known: method_names().collect(),
    }))
}

fn start(entry: &Entry, options: &str) -> Result<Box<dyn Method>, MethodError> {
    let name = entry.name;
    (entry.start)(options).map_err(|stop| match stop {
        Stop::Options(what) => MethodError::Option { name, what },
        Stop::Missing(why) => MethodError::Unavailable { name, why },
    })
}

fn without_options(options: &str, method: impl Method + 'static) -> Result<Box<dyn Method>, Stop> {
    if options.is_empty() {
        Ok(Box::new(method))
    } else {
        Err(Stop::Options(format!(
            "there is no option `{options}`; it has none"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_method_starts_by_its_name_or_says_why_not() {
        for listed in methods() {
            match method(listed.info.name) {
                Ok(method) => assert_eq!(method.info().name, listed.info.name),
                Err(MethodError::Unavailable { why, .. }) => {
                    assert_eq!(Some(why), listed.why_not);
                }
                Err(error) => panic!("{error}"),
            }
        }
    }

    #[test]
    fn every_listed_option_is_taken() {
        for listed in methods().iter().filter(|m| m.why_not.is_none()) {
            for option in listed.options {
                let spec = format!("{}+{}", listed.info.name, option.name);
                assert!(method(&spec).is_ok(), "{spec}");
            }
        }
    }

    #[test]
    fn what_changes_all_the_time_is_drawn_by_a_method_that_runs_here() {
        let name = live_method();
        let methods = methods();
        let listed = methods.iter().find(|m| m.info.name == name).unwrap();
        assert_eq!(listed.why_not, None);
        let is_software = listed.info.device.contains("llvmpipe");
        assert!(!is_software, "{}", listed.info.device);
    }

    #[test]
    fn auto_chooses_a_fast_method_that_draws_everything() {
        assert_eq!(method(AUTO).unwrap().info().name, "cpu");
    }

    #[test]
    fn an_unknown_method_is_refused_with_those_there_are() {
        let error = method("gpuu").err().unwrap().to_string();
        assert!(
            error.contains("gpuu") && error.contains("auto, cpu"),
            "{error}"
        );
    }

    #[test]
    fn an_unknown_option_is_refused() {
        let error = method("cpu+quick").err().unwrap();
        assert!(matches!(error, MethodError::Option { name: "cpu", .. }));
        assert!(error.to_string().contains("quick"), "{error}");
    }
}
