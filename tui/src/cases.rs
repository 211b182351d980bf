//! `spherule cases`: cases of the families in which ray-sphere intersection goes wrong, to files or as lines.
//!
//! Case i is of the family i modulo their number, so that the first cases, however few, are spread over the families.
//! Rows are written as they are made: memory does not grow with their number.

use crate::error::stdout::Stdout;
use crate::error::{Error, write_stdout};
use crate::npy::{Output, bytes_of_row};
use crate::whole_file::check_outputs;
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
    /// Where to write rays: .npy, float32, (N, 8): origin xyz, direction xyz, t_min, t_max
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
    let create = |path: Option<&Path>, dtype: &str, shape: &[u64]| {
        path.map(|path| Output::create(path, dtype, shape)).transpose()
    };
    let mut outputs = [
        create(out_spheres.as_deref(), "<f4", &[*count, 4])?,
        create(out_rays.as_deref(), "<f4", &[*count, 8])?,
        create(out_family.as_deref(), "|u1", &[*count])?,
    ];
    for index in 0..*count {
        let (family, case) = case(arguments, &families, index);
        let row = case.numbers();
        let rows = [bytes_of_row(&row[8..]), bytes_of_row(&row[..8]), vec![family.number]];
        for (output, row) in outputs.iter_mut().zip(rows) {
            output.as_mut().map_or(Ok(()), |output| output.write(&row))?;
        }
    }
    // All files are whole before any of them gets its name.
    outputs.iter_mut().flatten().try_for_each(Output::written)?;
    outputs.into_iter().flatten().try_for_each(Output::finish)
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
