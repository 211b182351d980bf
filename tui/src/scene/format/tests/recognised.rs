use super::*;

fn refused(name: &str, bytes: impl AsRef<[u8]>, reading: &Reading) -> String {
    let path = written(name, bytes);
    open(path.to_str().expect("UTF-8"), reading).expect_err("no format").to_string()
}

/// A name says what unknown content is, but not what known content is not.
#[test]
fn content_that_is_known_is_not_read_as_its_name_says() {
    let files: [(&str, &[u8], &str); 14] = [
        ("sheet.csv", b"PK\x03\x04............", "a zip archive"),
        ("page.pdb", b"<!DOCTYPE html>\n<html></html>\n", "no <robot>"),
        ("powershell.csv", b"\xff\xfex\0,\0y\0,\0z\0\n\0", "UTF-16 text; save it as UTF-8"),
        ("excel.csv", b"\xfe\xff\0x\0,\0y\0,\0z\0\n", "UTF-16 text; save it as UTF-8"),
        ("blank.pdb", b"\n  \n<!DOCTYPE html>\n<html></html>\n", "no <robot>"),
        ("zstd.xyz", b"\x28\xb5\x2f\xfd\x04\0", "zstd, which is not read; .gz and .bz2 are"),
        ("compress.pdb", b"\x1f\x9d\x90\0", "a .Z file, which is not read; .gz and .bz2 are"),
        ("points.csv", b"LASF\0\0\0\0", "LAS, which is not read"),
        ("compressed.csv", b"LASF\x01\0\x11\0", "LAS, which is not read"),
        ("amber.xyz", b"CDF\x01....", "NetCDF"),
        ("little.xtc", b"\x54\0\0\0CORD....", "a DCD trajectory"),
        ("big.xtc", b"\0\0\0\x54CORD....", "a DCD trajectory"),
        ("long.xtc", b"\x54\0\0\0\0\0\0\0CORD....", "a DCD trajectory"),
        ("big-long.xtc", b"\0\0\0\0\0\0\0\x54CORD....", "a DCD trajectory"),
    ];
    for (name, bytes, part) in files {
        let message = refused(name, bytes, &Reading::default());
        assert!(message.contains(part), "{name}: {message}");
    }
    // In the columns of PDB its radii would be lost without a word.
    let pqr = "ATOM      1  N   ALA     1      11.104   6.134  -6.504 -0.300 1.8240\n";
    let message = refused("columns.pqr", pqr, &Reading::default());
    assert!(message.contains("PQR, which is not read; --format pdb"), "{message}");
    let reading = Reading { format: Some(Format::Pdb), ..Reading::default() };
    let asked = &mut frames_of("asked.pqr", pqr, &reading);
    assert_eq!(centers_in(asked, 0), Some(vec![[11.104, 6.134, -6.504]]));
    let words = "ATOM 1 N ALA 1 11.10412 6.13401 -6.50418 -0.30000 1.82400\n";
    wrong(words, "f:1:1: values between spaces, as in PQR, which is not read");
    let unknown = &mut film("text.csv", "Some text.\n");
    assert!(error_in(unknown, 0).contains("no columns x, y, z"));
    assert_eq!(centers(&good("CDF,x,y,z\n0.5,1,2,3\n")), [[1.0, 2.0, 3.0]]);
}

#[test]
fn a_file_that_is_still_empty_becomes_what_its_name_says() {
    let reading = Reading { follow: true, ..Reading::default() };
    let gro = "t\n    1\n    1SOL     OW    1   0.126   1.624   1.679\n   1 1 1\n";
    for (name, text, spheres) in [
        ("awaited.xyz", "1\n\nC 0 0 0\n", 1),
        ("awaited.gro", gro, 1),
        ("awaited.pdb", PDB, 3),
        ("awaited.csv", "x,y,z\n1,2,3\n4,5,6\n", 2),
    ] {
        let frames = &mut frames_of(name, b"", &reading);
        for _ in 0..2 {
            assert!(frame(frames, 0).is_none(), "{name}");
        }
        written(name, text);
        assert_eq!(frame(frames, 0).map(|scene| scene.spheres().len()), Some(spheres), "{name}");
        let message = refused(name, b"", &Reading::default());
        assert!(message.ends_with(": the file is empty"), "{message}");
    }
    let nameless = refused("awaited", b"", &reading);
    assert!(nameless.ends_with(": the file is empty; --format says what it will be"), "{nameless}");
}
