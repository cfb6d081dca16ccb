@tool
class_name LipzShapes
extends RefCounted
## The blend shapes of a model, by their names: which of them take the weights of a rig.

const ShapeNames := preload("shape_names.gd")

const _MOST_LISTED := 5

## The name of the rig whose weights the shapes take, or a viseme type; empty if none has a known name.
var kind := ""
## The names of the weights.
var weight_names := PackedStringArray()
## For each weight, the index of its shape in the list of names; -1 without one.
var indices := PackedInt32Array()
## A sentence about weights without a shape; empty if none is missing.
var report := ""


## Recognises the shapes of a model by a list of their names. With a rig of a bank, finds the shapes for its weights.
static func recognise(names: PackedStringArray, rig: LipzRig = null) -> LipzShapes:
	var reader := ShapeNames.new()
	var degrees := _forms_of(reader, names)
	var found := LipzShapes.new()
	if rig != null:
		found.kind = rig.name
		found.weight_names = rig.weight_names
	else:
		found._recognise_kind(reader, degrees)
	var also: Dictionary = _kind_of(found.kind).get("also", {})
	for weight in found.weight_names:
		found.indices.append(_index_of(reader, weight, degrees, also))
	found._write_report(names)
	return found


## Returns, for each degree of similarity, the index of a name by its form in this degree.
static func _forms_of(reader: ShapeNames, names: PackedStringArray) -> Array[Dictionary]:
	var degrees: Array[Dictionary] = [{}, {}, {}, {}, {}]
	for index in names.size():
		var forms := reader.forms(names[index])
		for degree in forms.size():
			if forms[degree] != "" and not degrees[degree].has(forms[degree]):
				degrees[degree][forms[degree]] = index
	return degrees


static func _index_of(reader: ShapeNames, weight: String, degrees: Array[Dictionary], also: Dictionary) -> int:
	var known := PackedStringArray([ShapeNames.letters(weight)])
	for text: String in also.get(weight, []):
		known.append(ShapeNames.letters(text))
	known.append(reader.forms(weight)[2]) # a rig may have a prefix that the model lacks
	for by_form in degrees:
		for form in known:
			if by_form.has(form):
				return by_form[form]
	return -1


static func _kind_of(kind_name: String) -> Dictionary:
	for found: Dictionary in ShapeNames.KINDS:
		if found.kind == kind_name:
			return found
	return {}


## Finds the kind of which the model has the most shapes of the mouth.
func _recognise_kind(reader: ShapeNames, degrees: Array[Dictionary]) -> void:
	var most := 0
	for found: Dictionary in ShapeNames.KINDS:
		var count := 0
		for weight in ShapeNames.words(found.mouth):
			count += 1 if _index_of(reader, weight, degrees, found.also) >= 0 else 0
		if count > most:
			most = count
			kind = found.kind
			weight_names = ShapeNames.words(found.mouth) + ShapeNames.words(found.rest)


func _write_report(names: PackedStringArray) -> void:
	var others := PackedStringArray()
	for index in names.size():
		if not indices.has(index):
			others.append(names[index])
	if kind == "":
		report = "none of %d shapes has a known name (%s)" % [names.size(), _listed(others)]
		return
	var missing := PackedStringArray()
	for index in weight_names.size():
		if indices[index] < 0 and weight_names[index] != LipzClip.REST: # a mesh without weights rests
			var similar := ShapeNames.nearest(weight_names[index], others)
			missing.append(weight_names[index] + (" (did you mean %s?)" % similar if similar != "" else ""))
	if not missing.is_empty():
		report = "%d of %d shapes of %s are missing: %s" % [missing.size(), weight_names.size(), kind, _listed(missing)]


static func _listed(texts: PackedStringArray) -> String:
	var more := texts.size() - _MOST_LISTED
	var shown := ", ".join(texts.slice(0, _MOST_LISTED))
	return "%s, %d more" % [shown, more] if more > 0 else shown
