//! A set of clusters: those whose members have changed.

/// Cluster numbers, each at most once.
#[derive(Clone, Debug, Default)]
pub struct DirtyClusters {
    /// A bit per cluster.
    words: Vec<u64>,
    len: u32,
}

impl DirtyClusters {
    /// Adds a cluster.
    #[inline]
    pub fn add(&mut self, cluster: usize) {
        let (word, bit) = (cluster / 64, 1 << (cluster % 64));
        if self.words.len() <= word {
            self.words.resize(word + 1, 0);
        }
        self.len += u32::from(self.words[word] & bit == 0);
        self.words[word] |= bit;
    }

    /// Adds all clusters of another set.
    pub fn join(&mut self, other: &Self) {
        if self.words.len() < other.words.len() {
            self.words.resize(other.words.len(), 0);
        }
        for (word, more) in self.words.iter_mut().zip(&other.words) {
            self.len += (more & !*word).count_ones();
            *word |= more;
        }
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
        self.words.iter().enumerate().flat_map(|(number, &word)| {
            let rest = std::iter::successors(Some(word), |rest| Some(rest & rest.wrapping_sub(1)));
            let bits = rest.take_while(|rest| *rest != 0);
            bits.map(move |rest| 64 * number + rest.trailing_zeros() as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_are_counted_once_and_come_ascending() {
        let set = |clusters: &[usize]| {
            let mut dirty = DirtyClusters::default();
            clusters.iter().for_each(|&cluster| dirty.add(cluster));
            dirty
        };
        assert!(set(&[]).is_empty());
        let mut dirty = set(&[7, 2, 7, 140, 63, 64]);
        assert_eq!(dirty.len(), 5);
        assert!(dirty.iter().eq([2, 7, 63, 64, 140]));
        dirty.join(&set(&[7, 0, 200]));
        assert_eq!(dirty.len(), 7);
        assert!(dirty.iter().eq([0, 2, 7, 63, 64, 140, 200]));
        let mut few = set(&[1]);
        few.join(&dirty);
        assert_eq!(few.len(), 8);
    }
}
