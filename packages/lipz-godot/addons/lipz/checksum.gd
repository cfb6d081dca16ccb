@tool
extends RefCounted
## The checksum of a bank: XXH64 of docs/reference/bank-format.md.

const _OFFSET := 8
const _FIRST := 16
## 0x9E3779B185EBCA87 and so on, as signed numbers.
const _P1 := -7046029288634856825
const _P2 := -4417276706812531889
const _P3 := 1609587929392839161
const _P4 := -8796714831421723037


static func _rotated(value: int, bits: int) -> int:
	return value << bits | (value >> (64 - bits) & ((1 << bits) - 1))


static func _shifted(value: int, bits: int) -> int:
	return value >> bits & ((1 << (64 - bits)) - 1)


static func _round(lane: int, word: int) -> int:
	return _rotated(lane + word * _P2, 31) * _P1


## Whether the contents of a file have the checksum in their header.
static func is_intact(data: PackedByteArray) -> bool:
	return of(data) == data.decode_s64(_OFFSET)


## Returns the checksum of the contents of a file.
static func of(data: PackedByteArray) -> int:
	var padded := data.slice(_FIRST)
	padded.append(1)
	padded.resize(padded.size() + 31 & ~31)
	var words := padded.to_int64_array()
	var a := _P1 + _P2
	var b := _P2
	var c := 0
	var d := -_P1
	for index in range(0, words.size(), 4):
		a = _round(a, words[index])
		b = _round(b, words[index + 1])
		c = _round(c, words[index + 2])
		d = _round(d, words[index + 3])
	var found := _rotated(a, 1) + _rotated(b, 7) + _rotated(c, 12) + _rotated(d, 18)
	for lane: int in [a, b, c, d]:
		found = (found ^ _round(0, lane)) * _P1 + _P4
	found += padded.size()
	found = (found ^ _shifted(found, 33)) * _P2
	found = (found ^ _shifted(found, 29)) * _P3
	return found ^ _shifted(found, 32)
