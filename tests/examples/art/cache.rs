//! Results of earlier runs, in files under `target/art`: chafa's pictures, and figures of pictures.

use spherule_tests::art::figures::Figures;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::{env, fs, io};

/// The version of the measures: a change of a measure must change this number.
const JUDGE: u32 = 1;

pub(crate) struct Cache(PathBuf);

impl Cache {
    pub(crate) fn new() -> io::Result<Self> {
        // target/PROFILE/examples/art
        let program = env::current_exe()?;
        let target = program.ancestors().nth(3).ok_or(io::ErrorKind::NotFound)?;
        let path = target.join("art");
        fs::create_dir_all(&path)?;
        Ok(Self(path))
    }

    /// The file for what is made from `key`.
    pub(crate) fn file(&self, key: impl Hash, ending: &str) -> PathBuf {
        let mut hasher = DefaultHasher::new();
        (JUDGE, key).hash(&mut hasher);
        self.0.join(format!("{:016x}.{ending}", hasher.finish()))
    }

    /// The numbers made from `key`, computed once.
    pub(crate) fn numbers<const N: usize>(
        &self,
        key: impl Hash,
        compute: impl FnOnce() -> [f64; N],
    ) -> io::Result<[f64; N]> {
        let file = self.file(key, "txt");
        let known = fs::read_to_string(&file).ok().and_then(|text| {
            let numbers: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
            numbers.ok()?.try_into().ok()
        });
        if let Some(known) = known {
            return Ok(known);
        }
        let numbers = compute();
        fs::write(file, numbers.map(|number| number.to_string()).join(" "))?;
        Ok(numbers)
    }

    /// The figures made from `key`.
    pub(crate) fn figures(
        &self,
        key: impl Hash,
        compute: impl FnOnce() -> Figures,
    ) -> io::Result<Figures> {
        let [flip, ssim, psnr, far, near, correlation] = self.numbers(key, || {
            let Figures { flip, ssim, psnr, far, near, correlation } = compute();
            [flip, ssim, psnr, far, near, correlation]
        })?;
        Ok(Figures { flip, ssim, psnr, far, near, correlation })
    }
}
