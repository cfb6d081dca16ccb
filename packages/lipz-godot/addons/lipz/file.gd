@tool
extends RefCounted
## The header and the directory of a file, and its sections.

const Errors := preload("errors.gd")
const Section := preload("section.gd")

const FINGERPRINT_OFFSET := 24
const SEED_OFFSET := 32
const _MAGIC: Array[int] = [0x89, 0x4C, 0x50, 0x5A, 0x0D, 0x0A, 0x1A, 0x0A]
const _HEADER_BYTES := 64
const _ENTRY_BYTES := 16
const _COUNT_OFFSET := 40
const _MOST_SECTIONS := 64
const _FORMAT_MAJOR := 1
## The sections that a bank must have, in their order, each with the bytes of an entry.
const _BANK: Array = [
	["CLIP", 16], ["KEYS", 16], ["RATE", 16], ["PILT", 4], ["ORDR", 4], ["NAME", 1], ["FRAM", 1], ["STRT", 4],
	["LOCL", 8], ["TXST", 4], ["TEXT", 1], ["EVRF", 4], ["EVNT", 16], ["EVTY", 16], ["EVNM", 8], ["EVST", 1],
]
const _TEXTS: Array = [["NAME", 1], ["LOCL", 8], ["TXST", 4], ["TEXT", 1]]

var data: PackedByteArray
## The sections by their tags.
var sections: Dictionary[String, Section] = {}
## Whether the file is a text bank.
var has_texts_only := false
## Empty, or the reason why the file cannot be used.
var problem: Dictionary = {}


## Checks the header, but not the sections.
func _init(bytes: PackedByteArray) -> void:
	data = bytes
	problem = _header_problem()
	if problem.is_empty():
		has_texts_only = _section_count() > 0 and _tag(0) == "NAME"


## Returns the section with a tag; an empty section if the file does not have it.
func section(tag: String) -> Section:
	return sections[tag] if sections.has(tag) else Section.new()


func _section_count() -> int:
	return data.decode_u32(_COUNT_OFFSET)


func _tag(index: int) -> String:
	var at := _HEADER_BYTES + index * _ENTRY_BYTES
	return data.slice(at, at + 4).get_string_from_ascii()


func _starts_with_magic(count: int) -> bool:
	for index in count:
		if data[index] != _MAGIC[index]:
			return false
	return true


func _header_problem() -> Dictionary:
	if data.size() < _HEADER_BYTES:
		if data.size() >= 4 and not _starts_with_magic(4):
			return Errors.problem("NotABank", 0)
		return Errors.problem("TooShort", data.size())
	if not _starts_with_magic(_MAGIC.size()):
		return Errors.problem("TextMode" if _starts_with_magic(4) else "NotABank", 0)
	if data.decode_u16(20) != _FORMAT_MAJOR:
		return Errors.problem("UnsupportedVersion", 20)
	if data.decode_u32(16) != data.size():
		return Errors.problem("WrongLength", 16)
	if _section_count() > _MOST_SECTIONS:
		return Errors.problem("DirectoryTooLong", _COUNT_OFFSET)
	if _HEADER_BYTES + _section_count() * _ENTRY_BYTES > data.size():
		return Errors.problem("DirectoryOutOfBounds", _COUNT_OFFSET)
	return {}


## Finds the sections, and checks that those that the file must have are there in their order.
func find_sections() -> void:
	var needed := _TEXTS if has_texts_only else _BANK
	var found := 0
	for index in _section_count():
		var at := _HEADER_BYTES + index * _ENTRY_BYTES
		var start := data.decode_u32(at + 4)
		var length := data.decode_u32(at + 8)
		if start + length > data.size():
			problem = Errors.problem("SectionOutOfBounds", at)
			return
		var tag := _tag(index)
		if found < needed.size() and needed[found][0] == tag:
			var entry_bytes: int = needed[found][1]
			if data.decode_u16(at + 12) != entry_bytes or length % entry_bytes != 0:
				problem = Errors.problem("SectionShape", at)
				return
			found += 1
			sections[tag] = Section.new(data, start, length)
		elif data.decode_u16(at + 14) & 1:
			problem = Errors.problem("SectionUnknown", at)
			return
		elif not sections.has(tag):
			sections[tag] = Section.new(data, start, length)
	if found < needed.size():
		problem = Errors.problem("SectionMissing", _COUNT_OFFSET)
