//! Merge keys: completes an object by the entries of those that its `<<` names.

use std::collections::HashSet;
use std::rc::Rc;

use super::node::{Content, NodeData};

/// Puts the entries of the values `merges` before those of the object `node`, and marks the values
/// as merged.
///
/// An own entry wins, then that of a later `<<`, then that of an earlier object of a list, as in
/// YAML 1.1. Cost: linear in the entries of the merged objects.
///
/// # Errors
/// The line of a value that is neither an object nor a list of objects.
pub(super) fn merge(
    values: &mut [NodeData<'_>],
    node: &mut NodeData<'_>,
    merges: &[u32],
) -> Result<(), u32> {
    let Content::Map(own) = &mut node.content else {
        return Ok(());
    };
    if merges.is_empty() {
        return Ok(());
    }
    let mut objects: Vec<u32> = Vec::new();
    for &value in merges.iter().rev() {
        match &values[value as usize].content {
            Content::List(items) => objects.extend(items),
            _ => objects.push(value),
        }
    }
    let mut seen: HashSet<Rc<str>> = own.iter().map(|(key, _)| key.clone()).collect();
    let mut merged: Vec<(Rc<str>, u32)> = Vec::new();
    for object in objects {
        let object = &mut values[object as usize];
        let Content::Map(entries) = &object.content else {
            return Err(object.line);
        };
        // The last value of a key is used.
        for (key, value) in entries.iter().rev() {
            if seen.insert(key.clone()) {
                merged.push((key.clone(), *value));
            }
        }
        object.is_merged = true;
    }
    merged.reverse();
    merged.append(own);
    *own = merged;
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::source::Source;
    use crate::yaml::Yaml;
    use crate::{ReadError, ReadOptions};

    fn json(text: &str) -> Result<String, ReadError> {
        let options = ReadOptions::default();
        let name = "site.yaml";
        let source = Source {
            name,
            options: &options,
        };
        let yaml = Yaml::parse(&source, text)?;
        let root = yaml.root().expect("a value");
        Ok(root.to_json(1 << 20).expect("few values"))
    }

    #[test]
    fn own_entries_win_then_earlier_objects_of_a_list() {
        let merged = |text: &str| {
            let found = json(&format!(
                "- &a {{x: 1, y: 2}}\n- &b {{x: 3, z: 4}}\n- {text}\n"
            ));
            let found = found.unwrap();
            found
                .rsplit_once(",{")
                .unwrap()
                .1
                .trim_end_matches("}]")
                .to_owned()
        };
        assert_eq!(merged("{<<: *a, y: 9}"), r#""x":1,"y":9"#);
        assert_eq!(merged("{y: 9, <<: *a}"), r#""x":1,"y":9"#);
        assert_eq!(merged("{<<: [*a, *b]}"), r#""z":4,"x":1,"y":2"#);
        assert_eq!(merged("{<<: [*b, *a], w: 0}"), r#""y":2,"x":3,"z":4,"w":0"#);
        assert_eq!(merged("{<<: {<<: *b, v: 5}}"), r#""x":3,"z":4,"v":5"#);
        // Only a plain key merges.
        assert_eq!(merged(r#"{"<<": 7}"#), r#""<<":7"#);
        for wrong in ["<<: 1", "<<: [1]", "<<:"] {
            let error = json(&format!("a: 1\n{wrong}\n")).err().unwrap().to_string();
            assert!(error.contains("`<<` merges objects"), "{error}");
        }
    }

    #[test]
    fn merged_entries_are_bounded() {
        // Each object has twice the entries of the one before.
        let mut text = "- &m0 {k0: 0}\n".to_owned();
        for i in 1..40 {
            let last = i - 1;
            text += &format!("- &m{i} {{<<: [*m{last}, {{a{i}: *m{last}}}], k{i}: *m{last}}}\n");
        }
        assert_eq!(json(&text).err().unwrap().code(), "limit");
        let long = "k".repeat(1 << 16);
        let objects = "- {<<: *a}\n".repeat(1 << 14);
        let text = format!("- &a {{\"{long}\": 1}}\n{objects}");
        let options = ReadOptions::default();
        let (name, options) = ("site.yaml", &options);
        assert!(Yaml::parse(&Source { name, options }, &text).is_ok());
    }
}
