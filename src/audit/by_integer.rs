//! Things by integers that lie close together, found without a search.

/// Things by integers.
#[derive(Clone, Debug)]
pub(super) struct ByInteger<T> {
    first: u32,
    /// From the first integer on: one more than the place among the things, 0 where there is none.
    places: Vec<u16>,
    things: Vec<T>,
}

impl<T> Default for ByInteger<T> {
    fn default() -> ByInteger<T> {
        ByInteger {
            first: 0,
            places: Vec::new(),
            things: Vec::new(),
        }
    }
}

impl<T> ByInteger<T> {
    fn place(&self, k: u32) -> Option<usize> {
        let at = k.wrapping_sub(self.first) as usize;
        usize::from(*self.places.get(at)?).checked_sub(1)
    }

    /// That of an integer, made if there is none.
    pub(super) fn or_insert_with(&mut self, k: u32, make: impl FnOnce() -> T) -> &mut T {
        let place = self.place(k).unwrap_or_else(|| self.insert(k, make()));
        &mut self.things[place]
    }

    #[cold]
    fn insert(&mut self, k: u32, thing: T) -> usize {
        if self.places.is_empty() {
            self.first = k;
        }
        let before = self.first.saturating_sub(k);
        self.places
            .splice(..0, std::iter::repeat_n(0, before as usize));
        self.first -= before;
        let at = (k - self.first) as usize;
        self.places.resize(self.places.len().max(at + 1), 0);
        self.things.push(thing);
        self.places[at] = self.things.len() as u16;
        self.things.len() - 1
    }

    pub(super) fn get(&self, k: u32) -> Option<&T> {
        Some(&self.things[self.place(k)?])
    }

    pub(super) fn get_mut(&mut self, k: u32) -> Option<&mut T> {
        let place = self.place(k)?;
        Some(&mut self.things[place])
    }

    /// In rising order.
    pub(super) fn iter(&self) -> impl Iterator<Item = (u32, &T)> {
        let places = (self.first..).zip(&self.places);
        places.filter_map(|(k, place)| Some((k, &self.things[usize::from(*place).checked_sub(1)?])))
    }
}

impl<T: PartialEq> PartialEq for ByInteger<T> {
    fn eq(&self, other: &ByInteger<T>) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: Eq> Eq for ByInteger<T> {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    proptest! {
        /// As a map that is searched.
        #[test]
        fn things_are_found_again(all in prop::collection::vec((0u32..80, any::<u8>()), 0..60), at: u32) {
            let (mut some, mut expected) = (ByInteger::default(), BTreeMap::new());
            for (k, thing) in all {
                prop_assert_eq!(*some.or_insert_with(k, || thing), *expected.entry(k).or_insert(thing));
                *some.get_mut(k).unwrap() ^= 1;
                *expected.get_mut(&k).unwrap() ^= 1;
            }
            prop_assert!(some.iter().eq(expected.iter().map(|(k, thing)| (*k, thing))));
            prop_assert_eq!(some.get(at), expected.get(&at));
            prop_assert_eq!(some.get_mut(at).is_some(), expected.contains_key(&at));
            let mut again = ByInteger::default();
            for (k, thing) in expected.iter().rev() {
                prop_assert!(again != some);
                again.or_insert_with(*k, || *thing);
            }
            prop_assert_eq!(again, some);
        }
    }
}
