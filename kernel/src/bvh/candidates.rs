//! The spheres that may be a ray's nearest, until the tier is asked.

/// How many candidates a ray can keep.
const MOST: usize = 8;

/// Spheres that may be a ray's nearest, by their places in the leaves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidates {
    places: [u32; MOST],
    /// No answer of that candidate is below.
    entries: [f32; MOST],
    count: usize,
}

impl Candidates {
    pub(super) const NONE: Self = Self { places: [0; MOST], entries: [0.0; MOST], count: 0 };

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Whether another has no room, after those were dropped whose entry is past `best`.
    #[inline(always)]
    pub(super) fn is_full(&mut self, best: f32) -> bool {
        if self.count < MOST {
            return false;
        }
        let mut kept = 0;
        for at in 0..MOST {
            if self.entries[at] <= best {
                self.entries[kept] = self.entries[at];
                self.places[kept] = self.places[at];
                kept += 1;
            }
        }
        self.count = kept;
        kept == MOST
    }

    #[inline(always)]
    pub(super) fn push(&mut self, place: u32, entry: f32) {
        if let (Some(to), Some(at)) =
            (self.places.get_mut(self.count), self.entries.get_mut(self.count))
        {
            *to = place;
            *at = entry;
            self.count += 1;
        }
    }

    /// The places of those whose entry is not past `best`.
    #[inline(always)]
    pub(super) fn places(&self, best: f32) -> impl Iterator<Item = u32> {
        let pairs = self.places.iter().zip(&self.entries).take(self.count);
        pairs
            .filter(
                #[inline(always)]
                move |(_, entry)| **entry <= best,
            )
            .map(
                #[inline(always)]
                |(place, _)| *place,
            )
    }
}
