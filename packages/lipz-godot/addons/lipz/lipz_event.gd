@tool
class_name LipzEvent
extends RefCounted
## An event of a line in Character Event Syntax, such as `mara feels sad`.

## `feels`, `sees`, `stares`, `stops staring`, `points`, `stops pointing`, `does`, or one of the gestures `nods`,
## `shakes`, `breathes`, `blinks` and `looks away`.
var verb := ""
## The name of the character; empty for a speaker without a name.
var character := ""
## The emotion, target or action; empty without one. For a gesture, its strength as written in the file, such as `4`.
var object := ""


func _to_string() -> String:
	var words: Array[String] = [character, verb, object]
	return " ".join(words.filter(func(word: String) -> bool: return word != ""))
