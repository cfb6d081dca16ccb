--- Articulation: how far jaw, lips and tongue are from rest.

local blend = require("lipz.blend")
local bytes = require("lipz.bytes")
local profiles = require("lipz.profiles")
local targets = require("lipz.targets")
local time = require("lipz.time")
local Bank = require("lipz.bank")
local Clip = require("lipz.clip")
require("lipz.phones")

local NAMES = {
  "jaw", "opening", "closure", "teeth", "rounding", "spreading", "tongue_tip", "tongue_out", "tongue_back",
}
local INDICES = {}
for index, name in ipairs(NAMES) do INDICES[name] = index end

local RECORD_BYTES = 16
local GAIN_PER_DB, LEAST_GAIN, MOST_GAIN = 35, 700, 1300
local REACH_MS, MOST_MS, MOST_US = 150, 400, 400000
local MOST_NEAR = 24
local GLIDE_PERCENT, SHORTEST_GLIDE_US = 55, 30000
local LONGEST_FRAME_US = 1000000
local REST = "-"

local articulation = { NAMES = NAMES }

--- An articulation profile, with `name`.
local DEFAULT = {
  name = "default", targets = {}, gain_percent = 100, jaw_percent = 100, lead_ms = 10, level_db = -20,
}

local function read(section, at)
  local name_length, count = bytes.u16(section, at), bytes.u16(section, at + 2)
  local name = bytes.text(section, at + RECORD_BYTES, name_length)
  local first = name and at + RECORD_BYTES + name_length
  if not first or not bytes.part(section, first, targets.length(count)) then return nil end
  return {
    name = name, targets = targets.read(section, first, count),
    gain_percent = bytes.u16(section, at + 4), jaw_percent = bytes.u16(section, at + 6),
    lead_ms = bytes.i16(section, at + 8), level_db = bytes.i16(section, at + 10),
  }, first + targets.length(count)
end

--- `bank:articulations()` returns all articulation profiles, and `bank:articulation(name)` one of them or nil.
profiles.add_queries(Bank, "ARTC", "articulations", "articulation", read)

--- Returns the articulation profile of the project, or the built-in one.
function Bank:default_articulation() return self:articulation("default") or DEFAULT end

local function gain_at(profile, level_db)
  local louder_db = level_db and level_db - profile.level_db or 0
  local line = math.max(LEAST_GAIN, math.min(louder_db * GAIN_PER_DB + 1000, MOST_GAIN))
  return math.floor(line * profile.gain_percent / 100)
end

--- Returns the microseconds from the query, at `ms` and `us`, to a time in milliseconds.
local function until_ms(start_ms, ms, us) return math.max(-MOST_MS, math.min(start_ms - ms, MOST_MS)) * 1000 - us end

local function add_phones(phones, at, profile)
  local ms, us = -MOST_MS, 0
  if time.has_begun(at) then
    local part
    ms, part = time.position(at, 1000, 1)
    ms, us = ms + profile.lead_ms, math.floor(part * 1000 / 65536)
  end
  local first = math.max(phones:started_by(math.max(ms - REACH_MS, 0)) - 1, 0)
  for index = first, first + MOST_NEAR - 1 do
    local number, start_ms = phones:start(index)
    if not number or start_ms > math.max(ms + REACH_MS, 0) then return end
    if number ~= 0 then
      local target = profile.targets[number + 1] or targets.REST
      local start_us, end_us = until_ms(start_ms, ms, us), until_ms(phones:end_ms(index), ms, us)
      if target.second ~= number and end_us - start_us > SHORTEST_GLIDE_US then
        local glide_us = start_us + math.floor((end_us - start_us) * GLIDE_PERCENT / 100)
        blend.add(start_us, glide_us, target)
        start_us, target = glide_us, profile.targets[target.second + 1] or targets.REST
      end
      blend.add(start_us, end_us, target)
    end
  end
end

local function add_visemes(clip, at)
  if not clip.fps_numerator or not clip.viseme_type or not time.has_begun(at) then return end
  local frame, part = time.position(at, clip.fps_numerator, clip.fps_denominator)
  local frame_us = math.max(1, math.min(clip:start_of_frame_us(1), LONGEST_FRAME_US))
  local reach = math.floor(MOST_US / frame_us) + 1
  local start, last = math.max(frame - reach, 0), math.min(frame + reach, clip.frame_count)
  local passed_us = math.floor(frame_us * math.floor(part / 16) / 4096)
  local start_us = -((frame - start) * frame_us + passed_us)
  while start < last do
    local viseme, length = clip:viseme(start), 1
    while start + length < last and clip:viseme(start + length) == viseme do length = length + 1 end
    local end_us = start_us + length * frame_us
    if viseme ~= REST then blend.add(start_us, end_us, targets.of_viseme(clip.viseme_type, viseme)) end
    start, start_us = start + length, end_us
  end
end

--- Writes the thousandths of the nine values at a time into `out`, in the order of `NAMES`.
function articulation.thousandths(clip, at, profile, out)
  profile = profile or clip.bank:default_articulation()
  local phones = clip:phones()
  blend.start(phones.are_certain)
  if phones.count > 0 then add_phones(phones, at, profile) else add_visemes(clip, at) end
  local rest = profile.targets[1] or targets.REST
  blend.finish(rest, gain_at(profile, phones.level_db), profile.jaw_percent, out)
  if not clip.fps_numerator then return out end
  local frame, part = time.position(at, clip.fps_numerator, clip.fps_denominator)
  for _, curve in ipairs(clip:curves()) do
    local index = INDICES[curve.name]
    if index then out[index] = math.max(0, math.min(curve:thousandths(frame, part), 1000)) end
  end
  return out
end

local scratch = {}

--- Returns the articulation at a time: `jaw`, `opening`, `closure`, `teeth`, `rounding`, `spreading`, `tongue_tip`,
-- `tongue_out` and `tongue_back`, each from 0 to 1. Without a profile, uses the project's. Pass the same table as
-- `out` in each rendered frame, so that none is created.
function Clip:articulation_at(at, profile, out)
  out = out or {}
  articulation.thousandths(self, at, profile, scratch)
  for index, name in ipairs(NAMES) do out[name] = scratch[index] / 1000 end
  return out
end

return articulation
