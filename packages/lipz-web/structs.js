// The structs of lipz.h in the memory of the module. A test compares them with the header.
//
// Fields have the sizes and the alignments of C on wasm32, where pointers have 4 bytes.

const number = (size, get, set) => ({
  size,
  align: size,
  read: (view, at) => view[get](at, true),
  write: (view, at, value) => view[set](at, value, true),
});

export const u16 = number(2, "getUint16", "setUint16");
export const u32 = number(4, "getUint32", "setUint32");
export const i32 = number(4, "getInt32", "setInt32");
export const u64 = number(8, "getBigUint64", "setBigUint64");
export const i64 = number(8, "getBigInt64", "setBigInt64");
export const pointer = u32;
export const lipz_viseme = { size: 1, align: 1, read: (view, at) => String.fromCharCode(view.getUint8(at)) };

/** A struct whose fields are numbers or structs. */
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
    /** The offset of each field in bytes. */
    places: Object.fromEntries(places.map(([name, at]) => [name, at])),
    size: aligned(end, align),
    align,
    // Plain loops, because each rendered frame reads several structs.
    read(view, start) {
      const value = {};
      for (const [name, at, type] of places) value[name] = type.read(view, start + at);
      return value;
    },
    write(view, start, value) {
      for (const [name, at, type] of places) type.write(view, start + at, value[name]);
    },
  };
}

/** An array of a fixed number of numbers. */
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

export const lipz_dialogue = struct({ words: array(u32, 80) });

export const lipz_file = struct({ words: array(u32, 80) });

export const lipz_bytes = struct({ data: pointer, length_bytes: u32 });

export const lipz_problem = struct({ file: u32, offset_bytes: u32 });

export const lipz_dialogue_info_t = struct({
  clip_count: u64,
  file_count: u32,
  locale_count: u32,
  voice_count: u32,
  reserved: u32,
});

export const lipz_file_info = struct({ checksum: u64, fingerprint: u64, kind: u32, clip_count: u32 });

export const lipz_set_bank = struct({ file_name: lipz_string, checksum: u64, length_bytes: u32, clip_count: u32 });

export const lipz_clip = struct({
  id: u64,
  version: u32,
  file: u32,
  slot: u32,
  frame_count: u32,
  segment_count: u32,
  fps_numerator: u32,
  fps_denominator: u32,
  viseme_type: u32,
  has_visemes: u32,
  has_events: u32,
});

export const lipz_time = struct({ count: i64, rate_hz: u32, reserved: u32 });

export const lipz_segment = struct({
  clip_id: u64,
  version: u32,
  file: u32,
  slot: u32,
  index: u32,
  start_frame: u32,
  end_frame: u32,
});

export const lipz_recording = struct({ length_us: u64, content_hash: u64 });

export const lipz_voice = struct({ tag: lipz_string, version: u32, place: u32, is_original: u32 });

export const lipz_voiced_clip = struct({ clip: lipz_clip, spoken: u32, reserved: u32 });

export const lipz_locale = struct({ tag: lipz_string, version: u32, place: u32, is_default: u32 });

export const lipz_text = struct({ data: pointer, length_bytes: u32, is_fallback: u32 });

export const lipz_name = struct({ name: lipz_string, bank: u32, id: u32 });

export const lipz_event = struct({ character: lipz_name, object: lipz_name, verb: u32, strength_thousandths: u32 });

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

export const lipz_babble = struct({ name: lipz_string, index: u32, version: u32 });

export const lipz_weights = struct({ ooh: u32, aah: u32 });

export const lipz_curve = struct({
  name: lipz_string,
  key_count: u32,
  version: u32,
  file: u32,
  slot: u32,
  place: u32,
  fps_numerator: u32,
  fps_denominator: u32,
  reserved: u32,
});

export const lipz_curve_key_t = struct({ frame: u32, thousandths: i32 });

export const lipz_curve_cursor = struct({ key: u32 });

export const lipz_who = struct({ name: lipz_string, is_speaker: u32 });

export const lipz_emotions = struct({ thousandths: array(i32, 12), strongest: u32, sum: i32 });

export const lipz_face_profile = struct({ name: lipz_string, index: u32, version: u32 });

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

export const lipz_articulation = struct({ thousandths: array(u16, 9) });

export const lipz_articulation_profile = struct({ name: lipz_string, index: u32, version: u32 });

export const lipz_rig = struct({ name: lipz_string, index: u32, version: u32, weight_count: u32, reserved: u32 });
