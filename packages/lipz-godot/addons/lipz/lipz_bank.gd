@tool
@icon("icon.svg")
class_name LipzBank
extends Resource
## A bank: visemes, subtitles and events of spoken lines ([i]clips[/i]). [code]load("res://voices.lipzbank")[/code]
## compares its checksum, and returns it, or null for a damaged bank.

const Articulation := preload("articulation.gd")
const Babble := preload("babble.gd")
const Checksum := preload("checksum.gd")
const Errors := preload("errors.gd")
const EventTable := preload("event_table.gd")
const FaceProfile := preload("face_profile.gd")
const File := preload("file.gd")
const Hashing := preload("hashing.gd")

## The plural categories of Unicode's CLDR, which come first in the keys of variants.
const PLURAL_CATEGORIES: PackedStringArray = ["zero", "one", "two", "few", "many", "other"]

## The number of clips.
var clip_count := 0
var _file: File
var _events: EventTable
var _locales: Array[LipzLocale] = []
var _pilots := PackedInt64Array()
var _segment_count := 0
## What the first query has read, by the tag of its section.
var _kept: Dictionary[String, Array] = {}
var _default_articulation: Articulation
var _default_face_profile: FaceProfile


## Opens a bank from the contents of a file. Checks its header and its directory; for files that were downloaded, call
## [method verify_checksum] as well. If the file cannot be used, prints an error with the reason, and returns null.
static func open(bytes: PackedByteArray) -> LipzBank:
	var file := _opened(bytes)
	if not file.problem.is_empty():
		push_error("lipz: ", file.problem.message)
		return null
	var bank := LipzBank.new()
	bank._read(file)
	return bank


## Returns the reason why a bank cannot be opened: `message`, `kind`, `status` and `offset_bytes`; empty if it can.
static func problem_of(bytes: PackedByteArray) -> Dictionary:
	return _opened(bytes).problem


static func _opened(bytes: PackedByteArray) -> File:
	var file := File.new(bytes)
	if file.problem.is_empty() and file.has_texts_only:
		file.problem = Errors.problem("TextsOnly", 0)
	if file.problem.is_empty():
		file.find_sections()
	return file


func _read(file: File) -> void:
	_file = file
	_events = EventTable.new(file)
	clip_count = file.section("CLIP").length >> 4
	_segment_count = maxi((file.section("STRT").length >> 2) - 1, 0)
	_locales = LipzLocale._list(file, _segment_count)
	var pilots := file.section("PILT")
	for index in pilots.length >> 2:
		_pilots.append(pilots.u32(index * 4))


## Returns the reason why texts cannot be opened for this bank; empty if they can.
func problem_of_texts(bytes: PackedByteArray) -> Dictionary:
	return _opened_texts(bytes).problem


func _opened_texts(bytes: PackedByteArray) -> File:
	var file := File.new(bytes)
	if file.problem.is_empty():
		var own := _file.data.decode_s64(File.FINGERPRINT_OFFSET)
		if bytes.decode_s64(File.FINGERPRINT_OFFSET) != own:
			file.problem = Errors.problem("OtherClips", File.FINGERPRINT_OFFSET)
	if file.problem.is_empty():
		file.find_sections()
	return file


## Adds the languages of a text bank (`.lipztexts`). Checks its header and its directory. If it cannot be used, prints
## an error and returns false.
func open_texts(bytes: PackedByteArray) -> bool:
	var file := _opened_texts(bytes)
	if not file.problem.is_empty():
		push_error("lipz: ", file.problem.message)
		return false
	_locales.append_array(LipzLocale._list(file, _segment_count))
	return true


## Compares all bytes with the checksum. Returns false if the file was changed or damaged. It takes about a
## millisecond for each 10 kB. [method @GDScript.load] has already done it.
func verify_checksum() -> bool:
	return Checksum.is_intact(_file.data)


## Compares all bytes of a text bank with its checksum. Returns false if the file was changed or damaged, or is not a
## file of lipz. Call it for files that were downloaded, before [method open_texts].
static func verify_texts(bytes: PackedByteArray) -> bool:
	return File.new(bytes).problem.is_empty() and Checksum.is_intact(bytes)


## Returns the clip with a key, such as `act1/mara-good-evening`; null if there is none.
func clip(key: String) -> LipzClip:
	if clip_count == 0 or _pilots.is_empty():
		return null
	var id := Hashing.clip_id(key)
	var slot := Hashing.slot_of(id, _file.data.decode_s64(File.SEED_OFFSET), _pilots, clip_count)
	var found := LipzClip._of(self, slot)
	return found if found != null and found._id == id and found.key == key else null


## Returns the clip with an index from 0, in the order of the keys; null if there is none.
func clip_at(index: int) -> LipzClip:
	return LipzClip._of(self, _file.section("ORDR").u32(index * 4))


## Returns all clips, in the order of their keys.
func clips() -> Array[LipzClip]:
	var list: Array[LipzClip] = []
	for index in _file.section("ORDR").length >> 2:
		var found := clip_at(index)
		if found == null:
			break
		list.append(found)
	return list


## Returns the languages, in the order of their tags, those of text banks last. Tags with `-x-` are variants of texts:
## leave them out of a menu.
func locales() -> Array[LipzLocale]:
	return _locales


## Returns the language with a tag, such as `de-de`; null if the bank does not have it.
func locale(tag: String) -> LipzLocale:
	for found in _locales:
		if found.tag == tag:
			return found
	return null


## Returns the language for a tag in any spelling, such as `de-de`, `de_DE` or `de`: the language with this tag, or the
## first one of the same language; null if the bank has neither.
func nearest_locale(tag: String) -> LipzLocale:
	var wanted := tag.to_lower().replace("_", "-")
	var found := locale(wanted)
	if found != null:
		return found
	for other in _locales:
		if other.tag.get_slice("-", 0) == wanted.get_slice("-", 0) and not other.tag.contains("-x-"):
			return other
	return null


## Returns the language for the texts of a variant: for `pl-pl` and the key `few`, those of `text_pl-pl-x-few` in Lipz
## files. A key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names
## from the end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip
## has any of these, the result is the language itself. Look variants up once per language.
func variant(language: LipzLocale, key: String) -> LipzLocale:
	var found := _variant_with_beginning(language, key)
	if found == null and key.contains("-") and key.get_slice("-", 0) in PLURAL_CATEGORIES:
		found = _variant_with_beginning(language, key.substr(key.find("-") + 1))
	return language if found == null else found


## Returns the variant with the most names of the beginning of the key; null without one.
func _variant_with_beginning(language: LipzLocale, key: String) -> LipzLocale:
	var names := key.split("-")
	while not names.is_empty():
		var found := locale(language.tag + "-x-" + "-".join(names))
		if found != null:
			return found
		names.remove_at(names.size() - 1)
	return null


## Returns the default language of the project; null without one.
func default_locale() -> LipzLocale:
	for found in _locales:
		if found.is_default:
			return found
	return null


## Returns the tags of the voices, that of the originals first; empty without dubs.
func voices() -> PackedStringArray:
	var tags := PackedStringArray()
	var section := _file.section("VOIC")
	var start := 0
	for at in section.length:
		if section.u8(at) == 0:
			tags.append(section.text(start, at - start))
			start = at + 1
	return tags


## Returns all rigs, in the order of their names.
func rigs() -> Array[LipzRig]:
	var list: Array[LipzRig] = []
	list.assign(_profiles("RIGS", LipzRig._read))
	return list


## Returns the rig with a name, such as `arkit`; null if the bank does not have it.
func rig(rig_name: String) -> LipzRig:
	return _named(_profiles("RIGS", LipzRig._read), rig_name)


## Returns all articulation profiles, each with `name`.
func articulations() -> Array:
	return _profiles("ARTC", Articulation.read)


## Returns the articulation profile with a name; for `default`, if the bank does not have it, the built-in one.
func articulation(profile_name := "default") -> Articulation:
	var found: Articulation = _named(articulations(), profile_name)
	return Articulation.new() if found == null and profile_name == "default" else found


## Returns the articulation profile of the project, which the bank keeps.
func _usual_articulation() -> Articulation:
	if _default_articulation == null:
		_default_articulation = articulation()
	return _default_articulation


## Returns all face profiles, each with `name`.
func face_profiles() -> Array:
	return _profiles("FACE", FaceProfile.read)


## Returns the face profile with a name; for `default`, if the bank does not have it, the built-in one.
func face_profile(profile_name := "default") -> FaceProfile:
	var found: FaceProfile = _named(face_profiles(), profile_name)
	return FaceProfile.new() if found == null and profile_name == "default" else found


## Returns the face profile of the project, which the bank keeps.
func _usual_face_profile() -> FaceProfile:
	if _default_face_profile == null:
		_default_face_profile = face_profile()
	return _default_face_profile


## Returns the babble profile with a name; for `default`, if the bank does not have it, the built-in one.
func babble(profile_name := "default") -> Babble:
	var found: Babble = _named(_profiles("BABL", Babble.read), profile_name)
	return Babble.new() if found == null and profile_name == "default" else found


## Reads the profiles of a section, which follow each other. A damaged one ends the list.
func _profiles(tag: String, read: Callable) -> Array:
	if not _kept.has(tag):
		var list := []
		var section := _file.section(tag)
		var at := 0
		while at < section.length:
			var profile: Variant = read.call(section, at)
			if profile == null:
				break
			list.append(profile)
			at = profile.end_bytes
		_kept[tag] = list
	return _kept[tag]


static func _named(list: Array, profile_name: String) -> Variant:
	for profile: Variant in list:
		if profile.name == profile_name:
			return profile
	return null
