--- The golden dumps of fixtures/banks/v1. Prints the answers of this reader to every query, which must be the same.

local files = require("test.files")
local lipz = require("lipz")
local u64 = require("lipz.u64")

local LONGEST_BYTES, START_CHARACTERS = 400, 40
local BANKS = {
  { "drama" }, { "small" }, { "stripped", dump = "small" }, { "split", dump = "small", texts = { "de-de", "en-us" } },
  { "wide" }, { "curves" }, { "faces" }, { "specials" }, { "phones" }, { "rigs" }, { "recorded" },
  { "dubbed" }, { "variants" }, { "long" },
}
local TYPES = { blair = "Blair", toonboom = "ToonBoom", rms = "Rms" }

local out

local function put(format, ...) out[#out + 1] = string.format(format, ...) end

local function escaped(text)
  text = text:gsub('[%z\1-\31\127"\\]', function(c) return ("\\u{%x}"):format(c:byte()) end)
  text = text:gsub("\194([\128-\160])", function(c) return ("\\u{%x}"):format(c:byte()) end)
  return (text:gsub("\226\128\139", "\\u{200b}"):gsub("\226\128\175", "\\u{202f}"))
end

--- FNV-1a of 64 bits.
local function fnv(text)
  local high, low = 0xCBF29CE4, 0x84222325
  for at = 1, #text do
    high, low = u64.mul(high, u64.xor32(low, text:byte(at)), 0x100, 0x1B3)
  end
  return u64.hex(high, low)
end

local function quoted(text)
  if #text <= LONGEST_BYTES then return '"' .. escaped(text) .. '"' end
  local start, count = {}, 0
  for character in text:gmatch("[^\128-\191][\128-\191]*") do
    count = count + 1
    if count > START_CHARACTERS then break end
    start[count] = character
  end
  return ('"%s"... %d bytes, fnv %s'):format(escaped(table.concat(start)), #text, fnv(text))
end

local function some(value) return value and ("Some(%d)"):format(value) or "None" end

--- A number as the dumps print it: without zeros at its end.
local function plain(value)
  local thousandths = math.floor(value * 1000 + 0.5)
  local size = math.abs(thousandths)
  local text = ("%d.%03d"):format(math.floor(size / 1000), size % 1000):gsub("%.?0+$", "")
  if size % 1000 == 0 then text = ("%d"):format(size / 1000) end
  return (thousandths < 0 and "-" or "") .. text
end

local function put_sampled(clip)
  put("  at 24 fps, each 50 ms: ")
  local before
  for step = 0, 199 do
    local at = { us = step * 50000 }
    local segment = clip:segment_at(at)
    if segment ~= before then
      put("%s", segment and ("[%d]"):format(segment) or "[end]")
      before = segment
    end
    if not segment then
      assert(clip:viseme_at(at) == "-")
      break
    end
    put("%s", clip:viseme_at(at))
  end
  put("\n")
end

local function put_mouth(clip)
  put("\nclip %s %s\n", clip.key, clip.id)
  local rate = clip.fps_numerator and ("Fps(%d/%d)"):format(clip.fps_numerator, clip.fps_denominator) or "unspecified"
  put("  rate %s, type %s\n", rate, TYPES[clip.viseme_type] or "unspecified")
  put("  visemes %s, events %s\n", tostring(clip.has_visemes), tostring(clip.has_events))
  local duration = clip.fps_numerator and clip:start_of_frame_us(clip.frame_count)
  put("  %d frames %s, %s us\n", clip.frame_count, clip:frames(), some(duration))
  put_sampled(clip:or_fps(24))
end

local function put_voices(bank, clip)
  local original = clip:original()
  if original then put("  dub of %s in %s\n", original.key, clip:voice()) end
  for _, tag in ipairs(original and {} or bank:voices()) do
    local voiced, spoken = clip:in_voice(tag)
    if spoken ~= "original" then put("  in %s %s (%s)\n", tag, voiced.key, spoken == "dub" and "Dub" or "OtherDub") end
  end
end

local function put_curves(clip)
  local length_us, hash = clip:recording()
  if length_us then put("  recording %d us, content %s\n", length_us, hash) end
  local rated = clip:or_fps(24)
  for _, curve in ipairs(clip:curves()) do
    put("  curve %s", quoted(curve.name))
    for index = 0, curve.key_count - 1 do
      local frame, value = curve:key(index)
      put(" %d:%s", frame, plain(value))
    end
    put(", each 50 ms:")
    for step = 0, 19 do put(" %s", plain(rated:curve(curve.name):value_at({ us = step * 50000 }))) end
    put("\n")
  end
end

local FACE = { "blink", "head_pitch", "head_yaw", "head_roll", "eye_pitch", "eye_yaw", "brows", "shrug", "breath" }

local function put_faces(clip, profile)
  put("  face %s, each 150 ms", quoted(profile.name))
  for step = 0, 66 do
    local face = clip:face_at({ us = step * 150000 }, nil, profile)
    for index, name in ipairs(FACE) do put("%s%s", index == 1 and ": " or " ", plain(face[name])) end
  end
  put("\n")
end

--- The names of the phones, from the table of the format.
local function phone_names()
  local names = {}
  local section = files.read("docs/reference/bank-format.md"):match("\n## Phones\n(.-)\n## ")
  for number, arpabet, ipa in section:gmatch("\n| (%d+) | ([^|]*)| ([^|]*)|%f[\n]") do
    local name = (arpabet:match("`(.*)`") or ipa:match("`(.*)`"))
    if name then names[tonumber(number)] = name end
  end
  return names
end

local names = phone_names()

local function put_articulation(bank, clip, profile)
  local phones, list = clip:phones(), {}
  for index = 0, phones.count - 1 do
    local number, start_ms = phones:start(index)
    list[#list + 1] = ("%s@%d"):format(names[number] or "?", start_ms)
  end
  put("  phones %s, certain %s, %s dB\n", table.concat(list, " "), tostring(phones.are_certain), some(phones.level_db))
  put("  articulation %s, each 50 ms", quoted(profile.name))
  for step = 0, 19 do
    local found = clip:articulation_at({ us = step * 50000 }, profile)
    for index, name in ipairs(require("lipz.articulation").NAMES) do
      put("%s%d", index == 1 and ": " or " ", math.floor(found[name] * 1000 + 0.5))
    end
  end
  put("\n")
  for _, rig in ipairs(bank:rigs()) do
    put("  rig %s", quoted(rig.name))
    local weights = clip:weights_at({ us = 500000 }, rig, { profile = profile })
    for index, name in ipairs(rig.weight_names) do put(" %s %s", name, plain(weights[index])) end
    put("\n")
  end
end

local function put_segment(bank, clip, segment)
  local first, last = clip:segment_frames(segment)
  put("  segment %d frames %d..%d us %s..%s\n", segment, first, last, some(clip:start_of_frame_us(first)),
    some(clip:start_of_frame_us(last)))
  local event = clip:event(segment)
  if event then put("    event %s\n", quoted(event)) end
  for _, typed in ipairs(clip:events(segment)) do put('    typed "%s"\n', escaped(tostring(typed))) end
  for _, locale in ipairs(bank:locales()) do
    local text, is_fallback = clip:text(segment, locale)
    if text then put("    %s %s%s\n", locale.tag, quoted(text), is_fallback and " (fallback)" or "") end
  end
end

local function put_profile(profile)
  put("face %s, blinks", quoted(profile.name))
  for _, interval in ipairs(profile.blink_interval_ms) do put(" %d", interval) end
  put(" ms, each %d, %d %% double, head %d %d, pose %d ms, glances %d %%, fixation %d ms\n", profile.blink_length_ms,
    profile.double_blink_percent, profile.head_motion, profile.head_follows, profile.pose_ms, profile.glance_percent,
    profile.fixation_ms)
end

local function dump(bank)
  out = {}
  put("format 1, %d clips\n", bank.clip_count)
  for _, locale in ipairs(bank:locales()) do
    put("locale %s%s\n", locale.tag, locale.is_default and " default" or "")
  end
  for index, tag in ipairs(bank:voices()) do put("voice %s%s\n", tag, index == 1 and " original" or "") end
  for _, profile in ipairs(bank:face_profiles()) do put_profile(profile) end
  for clip in bank:clips() do
    put_mouth(clip)
    put_voices(bank, clip)
    put_curves(clip)
    for _, profile in ipairs(bank:face_profiles()) do put_faces(clip, profile) end
    for _, profile in ipairs(bank:articulations()) do put_articulation(bank, clip, profile) end
    for segment = 0, clip.segment_count - 1 do put_segment(bank, clip, segment) end
  end
  return table.concat(out)
end

--- Compares all dumps. Returns their number and an error message or nil.
return function()
  for _, case in ipairs(BANKS) do
    local name = case[1]
    local bank = assert(lipz.open(files.golden(name .. ".lipzbank")))
    for _, tag in ipairs(case.texts or {}) do
      assert(bank:open_texts(files.golden(("%s.%s.lipztexts"):format(name, tag))))
    end
    local problem = files.difference(name .. ".dump", dump(bank), files.golden((case.dump or name) .. ".dump"))
    if problem then return 0, problem end
  end
  return #BANKS, nil
end
