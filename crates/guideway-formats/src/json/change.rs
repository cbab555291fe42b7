//! Changes of JSON values: splices a text where two values differ, so that all other bytes stay.
//!
//! The old value is the one that a reader finds in the text, as a writer would write it. A member
//! that the reader does not know is in neither value and stays.

use super::array_splice::{ArrayEdit, ListEdit};
use super::scan::{MemberRange, members, value_end};
use super::splice::Splices;
use super::style::line_indent;
use super::tree::{Members, Tree};

impl Splices<'_> {
    /// Changes the value at byte `at` as the value `old` became `new`.
    pub(crate) fn change(&mut self, at: usize, old: &Tree<'_>, new: &Tree<'_>) {
        if old == new {
            return;
        }
        match (old, new, self.text().as_bytes().get(at)) {
            (Tree::Raw(a), Tree::Raw(b), _) if is_nested(a) && is_nested(b) => {
                self.change(at, &Tree::opened(a), &Tree::opened(b));
            }
            (Tree::Object(old), Tree::Object(new), Some(b'{')) => {
                self.change_members(at, old, new);
            }
            (Tree::Array(old), Tree::Array(new), Some(b'[')) => self.change_items(at, old, new),
            _ => self.replace_value(at, new),
        }
    }

    fn replace_value(&mut self, at: usize, new: &Tree<'_>) {
        let range = at..value_end(self.text(), at);
        let template = &self.text()[range.clone()];
        let template = template.starts_with(['{', '[']).then_some(template);
        let text = self
            .style()
            .render(new, line_indent(self.text(), at), template);
        self.replace(range, text);
    }

    fn change_members(&mut self, at: usize, old: &Members<'_>, new: &Members<'_>) {
        let all = members(self.text(), at);
        let mut edit = ListEdit {
            open: at,
            removed: vec![false; all.len()],
            items: all.iter().map(|m| m.key.start..m.value.end).collect(),
            added: Vec::new(),
        };
        for (key, value) in new {
            let before = value_of(old, key);
            if before == Some(value) {
                continue;
            }
            match (self.find(&all, key), before) {
                (Some(index), Some(before)) => {
                    self.change(all[index].value.start, before, value);
                }
                (Some(index), None) => self.replace_value(all[index].value.start, value),
                (None, _) => {
                    let added = self.render_member(at, &all, key, value);
                    edit.added.push(added);
                }
            }
        }
        for (key, _) in old.iter().filter(|(key, _)| value_of(new, key).is_none()) {
            if let Some(index) = self.find(&all, key) {
                edit.removed[index] = true;
            }
        }
        edit.apply(self);
    }

    fn render_member(&self, at: usize, all: &[MemberRange], key: &str, value: &Tree<'_>) -> String {
        let siblings = &self.text()[at..value_end(self.text(), at)];
        let indent = match all.last() {
            Some(last) => line_indent(self.text(), last.key.start),
            None => line_indent(self.text(), at),
        };
        self.style().render_member(key, value, indent, siblings)
    }

    /// Finds the last member with a key, or with the other name of it.
    fn find(&self, all: &[MemberRange], key: &str) -> Option<usize> {
        let named = |key: &str| all.iter().rposition(|m| m.has_key(self.text(), key));
        named(key).or_else(|| {
            let pair = self.aliases.iter().find(|pair| pair.contains(&key))?;
            pair.iter().find_map(|alias| named(alias))
        })
    }

    fn change_items(&mut self, at: usize, old: &[Tree<'_>], new: &[Tree<'_>]) {
        let mut edit = ArrayEdit::new(self.text(), at);
        if edit.items().len() != old.len() {
            let new = Tree::Array(new.to_vec());
            return self.replace_value(at, &new);
        }
        let same = old.iter().zip(new).take_while(|(a, b)| a == b).count();
        let rest = old.len().min(new.len()) - same;
        let pairs = old.iter().rev().zip(new.iter().rev());
        let same_end = pairs.take(rest).take_while(|(a, b)| a == b).count();
        let (old_end, new_end) = (old.len() - same_end, new.len() - same_end);
        if old_end == new_end {
            for item in same..old_end {
                let at = edit.items()[item].start;
                self.change(at, &old[item], &new[item]);
            }
        } else if same_end == 0 && old_end < new_end {
            for item in same..old_end {
                let at = edit.items()[item].start;
                self.change(at, &old[item], &new[item]);
            }
            new[old_end..]
                .iter()
                .cloned()
                .for_each(|item| edit.push(item));
            edit.apply(self);
        } else if same == new_end {
            (same..old_end).for_each(|item| edit.remove(item));
            edit.apply(self);
        } else {
            self.replace_value(at, &Tree::Array(new.to_vec()));
        }
    }
}

fn is_nested(text: &str) -> bool {
    text.starts_with(['{', '['])
}

fn value_of<'m, 'a>(members: &'m Members<'a>, key: &str) -> Option<&'m Tree<'a>> {
    let mut all = members.iter();
    all.find(|(name, _)| name == key).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the text after a change of its value from `old` to `new`, given as JSON texts.
    fn changed(text: &str, old: &str, new: &str) -> String {
        let mut splices = Splices::new(text, &[["first", "second"]]);
        splices.change(0, &Tree::Raw(old.into()), &Tree::Raw(new.into()));
        let mut out = Vec::new();
        splices.write(&mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn equal_values_change_nothing() {
        let text = "{ \"a\" : 1.0e0 }";
        assert_eq!(changed(text, r#"{"a":1}"#, r#"{"a":1}"#), text);
    }

    #[test]
    fn changes_one_value_and_keeps_the_unknown_ones() {
        let text = "{\n  \"x\": 1.50, \"ours\": [ 1 ],\n  \"at\": { \"y\": 2, \"z\":3 }\n}\n";
        let old = r#"{"x":1.5,"at":{"y":2.0}}"#;
        assert_eq!(
            changed(text, old, r#"{"x":1.5,"at":{"y":7.0}}"#),
            text.replace("\"y\": 2", "\"y\": 7.0")
        );
        assert_eq!(
            changed(text, old, r#"{"x":1.5}"#),
            "{\n  \"x\": 1.50, \"ours\": [ 1 ]\n}\n"
        );
        assert_eq!(
            changed(text, old, r#"{"at":{"y":2.0}}"#),
            "{\n  \"ours\": [ 1 ],\n  \"at\": { \"y\": 2, \"z\":3 }\n}\n"
        );
        assert_eq!(
            changed(text, old, r#"{"x":1.5,"at":{"y":2.0},"new":[1,{"b":2}]}"#),
            "{\n  \"x\": 1.50, \"ours\": [ 1 ],\n  \"at\": { \"y\": 2, \"z\":3 },\n  \
             \"new\": [\n    1,\n    {\n      \"b\": 2\n    }\n  ]\n}\n"
        );
    }

    #[test]
    fn changes_items_of_lists() {
        let text = r#"{"l": [1, 2, 3]}"#;
        let old = r#"{"l":[1,2,3]}"#;
        for (new, expected) in [
            (r#"{"l":[1,9,3]}"#, r#"{"l": [1, 9, 3]}"#),
            (r#"{"l":[1,2,3,4]}"#, r#"{"l": [1, 2, 3, 4]}"#),
            (r#"{"l":[1,2]}"#, r#"{"l": [1, 2]}"#),
            (r#"{"l":[2,3]}"#, r#"{"l": [2, 3]}"#),
            (r#"{"l":[]}"#, r#"{"l": []}"#),
            (r#"{"l":[7,1,2,3,8]}"#, r#"{"l": [7, 1, 2, 3, 8]}"#),
        ] {
            assert_eq!(changed(text, old, new), expected);
        }
        assert_eq!(changed(r#"{"l": []}"#, r#"{"l":[]}"#, old), text);
        let lines = "{\n \"l\": []\n}";
        let added = "{\n \"l\": [\n  1,\n  2,\n  3\n ]\n}";
        assert_eq!(changed(lines, r#"{"l":[]}"#, old), added);
    }

    #[test]
    fn finds_the_other_name_of_a_member() {
        let text = r#"{"second":1,"b":2}"#;
        let old = r#"{"first":1,"b":2}"#;
        let new = r#"{"first":5,"b":2}"#;
        assert_eq!(changed(text, old, new), r#"{"second":5,"b":2}"#);
        assert_eq!(changed(text, old, r#"{"b":2}"#), r#"{"b":2}"#);
    }
}
