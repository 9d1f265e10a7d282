//! Concatenated lists of numbers, one list for each key.

use std::ops::Range;

/// A list of numbers for each key `0 .. n`, in the order in which they were given; built by
/// counting sort.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    offsets: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Builds the lists of `keys` keys from (key, number) pairs.
    pub fn new(keys: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut offsets = vec![0u32; keys + 1];
        pairs.clone().for_each(|(key, _)| offsets[key as usize + 1] += 1);
        for key in 0..keys {
            offsets[key + 1] += offsets[key];
        }
        let mut next = offsets.clone();
        let mut items = vec![0; offsets[keys] as usize];
        for (key, item) in pairs {
            items[next[key as usize] as usize] = item;
            next[key as usize] += 1;
        }
        Lists { offsets, items }
    }

    /// Number of keys.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there is no key.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The list of a key.
    pub fn of(&self, key: u32) -> &[u32] {
        &self.items[self.range(key)]
    }

    /// The range of a key's list in [`Lists::items`].
    pub fn range(&self, key: u32) -> Range<usize> {
        self.offsets[key as usize] as usize..self.offsets[key as usize + 1] as usize
    }

    /// All lists, concatenated.
    pub fn items(&self) -> &[u32] {
        &self.items
    }
}
