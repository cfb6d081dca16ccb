extends RefCounted
## A target: how far jaw, lips and tongue move for a phone or a viseme (docs/reference/bank-format.md).

const Section := preload("section.gd")

const BYTES := 12

## Percentages.
var jaw: int
var opening: int
var rounding: int
var spreading: int
var tongue_tip: int
var tongue_out: int
var tongue_back: int
## Strengths in tenths.
var jaw_strength: int
var lips_strength: int
var rounding_strength: int
## The number of the second sound of a diphthong, or the phone's own number.
var second: int
var closes_lips: bool
var touches_teeth: bool
var narrows_jaw: bool


func _init(bytes: PackedByteArray) -> void:
	jaw = bytes[0]
	opening = bytes[1]
	rounding = bytes[2]
	spreading = bytes[3]
	tongue_tip = bytes[4]
	tongue_out = bytes[5]
	tongue_back = bytes[6]
	jaw_strength = bytes[7]
	lips_strength = bytes[8]
	rounding_strength = bytes[9]
	closes_lips = bytes[10] & 1 != 0
	touches_teeth = bytes[10] & 2 != 0
	narrows_jaw = bytes[10] & 4 != 0
	second = bytes[11]


## The mouth at rest, for phones without a target.
static func rest() -> RefCounted:
	return new(PackedByteArray([5, 12, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0]))


## Returns the targets of the visemes of a type, by their codes. `""` has the target of all other codes.
static func of_visemes(viseme_type: String) -> Dictionary:
	var shapes := {
		"S": [22, 50, 15, 20, 70, 0, 20, 7, 6, 5, 0, 0],
		"M": [25, 0, 5, 0, 0, 0, 0, 7, 10, 5, 1, 0],
		"F": [20, 15, 0, 0, 0, 0, 0, 7, 10, 5, 2, 0],
		"A": [85, 85, 5, 10, 0, 0, 10, 10, 10, 10, 0, 0],
		"E": [40, 65, 5, 50, 0, 0, 0, 10, 10, 10, 0, 0],
		"O": [60, 55, 50, 0, 0, 0, 40, 10, 10, 15, 0, 0],
		"U": [28, 32, 70, 0, 0, 0, 40, 10, 14, 15, 0, 0],
		"W": [20, 15, 90, 0, 0, 0, 40, 7, 14, 15, 0, 0],
		"L": [35, 55, 5, 0, 100, 20, 0, 7, 6, 5, 0, 0],
	}
	var blair := {"B": "S", "A": "M", "G": "F", "D": "A", "C": "E", "E": "O", "F": "U"}
	var levels: Array[int] = [0, 11, 22, 33, 44, 55, 66, 77, 88, 100]
	var found := {"": new(PackedByteArray(shapes["S"]))}
	match viseme_type:
		"blair":
			for code: String in shapes:
				found[code] = new(PackedByteArray(shapes[code]))
		"toonboom":
			for code: String in blair:
				found[code] = new(PackedByteArray(shapes[blair[code]]))
		"rms":
			for digit in 10:
				var percent := levels[digit]
				found[str(digit)] = new(PackedByteArray([percent, percent, 0, 0, 0, 0, 0, 10, 10, 10, 0, 0]))
	return found


## Reads `count` targets, in the order of the numbers of the phones.
static func list(section: Section, at: int, count: int) -> Array:
	var found := []
	for index in count:
		found.append(new(section.slice(at + index * BYTES, BYTES)))
	return found
