@tool
extends RefCounted
## Phones: the units of speech in a clip, and their times.

const Section := preload("section.gd")

const _RECORD_BYTES := 8
const _OFFSET := 0x3FFFFFFF
const _CERTAIN := 0x40000000
const _WIDE := 0x80000000
const _UNKNOWN_LEVEL := 0x80
## The length of the last phone of a clip without frames.
const _LAST_MS := 100

## The number of each phone, and its start in milliseconds.
var numbers := PackedInt64Array()
var starts_ms := PackedInt64Array()
## The end of the last phone in milliseconds.
var end_ms := 0
## Whether the phones come from the text of the recording.
var are_certain := true
var has_level := false
## The level of the speech in decibels relative to full scale.
var level_db := 0


## Reads the phones of a clip.
func _init(clip: LipzClip) -> void:
	var records := clip.bank._file.section("PHNC")
	var index := LipzCurve._find_slot(records, clip.slot)
	if index < 0:
		return
	var data := clip.bank._file.section("PHON")
	var flags := records.u32(index * _RECORD_BYTES + 4)
	var next := records.u32((index + 1) * _RECORD_BYTES + 4)
	var first := flags & _OFFSET
	var last := next & _OFFSET if next >= 0 else data.length
	if last <= first or not data.has_bytes(first, last - first):
		return
	are_certain = flags & _CERTAIN != 0
	has_level = data.u8(first) != _UNKNOWN_LEVEL
	level_db = data.u8(first) - 256 if data.u8(first) >= 128 else data.u8(first)
	_read(data, first + 1, last, flags & _WIDE != 0)
	if not numbers.is_empty():
		end_ms = _last_end_ms(clip)


func _read(data: Section, first: int, last: int, is_wide: bool) -> void:
	var entry_bytes := 5 if is_wide else 3
	for at in range(first, last - entry_bytes + 1, entry_bytes):
		numbers.append(data.u8(at))
		starts_ms.append(data.u32(at + 1) if is_wide else data.u16(at + 1))


func _last_end_ms(clip: LipzClip) -> int:
	if clip.frame_count > 0 and clip.fps_numerator > 0:
		@warning_ignore("integer_division")
		return clip.start_of_frame_us(clip.frame_count) / 1000
	return starts_ms[starts_ms.size() - 1] + _LAST_MS


## Returns the phones of a clip, which it keeps.
static func of(clip: LipzClip) -> RefCounted:
	if clip._phones == null:
		clip._phones = new(clip)
	return clip._phones
