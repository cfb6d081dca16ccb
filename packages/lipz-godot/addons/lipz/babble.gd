@tool
extends RefCounted
## Babble: mouth movement without visemes, from the power of the voice. A profile of a bank, or the built-in one.

const Clock := preload("clock.gd")
const Section := preload("section.gd")

const _RECORD_BYTES := 32
const _ZERO := 48
const _OPENNESS_OF_PRODUCT := 0.0121

var name := "default"
## The offset after the profile in its section, in bytes.
var end_bytes := 0
var _ooh := "1247898743223344444443200000"
var _aah := "257998776531013446642343"
var _ooh_transfer := "0012345566778899"
var _aah_transfer := "0000123456789"
var _numerator := 24
var _denominator := 1


## Reads the profile at an offset of a section; null if it is damaged.
static func read(section: Section, start: int) -> Variant:
	var texts: Array[String] = []
	var first := start + _RECORD_BYTES
	for index in 5:
		var length := section.u16(start + 16 + index * 2)
		if length < 0 or not section.has_bytes(first, length):
			return null
		texts.append(section.text(first, length))
		first += length
	var profile := new()
	profile.name = texts[0]
	profile._ooh = texts[1]
	profile._aah = texts[2]
	profile._ooh_transfer = texts[3]
	profile._aah_transfer = texts[4]
	profile._numerator = section.u32(start + 8)
	profile._denominator = section.u32(start + 12)
	profile.end_bytes = first
	return profile if profile._numerator > 0 and profile._denominator > 0 else null


## Returns how far the lips are rounded (x) and how far the jaw is open (y), from 0 to about 1, some time after the
## voice has started. The power of the voice is from 0 to 1.
func at(elapsed_seconds: float, power: float) -> Vector2:
	return at_ns(Clock.of_seconds(elapsed_seconds), power)


func at_ns(elapsed_ns: int, power: float) -> Vector2:
	var index := Clock.frame(elapsed_ns, _numerator, _denominator)
	if index < 0 or index >= Clock.LAST_FRAME or is_nan(power):
		return Vector2.ZERO
	return Vector2(_openness(_ooh, index, _ooh_transfer, power), _openness(_aah, index, _aah_transfer, power))


static func _openness(loop: String, index: int, transfer: String, power: float) -> float:
	if loop == "" or transfer == "":
		return 0.0
	var digit := loop.unicode_at(index % loop.length()) - _ZERO
	var place := clampi(int(power * transfer.length()), 0, transfer.length() - 1)
	return digit * (transfer.unicode_at(place) - _ZERO) * _OPENNESS_OF_PRODUCT
