//! The subset of the JSON of a glTF file that is used here.

use std::f64::consts::FRAC_1_SQRT_2;

use serde::Serialize;

use super::mesh::Mesh;
use super::{Affine, Model};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const LINEAR: u32 = 9729;
const LINEAR_MIPMAP_LINEAR: u32 = 9987;
const REPEAT: u32 = 10497;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct GltfDocument {
    asset: Asset,
    scene: u32,
    scenes: [GltfScene; 1],
    nodes: [Node; 2],
    meshes: [GltfMesh; 1],
    materials: [Material; 1],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    textures: Vec<GltfTexture>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    samplers: Vec<Sampler>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    images: Vec<GltfImage>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<BufferView>,
    buffers: [Buffer; 1],
}

#[derive(Serialize)]
struct Asset {
    version: &'static str,
    generator: &'static str,
}

#[derive(Serialize)]
struct GltfScene {
    nodes: [u32; 1],
}

/// The outer node rotates the source's axes to those of glTF; the inner node translates the mesh
/// back to its original position.
#[derive(Serialize)]
#[serde(untagged)]
enum Node {
    Outer {
        children: [u32; 1],
        #[serde(skip_serializing_if = "Option::is_none")]
        rotation: Option<[f64; 4]>,
    },
    Inner {
        mesh: u32,
        translation: [f64; 3],
    },
}

#[derive(Serialize)]
struct GltfMesh {
    primitives: [Primitive; 1],
    #[serde(skip_serializing_if = "Option::is_none")]
    extras: Option<Extras>,
}

/// The inverse of the texture transformation: `(u, v) = matrix · TEXCOORD_0 + origin`.
#[derive(Serialize)]
struct Extras {
    map: Affine,
}

#[derive(Serialize)]
struct Primitive {
    attributes: GltfAttributes,
    indices: usize,
    material: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
struct GltfAttributes {
    position: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    texcoord_0: Option<usize>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Material {
    double_sided: bool,
    pbr_metallic_roughness: Roughness,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Roughness {
    #[serde(skip_serializing_if = "Option::is_none")]
    base_color_texture: Option<TextureIndex>,
    metallic_factor: f64,
    roughness_factor: f64,
}

#[derive(Serialize)]
struct TextureIndex {
    index: u32,
}

#[derive(Serialize)]
struct GltfTexture {
    sampler: u32,
    source: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Sampler {
    mag_filter: u32,
    min_filter: u32,
    wrap_s: u32,
    wrap_t: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct GltfImage {
    buffer_view: usize,
    mime_type: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: usize,
    component_type: u32,
    count: usize,
    #[serde(rename = "type")]
    kind: &'static str,
    // Doubles represent floats exactly.
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<[f64; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct BufferView {
    buffer: u32,
    byte_offset: usize,
    byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Buffer {
    byte_length: usize,
}

/// The layout of the buffer: consecutive views and the arrays in them.
#[derive(Default)]
struct BufferLayout {
    accessors: Vec<Accessor>,
    views: Vec<BufferView>,
    end: usize,
}

impl BufferLayout {
    fn view(&mut self, byte_length: usize, target: Option<u32>) -> usize {
        self.views.push(BufferView { buffer: 0, byte_offset: self.end, byte_length, target });
        self.end += byte_length;
        self.views.len() - 1
    }

    /// Adds an array of `count` × `components` 32-bit words and returns its index.
    fn array(&mut self, component_type: u32, count: usize, components: usize) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3"][components - 1];
        let target = if component_type == FLOAT { ARRAY_BUFFER } else { ELEMENT_ARRAY_BUFFER };
        let buffer_view = self.view(4 * components * count, Some(target));
        self.accessors.push(Accessor { buffer_view, component_type, count, kind, min: None, max: None });
        self.accessors.len() - 1
    }
}

impl GltfDocument {
    /// Describes a file in which the mesh and then the picture of `picture` bytes are written.
    pub(super) fn new(mesh: &Mesh, model: &Model, picture: usize) -> GltfDocument {
        let mut layout = BufferLayout::default();
        let position = layout.array(FLOAT, mesh.positions.len(), 3);
        let [low, high] = mesh.bounds().map(|bound| Some(bound.map(f64::from)));
        (layout.accessors[position].min, layout.accessors[position].max) = (low, high);
        let normal = model.normals.map(|_| layout.array(FLOAT, mesh.normals.len(), 3));
        let texcoord_0 = model.map.map(|_| layout.array(FLOAT, mesh.texture.len(), 2));
        let indices = layout.array(UNSIGNED_INT, 3 * mesh.triangles.len(), 1);
        let picture = (picture > 0).then(|| layout.view(picture, None));
        let images = picture.map(|buffer_view| GltfImage { buffer_view, mime_type: "image/png" });
        let sampler = Sampler { mag_filter: LINEAR, min_filter: LINEAR_MIPMAP_LINEAR, wrap_s: REPEAT, wrap_t: REPEAT };
        // A rotation by −90° about the first axis takes z to y.
        let rotation = model.z_up.then_some([-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2]);
        let inverse = model.texture.inverse();
        GltfDocument {
            asset: Asset { version: "2.0", generator: concat!("riemap ", env!("CARGO_PKG_VERSION")) },
            scene: 0,
            scenes: [GltfScene { nodes: [0] }],
            nodes: [Node::Outer { children: [1], rotation }, Node::Inner { mesh: 0, translation: mesh.centre }],
            meshes: [GltfMesh {
                primitives: [Primitive {
                    attributes: GltfAttributes { position, normal, texcoord_0 },
                    indices,
                    material: 0,
                }],
                extras: texcoord_0.map(|_| Extras { map: inverse }),
            }],
            materials: [Material {
                double_sided: true,
                pbr_metallic_roughness: Roughness {
                    base_color_texture: picture.map(|_| TextureIndex { index: 0 }),
                    metallic_factor: 0.0,
                    roughness_factor: 0.8,
                },
            }],
            textures: picture.map(|_| GltfTexture { sampler: 0, source: 0 }).into_iter().collect(),
            samplers: picture.map(|_| sampler).into_iter().collect(),
            images: images.into_iter().collect(),
            accessors: layout.accessors,
            buffer_views: layout.views,
            buffers: [Buffer { byte_length: layout.end }],
        }
    }
}
