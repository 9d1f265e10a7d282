//! What mesh files are read, and what every broken one is told.

use crate::mesh_files::{SQUARE_OBJ, SQUARE_OFF, SQUARE_PLY, SQUARE_STL, SQUARES, bad, good, square, without_normals};
use proptest::prelude::*;
use riemap::io::{self, Defect, Format, MeshFile, Place};
use riemap::surface::Faces;

#[test]
fn every_format_reads_the_same_square_with_any_line_end_and_a_byte_order_mark() {
    for (format, text) in SQUARES {
        assert_eq!(without_normals(good(format, text)), square(), "{format:?}");
        for line_end in ["\r\n", "\r", "\n\n", " \t\n"] {
            // a PLY header has one declaration a line, blank ones are nothing
            let text = text.replace('\n', line_end);
            assert_eq!(without_normals(good(format, &text)), square(), "{format:?} {line_end:?}");
        }
        assert_eq!(without_normals(good(format, format!("\u{feff}{text}"))), square(), "{format:?}");
        assert_eq!(without_normals(good(format, text.trim_end())), square(), "{format:?} without last line end");
    }
}

#[test]
fn obj_faces_are_read_in_every_notation() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let normals = "vt 0 0\nvn 0 0 2\nvn 0 2 0\n";
    for faces in [
        "f 1 2 3\nf 1 3 4",
        "f 1/1 2/1 3/1\nf 1/1 3/1 4/1",
        "f 1//1 2//1 3//1\nf 1//1 3//2 4//2",
        "f 1/1/1 2/1/1 3/1/1\nf 1/1/-2 3/1/1 4/1/-1",
        "f -4 -3 -2\nf -4 -2 -1",
        "\tf  1\t2 3 # a comment\n  f 1 3 4  ",
        "o x\ng y\ns off\nusemtl z\nmtllib z\nl 1 2\np 1\nvp 0 1\nf 1 \\\n2 3\nf 1 3\\\r\n 4#",
    ] {
        let mesh = good(Format::Obj, format!("# c\n{vertices}{normals}{faces}"));
        assert_eq!(without_normals(mesh), square(), "{faces}");
        // faces may come before what they name
        if !faces.contains('-') {
            assert_eq!(
                without_normals(good(Format::Obj, format!("{faces}\n{vertices}{normals}"))),
                square(),
                "{faces}"
            );
        }
    }
    let polygons = good(Format::Obj, format!("{vertices}v 2 2 0\nf 1 2 3\nf 1 2 3 4\nf 5 4 3 2 1\n"));
    let expected = Faces::from_iter([&[0, 1, 2][..], &[0, 1, 2, 3], &[4, 3, 2, 1, 0]]);
    assert_eq!(*polygons.surface.faces(), expected);
}

#[test]
fn face_normals_are_the_normalised_mean_of_corner_normals_or_absent() {
    let obj =
        |faces: &str| good(Format::Obj, format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 2 0\nvn 0 0 -2\n{faces}"));
    let mixed = obj("f 1//1 2//1 3//1\nf 1//1 2//2 3//1");
    // the mean of (0,0,2), (0,2,0), (0,0,2) is along (0,1,2); two roundings
    let [x, y, z] = mixed.surface.face_normals().as_ref().unwrap()[1];
    assert!(x == 0.0 && (y - 0.2f64.sqrt()).abs() < 1e-15 && (z - 0.8f64.sqrt()).abs() < 1e-15);
    assert_eq!(mixed.surface.face_normals().unwrap()[0], [0.0, 0.0, 1.0]);
    for faces in ["f 1//1 2//1 3//1\nf 1 2//1 3//1", "f 1//1 2//1 3//1\nf 1//1 2//3 3", "f 1//1 2//1 3//1\nf 1 2 3"] {
        let partly = obj(faces);
        assert_eq!((partly.surface.face_normals(), partly.face_without_normal), (None, Some(1)), "{faces}");
    }
    assert_eq!(good(Format::Obj, SQUARE_OBJ).face_without_normal, None);
    let off = good(Format::Off, "NOFF 3 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 3 0 1 2");
    assert_eq!(off.surface.face_normals(), Some(&[[0.0, 0.0, 1.0]][..]));
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n\
        property double z\nproperty uchar red\nproperty double x\nproperty double y\nproperty list uchar int extra\n\
        element rest 1\nproperty list int float stuff\nelement face 1\nproperty int flags\n\
        property list uchar uint vertex_index\nend_header\n\
        0 0 3 9 255 0 0 0\n0 0 3 9 255 1 0 2 7 7\n0 0 3 9 255 0 1.50 1 7\n3 1 2 3.5\n5 3 2 1 0\n";
    let ply = good(Format::Ply, ply);
    assert_eq!(ply.surface.positions(), [[0.0, 0.0, 9.0], [1.0, 0.0, 9.0], [0.0, 1.5, 9.0]]);
    assert_eq!(ply.surface.faces().get(0), [2, 1, 0]);
    assert_eq!(ply.surface.face_normals(), Some(&[[0.0, 0.0, 1.0]][..]));
    assert_eq!(ply.vertex_text.unwrap().line(2), Some(&b"v 0 1.50 9"[..]));
    assert_eq!(good(Format::Stl, SQUARE_STL).surface.face_normals(), Some(&[[0.0, 0.0, 1.0]; 2][..]));
    let unstated = good(Format::Stl, SQUARE_STL.replace("normal 0 0 1", "normal nan 0 0"));
    assert_eq!((unstated.surface.face_normals(), unstated.face_without_normal), (None, Some(0)));
}

#[test]
fn off_is_read_by_word_with_every_header() {
    let body = &SQUARE_OFF[4..];
    for text in [
        body.to_owned(),
        format!("OFF {body}"),
        format!("OFF{body}"),
        format!("# c\nOFF # c\n\n# 9 9 9\n{}", body.replace('\n', " # c\n\n")),
        SQUARE_OFF.replacen("4 2 0", "4 2", 1),
        SQUARE_OFF.replace(' ', "\n"),
        SQUARE_OFF.replace('\n', " "),
        SQUARE_OFF.replace("3 0 1 2", "3 0 1 2 255 0 0").replace("3 0 2 3", "3 0\n2\n3 0.5 0.5 0.5 1"),
        format!("COFF\n{}", body.replace(" 0\n", " 0 255 0 0 255\n").replacen(" 255 0 0 255", "", 1)),
        format!("COFF\n{}", body.replace(" 0\n", " 0 0.5 0.5 0.5\n").replacen(" 0.5 0.5 0.5", "", 1)),
        "STCOFF 4 2 0 0 0 0 1 1 1 1 8 8 1 0 0 1 1 1 1 8 8 1 1 0 1 1 1 1 8 8 0 1 0 1 1 1 1 8 8 3 0 1 2 3 0 2 3"
            .to_owned(),
        "STNOFF\n4 2 0\n0 0 0 0 0 1 8 8\n1 0 0 0 0 1 8 8\n1 1 0 0 0 1 8 8\n0 1 0 0 0 1 8 8\n3 0 1 2\n3 0 2 3 7"
            .to_owned(),
    ] {
        assert_eq!(without_normals(good(Format::Off, &text)), square(), "{text}");
    }
    for header in ["4OFF", "nOFF", "ST4OFF"] {
        let error = bad(Format::Off, format!("{header}\n{body}"));
        assert!(matches!(error.defect, Defect::Unsupported { .. }), "{error}");
    }
}

/// The square in the binary formats, with numbers turned into bytes as told.
fn binary_off(header: &str, float: impl Fn(f64) -> Vec<u8>, word: impl Fn(u32) -> Vec<u8>, colours: bool) -> Vec<u8> {
    let surface = square();
    let mut out = header.as_bytes().to_vec();
    out.extend([4, 2, 0].into_iter().flat_map(&word));
    out.extend(surface.positions().iter().flatten().flat_map(|&x| float(x)));
    for (f, polygon) in surface.faces().iter().enumerate() {
        out.extend(word(3));
        out.extend(polygon.iter().flat_map(|&v| word(v)));
        if colours {
            out.extend(word(if f == 0 { 0 } else { 3 }));
            out.extend((0..3 * f).flat_map(|_| float(0.5)));
        }
    }
    out
}

#[test]
fn binary_off_is_read_in_either_byte_order_with_and_without_colours() {
    let header = "OFF BINARY\n";
    let big = |x: u32| x.to_be_bytes().to_vec();
    let little = |x: u32| x.to_le_bytes().to_vec();
    for colours in [true, false] {
        for file in [
            binary_off(header, |x| (x as f32).to_be_bytes().to_vec(), big, colours),
            binary_off(header, |x| (x as f32).to_le_bytes().to_vec(), little, colours),
        ] {
            assert_eq!(without_normals(good(Format::Off, &file)), square());
            for length in header.len()..file.len() {
                bad(Format::Off, &file[..length]);
            }
            assert!(matches!(bad(Format::Off, [&file[..], b"more"].concat()).place, Place::Byte(_)));
        }
    }
    let doubles = binary_off(header, |x| x.to_le_bytes().to_vec(), little, false);
    assert_eq!(without_normals(good(Format::Off, doubles)), square());
}

fn binary_stl(header: &[u8]) -> Vec<u8> {
    let surface = square();
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(2u32.to_le_bytes());
    for polygon in surface.faces().iter() {
        out.extend([0f32, 0.0, 4.0].into_iter().flat_map(f32::to_le_bytes));
        // −0 is the same place as +0
        let coordinates = polygon.iter().flat_map(|&v| surface.positions()[v as usize]);
        out.extend(coordinates.flat_map(|x| (if x == 0.0 { -0.0f32 } else { x as f32 }).to_le_bytes()));
        out.extend([0, 0]);
    }
    out
}

#[test]
fn stl_is_told_apart_by_its_length_not_by_its_first_word() {
    for header in [&b"solid binary"[..], b"anything", b"\0"] {
        let mesh = good(Format::Stl, binary_stl(header));
        assert_eq!(mesh.surface.face_normals(), Some(&[[0.0, 0.0, 1.0]; 2][..]));
        assert_eq!(without_normals(mesh), square());
    }
    let two = format!("{SQUARE_STL}{}", SQUARE_STL.to_uppercase());
    assert_eq!(good(Format::Stl, two).surface.faces().len(), 4);
    // a facet that welding collapses is kept: it is for the diagnosis to report
    let collapsed = good(Format::Stl, SQUARE_STL.replace("vertex 1 0 0", "vertex 0 -0.0 0"));
    assert_eq!(collapsed.surface.faces().get(0), [0, 0, 1]);
    for length in [0, 1, 83, 84, 100, 183] {
        bad(Format::Stl, &binary_stl(b"solid\0")[..length]);
    }
}

#[test]
fn ply_is_read_in_every_encoding_and_scalar_type() {
    let types = ["char", "uint8", "short", "uint16", "int", "uint32", "float", "float64"];
    let encode = |kind: usize, x: f64, big: bool| -> Vec<u8> {
        let mut bytes = match kind {
            0 => (x as i8).to_le_bytes().to_vec(),
            1 => (x as u8).to_le_bytes().to_vec(),
            2 => (x as i16).to_le_bytes().to_vec(),
            3 => (x as u16).to_le_bytes().to_vec(),
            4 => (x as i32).to_le_bytes().to_vec(),
            5 => (x as u32).to_le_bytes().to_vec(),
            6 => (x as f32).to_le_bytes().to_vec(),
            _ => x.to_le_bytes().to_vec(),
        };
        if big {
            bytes.reverse();
        }
        bytes
    };
    let surface = square();
    for (encoding, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        for (kind, name) in types.iter().enumerate() {
            let index = kind % 6;
            let mut file = format!(
                "ply\r\nformat {encoding} 1.0\r\nelement junk 2\r\nproperty list {1} {0} l\r\nelement vertex 4\r\n\
                 property {0} x\r\nproperty {0} y\r\nproperty {0} z\r\nelement face 2\r\n\
                 property list {1} {1} vertex_indices\r\nproperty {0} flag\r\nend_header\r\n",
                name, types[index]
            )
            .into_bytes();
            let mut put = |kind, x| file.extend(encode(kind, x, big));
            for (k, x) in [(index, 1.0), (kind, 5.0), (index, 0.0)] {
                put(k, x);
            }
            surface.positions().iter().flatten().for_each(|&x| put(kind, x));
            for polygon in surface.faces().iter() {
                put(index, 3.0);
                polygon.iter().for_each(|&v| put(index, f64::from(v)));
                put(kind, 9.0);
            }
            assert_eq!(without_normals(good(Format::Ply, &file)), surface, "{encoding} {name}");
            let header = file.windows(12).position(|w| w == b"end_header\r\n").unwrap();
            for length in 0..file.len() {
                let place = bad(Format::Ply, &file[..length]).place;
                assert!(length <= header + 12 || matches!(place, Place::Byte(_)), "{place}");
            }
            assert!(matches!(bad(Format::Ply, [&file[..], b"x"].concat()).defect, Defect::TrailingBytes { bytes: 1 }));
        }
    }
}

#[test]
fn malformed_files_are_told_where_and_what() {
    let obj = |change: (&str, &str)| bad(Format::Obj, SQUARE_OBJ.replacen(change.0, change.1, 1));
    let off = |change: (&str, &str)| bad(Format::Off, SQUARE_OFF.replacen(change.0, change.1, 1));
    let ply = |change: (&str, &str)| bad(Format::Ply, SQUARE_PLY.replacen(change.0, change.1, 1));
    let stl = |change: (&str, &str)| bad(Format::Stl, SQUARE_STL.replacen(change.0, change.1, 1));
    for (error, expected) in [
        (obj(("v 1 1 0", "v 1 nan 0")), "line 3: the coordinate `nan` is not a finite number"),
        (obj(("v 1 1 0", "v 1 1e999 0")), "line 3: the coordinate `1e999` is not a finite number"),
        (obj(("v 1 1 0", "v 1 1,5 0")), "line 3: `1,5` is not a number (a coordinate was expected)"),
        (obj(("v 1 1 0", "v 1 1")), "line 3: only 2 of 3 coordinates"),
        (obj(("f 1 3 4", "f 1 3")), "line 6: a face with 2 corners; faces have 3 or more"),
        (obj(("f 1 3 4", "f 1 0 4")), "line 6: the index 0 in `0`: this format counts from 1"),
        (obj(("f 1 3 4", "f 1 5 4")), "line 6: vertex 5 does not exist: the file has 4 (counted from 1)"),
        (obj(("f 1 2 3", "f 1 -5 3")), "line 5: vertex -5 does not exist: the file has 4 (counted from 1)"),
        (obj(("f 1 3 4", "f 1//1 3//1 4//1")), "line 6: normal 1 does not exist: the file has 0 (counted from 1)"),
        (
            obj(("f 1 3 4", "f 1 3/x 4")),
            "line 6: `3/x` is not a number (a corner such as 7, 7/3, 7//5 or 7/3/5 was expected)",
        ),
        (off(("OFF", "OOF")), "line 1: `OOF` where the keyword OFF was expected"),
        (off(("4 2 0", "4 x 0")), "line 2: `x` is not a number (the number of faces was expected)"),
        (off(("1 1 0", "1 inf 0")), "line 5: the coordinate `inf` is not a finite number"),
        (off(("3 0 2 3", "3 0 2 4")), "line 8: vertex 4 does not exist: the file has 4 (counted from 0)"),
        (off(("3 0 2 3", "2 0 2")), "line 8: a face with 2 corners; faces have 3 or more"),
        (
            off(("4 2 0", "4 1 0")),
            "line 8: `3` after the end of the data: the counts in the header are too small, or a line above is too long",
        ),
        (
            off(("4 2 0", "4 3 0")),
            "line 9: the file ends too early: the number of a face's corners was expected (2 of 3 faces read)",
        ),
        (ply(("ply", "plx")), "line 1: `plx` where the keyword `ply` was expected"),
        (ply(("ascii", "utf8")), "line 2: `utf8` where ascii, binary_little_endian or binary_big_endian was expected"),
        (
            ply(("property float z\n", "")),
            "line 8: the header has no scalar properties `x`, `y`, `z` for the element `vertex`",
        ),
        (
            ply(("vertex_indices", "corners")),
            "line 9: the header has no property list `vertex_indices` of whole numbers for the element `face`",
        ),
        (
            ply(("element face", "element tristrips")),
            "line 9: a mesh of triangle strips (element `tristrips`) cannot be read; save it with single faces, or convert the strips to triangles",
        ),
        (ply(("1 1 0", "1 1e999 0")), "line 12: the coordinate `1e999` is not a finite number"),
        (ply(("1 1 0", "1 1 0 7")), "line 12: `7` is one value too many for an element `vertex`"),
        (ply(("3 0 2 3", "3 0 2 9")), "line 15: vertex 9 does not exist: the file has 4 (counted from 0)"),
        (
            ply(("3 0 2 3", "3 0 2 3\n1")),
            "line 16: `1` after the end of the data: the counts in the header are too small, or a line above is too long",
        ),
        (stl(("vertex 1 0 0", "vertex 1 0 inf")), "line 5: the coordinate `inf` is not a finite number"),
        (stl(("vertex 1 0 0\n", "")), "line 6: `endloop` where one of three lines `vertex x y z` was expected"),
        (
            stl(("endsolid a square", "")),
            "line 17: the file ends too early: `facet` or `endsolid` was expected (2 facets read)",
        ),
    ] {
        assert_eq!(error.to_string(), expected);
    }
    for format in Format::ALL {
        assert_eq!(bad(format, "").to_string(), "the whole file: the file is empty", "{format:?}");
        assert_eq!(bad(format, " \r\n").to_string(), "the whole file: the file is empty", "{format:?}");
    }
    let cloud = SQUARE_OFF.replacen("4 2 0", "4 0 0", 1).replace("3 0 1 2\n3 0 2 3\n", "");
    assert!(matches!(bad(Format::Off, cloud).defect, Defect::NoFaces { vertices: 4 }));
}

#[test]
fn counts_in_headers_are_not_believed() {
    for count in ["1000000000", "4000000000", "99999999999", "999999999999999999"] {
        for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
            for old in ["vertex 4", "face 2"] {
                let element = old.split(' ').next().unwrap();
                let file = SQUARE_PLY.replace(old, &format!("{element} {count}")).replace("ascii", encoding);
                bad(Format::Ply, file);
            }
        }
        bad(Format::Off, SQUARE_OFF.replace("4 2 0", &format!("{count} 2 0")));
        bad(Format::Off, SQUARE_OFF.replace("4 2 0", &format!("4 {count} 0")));
        bad(Format::Off, SQUARE_OFF.replace("3 0 2 3", &format!("{count} 0 2 3")));
        bad(Format::Ply, SQUARE_PLY.replace("3 0 2 3", &format!("{count} 0 2 3")));
    }
    bad(Format::Off, [b"OFF BINARY\n".as_slice(), &[0xff; 64]].concat());
}

#[test]
fn comments_need_not_be_utf8() {
    let latin = |text: &str, old: &str, new: &[u8]| {
        let at = text.find(old).unwrap();
        [&text.as_bytes()[..at], new, &text.as_bytes()[at..]].concat()
    };
    good(Format::Obj, latin(SQUARE_OBJ, "v 1", b"# Fl\xe4che\n"));
    good(Format::Off, latin(SQUARE_OFF, "4 2", b"# Fl\xe4che\n"));
    good(Format::Ply, latin(SQUARE_PLY, "element", b"comment Fl\xe4che\n"));
    good(Format::Stl, latin(SQUARE_STL, "a square", b"Fl\xe4che "));
}

proptest! {
    #[test]
    fn no_bytes_make_a_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        for (format, text) in SQUARES {
            let _ = io::parse(&bytes, format);
            let _ = io::parse(&[text.as_bytes(), &bytes].concat(), format);
        }
        let _ = io::parse(&[b"OFF BINARY\n", &bytes[..]].concat(), Format::Off);
    }

    #[test]
    fn mutations_of_valid_files_are_read_soundly_or_refused(
        which in 0usize..7,
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0u8..4), 1..6),
        cut in proptest::option::of(any::<prop::sample::Index>()),
    ) {
        let binary_ply = [SQUARE_PLY.split_inclusive("end_header\n").next().unwrap().replace("ascii", "binary_little_endian")
            .into_bytes(), vec![0; 48], vec![3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0]].concat();
        let off = binary_off("NOFF BINARY\n", |x| (x as f32).to_be_bytes().to_vec(), |x| x.to_be_bytes().to_vec(), true);
        let (format, mut file) = match which {
            0..4 => (SQUARES[which].0, SQUARES[which].1.as_bytes().to_vec()),
            4 => (Format::Ply, binary_ply),
            5 => (Format::Stl, binary_stl(b"solid")),
            _ => (Format::Off, off),
        };
        for (at, byte, kind) in changes {
            let i = at.index(file.len());
            match kind {
                0 => file[i] = byte,
                1 => file[i] = b"0123456789-/ \n#\\"[usize::from(byte) % 16],
                2 => file.insert(i, byte),
                _ if file.len() > 1 => { file.remove(i); }
                _ => {}
            }
        }
        if let Some(cut) = cut {
            file.truncate(cut.index(file.len()));
        }
        match io::parse(&file, format) {
            Ok(MeshFile { surface, vertex_text, .. }) => {
                let nv = surface.positions().len();
                prop_assert!(surface.positions().iter().flatten().all(|x| x.is_finite()));
                prop_assert!(surface.faces().iter().all(|p| p.len() >= 3 && p.iter().all(|&v| (v as usize) < nv)));
                prop_assert!(vertex_text.is_none_or(|t| t.len() == nv));
                prop_assert!(surface.face_normals().is_none_or(|n| n.len() == surface.faces().len()));
            }
            Err(error) => prop_assert!(!error.to_string().contains(|c: char| c.is_control())),
        }
    }
}
