//! Paths as typed: expands `~`, and completes names from the entries of a folder.

use std::env;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use crate::services::AppServices;

/// Most entries of a folder that a completion examines.
const MAX_EXAMINED: usize = 20_000;
/// Most candidates of a completion.
const MAX_CANDIDATES: usize = 12;

/// The completion of a typed path.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Completion {
    /// The text, as far as all candidates agree.
    pub(super) text: String,
    /// Names of the files and folders that the text can become; folders end with a separator.
    pub(super) candidates: Vec<String>,
    /// True if there are more candidates.
    pub(super) has_more: bool,
}

/// The path of a typed text: without the spaces around it, and with `~` as the home folder.
pub(super) fn path_of(text: &str) -> PathBuf {
    expanded(text, env::home_dir().as_deref())
}

fn expanded(text: &str, home: Option<&Path>) -> PathBuf {
    let text = text.trim();
    let rest = text.strip_prefix('~');
    let rest = rest.filter(|rest| rest.is_empty() || rest.starts_with(['/', MAIN_SEPARATOR]));
    match (rest, home) {
        (Some(rest), Some(home)) => home.join(rest.trim_start_matches(['/', MAIN_SEPARATOR])),
        _ => PathBuf::from(text),
    }
}

/// Completes the name at the end of a text from the entries of its folder. Hidden entries need a
/// leading point.
pub(super) fn complete(text: &str, services: &dyn AppServices) -> Completion {
    let text = text.trim_start();
    let cut = text.rfind(['/', MAIN_SEPARATOR]).map_or(0, |at| at + 1);
    let (folder, start) = text.split_at(cut);
    let path = match folder {
        "" => PathBuf::from("."),
        folder => path_of(folder),
    };
    let is_wanted =
        |name: &str| name.starts_with(start) && (!name.starts_with('.') || !start.is_empty());
    let mut names = services.names_in(&path, MAX_EXAMINED, &is_wanted);
    names.sort_unstable();
    let common = names.iter().skip(1).fold(
        names.first().map_or(start, String::as_str),
        |common, name| &common[..common_bytes(common, name)],
    );
    Completion {
        text: format!("{folder}{common}"),
        has_more: names.len() > MAX_CANDIDATES,
        candidates: names.iter().take(MAX_CANDIDATES).cloned().collect(),
    }
}

/// Length of the common start of two texts, in bytes.
fn common_bytes(a: &str, b: &str) -> usize {
    let same = a.chars().zip(b.chars()).take_while(|(a, b)| a == b);
    same.map(|(a, _)| a.len_utf8()).sum()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::tests::services::TestServices;

    #[test]
    fn tilde_is_the_home_folder_only_at_the_start_of_a_name() {
        let home = Some(Path::new("/home/ada"));
        for (text, path) in [
            (" ~/site.lif ", "/home/ada/site.lif"),
            ("~", "/home/ada"),
            ("~x/site", "~x/site"),
            ("a/~/b", "a/~/b"),
            ("/a b/c", "/a b/c"),
        ] {
            assert_eq!(expanded(text, home), Path::new(path), "{text}");
        }
        assert_eq!(expanded("~/a", None), Path::new("~/a"));
    }

    #[test]
    fn completes_as_far_as_all_names_agree() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["hall.lif.json", "hall.arrow", "häfen", ".hidden"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        fs::create_dir(folder.path().join("plans")).unwrap();
        let base = folder.path().join("").to_string_lossy().into_owned();
        let services = TestServices::with([]);
        let done = |start: &str| {
            let done = complete(&format!("{base}{start}"), &*services);
            (done.text.replace(&base, ""), done.candidates.len())
        };
        assert_eq!(done(""), (String::new(), 4));
        assert_eq!(done("h"), ("h".into(), 3));
        assert_eq!(done("ha"), ("hall.".into(), 2));
        assert_eq!(done("hall.l"), ("hall.lif.json".into(), 1));
        assert_eq!(done("pl"), ("plans/".into(), 1));
        assert_eq!(done("."), (".hidden".into(), 1));
        assert_eq!(done("nothing"), ("nothing".into(), 0));
        for number in 0..20 {
            fs::write(folder.path().join(format!("x{number}")), "").unwrap();
        }
        let many = complete(&format!("{base}x"), &*services);
        assert!(many.has_more && many.candidates.len() == MAX_CANDIDATES);
    }
}
