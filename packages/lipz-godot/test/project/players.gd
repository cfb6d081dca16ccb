extends "node_test.gd"
## Players whose receivers skip lines or play the next one, and the languages of subtitles.

const Files := preload("files.gd")

const _LINE := "act1/mara-good-evening"
const _NEXT := "act1/otto-twenty-years"


## Returns a player whose log also has subtitles in quotation marks, and ends.
func _speaker() -> LipzPlayer:
	var player := _player(Files.bank("drama"))
	player.subtitle_changed.connect(func(text: String) -> void: _heard.append("'%s'" % text))
	player.finished.connect(func() -> void: _heard.append("finished"))
	return player


func _log() -> String:
	var log_text := " | ".join(_heard)
	_heard.clear()
	return log_text


## A receiver of the last event of a skipped line plays the next line, which must not be stopped.
func _test_next_line_while_skipping() -> void:
	var player := _speaker()
	player.event_fired.connect(func(event: LipzEvent) -> void:
		if event.object == "fog":
			player.play(_NEXT, "otto"))
	player.play(_LINE, "mara")
	_log()
	player.skip()
	_expect("the next line after a skip", player.is_playing() and player.clip.key == _NEXT, true)
	_expect("a skip and the next line", _log(),
		"mara sees otto | mara points fog | '' | finished | otto feels sad | 'Es ist seit zwanzig Jahren unterwegs.'")
	player.free()


## A receiver of the first event skips the line: all events follow, each once, and in order.
func _test_skip_in_a_receiver() -> void:
	var player := _speaker()
	player.event_fired.connect(func(event: LipzEvent) -> void:
		if event.verb == "feels":
			player.skip())
	player.play(_LINE, "mara")
	_expect("playing after a skip", player.is_playing(), false)
	_expect("a skip by a receiver", _log(), "mara feels neutral | mara sees otto | mara points fog | finished")
	player.free()


## A receiver of the end plays the next line.
func _test_next_line_at_the_end() -> void:
	var player := _speaker()
	player.finished.connect(func() -> void: player.play(_NEXT, "otto"), CONNECT_ONE_SHOT)
	player.play(_LINE, "mara")
	_log()
	player.skip()
	_expect("the next line at the end", player.is_playing() and player.clip.key == _NEXT, true)
	_expect("the end and the next line", _log(),
		"mara sees otto | mara points fog | '' | finished | otto feels sad | 'Es ist seit zwanzig Jahren unterwegs.'")
	player.free()


## A line that replaces another one begins, whatever a receiver of the end plays.
func _test_replaced_line() -> void:
	var player := _speaker()
	player.play(_LINE, "mara")
	player.finished.connect(func() -> void: player.play(_LINE, "mara"))
	_log()
	_expect("a new line", player.play(_NEXT, "otto"), true)
	_expect("a replaced line", _log(),
		"'' | finished | otto feels sad | 'Es ist seit zwanzig Jahren unterwegs.'")
	_expect("the line that plays", player.clip.key, _NEXT)
	player.free()


## A receiver of a viseme stops the line.
func _test_stop_by_a_viseme() -> void:
	var player := _speaker()
	player.viseme_changed.connect(func(_viseme: String) -> void: player.stop())
	player.play(_LINE, "mara")
	_expect("a stop by a viseme", _log(), "mara feels neutral | finished")
	player.free()


func _test_languages() -> void:
	var player := _speaker()
	var german := "'Guten Abend, Otto.'"
	var english := "'Good evening, Otto.'"
	var languages: Dictionary[String, String] = {
		"de-de": german, "de-DE": german, "de_DE": german, "de": german, "DE": german, "de-at": german,
		"en": english, "xx-xx": english, "d": english,
	}
	for tag in languages:
		player.locale = tag
		player.play(_LINE)
		player.play(_LINE)
		_expect("the language " + tag, languages[tag] in _log(), true)
	player.locale = ""
	for tag: String in ["de_DE", "de"]:
		TranslationServer.set_locale(tag)
		player.play(_LINE)
		_expect("the language of the project " + tag, german in _log(), true)
	TranslationServer.set_locale("en")
	_expect("a language without a bank's text", player.bank.nearest_locale("xx"), null)
	player.free()


## Runs all tests. Returns their number, or messages about failures.
func run() -> String:
	_test_next_line_while_skipping()
	_test_skip_in_a_receiver()
	_test_next_line_at_the_end()
	_test_replaced_line()
	_test_stop_by_a_viseme()
	_test_languages()
	return "\n".join(_problems) if not _problems.is_empty() else "6 tests"
