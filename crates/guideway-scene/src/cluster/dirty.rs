//! A set of clusters: those whose members have changed.

/// Cluster numbers, each at most once.
#[derive(Clone, Debug, Default)]
pub struct DirtyClusters {
    is_dirty: Vec<bool>,
    len: u32,
}

impl DirtyClusters {
    /// Adds a cluster.
    pub fn add(&mut self, cluster: usize) {
        if self.is_dirty.len() <= cluster {
            self.is_dirty.resize(cluster + 1, false);
        }
        self.len += u32::from(!self.is_dirty[cluster]);
        self.is_dirty[cluster] = true;
    }

    /// Number of clusters in the set.
    pub fn len(&self) -> u32 {
        self.len
    }

    /// Returns `true` if the set is empty.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The clusters, ascending.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        let all = self.is_dirty.iter().enumerate();
        all.filter_map(|(cluster, &is_dirty)| is_dirty.then_some(cluster))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_are_counted_once_and_come_ascending() {
        let mut dirty = DirtyClusters::default();
        assert!(dirty.is_empty());
        [7, 2, 7, 40]
            .into_iter()
            .for_each(|cluster| dirty.add(cluster));
        assert_eq!(dirty.len(), 3);
        assert!(dirty.iter().eq([2, 7, 40]));
    }
}
