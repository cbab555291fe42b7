/// Where one has been, to go back and forth between: at most [`ViewHistory::MOST`] places.
#[derive(Clone, Debug)]
pub struct ViewHistory<T> {
    places: Vec<T>,
    at: usize,
}

impl<T: Clone + PartialEq> ViewHistory<T> {
    /// Places kept; older ones are forgotten.
    pub const MOST: usize = 200;

    /// A trail that begins here.
    pub fn new(place: T) -> Self {
        Self {
            places: vec![place],
            at: 0,
        }
    }

    /// Comes to a place; what lay ahead is forgotten. Staying is no move.
    pub fn go(&mut self, place: T) {
        if self.places[self.at] == place {
            return;
        }
        self.places.truncate(self.at + 1);
        self.places.push(place);
        if self.places.len() > Self::MOST {
            self.places.remove(0);
        }
        self.at = self.places.len() - 1;
    }

    /// One step back, if there is one.
    pub fn back(&mut self) -> Option<T> {
        self.at = self.at.checked_sub(1)?;
        Some(self.places[self.at].clone())
    }

    /// One step forward again, if there is one.
    pub fn forward(&mut self) -> Option<T> {
        let place = self.places.get(self.at + 1)?;
        self.at += 1;
        Some(place.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn back_and_forward_follow_the_way() {
        let mut trail = ViewHistory::new(0);
        trail.go(1);
        trail.go(1);
        trail.go(2);
        assert_eq!(trail.back(), Some(1));
        assert_eq!(trail.back(), Some(0));
        assert_eq!(trail.back(), None);
        assert_eq!(trail.forward(), Some(1));
        trail.go(3);
        assert_eq!(trail.forward(), None);
        assert_eq!(trail.back(), Some(1));
    }

    #[test]
    fn an_endless_way_takes_no_endless_memory() {
        let mut trail = ViewHistory::new(0);
        (1..10_000).for_each(|place| trail.go(place));
        let steps = std::iter::from_fn(|| trail.back()).count();
        assert_eq!(steps, ViewHistory::<i32>::MOST - 1);
    }
}
