--- The cases of fixtures/playback/cases.txt. Prints the file with the answers of this reader, which must be the same.

local files = require("test.files")
local lipz = require("lipz")

local FEATURES = {
  lead = true, states = true, hold = true, refresh = true, ["text-banks"] = true, babble = true, curves = true,
  emotions = true, faces = true, voices = true, articulation = true,
}

local stage, answers

local function say(...) answers[#answers + 1] = "  " .. string.format(...) end

local function thousandths(value) return ("%d"):format(math.floor(value * 1000 + 0.5)) end

local function ten_thousandths(value) return ("%d"):format(math.floor(value * 10000 + 0.5)) end

--- Returns the number of 32 bits that is nearest to a number, and two of its units in the last place later, because a
-- time of 32 bits has this tolerance.
local function single(text)
  local value = tonumber(text)
  if value == 0 or value ~= value or value == math.huge or value == -math.huge then return value end
  local unit = 1
  while math.abs(value) < unit do unit = unit / 2 end
  while math.abs(value) >= unit * 2 do unit = unit * 2 end
  unit = unit * 2 ^ -23
  return (math.floor(value / unit + 0.5) + 2) * unit
end

local NUMBERS = { nan = 0 / 0, inf = math.huge, ["-inf"] = -math.huge }

local function number(word) return NUMBERS[word] or tonumber(word) end

--- Reads a time from `words`, from an index on. Returns the time and the index of the next word.
local function time_of(words, at)
  local unit = words[at]
  if unit == "us" then return { us = tonumber(words[at + 1]) }, at + 2 end
  if unit == "samples" then return { position = tonumber(words[at + 1]), rate_hz = tonumber(words[at + 2]) }, at + 3 end
  if unit == "seconds" then return number(words[at + 1]), at + 2 end
  return NUMBERS[words[at + 1]] or single(words[at + 1]), at + 2
end

local function show()
  local clip, cursor = stage.clip, stage.cursor
  local frame = cursor.frame and ("%d"):format(cursor.frame) or (cursor.is_over and "over" or "waiting")
  local line = ("frame %s, viseme %s"):format(frame, cursor:viseme())
  local openness = cursor:openness()
  if openness then line = line .. ", open " .. ten_thousandths(openness) end
  local segment = cursor:segment()
  if segment then
    line = line .. (", segment %d"):format(segment)
    local text, is_fallback = clip:text(segment, stage.locale)
    if text then line = line .. ": " .. text .. (is_fallback and " (fallback)" or "") end
  end
  answers[#answers + 1] = "  " .. line
end

local function show_due(events, segments)
  show()
  for _, segment in ipairs(segments or {}) do
    local event = stage.cursor.clip:event(segment)
    answers[#answers + 1] = ("  due %d"):format(segment)
      .. (event and (event == "" and ":" or ": " .. event) or "")
  end
  for _, event in ipairs(events or {}) do answers[#answers + 1] = "  event " .. tostring(event) end
end

local function show_state(name, state)
  local emotion, stares_at, points_at = state.emotion or "-", state.stares_at or "-", state.points_at or "-"
  say("%s: feels %s, stares %s, points %s", name or "-", emotion, stares_at, points_at)
end

local function who_of(words, at)
  if words[at] == "of" then return words[at + 1], at + 2 end
  if words[at] == "speaker" then return { speaker = words[at + 1] }, at + 2 end
  return nil, at
end

local function look_of(words, at)
  if words[at] == "ahead" then return nil, at + 1 end
  local pitch, yaw = tonumber(words[at + 1]) / 1000, tonumber(words[at + 2]) / 1000
  return { pitch = pitch, yaw = yaw, is_person = words[at] == "person" }, at + 3
end

local function show_face(face)
  local function of(name) return thousandths(face[name]) end
  say("blink %s, head %s %s %s, eyes %s %s, brows %s, shrug %s, breath %s", of("blink"), of("head_pitch"),
    of("head_yaw"), of("head_roll"), of("eye_pitch"), of("eye_yaw"), of("brows"), of("shrug"), of("breath"))
end

--- Returns a profile of the bank; "default" stands for that of the project.
local function profile_of(kind, name)
  local bank = stage.bank
  local found
  if name == "default" then found = bank["default_" .. kind](bank) else found = bank[kind](bank, name) end
  if not found then say("no profile") end
  return found
end

local function start(words)
  local clip = assert(stage.bank:clip(words[2]), words[2])
  for at = 3, #words, 2 do
    if words[at] == "rate" then
      local numerator, denominator = words[at + 1]:match("(%d+)/(%d+)")
      clip = clip:or_fps(tonumber(numerator), tonumber(denominator))
    else
      clip = clip:or_viseme_type(words[at + 1])
    end
  end
  stage.clip, stage.cursor = clip, (clip:cursor())
  if not stage.cursor then say("no frame rate") end
end

local commands = {}

function commands.bank(words)
  stage.bank, stage.locale = assert(lipz.open(files.golden(words[2] .. ".lipzbank"))), nil
  local clip = stage.cursor and stage.bank:clip(stage.clip.key)
  if clip then stage.cursor:resume(clip) end
end

function commands.texts(words) assert(stage.bank:open_texts(files.golden(words[2] .. ".lipztexts"))) end

function commands.locale(words)
  stage.locale = stage.bank:locale(words[2])
  if not stage.locale then say("no locale") end
end

function commands.variant(words)
  stage.locale = stage.bank:variant(stage.locale, words[2])
  say(stage.locale.tag)
end

commands.clip = start

function commands.speaker(words) stage.cursor:set_speaker(words[2]) end

function commands.lead(words)
  local frames = ({ one = 1, two = 2 })[words[2]]
  stage.cursor:set_lead_us(frames and stage.cursor:lead_of(frames) or tonumber(words[2]))
end

function commands.hold(words)
  local hold = tonumber(words[2]) or words[2]
  stage.cursor:set_hold(hold == "display" and { rendered_frame_us = tonumber(words[3]) } or hold)
end

function commands.advance(words) show_due(stage.cursor:advance_to((time_of(words, 2)))) end

commands["loop"] = function(words) show_due(stage.cursor:loop_to((time_of(words, 2)))) end

function commands.seek(words)
  stage.cursor:seek((time_of(words, 2)))
  show()
end

function commands.finish() show_due(stage.cursor:finish()) end

function commands.state(words)
  local name = words[2] ~= "-" and words[2] or nil
  show_state(name, stage.cursor:state(name))
end

function commands.characters()
  for _, state in ipairs(stage.cursor:characters()) do show_state(state.name, state) end
end

function commands.babble(words)
  local babble = profile_of("babble", words[2])
  if not babble then return end
  local elapsed, at = time_of(words, 3)
  local power = number(words[at + 1])
  local ooh, aah = babble:at(elapsed, words[at] == "level" and power / 65536 or power)
  say("ooh %s, aah %s", ten_thousandths(ooh), ten_thousandths(aah))
end

function commands.curves()
  for _, curve in ipairs(stage.clip:curves()) do
    local line = curve.name .. ":"
    for index = 0, curve.key_count - 1 do
      local frame, value = curve:key(index)
      line = line .. (" %d:%s"):format(frame, thousandths(value))
    end
    answers[#answers + 1] = "  " .. line
  end
end

function commands.curve(words)
  local curve = stage.clip:curve(words[2])
  if not curve then return say("no curve") end
  local value
  if words[3] == "frame" then
    value = curve:value(tonumber(words[4]))
  else
    value = curve:value_at((time_of(words, 3)))
  end
  say(value and thousandths(value) or "no frame rate")
end

function commands.emotions(words)
  local who, at = who_of(words, 2)
  local found = stage.clip:emotions_at((time_of(words, at)), who)
  local line = " "
  for _, name in ipairs(require("lipz.emotions").NAMES) do
    if found[name] ~= 0 then line = line .. (" %s %s,"):format(name, thousandths(found[name])) end
  end
  answers[#answers + 1] = ("%s strongest %s, sum %s"):format(line, found.strongest or "neutral", thousandths(found.sum))
end

function commands.face(words)
  local who, at = who_of(words, 2)
  local look, time_at = look_of(words, at + 1)
  local profile = profile_of("face_profile", words[at])
  if profile then show_face(stage.clip:face_at(time_of(words, time_at), who, profile, look)) end
end

function commands.idle(words)
  local look, at = look_of(words, 3)
  local profile = profile_of("face_profile", words[2])
  local seed = words[at] == "18446744073709551615" and ("f"):rep(16) or tonumber(words[at])
  if profile then show_face(profile:idle_at(time_of(words, at + 1), seed, look)) end
end

local function show_values(names, values)
  local list = {}
  for index, name in ipairs(names) do list[index] = name .. " " .. thousandths(values[index]) end
  answers[#answers + 1] = "  " .. table.concat(list, ", ")
end

function commands.articulation(words)
  local profile = profile_of("articulation", words[2])
  if not profile then return end
  local found = stage.clip:articulation_at((time_of(words, 3)), profile)
  local names, values = require("lipz.articulation").NAMES, {}
  for index, name in ipairs(names) do values[index] = found[name] end
  show_values(names, values)
end

function commands.weights(words)
  local rig = stage.bank:rig(words[2])
  if not rig then return say("no rig") end
  local profile = profile_of("articulation", words[3])
  if not profile then return end
  show_values(rig.weight_names, stage.clip:weights_at(time_of(words, 4), rig, { profile = profile }))
end

function commands.voices()
  for _, tag in ipairs(stage.bank:voices()) do say("%s", tag) end
end

function commands.voice(words)
  local is_known = false
  for _, tag in ipairs(stage.bank:voices()) do is_known = is_known or tag == words[2] end
  if not is_known then return say("no voice") end
  local clip, spoken = stage.clip:in_voice(words[2])
  say("%s: %s, spoken in %s", spoken, clip.key, clip:voice() or "-")
end

--- Plays all cases. Returns the number of commands that were run and skipped, and an error message or nil.
return function()
  local expected = files.read("fixtures/playback/cases.txt")
  local run, skipped, is_skipping = 0, 0, false
  stage, answers = {}, {}
  for _, line in ipairs(files.lines(expected)) do
    local is_answer = line:sub(1, 2) == "  "
    if not is_answer or is_skipping then answers[#answers + 1] = line end
    if line:sub(1, 2) == "##" then is_skipping = false end
    if line:sub(1, 6) == "needs " then
      for _, feature in ipairs(files.words(line:sub(7))) do is_skipping = is_skipping or not FEATURES[feature] end
    elseif not is_answer and line ~= "" and line:sub(1, 1) ~= "#" then
      if is_skipping then
        skipped = skipped + 1
      else
        run = run + 1
        local words = files.words(line)
        assert(commands[words[1]], line)(words)
      end
    end
  end
  return run, skipped, files.difference("cases.txt", table.concat(answers, "\n") .. "\n", expected)
end
