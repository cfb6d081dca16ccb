@tool
extends RefCounted
## The names that models give to their blend shapes. Each kind has the name of the bank's rig whose weights its shapes
## take, or of a viseme type.

## The kinds, the first of which counts if a model has the shapes of several. `mouth` lists the weights of the
## mouth, by which a kind is recognised, and `rest` all others; a star stands for both sides. `also` has further
## names of a weight.
const KINDS: Array = [
	{
		"kind": "arkit",
		"mouth": "jawOpen mouthClose mouthFunnel mouthPucker mouthRollLower mouthRollUpper mouthShrugLower mouthPress* "
		+ "mouthStretch* mouthSmile* mouthFrown* mouthUpperUp* mouthLowerDown*",
		"rest": "tongueOut cheekSquint* noseSneer* browDown* browInnerUp browOuterUp* eyeWide* eyeSquint* eyeBlink*",
		"also": {},
	},
	{
		"kind": "ovr",
		"mouth": "sil PP FF TH DD kk CH SS nn RR aa E ih oh ou",
		"rest": "",
		"also": {"ih": ["I"], "oh": ["O"], "ou": ["U"]},
	},
	{
		"kind": "vrm",
		"mouth": "aa ih ou ee oh",
		"rest": "happy angry sad surprised blink",
		"also": {
			"aa": ["A"], "ih": ["I"], "ou": ["U"], "ee": ["E"], "oh": ["O"], "happy": ["Fcl_ALL_Joy", "Joy"],
			"angry": ["Fcl_ALL_Angry"], "sad": ["Fcl_ALL_Sorrow", "Sorrow"], "surprised": ["Fcl_ALL_Surprised"],
			"blink": ["Fcl_EYE_Close"],
		},
	},
	{"kind": "mmd", "mouth": "あ い う え お ん", "rest": "まばたき にこり 怒り 困る", "also": {}},
	{
		"kind": "live2d",
		"mouth": "ParamMouthOpenY ParamMouthForm",
		"rest": "ParamEyeLOpen ParamEyeROpen",
		"also": {},
	},
	{"kind": "blair", "mouth": "A E F L M O S U W", "rest": "-", "also": {"-": ["rest"]}},
	{"kind": "toonboom", "mouth": "A B C D E F G", "rest": "-", "also": {"-": ["rest", "X"]}},
	{"kind": "rms", "mouth": "0 1 2 3 4 5 6 7 8 9", "rest": "-", "also": {"-": ["rest"]}},
]
## The kinds of a shape before its name: `viseme_aa`, `v_aa`, `Fcl_MTH_A`, `Mouth_A`.
const _PREFIXES := "^(?:arkit|fcl_mth|lipsync|mouth|mth|phoneme|v|viseme)[_ -]"
## The names of meshes and deformers before that of a shape: `blendShape1.jawOpen`, `M_F00_000_00_Fcl_MTH_A`.
const _PATHS := "^.*(?:[.:|/](?!$)|(?=Fcl_))"
## The short form of a side at the end of a name: `mouthSmile_L`, `eyeBlink.R`, `jawL`.
const _SIDES := "[_. -]([lrLR])$|(?<=[a-z])([LR])$"

var _prefix := RegEx.create_from_string("(?i)" + _PREFIXES)
var _path := RegEx.create_from_string(_PATHS)
var _side := RegEx.create_from_string(_SIDES)


## Returns the names in a list of words.
static func words(text: String) -> PackedStringArray:
	var found := PackedStringArray()
	for word in text.split(" ", false):
		if word.ends_with("*"):
			found.append(word.trim_suffix("*") + "Left")
			found.append(word.trim_suffix("*") + "Right")
		else:
			found.append(word)
	return found


## Returns the letters and digits of a name in lower case, which alone are compared.
static func letters(text: String) -> String:
	if text == "-": # the code of rest
		return text
	var found := ""
	for character in text.to_lower():
		var code := character.unicode_at(0)
		if code >= 0x80 or (code >= 0x30 and code <= 0x39) or (code >= 0x61 and code <= 0x7A):
			found += character
	return found


func _bare(text: String) -> String:
	return letters(_prefix.sub(text, ""))


## Returns the forms in which a name is compared, in the order of their similarity to it. The third one is bare:
## without path and prefix.
func forms(text: String) -> PackedStringArray:
	var plain := _path.sub(text, "")
	var sided := plain
	var side := _side.search(text)
	if side != null:
		var is_left := side.get_string().to_lower().ends_with("l")
		sided = _path.sub(text.left(side.get_start()) + ("Left" if is_left else "Right"), "")
	return PackedStringArray([letters(text), letters(plain), _bare(plain), letters(sided), _bare(sided)])


## Returns the number of letters that are missing, wrong, extra or swapped with the next.
static func _distance(a: String, b: String) -> int:
	var before: Array = []
	var last: Array = range(b.length() + 1)
	for i in range(1, a.length() + 1):
		var row: Array = [i]
		for j in range(1, b.length() + 1):
			var changed := 0 if a[i - 1] == b[j - 1] else 1
			var least: int = mini(mini(last[j] + 1, row[j - 1] + 1), last[j - 1] + changed)
			if i > 1 and j > 1 and a[i - 1] == b[j - 2] and a[i - 2] == b[j - 1]:
				least = mini(least, before[j - 2] + 1)
			row.append(least)
		before = last
		last = row
	return last[b.length()]


## Returns the name from a list that is nearest to a known name; empty if more than a third of the letters differ.
static func nearest(known: String, names: PackedStringArray) -> String:
	var wanted := letters(known)
	var best := ""
	var least := int(wanted.length() / 3.0) + 1
	for text in names:
		var found := _distance(letters(text), wanted)
		if found < least:
			best = text
			least = found
	return best
