@tool
extends RefCounted
## A face profile of a bank, or the built-in one: how faces move by themselves.

const Section := preload("section.gd")

const _RECORD_BYTES := 40
const _INTERVALS := 13

var name := "default"
## Milliseconds from one blink to the next: on a calm face, and while each of the twelve emotions is the strongest.
var blink_interval_ms: Array[int] = [
	4000, 4000, 6000, 4000, 2000, 4000, 4000, 4000, 2000, 4000, 4000, 4000, 4000,
]
var blink_length_ms := 240
var double_blink_percent := 10
var glance_percent := 20
## In thousandths of a degree.
var head_motion := 3000
var head_follows := 20000
var pose_ms := 400
var fixation_ms := 1000
## The offset after the profile in its section, in bytes.
var end_bytes := 0


## Reads the profile at an offset of a section; null if it is damaged.
static func read(section: Section, at: int) -> Variant:
	var name_length := section.u16(at + 38)
	if name_length < 0 or not section.has_bytes(at + _RECORD_BYTES, name_length):
		return null
	var profile := new()
	profile.name = section.text(at + _RECORD_BYTES, name_length)
	for index in _INTERVALS:
		profile.blink_interval_ms[index] = section.u16(at + index * 2)
	profile.blink_length_ms = section.u16(at + 26)
	profile.double_blink_percent = section.u8(at + 28)
	profile.glance_percent = section.u8(at + 29)
	profile.head_motion = section.u16(at + 30)
	profile.head_follows = section.u16(at + 32)
	profile.pose_ms = section.u16(at + 34)
	profile.fixation_ms = section.u16(at + 36)
	profile.end_bytes = at + _RECORD_BYTES + name_length
	return profile
