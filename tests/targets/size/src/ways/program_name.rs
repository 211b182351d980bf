//! The program's name, which says the tier.

pub(super) const NAME: &[u8] = env!("CARGO_BIN_NAME").as_bytes();

/// Whether the program's name ends so.
pub(super) const fn ends_with(end: &str) -> bool {
    let end = end.as_bytes();
    let mut place = 0;
    while place < end.len() {
        if NAME[NAME.len() - 1 - place] != end[end.len() - 1 - place] {
            return false;
        }
        place += 1;
    }
    true
}

/// Does work by the tier of the program's name.
macro_rules! by_tier {
    ($tier:ident => $work:expr) => {
        match NAME[5] {
            b'f' => {
                let $tier = Fast;
                $work
            }
            b'g' => {
                let $tier = Geometric;
                $work
            }
            b's' => {
                let $tier = Stable;
                $work
            }
            _ => {
                let $tier = Exact;
                $work
            }
        }
    };
}

pub(super) use by_tier;
