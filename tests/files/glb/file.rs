//! A reader of binary glTF, by its specification.

use serde_json::Value;

pub struct File {
    pub json: Value,
    binary: Vec<u8>,
}

impl File {
    pub fn parse(bytes: &[u8]) -> File {
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
        let json = word(12);
        assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0));
        let binary = 20 + json;
        assert_eq!((&bytes[binary + 4..binary + 8], word(binary) % 4), (&b"BIN\0"[..], 0));
        assert_eq!(binary + 8 + word(binary), bytes.len());
        let file =
            File { json: serde_json::from_slice(&bytes[20..20 + json]).unwrap(), binary: bytes[binary + 8..].to_vec() };
        let padding = file.binary.len() - file.json["buffers"][0]["byteLength"].as_u64().unwrap() as usize;
        assert!(padding < 4 && file.binary[file.binary.len() - padding..].iter().all(|&b| b == 0));
        file
    }

    pub fn view(&self, view: &Value) -> &[u8] {
        let view = &self.json["bufferViews"][view.as_u64().unwrap() as usize];
        let of = |key: &str| view[key].as_u64().unwrap() as usize;
        &self.binary[of("byteOffset")..of("byteOffset") + of("byteLength")]
    }

    fn accessor(&self, index: &Value, kind: &str, component: u32) -> Vec<[u8; 4]> {
        let accessor = &self.json["accessors"][index.as_u64().unwrap() as usize];
        assert_eq!(
            (accessor["type"].as_str(), accessor["componentType"].as_u64()),
            (Some(kind), Some(component.into()))
        );
        let words: Vec<[u8; 4]> =
            self.view(&accessor["bufferView"]).chunks(4).map(|word| word.try_into().unwrap()).collect();
        let size = ["SCALAR", "VEC2", "VEC3"].iter().position(|k| *k == kind).unwrap() + 1;
        assert_eq!(words.len() as u64, accessor["count"].as_u64().unwrap() * size as u64);
        words
    }

    fn primitive(&self) -> &Value {
        &self.json["meshes"][0]["primitives"][0]
    }

    pub fn floats<const N: usize>(&self, attribute: &str) -> Vec<[f64; N]> {
        let kind = ["", "SCALAR", "VEC2", "VEC3"][N];
        let words = self.accessor(&self.primitive()["attributes"][attribute], kind, 5126);
        let floats: Vec<f64> = words.into_iter().map(|word| f64::from(f32::from_le_bytes(word))).collect();
        floats.chunks(N).map(|chunk| chunk.try_into().unwrap()).collect()
    }

    pub fn triangles(&self) -> Vec<[usize; 3]> {
        let words = self.accessor(&self.primitive()["indices"], "SCALAR", 5125);
        let indices: Vec<usize> = words.into_iter().map(|word| u32::from_le_bytes(word) as usize).collect();
        indices.chunks(3).map(|corners| corners.try_into().unwrap()).collect()
    }

    /// Where the vertices are in the space of the source.
    pub fn positions(&self) -> Vec<[f64; 3]> {
        let node = &self.json["nodes"][1];
        let centre = [0, 1, 2].map(|k| node["translation"][k].as_f64().unwrap());
        self.floats::<3>("POSITION").into_iter().map(|p| [0, 1, 2].map(|k| p[k] + centre[k])).collect()
    }

    /// The map, as `extras` says how to have it back.
    pub fn map(&self) -> Vec<[f64; 2]> {
        let affine = &self.json["meshes"][0]["extras"]["map"];
        let number = |value: &Value| value.as_f64().unwrap();
        let back = |[s, t]: [f64; 2]| {
            let row = |k: usize| number(&affine["matrix"][k][0]) * s + number(&affine["matrix"][k][1]) * t;
            [0, 1].map(|k| row(k) + number(&affine["origin"][k]))
        };
        self.floats::<2>("TEXCOORD_0").into_iter().map(back).collect()
    }
}
