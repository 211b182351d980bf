//! What an input is, told by its first bytes.

use super::Format;
use super::table::{Separator, comment, has_axes, says_separator};
use super::words::{count, split};
use crate::scene::number::number;

/// The error for an input whose format nothing tells.
pub(in crate::scene) const UNKNOWN: &str = "unknown format";

/// The records that a PDB file begins with.
const PDB: [&str; 24] = [
    "HEADER", "OBSLTE", "TITLE ", "SPLIT ", "CAVEAT", "COMPND", "SOURCE", "KEYWDS", "EXPDTA",
    "NUMMDL", "MDLTYP", "AUTHOR", "REVDAT", "SPRSDE", "JRNL  ", "REMARK", "DBREF ", "SEQRES",
    "CRYST1", "ORIGX1", "MODEL ", "ATOM  ", "HETATM", "MASTER",
];

/// The records in which a number may follow the name at once: `HETATM10000`, `CRYST110000.000`, `DBREF1`.
const THEN_NUMBER: [&str; 3] = ["HETATM", "CRYST1", "DBREF "];

/// Formats that are known and not read, by what they may begin with.
const OTHERS: [(&[&[u8]], &str); 11] = [
    (&[b"PK\x03\x04"], "a zip archive, such as .npz: unpack it first"),
    (&[b"\x89HDF"], "HDF5, which is not read"),
    (&[b"CDF\x01", b"CDF\x02", b"CDF\x05"], "NetCDF, which is not read"),
    (&[b"\x00\x00\x07\xc9"], "a TRR trajectory, which is not read; .xtc is"),
    // Fortran writes the length of a record before it, in four bytes or eight of either order.
    (
        &[
            b"\x54\x00\x00\x00CORD",
            b"\x00\x00\x00\x54CORD",
            b"\x54\x00\x00\x00\x00\x00\x00\x00CORD",
            b"\x00\x00\x00\x00\x00\x00\x00\x54CORD",
        ],
        "a DCD trajectory, which is not read; .xtc is",
    ),
    (&[b"7z\xbc\xaf"], "a 7z archive: unpack it first"),
    (&[b"\xfd7zXZ"], "xz, which is not read; .gz and .bz2 are"),
    (&[b"\x28\xb5\x2f\xfd"], "zstd, which is not read; .gz and .bz2 are"),
    (&[b"\x1f\x9d"], "a .Z file, which is not read; .gz and .bz2 are"),
    (&[b"LASF"], "LAS, which is not read"),
    (&[b"\xff\xfe", b"\xfe\xff"], "UTF-16 text; save it as UTF-8"),
];

/// The format of what begins with `head`.
///
/// # Errors
/// Says what it is instead, as far as that can be told.
pub(in super::super) fn recognise(head: &[u8]) -> Result<Format, &'static str> {
    if head.starts_with(b"\x93NUMPY") {
        return Ok(Format::Npy);
    }
    if is_xtc(head) {
        return Ok(Format::Xtc);
    }
    let begins = |magics: &[&[u8]]| magics.iter().any(|magic| head.starts_with(magic));
    if let Some((_, what)) = OTHERS.iter().find(|(magics, _)| begins(magics)) {
        return Err(what);
    }
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let lines: Vec<&[u8]> =
        head.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii_end).take(400).collect();
    let first = lines[0].trim_ascii();
    if first == b"ply" {
        return Ok(Format::Ply);
    }
    if says_separator(first) {
        return Ok(Format::Csv);
    }
    if first.starts_with(b"ITEM: ") {
        return Ok(Format::LammpsDump);
    }
    let digits = first.strip_prefix(b"-").unwrap_or(first);
    if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) {
        return Ok(Format::Xyz);
    }
    // Below a header that is a comment there may be the number of rows.
    let is_header =
        first.starts_with(b"//") && comment(first).is_some_and(|names| has_axes(&fields(names).1));
    if !is_header && is_gro(&lines) {
        return Ok(Format::Gro);
    }
    if head.trim_ascii_start().starts_with(b"<") {
        let is_robot = memchr::memmem::find(head, b"<robot").is_some();
        return if is_robot { Ok(Format::Urdf) } else { Err("XML, but no <robot>") };
    }
    let mut spoken =
        lines.iter().filter(|line| !matches!(line.trim_ascii().first(), None | Some(b'#')));
    let spoken_first = spoken.next().copied().unwrap_or_default();
    let is_cif = |line: &[u8]| line.len() >= 5 && line[..5].eq_ignore_ascii_case(b"data_");
    if is_cif(spoken_first.trim_ascii()) {
        return Ok(Format::Mmcif);
    }
    let is_atom = |line: &&[u8]| {
        (line.starts_with(b"ATOM  ") || line.starts_with(b"HETATM"))
            && line.len() >= 54
            && line[34] == b'.'
    };
    if is_record(spoken_first) && !is_toml(spoken_first) || lines.iter().any(is_atom) {
        return Ok(Format::Pdb);
    }
    if is_lammps_data(&lines) {
        return Ok(Format::LammpsData);
    }
    if is_toml(spoken_first) {
        return Ok(Format::Toml);
    }
    if is_mercury(&lines) {
        return Ok(Format::Mercury);
    }
    if is_table(&lines) {
        return Ok(Format::Csv);
    }
    Err(UNKNOWN)
}

/// The format of what begins with `head`, if it has frames and nothing that follows can change it: then the first frame may be shown
/// before more has come.
pub(in super::super) fn settled(head: &[u8]) -> Option<Format> {
    /// GRO is told by its third line.
    const TELLING: usize = 3;
    if is_xtc(head) {
        return Some(Format::Xtc);
    }
    // The last line may go on.
    let whole = memchr::memrchr(b'\n', head)?;
    if memchr::memchr_iter(b'\n', head).count() < TELLING {
        return None;
    }
    recognise(&head[..whole]).ok().filter(|format| format.has_frames())
}

fn is_xtc(head: &[u8]) -> bool {
    head.starts_with(b"\x00\x00\x07\xcb") || head.starts_with(b"\x00\x00\x07\xe7")
}

/// A record that a PDB file begins with. Its name ends there: a column of a table may be called `SOURCE_ID`.
fn is_record(line: &[u8]) -> bool {
    PDB.iter().any(|name| {
        let Some(rest) = line.strip_prefix(name.trim_end().as_bytes()) else { return false };
        rest.first().is_none_or(|byte| {
            byte.is_ascii_whitespace() || byte.is_ascii_digit() && THEN_NUMBER.contains(name)
        })
    })
}

/// A table, or a key and its value.
fn is_toml(line: &[u8]) -> bool {
    let line = line.trim_ascii();
    let key = line
        .iter()
        .take_while(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.'))
        .count();
    line.starts_with(b"[") || key > 0 && line[key..].trim_ascii_start().starts_with(b"=")
}

/// The second line is a number; the third has names in its first columns and points behind them.
fn is_gro(lines: &[&[u8]]) -> bool {
    let [_, atoms, atom, ..] = lines else { return false };
    count(atoms.trim_ascii()).is_some()
        && atom.len() >= 44
        && atom[20..].iter().filter(|&&byte| byte == b'.').count() >= 3
}

/// A number of atoms in the first lines.
fn is_lammps_data(lines: &[&[u8]]) -> bool {
    let says = |line: &&[u8]| {
        let mut words = split(line.split(|&byte| byte == b'#').next().unwrap_or_default());
        words.next().and_then(count).is_some() && words.eq([b"atoms"])
    };
    lines.iter().take(40).any(says)
}

/// The fields of a text, and what separates them.
fn fields(text: &[u8]) -> (Separator, Vec<&[u8]>) {
    let (separator, mut fields) = (Separator::of(text), Vec::new());
    separator.split(text, 1 << 10, &mut fields);
    (separator, fields.into_iter().map(|field| &text[field]).collect())
}

/// A number of particles, a time and a box, and below them the values of a particle, which are more. (A frame may have no particles:
/// then another follows.)
fn is_mercury(lines: &[&[u8]]) -> bool {
    let mut head = None;
    for line in lines.iter().map(|line| line.trim_ascii()).filter(|line| !line.is_empty()) {
        let (separator, words) = fields(line);
        if separator != Separator::Space || words.iter().any(|word| number(word).is_none()) {
            return false;
        }
        match (head, words.len()) {
            (None, values @ (6 | 8)) => match count(words[0]) {
                Some(0) => {}
                Some(_) => head = Some(values),
                None => return false,
            },
            (head, values) => return matches!((head, values), (Some(6), 8) | (Some(8), 14 | 15)),
        }
    }
    false
}

/// A header that names positions, or three numbers or more.
fn is_table(lines: &[&[u8]]) -> bool {
    for line in lines.iter().filter(|line| !line.trim_ascii().is_empty()) {
        let comment = comment(line);
        let (separator, words) = fields(comment.unwrap_or(line.trim_ascii()));
        if has_axes(&words) {
            return true;
        }
        if comment.is_some() {
            continue;
        }
        let is_separated = separator != Separator::Space;
        return words.len() >= 3
            && (is_separated && words.iter().all(|word| word.len() < 256)
                || words.iter().take(3).all(|word| number(word).is_some()));
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_that_begins_like_a_record_is_a_table() {
        for header in
            ["SOURCE_ID,x,y,z", "ATOM,X,Y,Z", "HETATM;x;y;z", "MODEL,x,y,z", "ATOM1,x,y,z"]
        {
            assert_eq!(recognise(format!("{header}\n7,1,2,3\n").as_bytes()), Ok(Format::Csv));
        }
    }

    #[test]
    fn a_title_of_gro_may_begin_with_slashes() {
        let rest = "    1\n    1SOL     OW    1   0.126   1.624   1.679\n   1 1 1\n";
        for (first, format) in [("// water", Format::Gro), ("//X Y Z", Format::Csv)] {
            assert_eq!(recognise(format!("{first}\n{rest}").as_bytes()), Ok(format), "{first}");
        }
    }

    /// However little of it has come.
    #[test]
    fn what_is_settled_stays() {
        let atom = "ATOM      1  N   ALA A   1      11.104   6.134  -6.504\n";
        for text in [
            "3\nwater\nO 0 0 0\n",
            "13\r\nwater\r\nO 0 0 0\r\n",
            "t\n 1\n    1SOL     OW    1   0.126   1.624   1.679\n",
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n",
            "# a\n\n# b\n\ndata_x\nloop_\n",
            "# a\n\n# b\n\nx = 1\n",
            format!("REMARK\n\n{atom}").as_str(),
            format!("no\nrecord\nhere\n{atom}").as_str(),
            "0 0 0 0 5 5\n2 0 0 0 5 5\n0 0 0 0 1 0 0 0\n",
            "0 0 0 0 5 5\n2 0 0 0 5 5\n0 0 0 0 1 0\n",
            "LAMMPS data\n\n\n3 atoms\n",
            "1 2 3\n4 5 6\n7 8 9\n10 atoms\n",
            "a,b,c\n1,2,3\n4,5,6\n",
        ] {
            let whole = recognise(text.as_bytes()).ok().filter(|format| format.has_frames());
            assert_eq!(settled(text.as_bytes()), whole, "{text}");
            for end in 0..text.len() {
                let settled = settled(&text.as_bytes()[..end]);
                assert!(settled.is_none() || settled == whole, "{settled:?} after {end}: {text}");
            }
        }
        assert_eq!(settled(b"\x00\x00\x07\xcb"), Some(Format::Xtc));
    }

    #[test]
    fn records_are_six_columns_wide() {
        for record in [
            "TITLE     A TITLE",
            "REMARK   2",
            "MODEL        1",
            "ATOM   1000  N   ALA A   1       1.1     6.1    -6.5",
            "ATOM  100000 N   ALA A   1       1.1     6.1    -6.5",
            "ATOM 1000000 N   ALA A   1       1.1     6.1    -6.5",
            "HETATM12345  O   HOH A   1       1.1     6.1    -6.5",
            "HETATMA0000  O   HOH A   1      11.104   6.134  -6.504",
            "CRYST110000.00010000.00010000.000  90.00  90.00  90.00 P 1",
            "DBREF1 1ABC A    1   100  UNP",
            "HEADER",
        ] {
            assert_eq!(recognise(record.as_bytes()), Ok(Format::Pdb), "{record}");
        }
    }
}
