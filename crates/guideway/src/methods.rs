use guideway_cpu::{Cpu, Oracle};
use guideway_render::{Method, MethodInfo};

/// The name that stands for the best method that runs here.
pub const AUTO: &str = "auto";

/// A method of this build, and whether it runs on this computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Available {
    /// What it is called and where it runs; the device is empty when it does not run.
    pub info: MethodInfo,
    /// Why it does not run here, if so.
    pub why_not: Option<String>,
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
    /// The method does not run on this computer.
    #[error("method `{name}` does not run here: {why}")]
    Unavailable {
        /// The method asked for.
        name: &'static str,
        /// What is missing.
        why: String,
    },
}

struct Entry {
    name: &'static str,
    summary: &'static str,
    /// Starts the method, or says what is missing for it.
    start: fn() -> Result<Box<dyn Method>, String>,
}

/// Every method of this build. The first that starts is the one that [`AUTO`] stands for.
const ENTRIES: &[Entry] = &[
    Entry {
        name: "cpu",
        summary: "Fast and exact on any processor; needs no graphics hardware",
        start: || Ok(Box::new(Cpu)),
    },
    Entry {
        name: "oracle",
        summary: "The slow judge of all other methods, in double precision",
        start: || Ok(Box::new(Oracle)),
    },
];

/// Every method of this build, the preferred ones first. Starts each to see whether it runs.
pub fn methods() -> Vec<Available> {
    let look = |entry: &Entry| match (entry.start)() {
        Ok(method) => Available {
            info: method.info(),
            why_not: None,
        },
        Err(why_not) => Available {
            info: MethodInfo {
                name: entry.name,
                summary: entry.summary,
                device: String::new(),
            },
            why_not: Some(why_not),
        },
    };
    ENTRIES.iter().map(look).collect()
}

/// Starts the method of this name; [`AUTO`] starts the best that runs here.
///
/// # Errors
/// When there is no such method, or it does not run on this computer.
pub fn method(name: &str) -> Result<Box<dyn Method>, MethodError> {
    let unavailable = |entry: &Entry, why| MethodError::Unavailable {
        name: entry.name,
        why,
    };
    if name == AUTO {
        let mut missing = None;
        for entry in ENTRIES {
            match (entry.start)() {
                Ok(method) => return Ok(method),
                Err(why) => missing = Some(unavailable(entry, why)),
            }
        }
        if let Some(missing) = missing {
            return Err(missing);
        }
    }
    match ENTRIES.iter().find(|entry| entry.name == name) {
        Some(entry) => (entry.start)().map_err(|why| unavailable(entry, why)),
        None => Err(MethodError::Unknown {
            asked: name.to_owned(),
            known: std::iter::once(AUTO)
                .chain(ENTRIES.iter().map(|entry| entry.name))
                .collect(),
        }),
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
    fn auto_never_chooses_the_oracle_while_cpu_runs() {
        assert_ne!(method(AUTO).unwrap().info().name, "oracle");
    }

    #[test]
    fn an_unknown_method_is_refused_with_those_there_are() {
        let error = method("gpuu").err().unwrap().to_string();
        assert!(
            error.contains("gpuu") && error.contains("auto, cpu"),
            "{error}"
        );
    }
}
