@tool
class_name LipzLocale
extends RefCounted
## A language of a bank, with the texts of all clips. Get it with [method LipzBank.locale].

const Section := preload("section.gd")
const File := preload("file.gd")

const _RECORD_BYTES := 8
const _NO_TEXT := 0xFFFFFFFF
const _FALLBACK := 0x80000000
const _HAS_LENGTH := 0x40000000
const _OFFSET := 0x3FFFFFFF
const _COUNT_BYTES := 3

## The tag, such as `de-de`.
var tag := ""
## Whether it is the default language of the project.
var is_default := false
var _starts: Section
var _texts: Section
var _first_entry := 0


## Returns the locales of a file, in the order of their tags.
static func _list(file: File, segment_count: int) -> Array[LipzLocale]:
	var list: Array[LipzLocale] = []
	var records := file.section("LOCL")
	for index in records.length >> 3:
		var at := index * _RECORD_BYTES
		var locale := LipzLocale.new()
		locale.tag = file.section("NAME").text(records.u32(at), records.u16(at + 4))
		locale.is_default = records.u16(at + 6) & 1 != 0
		locale._starts = file.section("TXST")
		locale._texts = file.section("TEXT")
		locale._first_entry = index * segment_count
		list.append(locale)
	return list


## Returns the entry of the segment with a number, or -1 without a text. `first` is the number of the clip's first
## one.
func _entry(first: int, number: int) -> int:
	var first_entry := _starts.u32((_first_entry + first) * 4)
	if first_entry < 0 or first_entry == _NO_TEXT:
		return -1
	return _starts.u32((_first_entry + number) * 4)


func _text(first: int, number: int) -> String:
	var entry := _entry(first, number)
	if entry < 0:
		return ""
	var offset := entry & _OFFSET
	if not entry & _HAS_LENGTH:
		var next := _starts.u32((_first_entry + number + 1) * 4)
		return _texts.text(offset, (next & _OFFSET) - offset) if next >= 0 else ""
	if not _texts.has_bytes(offset, _COUNT_BYTES):
		return ""
	var high := _texts.u8(offset) & 63
	var middle := _texts.u8(offset + 1) & 63
	return _texts.text(offset + _COUNT_BYTES, high * 4096 + middle * 64 + (_texts.u8(offset + 2) & 63))


func _is_fallback(first: int, number: int) -> bool:
	var entry := _entry(first, number)
	return entry >= 0 and entry & _FALLBACK != 0
