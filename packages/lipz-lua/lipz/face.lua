--- Faces: blinks, head and eyes, from generated motion and curves. Inside this module, values are in thousandths.

local chance = require("lipz.chance")
local emotions = require("lipz.emotions")
local head = require("lipz.head")
local time = require("lipz.time")
local u64 = require("lipz.u64")
local Clip = require("lipz.clip")
local Curve = require("lipz.curve")
local FaceProfile = require("lipz.face_profile")
local draw, either_side, part, scaled = chance.draw, chance.either_side, chance.part, chance.scaled
local STREAMS, WHOLE = chance.STREAMS, chance.WHOLE
local floor, min, max = math.floor, math.min, math.max

local SACCADE_MS = 50
local OF_A_FACE = { { 0, 1900 }, { 0, -1900 }, { -4000, 0 } }
local GLANCE_DOWN, GLANCE_MORE, GLANCE_ASIDE = 10000, 8000, 12000
local NEUTRAL, DEGREES_PER_UNIT = 5000, 2
local HEAD_MOST = 60000

--- The neutral value of each curve of a face.
local CURVES = {
  blink = 0, headPitch = 0, headYaw = 0, headRoll = 0, eyePitch = 0, eyeYaw = 0, lids = 0, nod = NEUTRAL,
  shake = NEUTRAL, lookPitch = 0, lookYaw = 0, brows = 0, shrug = 0, breath = 0,
}

local face = {}

--- Returns how far the lids are closed, some time after a blink has started.
local function closed_after(passed, length, is_double)
  local again = length + floor(length / 2)
  if is_double and passed >= again then passed = passed - again end
  local closing, open_from = floor(length / 4), floor(length / 2)
  if passed < closing then return floor(passed * 1000 / closing) end
  if passed < open_from then return 1000 end
  return floor(max(length - passed, 0) * 1000 / (length - open_from))
end

local feelings, blink_query = {}, { us = 0 }

--- Returns the interval between blinks at a time in milliseconds. `clip` is nil for a silent character.
local function interval_at(profile, clip, who, ms)
  blink_query.us = ms * 1000
  local strongest = clip and emotions.strongest(emotions.thousandths(clip, blink_query, who, feelings)) or 0
  return profile.blink_interval_ms[strongest + 1]
end

local function is_first(intervals, place)
  for before = 1, place - 1 do
    if intervals[before] == intervals[place] then return false end
  end
  return true
end

local function blink(profile, seed, ms, clip, who)
  local most, intervals = 0, profile.blink_interval_ms
  for place, interval in ipairs(intervals) do
    if interval > 0 and is_first(intervals, place) then
      local phase = part(interval, draw(seed, STREAMS.blink_phase, interval, 0))
      local last = floor((ms + phase) / interval)
      for slot = max(last - 1, 0), last do
        local late = part(floor(interval / 2), draw(seed, STREAMS.blink_time, interval, slot))
        local start = slot * interval + floor(interval / 4) + late - phase
        if start >= 0 and start <= ms then
          local is_double = part(100, draw(seed, STREAMS.double_blink, interval, slot)) < profile.double_blink_percent
          local closed = closed_after(ms - start, profile.blink_length_ms, is_double)
          if closed > most and interval_at(profile, clip, who, start) == interval then most = closed end
        end
      end
    end
  end
  return most
end

local function fixation(profile, seed, number)
  if part(100, draw(seed, STREAMS.glance, 0, number)) < profile.glance_percent then
    local down = GLANCE_DOWN + part(GLANCE_MORE, draw(seed, STREAMS.eye_pitch, 0, number))
    return -down, either_side(GLANCE_ASIDE, draw(seed, STREAMS.eye_yaw, 0, number))
  end
  local target = OF_A_FACE[part(#OF_A_FACE, draw(seed, STREAMS.target, 0, number)) + 1]
  return target[1], target[2]
end

local function eyes(profile, seed, ms, look)
  local pitch = look and floor(look.pitch * 1000 + 0.5) or 0
  local yaw = look and floor(look.yaw * 1000 + 0.5) or 0
  if look and look.is_person == false then return pitch, yaw end
  local before, now, done = chance.step(seed, ms, STREAMS.fixation_time, profile.fixation_ms, SACCADE_MS)
  local pitch_before, yaw_before = fixation(profile, seed, before)
  local pitch_now, yaw_now = fixation(profile, seed, now)
  return pitch + pitch_before + scaled(pitch_now - pitch_before, done, WHOLE),
    yaw + yaw_before + scaled(yaw_now - yaw_before, done, WHOLE)
end

--- Returns the parts of an angle by which the eyes turn, and by which the head follows them.
local function shared(profile, angle)
  local turned = max(-profile.head_follows, min(angle, profile.head_follows))
  return turned, max(-HEAD_MOST, min(angle - turned, HEAD_MOST))
end

--- Reads the values of the curves of a face into `values`, and returns the curve `pose`.
local function read_curves(clip, at, who, values)
  for name in pairs(CURVES) do values[name] = nil end
  local poses, frame, done
  if clip.fps_numerator then frame, done = time.position(at, clip.fps_numerator, clip.fps_denominator) end
  for _, found in ipairs(clip:curves_of(who)) do
    local neutral = CURVES[found.purpose]
    if found.purpose == "pose" then
      if not poses or #poses.name <= #found.curve.name then poses = found.curve end
    elseif neutral and frame then
      local value, before = found.curve:thousandths(frame, done), values[found.purpose]
      values[found.purpose] = before and Curve.farther(before, value, neutral) or value
    end
  end
  return poses
end

local function swing(value) return ((value or NEUTRAL) - NEUTRAL) * DEGREES_PER_UNIT end

--- Writes the face at a time into `out`, in thousandths. `clip` is nil for a silent character.
local function compute(profile, seed, at, look, clip, who, values, head_moves, poses, out)
  local ms = time.milliseconds(at)
  out.blink = max(values.blink or blink(profile, seed, ms, clip, who), values.lids or 0)
  local pitch, yaw, roll = 0, 0, 0
  if head_moves then pitch, yaw, roll = head.motion(clip, profile, seed, ms, poses) end
  local eye_pitch, eye_yaw = eyes(profile, seed, ms, look)
  local follow_pitch, follow_yaw
  out.eye_pitch, follow_pitch = shared(profile, (values.eyePitch or eye_pitch) + (values.lookPitch or 0))
  out.eye_yaw, follow_yaw = shared(profile, (values.eyeYaw or eye_yaw) + (values.lookYaw or 0))
  out.head_pitch = (values.headPitch or pitch) + swing(values.nod) + follow_pitch
  out.head_yaw = (values.headYaw or yaw) + swing(values.shake) + follow_yaw
  out.head_roll = values.headRoll or roll
  out.brows, out.shrug, out.breath = values.brows or 0, values.shrug or 0, values.breath or 0
  return out
end

local values, clip_seed, NO_VALUES = {}, {}, {}

--- Writes the face of a character of the clip at a time into `out`, in thousandths.
function face.thousandths(clip, at, who, profile, look, out)
  profile = profile or clip.bank:default_face_profile()
  local poses = read_curves(clip, at, who, values)
  clip_seed[1], clip_seed[2] = clip.id_high, clip.id_low
  local is_speaker = type(who) ~= "string"
  if not is_speaker then
    local high, low = u64.clip_id(who)
    clip_seed[1], clip_seed[2] = u64.xor32(high, clip.id_high), u64.xor32(low, clip.id_low)
  end
  local head_moves = is_speaker and clip.fps_numerator ~= nil
  return compute(profile, clip_seed, at, look, clip, who, values, head_moves, poses, out)
end

local function in_units(out)
  for name, value in pairs(out) do out[name] = value / 1000 end
  return out
end

--- Returns the face of a character of the clip at a time: `blink`, `brows` and `shrug` from 0 to 1; `head_pitch`,
-- `head_yaw`, `head_roll`, `eye_pitch` and `eye_yaw` in degrees; `breath` from 0 to 10. `who` is as in `emotions_at`.
-- `look` is the target of the gaze, `{ pitch = degrees, yaw = degrees }`, with `is_person = false` for a thing; nil
-- for a person straight ahead. Pass the same table as `out` in each rendered frame, so that none is created.
function Clip:face_at(at, who, profile, look, out)
  return in_units(face.thousandths(self, at, who, profile, look, out or {}))
end

--- Returns the face of a silent character at a time. Characters differ by their seeds: a number below 2^53, or 16
-- hexadecimal digits such as the id of a clip.
function FaceProfile:idle_at(at, seed, look, out)
  local number = { 0, seed or 0 }
  if type(seed) == "string" then
    number[1], number[2] = tonumber(seed:sub(1, 8), 16), tonumber(seed:sub(9, 16), 16)
  elseif seed then
    number[1], number[2] = floor(seed / 4294967296), seed % 4294967296
  end
  return in_units(compute(self, number, at, look, nil, nil, NO_VALUES, false, nil, out or {}))
end

return face
