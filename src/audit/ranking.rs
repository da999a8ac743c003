//! The few that are kept of many, the same whatever the order in which they came.

use std::cmp::Ordering;

/// The first elements of all that were offered, up to a number, in an order that leaves no two of
/// them equal.
#[derive(Clone, Debug)]
pub(super) struct First<T> {
    room: usize,
    kept: Vec<T>,
}

impl<T> First<T> {
    /// Room for that many.
    pub(super) fn new(room: usize) -> First<T> {
        First {
            room,
            kept: Vec::new(),
        }
    }

    /// Those kept of another that has as much room.
    pub(super) fn restore(room: usize, kept: Vec<T>) -> Option<First<T>> {
        (kept.len() <= room).then_some(First { room, kept })
    }

    /// Offers one; `place` compares one that is kept with it. It is made only if it is kept.
    pub(super) fn offer(&mut self, place: impl Fn(&T) -> Ordering, make: impl FnOnce() -> T) {
        // As a rule there is no room.
        let full = self.kept.len() == self.room;
        if full && self.kept.last().is_some_and(|last| place(last).is_le()) {
            return;
        }
        let at = self.kept.partition_point(|kept| place(kept).is_le());
        if at < self.room {
            self.kept.truncate(self.room - 1);
            self.kept.insert(at, make());
        }
    }

    /// The largest number kept.
    pub(super) fn room(&self) -> usize {
        self.room
    }

    /// Those kept, in their order.
    pub(super) fn kept(&self) -> &[T] {
        &self.kept
    }

    /// Adds those of another.
    pub(super) fn merge(&mut self, other: &First<T>, order: impl Fn(&T, &T) -> Ordering)
    where
        T: Clone,
    {
        for item in &other.kept {
            self.offer(|kept| order(kept, item), || item.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn of(values: &[u16], room: usize) -> First<u16> {
        let mut first = First::new(room);
        values
            .iter()
            .for_each(|v| first.offer(|kept: &u16| kept.cmp(v), || *v));
        first
    }

    proptest! {
        #[test]
        fn the_first_of_all(
            values in prop::collection::vec(any::<u16>(), 0..40), cut in 0usize..40, room in 1usize..9,
        ) {
            let mut sorted = values.clone();
            sorted.sort();
            sorted.truncate(room);
            let whole = of(&values, room);
            prop_assert_eq!(whole.kept(), &sorted);
            let (a, b) = values.split_at(cut.min(values.len()));
            for (a, b) in [(a, b), (b, a)] {
                let mut merged = of(a, room);
                merged.merge(&of(b, room), Ord::cmp);
                prop_assert_eq!(merged.kept(), &sorted);
            }
        }
    }

    /// An element after all kept ones is compared with the last of them alone.
    #[test]
    fn without_room_there_is_one_comparison() {
        let mut first = of(&[1, 2, 3, 4, 5, 6, 7, 8], 8);
        let compared = std::cell::Cell::new(0);
        let place = |kept: &u16| {
            compared.set(compared.get() + 1);
            kept.cmp(&9)
        };
        first.offer(place, || unreachable!("there is no room"));
        assert_eq!(compared.get(), 1);
    }
}
