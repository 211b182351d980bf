//! `spherule cases`: cases of the families in which ray-sphere intersection goes wrong, to files or as lines.
//!
//! Case i is of the family i modulo their number, so that the first cases, however few, are spread over the families.
//! Rows are written as they are made: memory does not grow with their number.

use crate::error::stdout::Stdout;
use crate::error::{Error, write_stdout};
use crate::whole_file::{WholeFile, check_outputs};
use clap::{ArgGroup, Args, value_parser};
use spherule_kernel::Tier;
use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_referee::case::Case;
use spherule_referee::families::{FAMILIES, Family, SEED};
use spherule_referee::intersector::{Intersector, Kernel};
use spherule_referee::snippet::hex;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Cases, and where they go.
#[derive(Args, Clone, Debug)]
#[command(group(ArgGroup::new("written").args(["out_spheres", "out_rays", "out_family", "json"]).multiple(true)))]
pub struct CasesArguments {
    /// Families, with commas between them [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = family)]
    pub family: Vec<Family>,
    /// How many cases, of all families together and in turns
    #[arg(
        long,
        value_name = "N",
        default_value = "24000",
        requires = "written",
        allow_negative_numbers = true
    )]
    pub count: u64,
    /// Their seed
    #[arg(long, value_name = "N", default_value_t = SEED, requires = "written", allow_negative_numbers = true)]
    pub seed: u32,
    /// Bring directions to unit length, as near as float32 does
    #[arg(long, requires = "written")]
    pub unit: bool,
    /// Where to write spheres: .npy, float32, (N, 4): centre xyz, radius
    #[arg(long, value_name = "S.npy")]
    pub out_spheres: Option<PathBuf>,
    /// Where to write rays: .npy, float32, (N, 8): origin xyz, direction xyz, `t_min`, `t_max`
    #[arg(long, value_name = "R.npy")]
    pub out_rays: Option<PathBuf>,
    /// Where to write the numbers of families: .npy, uint8, (N,)
    #[arg(long, value_name = "F.npy")]
    pub out_family: Option<PathBuf>,
    /// Write each case as a line of JSON, numbers as hexadecimal floats, with the true t, instead of files
    #[arg(long, value_parser = value_parser!(bool), conflicts_with_all = ["out_spheres", "out_rays", "out_family"])]
    pub json: bool,
}

fn family(name: &str) -> Result<Family, String> {
    let names = || FAMILIES.map(|family| family.name).join(", ");
    Family::named(name).ok_or_else(|| format!("one of {}", names()))
}

/// Writes the cases that `arguments` ask for; without files and `--json`, a line for every family.
///
/// # Errors
/// [`Error::Input`] if two outputs are one, [`Error::Running`] if an output cannot be written; then none of the files exists.
pub fn cases(arguments: &CasesArguments) -> Result<(), Error> {
    let all = || FAMILIES.to_vec();
    let families = if arguments.family.is_empty() { all() } else { arguments.family.clone() };
    if arguments.json {
        return write_lines(arguments, &families);
    }
    let CasesArguments { out_spheres, out_rays, out_family, count, .. } = arguments;
    if out_spheres.is_none() && out_rays.is_none() && out_family.is_none() {
        return write_stdout(list(&families).as_bytes());
    }
    let outputs =
        [("--out-spheres", out_spheres), ("--out-rays", out_rays), ("--out-family", out_family)];
    let outputs: Vec<(&str, &Path)> =
        outputs.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?))).collect();
    check_outputs(&outputs, &[])?;
    let mut spheres = Output::create(out_spheres.as_deref(), "<f4", (*count, Some(4)))?;
    let mut rays = Output::create(out_rays.as_deref(), "<f4", (*count, Some(8)))?;
    let mut numbers = Output::create(out_family.as_deref(), "|u1", (*count, None))?;
    for index in 0..*count {
        let (family, case) = case(arguments, &families, index);
        let row = case.numbers();
        spheres.write(|| bytes_of_row(&row[8..]))?;
        rays.write(|| bytes_of_row(&row[..8]))?;
        numbers.write(|| vec![family.number])?;
    }
    // All files are whole before any of them gets its name.
    let mut outputs = [spheres, rays, numbers];
    outputs.iter_mut().try_for_each(Output::written)?;
    outputs.into_iter().try_for_each(Output::finish)
}

/// Case `index`, and its family.
fn case(arguments: &CasesArguments, families: &[Family], index: u64) -> (Family, Case) {
    let count = families.len() as u64;
    let family = families[(index % count) as usize];
    let (seed, index) = (arguments.seed, index / count);
    let case =
        if arguments.unit { family.seeded_unit(seed, index) } else { family.seeded(seed, index) };
    (family, case)
}

/// A row of an array.
pub(crate) fn bytes_of_row(row: &[f32]) -> Vec<u8> {
    row.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A line a family.
fn list(families: &[Family]) -> String {
    let line =
        |family: &Family| format!("{:2} {:20} {}\n", family.number, family.name, family.attacks);
    families.iter().map(line).collect()
}

/// A JSON object a line.
fn write_lines(arguments: &CasesArguments, families: &[Family]) -> Result<(), Error> {
    let mut stdout = BufWriter::new(Stdout);
    let failed = |error: io::Error| Error::of_output("standard output", &error);
    let mut exact = Kernel(Tier::Exact);
    for index in 0..arguments.count {
        let (family, case) = case(arguments, families, index);
        let t = exact.pairs(&[case.sphere], &[case.ray])[0].map(|answer| answer.t as f32);
        stdout
            .write_all(line(family, index / families.len() as u64, &case, t).as_bytes())
            .map_err(failed)?;
    }
    stdout.flush().map_err(failed)
}

fn line(family: Family, index: u64, case: &Case, t: Option<f32>) -> String {
    let Case { ray: Ray { origin, direction, t_min, t_max }, sphere: Sphere { center, radius } } =
        case;
    let number = |x: f32| format!("\"{}\"", hex(x));
    let point = |v: Vec3| format!("[{}]", v.to_array().map(number).join(","));
    let t = t.map_or_else(|| "null".to_owned(), number);
    let mut line = format!("{{\"family\":\"{}\",\"index\":{index},", family.name);
    let _ = writeln!(
        line,
        "\"origin\":{},\"direction\":{},\"t_min\":{},\"t_max\":{},\"center\":{},\"radius\":{},\"t\":{t}}}",
        point(*origin),
        point(*direction),
        number(*t_min),
        number(*t_max),
        point(*center),
        number(*radius),
    );
    line
}

/// An array that is being written, if it is asked for.
struct Output(Option<(String, BufWriter<WholeFile>)>);

impl Output {
    fn create(
        path: Option<&Path>,
        dtype: &str,
        (rows, columns): (u64, Option<u64>),
    ) -> Result<Self, Error> {
        let Some(path) = path else { return Ok(Self(None)) };
        let name = path.display().to_string();
        let failed = |error: io::Error| Error::of_output(&name, &error);
        let mut file = BufWriter::new(WholeFile::create(path).map_err(failed)?);
        let shape =
            columns.map_or_else(|| format!("({rows},)"), |columns| format!("({rows}, {columns})"));
        file.write_all(&header(dtype, &shape)).map_err(failed)?;
        Ok(Self(Some((name, file))))
    }

    fn write(&mut self, bytes: impl FnOnce() -> Vec<u8>) -> Result<(), Error> {
        let Some((name, file)) = &mut self.0 else { return Ok(()) };
        file.write_all(&bytes()).map_err(|error| Error::of_output(name, &error))
    }

    /// Sees to it that all of the array is on the disk.
    fn written(&mut self) -> Result<(), Error> {
        let Some((name, file)) = &mut self.0 else { return Ok(()) };
        let written = file.flush().and_then(|()| file.get_ref().written());
        written.map_err(|error| Error::of_output(name, &error))
    }

    /// Gives the file its name.
    fn finish(self) -> Result<(), Error> {
        let Some((name, file)) = self.0 else { return Ok(()) };
        let failed = |error: io::Error| Error::of_output(&name, &error);
        let file = file.into_inner().map_err(|error| failed(error.into_error()))?;
        file.finish().map_err(failed)
    }
}

/// What a `.npy` file begins with: version 1, its data at a multiple of 64 bytes.
pub(crate) fn header(dtype: &str, shape: &str) -> Vec<u8> {
    let text = format!("{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}");
    let padding = 63 - (10 + text.len()) % 64;
    let text = text + &" ".repeat(padding) + "\n";
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}
