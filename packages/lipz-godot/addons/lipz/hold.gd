@tool
extends RefCounted
## Consonant hold: keeps consonants on the screen long enough to be seen (docs/guides/playback.md, lead and hold).

const _CONSONANTS: Dictionary = {"blair": "MSWFL", "toonboom": "ABFG", "rms": ""}


## Counts the frames from `frame` in a direction that are vowels or rests, at most `most`.
static func _open(codes: String, consonants: String, frame: int, step: int, most: int) -> int:
	var count := 0
	while count < most and frame >= 0 and frame < codes.length() and not consonants.contains(codes[frame]):
		count += 1
		frame += step
	return count


## Returns the frames that the consonant at `frame` lacks, when its frames are counted in a direction.
static func _missing(codes: String, frame: int, step: int, most: int) -> int:
	if frame < 0 or frame >= codes.length():
		return 0
	var code := codes[frame]
	var run := 0
	while run <= most and frame >= 0 and frame < codes.length() and codes[frame] == code:
		run += 1
		frame += step
	return maxi(most - run, 0)


## Returns the frame whose viseme is shown instead of that of `frame`.
static func shown(codes: String, viseme_type: String, hold: int, frame: int) -> int:
	var consonants: String = _CONSONANTS.get(viseme_type, "")
	if hold < 2 or consonants == "" or frame >= codes.length() or consonants.contains(codes[frame]):
		return frame
	var before := _open(codes, consonants, frame - 1, -1, hold)
	var behind := _open(codes, consonants, frame + 1, 1, hold)
	var spare := before + behind
	var missing_before := _missing(codes, frame - before - 1, -1, hold) if before < hold else 0
	var taken_before := mini(missing_before, spare)
	if before < taken_before:
		return frame - before - 1
	var after := frame + behind + 1
	var missing_behind := _missing(codes, after, 1, hold) if behind < hold else 0
	var room := _open(codes, consonants, after + hold - missing_behind, 1, hold)
	var early := missing_behind - maxi(room - 1, 0)
	return after if behind < mini(early, spare - taken_before) else frame
