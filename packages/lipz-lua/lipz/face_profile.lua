--- Face profiles: how faces move by themselves.

local bytes = require("lipz.bytes")
local profiles = require("lipz.profiles")
local Bank = require("lipz.bank")
local u8, u16 = bytes.u8, bytes.u16

local RECORD_BYTES = 40
local INTERVALS = 13

--- A face profile, with `name`.
local FaceProfile = {}
FaceProfile.__index = FaceProfile

local DEFAULT = setmetatable({
  name = "default",
  blink_interval_ms = { 4000, 4000, 6000, 4000, 2000, 4000, 4000, 4000, 2000, 4000, 4000, 4000, 4000 },
  blink_length_ms = 240, double_blink_percent = 10, glance_percent = 20, head_motion = 3000, head_follows = 20000,
  pose_ms = 400, fixation_ms = 1000,
}, FaceProfile)

local function read(section, at)
  local name_length = u16(section, at + 38)
  local name = bytes.text(section, at + RECORD_BYTES, name_length)
  if not name then return nil end
  local intervals = {}
  for index = 1, INTERVALS do intervals[index] = u16(section, at + (index - 1) * 2) end
  return setmetatable({
    name = name, blink_interval_ms = intervals, blink_length_ms = u16(section, at + 26),
    double_blink_percent = u8(section, at + 28), glance_percent = u8(section, at + 29),
    head_motion = u16(section, at + 30), head_follows = u16(section, at + 32),
    pose_ms = u16(section, at + 34), fixation_ms = u16(section, at + 36),
  }, FaceProfile), at + RECORD_BYTES + name_length
end

--- `bank:face_profiles()` returns all face profiles, and `bank:face_profile(name)` one of them or nil.
profiles.add_queries(Bank, "FACE", "face_profiles", "face_profile", read)

--- Returns the face profile of the project, or the built-in one.
function Bank:default_face_profile() return self:face_profile("default") or DEFAULT end

return FaceProfile
