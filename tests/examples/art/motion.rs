//! Pictures in motion: an orbit, and the error of how they change.

use super::cache::Cache;
use super::chafa::Chafa;
use super::modes::Mode;
use super::still::shown;
use super::subject::Subject;
use spherule::view::{View, orbited};
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::motion::{self, Changes};
use std::error::Error;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Frames, and the angle from one to the next in degrees.
pub(crate) const FRAMES: u16 = 12;
pub(crate) const STEP: f32 = 0.4;

/// What a mode reaches in a scene and a font.
#[derive(Clone, Copy)]
pub(crate) struct Unrest {
    pub(crate) ours: motion::Unrest,
    /// The best of each figure, with dither or without.
    pub(crate) chafa: Option<motion::Unrest>,
}

impl fmt::Display for Unrest {
    /// In thousandths, ours / chafa's: as an eye sees it, then pixel by pixel.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pair = |figure: fn(&motion::Unrest) -> f64| {
            let thousandths = |unrest: &motion::Unrest| format!("{:.1}", 1000.0 * figure(unrest));
            let chafa = self.chafa.as_ref().map(|chafa| format!(" / {}", thousandths(chafa)));
            thousandths(&self.ours) + &chafa.unwrap_or_default()
        };
        write!(formatter, "{} ({})", pair(|unrest| unrest.seen), pair(|unrest| unrest.plain))
    }
}

/// A scene that turns, in pixels.
pub(crate) struct Orbit<'a> {
    subject: &'a Subject,
    views: Vec<View>,
    truths: Vec<Light>,
    /// A number for all of these.
    key: u64,
    changes: Option<Changes>,
    cache: &'a Cache,
    chafa: Option<&'a Chafa>,
}

impl<'a> Orbit<'a> {
    pub(crate) fn new(
        subject: &'a Subject,
        cache: &'a Cache,
        chafa: Option<&'a Chafa>,
    ) -> Result<Self, Box<dyn Error>> {
        let view = |frame| orbited(&subject.home, f32::from(frame) * STEP.to_radians(), 0.0);
        let views: Vec<View> = (0..FRAMES).map(view).collect();
        let truths = views.iter().map(|view| subject.truth(view)).collect::<Result<Vec<_>, _>>()?;
        let key = key(&truths);
        Ok(Self { subject, views, truths, key, changes: None, cache, chafa })
    }

    /// Draws the frames and scores them in the mode's fonts.
    pub(crate) fn unrest(
        &mut self,
        mode: &Mode,
        fonts: &[Font],
    ) -> Result<Vec<Unrest>, Box<dyn Error>> {
        let ours = self.subject.pictures(&mode.style(), &self.views)?;
        // One row of frames for each dither.
        let mut chafas: Vec<Vec<Vec<u8>>> = Vec::new();
        if let Some(chafa) = self.chafa {
            for truth in &self.truths {
                let pictures = chafa.pictures(self.cache, truth, mode)?;
                chafas.resize(pictures.len(), Vec::new());
                chafas.iter_mut().zip(pictures).for_each(|(row, picture)| row.push(picture));
            }
        }
        let mut all = Vec::new();
        for &font in fonts {
            let ours = self.of(&ours, font)?;
            let mut chafa: Option<motion::Unrest> = None;
            for frames in &chafas {
                let next = self.of(frames, font)?;
                chafa = Some(chafa.map_or(next, |best| motion::Unrest {
                    seen: best.seen.min(next.seen),
                    plain: best.plain.min(next.plain),
                }));
            }
            all.push(Unrest { ours, chafa });
        }
        Ok(all)
    }

    fn of(&mut self, frames: &[Vec<u8>], font: Font) -> Result<motion::Unrest, Box<dyn Error>> {
        let lights =
            frames.iter().map(|bytes| shown(bytes, font)).collect::<Result<Vec<_>, _>>()?;
        let truths = &self.truths;
        let truth = &mut self.changes;
        let [seen, plain] = self.cache.numbers(("motion", self.key, key(&lights)), || {
            let truth = truth.get_or_insert_with(|| Changes::new(truths));
            let motion::Unrest { seen, plain } = Changes::new(&lights).unrest(truth);
            [seen, plain]
        })?;
        Ok(motion::Unrest { seen, plain })
    }
}

/// A number for pictures.
fn key(pictures: &[Light]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for picture in pictures {
        for channel in picture.pixels.as_flattened() {
            channel.to_bits().hash(&mut hasher);
        }
    }
    hasher.finish()
}
