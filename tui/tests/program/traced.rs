//! `spherule trace`, run on spheres and rays.

use crate::run::{array, data, file, prints};
use spherule_kernel::{Level, LevelName};

/// What a run of `trace` leaves behind.
#[derive(Clone)]
pub(crate) struct Traced {
    /// The line that it printed.
    pub(crate) text: String,
    /// The bytes of T, none with `--any`, and of I.
    pub(crate) files: [Vec<u8>; 2],
}

/// Runs `trace` with `words`; `name` is that of its files, since tests run side by side.
pub(crate) fn traced(name: &str, spheres: &[f32], rays: &[f32], words: &str) -> Traced {
    let inputs = inputs(name, spheres, rays);
    let [t, id] = ["t", "i"].map(|output| file(&format!("{name}.{output}.npy"), b""));
    let out_t = if words.contains("--any") { String::new() } else { format!("--out-t {t}") };
    let text = prints(&format!("trace {inputs} {out_t} --out-id {id} {words}"));
    Traced { text, files: [t, id].map(|path| std::fs::read(path).expect("an output")) }
}

/// The words that name files of spheres and rays.
pub(crate) fn inputs(name: &str, spheres: &[f32], rays: &[f32]) -> String {
    let spheres = file(&format!("{name}.s.npy"), array(spheres.len() / 4, 4, spheres));
    let rays = file(&format!("{name}.r.npy"), array(rays.len() / 8, 8, rays));
    format!("--spheres {spheres} --rays {rays}")
}

impl Traced {
    /// The value of a key in what was printed.
    pub(crate) fn value(&self, key: &str) -> &str {
        let mut pairs = self.text.split_whitespace();
        pairs.find_map(|pair| pair.strip_prefix(key)?.strip_prefix('=')).expect(key)
    }

    /// The numbers of T, as bits.
    pub(crate) fn t(&self) -> Vec<u32> {
        numbers(&self.files[0]).map(u32::from_le_bytes).collect()
    }

    /// The numbers of I.
    pub(crate) fn id(&self) -> Vec<i32> {
        numbers(&self.files[1]).map(i32::from_le_bytes).collect()
    }
}

/// The 4-byte elements after the header of a file.
fn numbers(bytes: &[u8]) -> impl Iterator<Item = [u8; 4]> {
    data(bytes).as_chunks().0.iter().copied()
}

/// The levels that this CPU has.
pub(crate) fn levels() -> Vec<LevelName> {
    let named = |name: LevelName| Level::named(name).map(Level::name);
    let levels: Vec<_> = LevelName::ALL.into_iter().filter_map(named).collect();
    println!("levels that ran: {levels:?}");
    levels
}
