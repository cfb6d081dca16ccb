@tool
extends RefCounted
## A section of a file: little-endian numbers at offsets in bytes from its start. A read outside the section returns
## -1, so a damaged bank cannot cause an error.

var data: PackedByteArray
## The offset of the section in the file, in bytes.
var start: int
## The length of the section, in bytes.
var length: int


func _init(file := PackedByteArray(), start_bytes := 0, length_bytes := 0) -> void:
	data = file
	start = start_bytes
	length = length_bytes


## Whether the bytes from [param at] are inside the section.
func has_bytes(at: int, count: int) -> bool:
	return at >= 0 and count >= 0 and at + count <= length


func u8(at: int) -> int:
	return data[start + at] if at >= 0 and at < length else -1


func u16(at: int) -> int:
	return data.decode_u16(start + at) if at >= 0 and at + 2 <= length else -1


## A signed number; 0 outside the section.
func i16(at: int) -> int:
	return data.decode_s16(start + at) if at >= 0 and at + 2 <= length else 0


func u32(at: int) -> int:
	return data.decode_u32(start + at) if at >= 0 and at + 4 <= length else -1


## A signed number; 0 outside the section.
func i32(at: int) -> int:
	return data.decode_s32(start + at) if at >= 0 and at + 4 <= length else 0


## The bits of an unsigned number of 64 bits; 0 outside the section.
func u64(at: int) -> int:
	return data.decode_s64(start + at) if at >= 0 and at + 8 <= length else 0


func slice(at: int, count: int) -> PackedByteArray:
	return data.slice(start + at, start + at + count) if has_bytes(at, count) else PackedByteArray()


## A string in UTF-8; empty if it is not inside the section.
func text(at: int, count: int) -> String:
	return slice(at, count).get_string_from_utf8() if count > 0 else ""
