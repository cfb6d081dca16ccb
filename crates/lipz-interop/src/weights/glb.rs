//! Binary glTF files: a JSON part and a buffer of numbers (Khronos, glTF 2.0, section 4).

use serde_json::{Value, json};

const MAGIC: u32 = 0x4654_6C67;
const VERSION: u32 = 2;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BIN_CHUNK: u32 = 0x004E_4942;
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
/// The component type of 32-bit floating-point numbers.
const FLOAT: u32 = 5126;

/// The numbers of a file, and the accessors that name ranges of them.
#[derive(Default)]
pub(super) struct GlbBuffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl GlbBuffer {
    /// Adds numbers that belong together by `components`, of the type `SCALAR` or `VEC3`. Returns their accessor.
    pub(super) fn floats(&mut self, numbers: &[f32], components: usize, kind: &str) -> usize {
        let offset = self.bytes.len();
        numbers.iter().for_each(|number| self.bytes.extend_from_slice(&number.to_le_bytes()));
        let bound = |fold: fn(f32, f32) -> f32| -> Vec<f32> {
            let of_component = |component| numbers.iter().skip(component).step_by(components).copied();
            (0..components).filter_map(|component| of_component(component).reduce(fold)).collect()
        };
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": self.bytes.len() - offset }));
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": FLOAT,
            "count": numbers.len() / components.max(1),
            "type": kind,
            "min": bound(f32::min),
            "max": bound(f32::max),
        }));
        self.accessors.len() - 1
    }

    /// Returns the file with these other parts, which are an object.
    pub(super) fn file(self, mut parts: Value) -> Vec<u8> {
        parts["asset"] = json!({ "version": "2.0", "generator": concat!("lipz ", env!("CARGO_PKG_VERSION")) });
        parts["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        parts["bufferViews"] = self.views.into();
        parts["accessors"] = self.accessors.into();
        let mut json = parts.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let chunks = [(JSON_CHUNK, json), (BIN_CHUNK, self.bytes)];
        let length = HEADER_BYTES + chunks.iter().map(|(_, bytes)| CHUNK_HEADER_BYTES + bytes.len()).sum::<usize>();
        let word = |length: usize| u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes();
        let mut file = Vec::with_capacity(length);
        file.extend_from_slice(&MAGIC.to_le_bytes());
        file.extend_from_slice(&VERSION.to_le_bytes());
        file.extend_from_slice(&word(length));
        for (kind, bytes) in chunks {
            file.extend_from_slice(&word(bytes.len()));
            file.extend_from_slice(&kind.to_le_bytes());
            file.extend_from_slice(&bytes);
        }
        file
    }
}
