//! Finds the `guideway.toml` for a checked file, and reads each only once.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use guideway::layout::{UserError, shown_path};

use super::rules::{ConfigFile, Rules};
use crate::cli::error::unreadable;
use crate::cli::input::{relative, resolved};

/// Name of the file.
const NAME: &str = "guideway.toml";

/// Largest file that is read.
const MAX_BYTES: u64 = 1 << 20;

const REMEDY: &str = "Correct the file; docs/command-line.md lists its keys";

/// The files of settings of this run.
#[derive(Default)]
pub(in super::super) struct Configs {
    /// A file for all checked files.
    given: Option<PathBuf>,
    /// The file of each folder that was looked for, if there is one.
    of_folder: HashMap<PathBuf, Option<Rc<Config>>>,
}

struct Config {
    path: PathBuf,
    folder: PathBuf,
    file: ConfigFile,
}

impl Configs {
    /// Takes one file for all checked files, or `None` to find the file of each.
    pub(in super::super) fn new(given: Option<&Path>) -> Self {
        Self {
            given: given.map(Path::to_owned),
            ..Self::default()
        }
    }

    /// The rules for a file, and the path of the file of settings that has them.
    ///
    /// # Errors
    /// When that file cannot be read or is not valid.
    pub(in super::super) fn rules(
        &mut self,
        checked: &Path,
    ) -> Result<(Rules, Option<PathBuf>), UserError> {
        let checked = resolved(checked);
        let folder = checked.parent().unwrap_or(Path::new("/")).to_owned();
        let config = match self.of_folder.get(&folder) {
            Some(known) => known.clone(),
            None => {
                let path = match &self.given {
                    Some(given) => Some(given.clone()),
                    None => folder
                        .ancestors()
                        .map(|f| f.join(NAME))
                        .find(|f| f.is_file()),
                };
                let config = path
                    .map(|path| Config::read(&path))
                    .transpose()?
                    .map(Rc::new);
                self.of_folder.insert(folder, config.clone());
                config
            }
        };
        Ok(match config {
            None => (Rules::default(), None),
            Some(config) => {
                let path = relative(&checked, &config.folder);
                (config.file.rules(&path), Some(config.path.clone()))
            }
        })
    }
}

impl Config {
    fn read(path: &Path) -> Result<Self, UserError> {
        let fail = |detail: String| {
            let message = format!("{}: {detail}", shown_path(path));
            UserError::new("config", message, REMEDY)
        };
        let mut text = String::new();
        let file = File::open(path).map_err(|error| fail(unreadable(&error)))?;
        let read = file.take(MAX_BYTES + 1).read_to_string(&mut text);
        read.map_err(|error| fail(error.to_string()))?;
        if text.len() as u64 > MAX_BYTES {
            return Err(fail(format!("the file is larger than {MAX_BYTES} bytes")));
        }
        let whole = resolved(path);
        Ok(Self {
            path: path.to_owned(),
            folder: whole.parent().unwrap_or(Path::new("/")).to_owned(),
            file: ConfigFile::parse(&text).map_err(fail)?,
        })
    }
}
