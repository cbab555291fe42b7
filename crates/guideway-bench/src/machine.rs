//! Reads the processor, memory and system of this computer for the report of a measurement.

use std::thread;

use serde::{Deserialize, Serialize};

use crate::format::count;

/// The computer and the program of a measurement. A field is `None` if the system does not report
/// it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Model of the processor.
    pub cpu: Option<String>,
    /// Hardware threads available to this program.
    pub cores: usize,
    /// Size of the main memory.
    pub memory_bytes: Option<u64>,
    /// Operating system with its version, and the processor architecture.
    pub os: String,
    /// Version of Guideway.
    pub guideway: String,
    /// Build profile: `release` or `debug`.
    pub profile: String,
}

impl Machine {
    /// Describes this computer.
    pub fn here() -> Self {
        Self {
            cores: thread::available_parallelism().map_or(1, usize::from),
            guideway: env!("CARGO_PKG_VERSION").to_owned(),
            profile: if cfg!(debug_assertions) {
                "debug".to_owned()
            } else {
                "release".to_owned()
            },
            ..Self::of_system()
        }
    }

    /// Processor, memory and system, as the files of Linux say.
    #[cfg(target_os = "linux")]
    fn of_system() -> Self {
        let read = |path| std::fs::read_to_string(path).unwrap_or_default();
        Self {
            cpu: value(&read("/proc/cpuinfo"), "model name", ':'),
            memory_bytes: value(&read("/proc/meminfo"), "MemTotal", ':').and_then(|v| bytes(&v)),
            os: os(
                &read("/etc/os-release"),
                &read("/proc/sys/kernel/osrelease"),
            ),
            ..Self::default()
        }
    }

    /// Processor, memory and system, as calls of the system say.
    #[cfg(not(target_os = "linux"))]
    fn of_system() -> Self {
        use sysinfo::{CpuRefreshKind, MemoryRefreshKind, RefreshKind, System};
        let wanted = RefreshKind::nothing()
            .with_cpu(CpuRefreshKind::nothing())
            .with_memory(MemoryRefreshKind::nothing().with_ram());
        let system = System::new_with_specifics(wanted);
        let cpu = system.cpus().first().map(|cpu| cpu.brand().trim());
        let named = System::long_os_version().unwrap_or_else(|| std::env::consts::OS.to_owned());
        let memory_bytes = system.total_memory();
        Self {
            cpu: cpu.filter(|name| !name.is_empty()).map(str::to_owned),
            memory_bytes: (memory_bytes > 0).then_some(memory_bytes),
            os: format!("{named}, {}", std::env::consts::ARCH),
            ..Self::default()
        }
    }
}

impl Machine {
    /// The processor with its threads and the memory, as a line of text.
    pub fn processor(&self) -> String {
        let memory = self
            .memory_bytes
            .map(|bytes| format!(", {} GB of memory", count(bytes / 1_000_000_000)));
        format!(
            "{}, {} threads{}",
            self.cpu.as_deref().unwrap_or("unknown"),
            self.cores,
            memory.unwrap_or_default()
        )
    }

    /// Version and profile of the program, as a line of text.
    pub fn build(&self) -> String {
        format!("{}, {} build", self.guideway, self.profile)
    }
}

/// The value of the first line `key <separator> value`.
#[cfg(any(target_os = "linux", test))]
fn value(text: &str, key: &str, separator: char) -> Option<String> {
    let pairs = text.lines().filter_map(|line| line.split_once(separator));
    let mut values = pairs.filter(|(name, _)| name.trim() == key);
    let value = values.next()?.1.trim().trim_matches('"');
    (!value.is_empty()).then(|| value.to_owned())
}

/// `1234 kB` in bytes.
#[cfg(any(target_os = "linux", test))]
fn bytes(text: &str) -> Option<u64> {
    let kib: u64 = text.strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

#[cfg(any(target_os = "linux", test))]
fn os(release: &str, kernel: &str) -> String {
    let name =
        value(release, "PRETTY_NAME", '=').unwrap_or_else(|| std::env::consts::OS.to_owned());
    let kernel = match kernel.trim() {
        "" => String::new(),
        version => format!(", kernel {version}"),
    };
    format!("{name}{kernel}, {}", std::env::consts::ARCH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_processor_memory_and_system() {
        let cpuinfo = "processor\t: 0\nmodel name\t: Some CPU @ 2.00GHz\nmodel name\t: other\n";
        let model = value(cpuinfo, "model name", ':');
        assert_eq!(model.as_deref(), Some("Some CPU @ 2.00GHz"));
        assert_eq!(bytes("2048 kB"), Some(2_097_152));
        assert_eq!(bytes("2048"), None);
        let os = os("ID=x\nPRETTY_NAME=\"Some Linux 1\"\n", "6.1.0\n");
        assert!(os.starts_with("Some Linux 1, kernel 6.1.0, "), "{os}");
    }

    #[test]
    fn missing_system_facts_are_none() {
        assert_eq!(value("", "model name", ':'), None);
        assert_eq!(value("model name :", "model name", ':'), None);
        assert_eq!(
            os("", ""),
            format!("{}, {}", std::env::consts::OS, std::env::consts::ARCH)
        );
        assert!(Machine::here().cores >= 1);
    }
}
