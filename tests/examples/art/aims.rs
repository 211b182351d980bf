//! Which aims a picture reaches, and which it misses.

use super::modes::Mode;
use super::still::Score;
use spherule_tests::art::figures::Figures;

/// Which aims one mode reaches in one scene and font.
pub(crate) struct Reached {
    pub(crate) flip: bool,
    pub(crate) ssim: bool,
    pub(crate) far: bool,
}

impl Reached {
    /// `least` is the floor of the figure from across the room.
    pub(crate) fn new(mode: &Mode, least: Option<f64>, score: &Score) -> Self {
        let Score { ours, chafa } = score;
        let beats = |is_no_worse: &dyn Fn(&Figures) -> bool| chafa.as_ref().is_none_or(is_no_worse);
        let above_floor = least.is_none_or(|least| ours.far >= least);
        Self {
            flip: beats(&|chafa| ours.flip <= mode.most_flip * chafa.flip),
            ssim: !mode.has_colors() || beats(&|chafa| ours.ssim >= chafa.ssim),
            far: above_floor && beats(&|chafa| ours.far > chafa.far),
        }
    }

    /// A star if an aim is missed.
    pub(crate) fn mark(is_reached: bool) -> &'static str {
        if is_reached { "" } else { " *" }
    }
}
