@tool
extends RefCounted
## Hashes of 64 bits (docs/reference/bank-format.md). Numbers are the bits of unsigned numbers, so they may be
## negative.

const _HALF := 0xFFFFFFFF
## 0x9E3779B97F4A7C15 and 0x9FB21C651E98DF25, which do not fit a signed number.
const STEP := -7046029254386353131
const FINISH := -6939452855193903323


static func mix(value: int, multiplier: int) -> int:
	var product := value * multiplier
	return product ^ (product >> 32 & _HALF)


## Returns the clip id of a key.
static func clip_id(key: String) -> int:
	var bytes := key.to_utf8_buffer()
	var count := bytes.size()
	var found := mix(count, STEP)
	bytes.resize(count + 8) # zeros after the key
	var at := 0
	while at + 8 <= count:
		found = mix(found ^ bytes.decode_s64(at), STEP)
		at += 8
	return mix(mix(found ^ bytes.decode_s64(at), STEP), FINISH)


## Returns the high 32 bits of a product of two numbers of 32 bits.
static func scale(value: int, count: int) -> int:
	return (value * count) >> 32 & _HALF


## Returns the slot to which the clip index leads from an id. [param pilots] has one number for each bucket.
static func slot_of(id: int, index_seed: int, pilots: PackedInt64Array, clip_count: int) -> int:
	var spread := mix(id ^ index_seed, STEP)
	var pilot := pilots[scale(spread >> 32 & _HALF, pilots.size())]
	if pilot & 0x80000000:
		return pilot & 0x7FFFFFFF
	var mixed := ((spread & _HALF) ^ (pilot * 0x9E3779B9 & _HALF)) * 0x85EBCA6B & _HALF
	mixed = (mixed ^ mixed >> 15) * 0xC2B2AE35 & _HALF
	return scale(mixed, clip_count)


## Returns the 16 hexadecimal digits of a number.
static func hex(value: int) -> String:
	return "%08x%08x" % [value >> 32 & _HALF, value & _HALF]
