//! Binary glTF files: the JSON part, and numbers of its accessors (Khronos, glTF 2.0, sections 3.6 and 4).

use lipz_diagnostics::{Code, Diagnostic};
use serde_json::Value;

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BIN_CHUNK: &[u8] = b"BIN\0";
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
/// The component type of 32-bit floating-point numbers.
const FLOAT: u64 = 5126;
const FLOAT_BYTES: usize = 4;

/// A file: its JSON part, and its buffer.
pub(super) struct Glb<'b> {
    pub(super) json: Value,
    buffer: &'b [u8],
}

impl<'b> Glb<'b> {
    /// Reads a file. Reports what is wrong with it.
    pub(super) fn read(bytes: &'b [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<Glb<'b>> {
        if bytes.get(..MAGIC.len()) != Some(MAGIC) {
            let diagnostic = Diagnostic::new(Code::ForeignSyntax, "the file is not a binary glTF file");
            diagnostics
                .push(diagnostic.help("export the animation as .glb or .vrma; .gltf files in JSON are not read"));
            return None;
        }
        let mut rest = bytes.get(HEADER_BYTES..).unwrap_or_default();
        let (mut json, mut buffer) = (None, &[][..]);
        while let Some((header, content)) = rest.split_at_checked(CHUNK_HEADER_BYTES) {
            let (length, kind) = header.split_at(4);
            let length =
                usize::try_from(u32::from_le_bytes(length.try_into().unwrap_or_default())).unwrap_or(usize::MAX);
            let Some((chunk, after)) = content.split_at_checked(length) else {
                diagnostics.push(cut_off());
                return None;
            };
            match kind {
                JSON_CHUNK => json = Some(chunk),
                BIN_CHUNK => buffer = chunk,
                _ => {}
            }
            rest = after;
        }
        let Some(json) = json else {
            diagnostics.push(cut_off());
            return None;
        };
        match serde_json::from_slice(json) {
            Ok(json) => Some(Glb { json, buffer }),
            Err(error) => {
                let message = format!("the JSON part of the file is not JSON: {error}");
                diagnostics.push(Diagnostic::new(Code::ForeignSyntax, message));
                None
            }
        }
    }

    /// Returns the numbers of an accessor, which must be of the type `kind` and have this number of components.
    pub(super) fn floats(&self, accessor: &Value, kind: &str, components: usize) -> Option<Vec<f32>> {
        let accessor = self.json.get("accessors")?.get(index(accessor)?)?;
        let is_plain = accessor.get("componentType")?.as_u64() == Some(FLOAT)
            && accessor.get("type")?.as_str() == Some(kind)
            && accessor.get("sparse").is_none();
        let view = self.json.get("bufferViews")?.get(index(accessor.get("bufferView")?)?)?;
        let offset = |of: &Value| of.get("byteOffset").map_or(Some(0), index);
        let count = index(accessor.get("count")?)?.checked_mul(components)?;
        let start = offset(view)?.checked_add(offset(accessor)?)?;
        let end = start.checked_add(count.checked_mul(FLOAT_BYTES)?)?;
        let bytes = self.buffer.get(start..end).filter(|_| is_plain && view.get("byteStride").is_none())?;
        Some(
            bytes
                .chunks_exact(FLOAT_BYTES)
                .map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap_or_default()))
                .collect(),
        )
    }
}

/// Returns a JSON number as an index.
pub(super) fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

fn cut_off() -> Diagnostic {
    Diagnostic::new(Code::ForeignCutOff, "the file ends too early: a part of it is not complete")
        .help("make or copy the file again; the copy or the tool may have been interrupted")
}
