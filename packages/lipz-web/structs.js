// The structs of lipz.h in the memory of the module: a test compares them with the header.
//
// Fields have the sizes and the alignments of C on wasm32, where pointers have 4 bytes.

export const u32 = {
  size: 4,
  align: 4,
  read: (view, at) => view.getUint32(at, true),
  write: (view, at, value) => view.setUint32(at, value, true),
};
export const i32 = {
  size: 4,
  align: 4,
  read: (view, at) => view.getInt32(at, true),
  write: (view, at, value) => view.setInt32(at, value, true),
};
export const u64 = {
  size: 8,
  align: 8,
  read: (view, at) => view.getBigUint64(at, true),
  write: (view, at, value) => view.setBigUint64(at, value, true),
};
export const pointer = u32;
export const lipz_viseme = { size: 1, align: 1, read: (view, at) => String.fromCharCode(view.getUint8(at)) };

/** A struct with these fields, each of which is a number or a struct. */
function struct(fields) {
  const places = [];
  let end = 0;
  let align = 1;
  for (const [name, type] of Object.entries(fields)) {
    const at = aligned(end, type.align);
    places.push([name, at, type]);
    end = at + type.size;
    align = Math.max(align, type.align);
  }
  return {
    fields,
    /** Where each field stands. */
    places: Object.fromEntries(places.map(([name, at]) => [name, at])),
    size: aligned(end, align),
    align,
    read: (view, start) => Object.fromEntries(places.map(([name, at, type]) => [name, type.read(view, start + at)])),
    write: (view, start, value) => places.forEach(([name, at, type]) => type.write(view, start + at, value[name])),
  };
}

/** An array of so many numbers. */
function array(of, length) {
  const places = Array.from({ length }, (_, index) => index * of.size);
  return {
    of,
    length,
    size: of.size * length,
    align: of.align,
    read: (view, start) => places.map((at) => of.read(view, start + at)),
    write: (view, start, values) => places.forEach((at, index) => of.write(view, start + at, values[index])),
  };
}

function aligned(at, align) {
  return Math.ceil(at / align) * align;
}

export const lipz_string = struct({ data: pointer, length_bytes: u32 });

export const lipz_bank = struct({
  data: pointer,
  length_bytes: u32,
  texts: pointer,
  texts_length_bytes: u32,
  places: array(u32, 34),
});

export const lipz_bank_info_t = struct({
  fingerprint: u64,
  clip_count: u32,
  locale_count: u32,
  format_major: u32,
  format_minor: u32,
});

export const lipz_clip = struct({
  id: u64,
  slot: u32,
  frame_count: u32,
  segment_count: u32,
  fps_numerator: u32,
  fps_denominator: u32,
  viseme_type: u32,
  has_visemes: u32,
  has_events: u32,
});

export const lipz_recording = struct({ length_us: u64, content_hash: u64 });

export const lipz_voiced_clip = struct({ clip: lipz_clip, spoken: u32, reserved: u32 });

export const lipz_segment = struct({ clip_id: u64, index: u32, start_frame: u32, end_frame: u32, reserved: u32 });

export const lipz_text = struct({ data: pointer, length_bytes: u32, is_fallback: u32 });

export const lipz_locale = struct({ tag: lipz_string, index: u32, is_default: u32, bank: u32 });

export const lipz_name = struct({ name: lipz_string, id: u32, bank: u32 });

export const lipz_event = struct({ character: lipz_name, object: lipz_name, verb: u32 });

export const lipz_cursor = struct({
  size_bytes: u32,
  frame: u32,
  clip_id: u64,
  fps_numerator: u32,
  fps_denominator: u32,
  viseme_type: u32,
  lead_us: u32,
  hold_frames: u32,
  speaker_id: u32,
  speaker_bank: u32,
  mouth_frame: u32,
  next_segment: u32,
  flags: u32,
  due_segment: u32,
  due_end: u32,
  due_around_to: u32,
  due_event: u32,
});

export const lipz_character = struct({
  name: lipz_name,
  feels: lipz_name,
  stares_at: lipz_name,
  points_at: lipz_name,
});

export const lipz_curve = struct({ name: lipz_string, place: u32, key_count: u32, bank: u32 });

export const lipz_curve_cursor = struct({ key: u32 });

export const lipz_curve_key = struct({ frame: u32, thousandths: i32 });

export const lipz_who = struct({ name: lipz_string, is_speaker: u32 });

export const lipz_emotions = struct({ thousandths: array(i32, 12), strongest: u32, sum: i32 });

export const lipz_babble = struct({ name: lipz_string, index: u32, bank: u32 });

export const lipz_weights = struct({ ooh: u32, aah: u32 });

export const lipz_face_profile = struct({ name: lipz_string, index: u32, bank: u32 });

export const lipz_look_at = struct({ pitch: i32, yaw: i32, is_person: u32 });

export const lipz_face = struct({
  blink: i32,
  head_pitch: i32,
  head_yaw: i32,
  head_roll: i32,
  eye_pitch: i32,
  eye_yaw: i32,
  brows: i32,
  shrug: i32,
  breath: i32,
});
export const lipz_layered_clip = struct({ clip: lipz_clip, layer: u32, texts_layer: u32, texts_id: u64 });

export const lipz_layered_voiced_clip = struct({ clip: lipz_layered_clip, spoken: u32, reserved: u32 });

export const lipz_layered_locale = struct({ locale: lipz_locale, is_stand_in: u32 });

export const lipz_layers_info_t = struct({ babble_layer: u32, default_locale_layer: u32, faces_layer: u32 });

export const lipz_set = struct({ data: pointer, length_bytes: u32 });

export const lipz_set_info_t = struct({ fingerprint: u64, clip_count: u64, bank_count: u32, moved_count: u32 });

export const lipz_set_bank = struct({
  file_name: lipz_string,
  checksum: u64,
  fingerprint: u64,
  length_bytes: u32,
  clip_count: u32,
});
