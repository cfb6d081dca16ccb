@tool
extends RefCounted
## The errors of a file that cannot be opened, with the numbers and messages of docs/reference/bank-format.md.

const _MESSAGES: Dictionary = {
	"TooShort": [1, "the file is shorter than the header of a bank"],
	"NotABank": [2, "the file is not a lipz bank"],
	"TextMode": [3, "the bank was damaged by a copy in text mode (line endings were converted)"],
	"UnsupportedVersion": [4, "the bank has a format version that this reader does not support"],
	"WrongLength":
	[5, "the file does not have the length in its header (cut off, or with bytes appended)"],
	"DirectoryOutOfBounds": [6, "the directory reaches past the end of the file"],
	"SectionOutOfBounds": [7, "a section reaches past the end of the file"],
	"SectionShape": [8, "the entry size or the length of a section is wrong"],
	"SectionMissing": [9, "a section that every bank has is missing"],
	"SectionUnknown":
	[10, "the bank needs a newer reader (a required section is unknown or out of order)"],
	"Checksum": [12, "the checksum does not match: the file was changed or damaged"],
	"DirectoryTooLong": [26, "the directory has more than 64 sections"],
	"OtherClips": [28, "the texts belong to a bank with other clips"],
	"TextsOnly": [29, "the file contains only texts, for the clips of another bank"],
}


## Returns a problem: `kind`, `status` (the number of the error), `offset_bytes` and `message`.
static func problem(kind: String, offset_bytes: int) -> Dictionary:
	var found: Array = _MESSAGES[kind]
	var message := "%s (status %d, at byte %d)" % [found[1], found[0], offset_bytes]
	return {"kind": kind, "status": found[0], "offset_bytes": offset_bytes, "message": message}
