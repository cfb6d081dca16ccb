@tool
extends RefCounted
## Targets: how far jaw, lips and tongue move for a phone or a viseme (docs/reference/bank-format.md). A target is
## the 12 bytes of its record, because reading an element of an array is faster than reading a member of an object.

const Section := preload("section.gd")

## The bytes of a target: percentages, strengths in tenths, classes, and the number of the second sound.
const JAW := 0
const OPENING := 1
const ROUNDING := 2
const SPREADING := 3
const TONGUE_TIP := 4
const TONGUE_OUT := 5
const TONGUE_BACK := 6
const JAW_STRENGTH := 7
const LIPS_STRENGTH := 8
const ROUNDING_STRENGTH := 9
const CLASSES := 10
const SECOND := 11
const BYTES := 12
## The classes.
const CLOSES_LIPS := 1
const TOUCHES_TEETH := 2
const NARROWS_JAW := 4

## The mouth at rest, for phones without a target.
static var rest := PackedByteArray([5, 12, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0])


## Returns the targets of the visemes of a type, by their codes. `""` has the target of all other codes.
static func of_visemes(viseme_type: String) -> Dictionary[String, PackedByteArray]:
	var shapes: Dictionary[String, PackedByteArray] = {
		"S": PackedByteArray([22, 50, 15, 20, 70, 0, 20, 7, 6, 5, 0, 0]),
		"M": PackedByteArray([25, 0, 5, 0, 0, 0, 0, 7, 10, 5, CLOSES_LIPS, 0]),
		"F": PackedByteArray([20, 15, 0, 0, 0, 0, 0, 7, 10, 5, TOUCHES_TEETH, 0]),
		"A": PackedByteArray([85, 85, 5, 10, 0, 0, 10, 10, 10, 10, 0, 0]),
		"E": PackedByteArray([40, 65, 5, 50, 0, 0, 0, 10, 10, 10, 0, 0]),
		"O": PackedByteArray([60, 55, 50, 0, 0, 0, 40, 10, 10, 15, 0, 0]),
		"U": PackedByteArray([28, 32, 70, 0, 0, 0, 40, 10, 14, 15, 0, 0]),
		"W": PackedByteArray([20, 15, 90, 0, 0, 0, 40, 7, 14, 15, 0, 0]),
		"L": PackedByteArray([35, 55, 5, 0, 100, 20, 0, 7, 6, 5, 0, 0]),
	}
	var found: Dictionary[String, PackedByteArray] = {}
	match viseme_type:
		"blair":
			found = shapes.duplicate()
		"toonboom":
			var blair := {"B": "S", "A": "M", "G": "F", "D": "A", "C": "E", "E": "O", "F": "U"}
			for code: String in blair:
				found[code] = shapes[blair[code]]
		"rms":
			for digit in 10:
				var percent: int = [0, 11, 22, 33, 44, 55, 66, 77, 88, 100][digit]
				found[str(digit)] = PackedByteArray([percent, percent, 0, 0, 0, 0, 0, 10, 10, 10, 0, 0])
	found[""] = shapes["S"]
	return found


## Reads `count` targets, in the order of the numbers of the phones.
static func list(section: Section, at: int, count: int) -> Array[PackedByteArray]:
	var found: Array[PackedByteArray] = []
	for index in count:
		found.append(section.slice(at + index * BYTES, BYTES))
	return found
