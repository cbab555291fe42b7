//! Names of files as seen from the folder of a project, so that both can be moved together.

use std::io;
use std::path::{Component, Path, PathBuf, absolute};

/// The name of a file as seen from the folder of a project: relative if both are on one disk.
/// Slashes separate folders, on Windows too.
///
/// # Errors
/// When the present folder is gone.
pub(crate) fn relative_to(project: &Path, file: &Path) -> io::Result<String> {
    let (project, file) = (absolute(project)?, absolute(file)?);
    let folder = project.parent().unwrap_or(Path::new(""));
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (folder.components().collect(), file.components().collect());
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    // Without the same disk, or with nothing in common but it, the whole name is clearer.
    if same <= 1 {
        return Ok(file.to_string_lossy().into_owned());
    }
    let up = from[same..].iter().map(|_| "..".to_owned());
    let down = to[same..].iter();
    let down = down.map(|part| part.as_os_str().to_string_lossy().into_owned());
    Ok(up.chain(down).collect::<Vec<_>>().join("/"))
}

/// The file of a name in a project.
pub(crate) fn absolute_from(project: &Path, name: &str) -> PathBuf {
    let folder = project.parent().unwrap_or(Path::new(""));
    let mut path = folder.to_path_buf();
    for part in Path::new(name).components() {
        let is_name = matches!(path.components().next_back(), Some(Component::Normal(_)));
        match part {
            Component::ParentDir if is_name => {
                path.pop();
            }
            Component::CurDir => {}
            part => path.push(part),
        }
    }
    path
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn names_are_relative_to_the_folder_of_the_project() {
        let project = Path::new("/plans/site/hall.guideway-project.toml");
        for (file, name) in [
            ("/plans/site/a.lif", "a.lif"),
            ("/plans/site/plans/b.png", "plans/b.png"),
            ("/plans/shared/c.dxf", "../shared/c.dxf"),
            ("/mnt/d.lif", "/mnt/d.lif"),
        ] {
            assert_eq!(relative_to(project, Path::new(file)).unwrap(), name);
            assert_eq!(absolute_from(project, name), Path::new(file));
        }
        let here = Path::new("hall.guideway-project.toml");
        assert_eq!(absolute_from(here, "a.lif"), Path::new("a.lif"));
        assert_eq!(absolute_from(here, "../a.lif"), Path::new("../a.lif"));
    }
}
