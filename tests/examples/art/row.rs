//! A line of a table: a mode in a font, and which aims it reaches.

use super::modes::Mode;
use super::motion::Unrest;
use super::still::Score;
use spherule_tests::art::figures::Figures;
use spherule_tests::art::font::Font;

pub(crate) struct Row {
    pub(crate) mode: Mode,
    pub(crate) font: Font,
    /// The score in each scene, by the scene's place among all.
    pub(crate) scores: Vec<(usize, Score)>,
    /// The error of changes in motion, likewise.
    pub(crate) unrest: Vec<(usize, Unrest)>,
}

impl Row {
    /// The mode, and its font if it has letters.
    pub(crate) fn name(&self) -> String {
        match self.mode.is_text {
            true => format!("{} {}", self.mode.name, self.font.word()),
            false => self.mode.name.to_owned(),
        }
    }

    pub(crate) fn reached(&self, scene: usize, score: &Score) -> Reached {
        let (Score { ours, chafa }, mode) = (score, &self.mode);
        let beats = |is_no_worse: &dyn Fn(&Figures) -> bool| chafa.as_ref().is_none_or(is_no_worse);
        let above_floor = self.least(scene).is_none_or(|least| ours.far >= least);
        Reached {
            flip: beats(&|chafa| ours.flip <= mode.most_flip * chafa.flip),
            ssim: !mode.has_colors() || beats(&|chafa| ours.ssim >= chafa.ssim),
            far: above_floor && beats(&|chafa| ours.far > chafa.far),
        }
    }

    /// The floor from across the room, in Unifont, where it was measured.
    pub(crate) fn least(&self, scene: usize) -> Option<f64> {
        (self.font == Font::Unifont).then(|| self.mode.far[scene])
    }

    /// Whether the mode is calm enough in motion.
    pub(crate) fn is_calm(&self, unrest: &Unrest) -> bool {
        let most = self.mode.most_unrest;
        unrest.chafa.is_none_or(|chafa| unrest.ours.seen <= most * chafa.seen)
    }
}

/// Which aims a mode reaches in a scene and font.
pub(crate) struct Reached {
    pub(crate) flip: bool,
    pub(crate) ssim: bool,
    pub(crate) far: bool,
}

impl Reached {
    /// A star if an aim is missed.
    pub(crate) fn mark(is_reached: bool) -> &'static str {
        if is_reached { "" } else { " *" }
    }
}

impl Score {
    /// FLIP as a share of chafa's.
    pub(crate) fn flip_ratio(&self) -> Option<f64> {
        self.chafa.map(|chafa| self.ours.flip / chafa.flip)
    }
}
