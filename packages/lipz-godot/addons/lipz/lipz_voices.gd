@tool
class_name LipzVoices
## Voices: the clip to play for a line that was recorded in several languages.

const _NO_DUB := 0xFFFFFFFF
const _DUB_OF := 0x80000000
const _OTHER_DUB := 0x40000000


## Returns the entry of a clip in the table of a voice, from 1 on.
static func _entry(bank: LipzBank, voice: int, slot: int) -> int:
	var found := bank._file.section("DUBS").u32(((voice - 1) * bank.clip_count + slot) * 4)
	return found if found >= 0 else _NO_DUB


## Returns the index of the voice in which a clip is spoken; 0 for an original.
static func _voice_index(clip: LipzClip) -> int:
	for voice in range(1, clip.bank.voices().size()):
		var found := _entry(clip.bank, voice, clip.slot)
		if found != _NO_DUB and found & _DUB_OF:
			return voice
	return 0


## Returns the tag of the voice in which a clip is spoken, such as `de-de`; empty without dubs.
static func voice_of(clip: LipzClip) -> String:
	var tags := clip.bank.voices()
	return tags[_voice_index(clip)] if not tags.is_empty() else ""


## Returns the clip of which a clip is a dub; null for an original.
static func original_of(clip: LipzClip) -> LipzClip:
	var voice := _voice_index(clip)
	return LipzClip._of(clip.bank, _entry(clip.bank, voice, clip.slot) & ~_DUB_OF) if voice > 0 else null


## Returns the clip to play in a voice: the clip itself, its dub, or its dub in a voice that this voice falls back to.
static func in_voice(clip: LipzClip, tag: String) -> LipzClip:
	var original := original_of(clip)
	if original == null:
		original = clip
	var voice := clip.bank.voices().find(tag)
	var dub: LipzClip = null
	if voice > 0:
		dub = LipzClip._of(clip.bank, _entry(clip.bank, voice, original.slot) & ~_OTHER_DUB)
	return dub if dub != null else original
