//! Volumes: one box of values in every format, and what is said of files that are none.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use crate::common::data_folder;
use proptest::prelude::*;
use riemap::io::{Sample, VolumeError, VolumeFormat, VolumeOptions, is_volume, parse_volume, read_volume, write_vol};
use riemap::surface::digital::Solid;
use tempfile::TempDir;

const SIZE: [usize; 3] = [3, 4, 5];

/// Values below 256, different along each axis.
fn value(i: usize, j: usize, k: usize) -> u64 {
    ((7 * i + 11 * j + 23 * k) % 13 * 17) as u64
}

/// All values, x fastest.
fn scan() -> Vec<u64> {
    let [x, y, z] = SIZE;
    (0..z).flat_map(|k| (0..y).flat_map(move |j| (0..x).map(move |i| value(i, j, k)))).collect()
}

/// All values, z fastest.
fn c_order() -> Vec<u64> {
    let [x, y, z] = SIZE;
    (0..x).flat_map(|i| (0..y).flat_map(move |j| (0..z).map(move |k| value(i, j, k)))).collect()
}

fn bytes_of<const N: usize>(values: &[u64], bytes: impl Fn(u64) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|&v| bytes(v)).collect()
}

fn zlib(data: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(data).expect("a vector takes everything");
    encoder.finish().expect("a vector takes everything")
}

fn vol(size_key: &str, width: usize, version: &str, data: &[u8]) -> Vec<u8> {
    let [x, y, z] = SIZE;
    let mut file = format!("X: {x}\nY: {y}\nZ: {z}\n{size_key}: {width}\nAlpha-Color: 0\n{version}.\n").into_bytes();
    file.extend_from_slice(data);
    file
}

fn npy(version: u8, descr: &str, fortran: bool, data: &[u8]) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': (3, 4, 5), }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut file = b"\x93NUMPY".to_vec();
    file.extend([version, 0]);
    let length = header.len() as u32;
    if version == 1 {
        file.extend((length as u16).to_le_bytes())
    } else {
        file.extend(length.to_le_bytes())
    }
    file.extend(header.bytes());
    file.extend_from_slice(data);
    file
}

fn pgm(header: &str, data: &[u8]) -> Vec<u8> {
    [header.as_bytes(), data].concat()
}

/// The same values as files of every format and kind: what it is, its extension, its content.
fn files() -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let (scan, c) = (scan(), c_order());
    let bytes = bytes_of(&scan, |v| [v as u8]);
    let longs = bytes_of(&scan, u64::to_le_bytes);
    let sizes = bytes_of(&SIZE.map(|n| n as u64), |n| (n as u32).to_le_bytes());
    let first = [&sizes, &b"\n"[..], &bytes].concat();
    let text: String = scan.iter().map(|v| format!("{v}\n")).collect();
    let crlf = String::from_utf8_lossy(&vol("Voxel-Size", 1, "Version: 2\n", &[])).replace('\n', "\r\n");
    vec![
        ("version 1", "vol", vol("Voxel-Size", 1, "", &first)),
        ("version 2", "vol", vol("Voxel-Size", 1, "Version: 2\n", &bytes)),
        ("version 2, CRLF", "VOL", pgm(&crlf, &bytes)),
        ("version 3", "vol", vol("Voxel-Size", 1, "Version: 3\n", &zlib(&bytes))),
        ("version 2", "longvol", vol("Lvoxel-Size", 8, "Version: 2\n", &longs)),
        ("version 3", "longvol", vol("Lvoxel-Size", 8, "Version: 3\n", &zlib(&longs))),
        ("P3D", "pgm3d", pgm("P3D\n3 4 5 \n255\n", &bytes)),
        (
            "P3d, a comment, a blank at the end",
            "pgm3d",
            pgm("P3d\n# x y z\n3 4 5\n255\n", &[&bytes[..], b"\n"].concat()),
        ),
        ("P5", "pgm3d", pgm("P5 3 4\n5 255 ", &bytes)),
        ("P5, two bytes", "pgm3d", pgm("P5\n3 4 5\n256\n", &bytes_of(&scan, |v| (v as u16).to_be_bytes()))),
        ("P2", "pgm3d", pgm("P2\n3 4 5\n255\n", text.as_bytes())),
        ("u1", "npy", npy(1, "|u1", false, &bytes_of(&c, |v| [v as u8]))),
        ("u1, Fortran", "npy", npy(1, "|u1", true, &bytes)),
        ("u2", "npy", npy(2, "<u2", false, &bytes_of(&c, |v| (v as u16).to_le_bytes()))),
        ("i2, big-endian", "npy", npy(3, ">i2", false, &bytes_of(&c, |v| (v as i16).to_be_bytes()))),
        ("i4", "npy", npy(1, "<i4", false, &bytes_of(&c, |v| (v as i32).to_le_bytes()))),
        ("i8, Fortran", "npy", npy(1, "<i8", true, &bytes_of(&scan, |v| (v as i64).to_le_bytes()))),
        ("u8", "npy", npy(1, "<u8", false, &bytes_of(&c, u64::to_le_bytes))),
        ("f4", "npy", npy(1, "<f4", false, &bytes_of(&c, |v| (v as f32).to_le_bytes()))),
        ("f8, big-endian, Fortran", "npy", npy(1, ">f8", true, &bytes_of(&scan, |v| (v as f64).to_be_bytes()))),
    ]
}

fn format_of(extension: &str) -> VolumeFormat {
    VolumeFormat::of(&PathBuf::from(format!("a.{extension}"))).expect("the extension of a volume")
}

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Folder(TempDir::new().expect("a temporary folder"))
    }

    fn file(&self, extension: &str, content: &[u8]) -> PathBuf {
        let path = self.0.path().join(format!("volume.{extension}"));
        fs::write(&path, content).expect("a temporary file");
        path
    }

    fn read(&self, extension: &str, content: &[u8], options: VolumeOptions) -> Result<Solid, VolumeError> {
        read_volume(&self.file(extension, content), &options)
    }

    fn message(&self, extension: &str, content: &[u8], options: VolumeOptions) -> String {
        match self.read(extension, content, options) {
            Ok(solid) => panic!("{} voxels of a file that is none", solid.len()),
            Err(error) => error.to_string(),
        }
    }
}

fn above(threshold: f64) -> VolumeOptions {
    VolumeOptions { threshold: Some(threshold), ..VolumeOptions::default() }
}

fn is_the_box(solid: &Solid, threshold: f64, what: &str) {
    assert_eq!(solid.size(), SIZE, "{what}");
    assert_eq!(solid.origin(), [0.0; 3], "{what}");
    for k in 0..SIZE[2] {
        for j in 0..SIZE[1] {
            for i in 0..SIZE[0] {
                let inside = value(i, j, k) as f64 > threshold;
                assert_eq!(solid.contains([i, j, k].map(|n| n as i32)), inside, "{what}: {i} {j} {k}");
            }
        }
    }
}

#[test]
fn every_format_gives_the_same_voxels_at_every_threshold() {
    let folder = Folder::new();
    for (what, extension, content) in files() {
        for threshold in [-3.0, 0.0, 50.5, 51.0, 203.0] {
            let solid = folder.read(extension, &content, above(threshold));
            let solid = solid.unwrap_or_else(|error| panic!("{what}: {error}"));
            is_the_box(&solid, threshold, what);
        }
        let default = folder.read(extension, &content, VolumeOptions::default());
        is_the_box(&default.unwrap_or_else(|error| panic!("{what}: {error}")), 0.0, what);
    }
}

#[test]
fn raw_files_need_their_size_and_may_have_two_bytes() {
    let folder = Folder::new();
    let sized = VolumeOptions { size: Some(SIZE), ..VolumeOptions::default() };
    let wide = VolumeOptions { sample: Some(Sample::U16), ..sized };
    let bytes = bytes_of(&scan(), |v| [v as u8]);
    let words = bytes_of(&scan(), |v| (v as u16).to_le_bytes());
    is_the_box(&folder.read("raw", &bytes, sized).expect("bytes"), 0.0, "bytes");
    is_the_box(&folder.read("raw", &words, wide).expect("words"), 0.0, "words");
    assert!(
        folder.message("raw", &bytes, VolumeOptions::default()).contains("number of values along x, y, z is not given")
    );
    let wrong = folder.message("raw", &bytes, wide);
    assert!(wrong.contains("3 × 4 × 5 values of 2 byte(s) do not make the 60 bytes"), "{wrong}");
    let none = VolumeOptions { size: Some([0, 4, 5]), ..sized };
    assert!(folder.message("raw", &bytes, none).contains("0 × 4 × 5 values"));
    let huge = VolumeOptions { size: Some([usize::MAX, 2, 5]), ..sized };
    assert!(folder.message("raw", &bytes, huge).contains("more than the"));
    assert!(folder.message("raw", b"", sized).contains("the file is empty"));
}

#[test]
fn options_without_meaning_for_a_format_are_refused() {
    let folder = Folder::new();
    for (_, extension, content) in files() {
        let size = VolumeOptions { size: Some(SIZE), ..VolumeOptions::default() };
        assert!(folder.message(extension, &content, size).contains("states its own size"));
        let sample = VolumeOptions { sample: Some(Sample::U8), ..VolumeOptions::default() };
        assert!(folder.message(extension, &content, sample).contains("states its own type"));
    }
    let nan = folder.message("vol", b"", above(f64::NAN));
    assert!(nan.contains("the threshold NaN is not a finite number"), "{nan}");
}

#[test]
fn a_volume_without_inside_says_how_large_its_values_are() {
    let folder = Folder::new();
    for (what, extension, content) in files() {
        let message = folder.message(extension, &content, above(204.0));
        let expected = "none of the 60 values is above the threshold 204; the largest is 204";
        assert!(message.contains(expected), "{what}: {message}");
    }
}

#[test]
fn negative_values_and_booleans_of_numpy_are_understood() {
    let folder = Folder::new();
    let signed = bytes_of(&c_order(), |v| (v as i16 - 100).to_le_bytes());
    is_the_box(&folder.read("npy", &npy(1, "<i2", false, &signed), above(-100.0)).expect("signed"), 0.0, "signed");
    let flags = bytes_of(&c_order(), |v| [u8::from(v > 50)]);
    is_the_box(&folder.read("npy", &npy(1, "|b1", false, &flags), above(0.0)).expect("flags"), 50.0, "flags");
    let mut floats = bytes_of(&c_order(), |v| (v as f64).to_le_bytes());
    floats[8 * 7..8 * 8].copy_from_slice(&f64::NAN.to_le_bytes());
    let message = folder.message("npy", &npy(1, "<f8", false, &floats), above(0.0));
    assert!(message.contains("byte 184: `NaN` is not a number"), "{message}");
}

#[test]
fn a_centre_in_the_header_moves_the_origin_as_in_dgtal() {
    let folder = Folder::new();
    let bytes = bytes_of(&scan(), |v| [v as u8]);
    let file = vol("Voxel-Size", 1, "Center-X: 10\nCenter-Y: 0\nCenter-Z: -7\nVersion: 2\n", &bytes);
    let solid = folder.read("vol", &file, above(0.0)).expect("a volume");
    // lowest voxel: centre − (size − 1)/2, whole numbers
    assert_eq!(solid.origin(), [9.0, -1.0, -9.0]);
}

#[test]
fn what_is_written_reads_back() {
    let folder = Folder::new();
    for origin in [[0.0, 0.0, 0.0], [-3.0, 12.0, -400.0]] {
        for size in [[1, 1, 1], [64, 2, 3], [65, 3, 2], [130, 1, 4]] {
            let mut solid = Solid::empty(size, origin);
            for n in 0..size.iter().product::<usize>() {
                if n % 3 != 1 {
                    let (i, j, k) = (n % size[0], n / size[0] % size[1], n / size[0] / size[1]);
                    solid.insert([i, j, k].map(|n| n as i32));
                }
            }
            let path = folder.0.path().join("written.vol");
            write_vol(&path, &solid).expect("a file");
            assert_eq!(read_volume(&path, &VolumeOptions::default()).expect("a volume"), solid);
        }
    }
    assert!(write_vol(&folder.0.path().join("none/x.vol"), &Solid::empty([1; 3], [0.0; 3])).is_err());
}

#[test]
fn files_cut_off_anywhere_are_errors() {
    for (what, extension, content) in files() {
        let format = format_of(extension);
        // P2: a shorter last number is a number; a blank at the end is not needed
        let last = content.len() - if what == "P2" || what.contains("blank") { 4 } else { 0 };
        for length in 0..last {
            let result = parse_volume(&content[..length], format, &above(-1.0));
            assert!(result.is_err(), "{what}, {length} of {}: {result:?}", content.len());
        }
        let longer = [&content[..], b" 7"].concat();
        let result = parse_volume(&longer, format, &above(-1.0));
        assert!(result.is_err(), "{what}: {result:?}");
    }
}

#[test]
fn defects_are_said_with_their_place() {
    let folder = Folder::new();
    let ok = "X: 3\nY: 4\nZ: 5\nVoxel-Size: 1\nVersion: 2\n.\n";
    for (extension, content, expected) in [
        ("vol", "".to_string(), "line 1: the file ends too early"),
        ("vol", "X: 3\nnonsense\n.\n".to_string(), "line 2: `nonsense` where a line `Key: value`"),
        ("vol", ok.replace("Z: 5\n", ""), "line 5: the header has no Z"),
        ("vol", ok.replace("Y: 4", "Y: four"), "line 2: `four` is not a number (Y was expected)"),
        ("vol", ok.replace("Y: 4", "Y: 0"), "line 2: 0 is not a number of voxels, 1 or more"),
        ("vol", ok.replace("Y: 4", "Y: -4"), "line 2: -4 is not a number of voxels"),
        ("vol", ok.replace("Voxel-Size: 1\n", ""), "line 5: the header has no Voxel-Size"),
        ("vol", ok.replace("Voxel-Size: 1", "Voxel-Size: 2"), "line 4: `2` where values of 1 byte"),
        ("vol", ok.replace("Version: 2", "Version: 4"), "line 5: `4` where version 2 (plain) or 3 (compressed)"),
        ("vol", ok.to_string(), "byte 42: the header promises 60 voxels of at least 1 bytes, but only 0 bytes follow"),
        ("vol", ok.replace("X: 3", "X: 3000000000"), "voxels are more than the 8589934592"),
        ("vol", ok.replace("Version: 2", "Version: 3") + "nonsense", "byte 44: the compressed data is damaged"),
        ("longvol", ok.to_string(), "the header has no Lvoxel-Size"),
        ("pgm3d", "P6\n".to_string(), "line 1: `P6` where `P3D`, `P5` or `P2`"),
        ("pgm3d", "P2\n3 4\n".to_string(), "(2 of 4 header numbers read)"),
        ("pgm3d", "P2\n1 1 2\n255\n7 x".to_string(), "line 4: `x` is not a number"),
        ("pgm3d", "P2\n1 1 2\n255\n7 8 9".to_string(), "line 4: `9` after the end of the data"),
        ("pgm3d", "P5\n1 1 2\n70000\n7 8 9".to_string(), "line 3: `70000` where a largest value up to 65535"),
        ("npy", "NUMPY".to_string(), "byte 0: `NUMPY` where `\\x93NUMPY`"),
    ] {
        let message = folder.message(extension, content.as_bytes(), above(0.0));
        assert!(message.contains(expected), "{content:?}: {message}");
    }
    for (descr, expected) in [("<c16", "numpy.save"), ("<f2", "numpy.save"), ("|O", "numpy.save")] {
        let message = folder.message("npy", &npy(1, descr, false, &[]), above(0.0));
        assert!(message.contains(expected), "{message}");
    }
    let flat = String::from_utf8_lossy(&npy(1, "|u1", false, &[])[10..]).replace("(3, 4, 5)", "(12, 5)  ");
    let flat = [&npy(1, "|u1", false, &[])[..10], flat.as_bytes()].concat();
    assert!(folder.message("npy", &flat, above(0.0)).contains("a shape of three lengths"));
}

#[test]
fn headers_are_not_believed() {
    let folder = Folder::new();
    // 2 GB of values that are not there: an allocation of that size would be noticed by the limit on a test machine, and
    // the error names what is missing
    let header = "X: 1200\nY: 1300\nZ: 1400\nVoxel-Size: 1\nVersion: 3\n.\n".to_string();
    let file = [header.as_bytes(), &zlib(&[1; 1000])].concat();
    let message = folder.message("vol", &file, above(0.0));
    assert!(message.contains("(1000 of 2184000000 voxels read)"), "{message}");
    let message = folder.message("pgm3d", b"P2 1200 1300 1400 9 1 2 3", above(0.0));
    assert!(message.contains("(3 of 2184000000 voxels read)"), "{message}");
}

#[test]
fn volumes_are_known_by_their_extension() {
    for format in VolumeFormat::ALL {
        assert!(is_volume(&PathBuf::from(format!("a/b.{}", format.extension().to_uppercase()))));
        assert!(VolumeFormat::known().contains(format.extension()));
    }
    assert!(!is_volume(&PathBuf::from("vol")) && !is_volume(&PathBuf::from("a.obj")));
    let folder = Folder::new();
    assert!(folder.message("dat", b"", above(0.0)).contains("known extensions: .vol, .longvol, .pgm3d, .npy, .raw"));
    let missing = read_volume(&folder.0.path().join("none.vol"), &above(0.0));
    assert!(matches!(missing, Err(VolumeError::Io { .. })));
    assert!(matches!(read_volume(folder.0.path(), &above(0.0)), Err(VolumeError::Directory { .. })));
}

#[test]
fn the_public_cat_is_the_same_in_both_formats() {
    let Some(folder) = data_folder().map(|folder| folder.join("digital")).filter(|f| f.join("cat10.vol").is_file())
    else {
        eprintln!("no public data: nothing is compared");
        return;
    };
    let read = |name| read_volume(&folder.join(name), &above(0.0)).unwrap_or_else(|error| panic!("{error}"));
    let (vol, pgm) = (read("cat10.vol"), read("cat10.pgm3d"));
    assert!(vol.voxels().eq(pgm.voxels()) && vol.len() == 8043);
    // the header of one has a centre at 0
    assert_eq!((vol.origin(), pgm.origin()), ([-19.0; 3], [0.0; 3]));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn garbage_in_a_file_is_never_more_than_an_error(which in 0..20_usize, at in 0_usize..400, what in prop::collection::vec(any::<u8>(), 0..9)) {
        let (_, extension, mut content) = files().swap_remove(which);
        let at = at % content.len();
        let end = (at + what.len()).min(content.len());
        content.splice(at..end, what);
        if let Ok(solid) = parse_volume(&content, format_of(extension), &above(0.0)) {
            prop_assert_eq!(solid.voxels().count(), solid.len());
        }
    }
}
