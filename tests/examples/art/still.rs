//! Pictures at rest, scored.

use super::cache::Cache;
use super::chafa::Chafa;
use super::image;
use super::modes::Mode;
use super::subject::Subject;
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::{Rgb, xterm};
use spherule_tests::art::screen::Screen;
use std::error::Error;
use std::path::Path;

/// What a mode reaches in a scene and a font.
#[derive(Clone, Copy)]
pub(crate) struct Score {
    pub(crate) ours: Figures,
    /// The best of each figure, with dither or without.
    pub(crate) chafa: Option<Figures>,
}

/// The scene in pixels, and whatever scoring it needs.
pub(crate) struct Judge<'a> {
    subject: &'a Subject,
    light: Light,
    colors: Vec<Rgb>,
    truth: Truth,
    pixels_a_degree: f32,
    cache: &'a Cache,
    chafa: Option<&'a Chafa>,
}

impl<'a> Judge<'a> {
    pub(crate) fn new(
        subject: &'a Subject,
        pixels_a_degree: f32,
        cache: &'a Cache,
        chafa: Option<&'a Chafa>,
    ) -> Result<Self, Box<dyn Error>> {
        let light = subject.truth(&subject.home)?;
        let truth = Truth::seen_at(&light, pixels_a_degree)?;
        let colors = light.colors();
        Ok(Self { subject, light, colors, truth, pixels_a_degree, cache, chafa })
    }

    /// Draws the picture and scores it in the mode's fonts. For the first font, writes it into the folder `sheets`,
    /// between the truth and chafa's picture.
    pub(crate) fn scores(
        &self,
        mode: &Mode,
        fonts: &[Font],
        sheets: Option<&Path>,
    ) -> Result<Vec<Score>, Box<dyn Error>> {
        let ours = self.subject.pictures(&mode.style(), &[self.subject.home])?.remove(0);
        let chafas = match self.chafa {
            Some(chafa) => chafa.pictures(self.cache, &self.light, mode)?,
            None => Vec::new(),
        };
        let mut scores = Vec::new();
        for &font in fonts {
            let ours = shown(&ours, font)?;
            let chafas: Vec<_> =
                chafas.iter().map(|bytes| shown(bytes, font)).collect::<Result<_, _>>()?;
            let mut figures = Vec::new();
            for chafa in &chafas {
                figures.push(self.figures(chafa)?);
            }
            scores.push(Score {
                ours: self.figures(&ours)?,
                chafa: figures.iter().copied().reduce(best),
            });
            if let Some(folder) = sheets {
                let name = format!("{}-{}-{}.png", mode.name, self.subject.name, font.word());
                // Of chafa's pictures the one with the lower FLIP.
                let least =
                    (0..chafas.len()).min_by(|&a, &b| figures[a].flip.total_cmp(&figures[b].flip));
                let chafa = least.map(|index| chafas[index].clone());
                let pictures: Vec<_> =
                    [self.light.clone(), ours].into_iter().chain(chafa).collect();
                image::write_png(&image::beside(&pictures), &folder.join(name))?;
            }
        }
        Ok(scores)
    }

    fn figures(&self, light: &Light) -> Result<Figures, Box<dyn Error>> {
        let bits: Vec<[u32; 3]> =
            light.pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect();
        let key = (&self.colors, bits, self.pixels_a_degree.to_bits());
        Ok(self.cache.figures(key, || self.truth.figures(light))?)
    }
}

/// What a terminal with xterm's colours and this font shows.
pub(crate) fn shown(bytes: &[u8], font: Font) -> Result<Light, Box<dyn Error>> {
    let (columns, rows) = super::modes::SIZE;
    Ok(Light::of_screen(&Screen::read(bytes, columns, rows, &xterm())?, font)?)
}

/// The best of each figure.
fn best(a: Figures, b: Figures) -> Figures {
    Figures {
        flip: a.flip.min(b.flip),
        ssim: a.ssim.max(b.ssim),
        psnr: a.psnr.max(b.psnr),
        far: a.far.max(b.far),
        near: a.near.max(b.near),
        correlation: a.correlation.max(b.correlation),
    }
}
