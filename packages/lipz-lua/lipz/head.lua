--- The generated motion of the head while the mouth moves.

local chance = require("lipz.chance")
local time = require("lipz.time")
local draw, either_side, part, scaled = chance.draw, chance.either_side, chance.part, chance.scaled
local STREAMS, WHOLE = chance.STREAMS, chance.WHOLE
local floor, min, max = math.floor, math.min, math.max

local NEAR_US = 250000
local LOOKED_AT_MS = 1000
local LAST_FRAME = 4294967295

local head = {}

local query = { us = 0 }

local function frame_at(clip, us)
  query.us = max(us, 0)
  return min(time.frame(query, clip.fps_numerator, clip.fps_denominator), LAST_FRAME)
end

local function moves(clip, frame) return clip:viseme(frame) ~= "-" end

--- Returns how much the head moves, in thousandths: less, the farther the mouth is from a frame that is not rest.
local function speaking(clip, ms)
  local now_us = ms * 1000
  local now = frame_at(clip, now_us)
  local nearest = NEAR_US
  for frame = min(now, clip.frame_count - 1), frame_at(clip, now_us - NEAR_US), -1 do
    if moves(clip, frame) then
      nearest = min(nearest, max(now_us - clip:start_of_frame_us(frame + 1), 0))
      break
    end
  end
  for frame = now + 1, min(frame_at(clip, now_us + NEAR_US), clip.frame_count - 1) do
    if moves(clip, frame) then
      nearest = min(nearest, clip:start_of_frame_us(frame) - now_us)
      break
    end
  end
  return floor((NEAR_US - nearest) * 1000 / NEAR_US)
end

local function start_ms(clip, frame) return floor(clip:start_of_frame_us(frame) / 1000) end

--- Returns the time of the first change in a slot: a segment starts, or the mouth starts or stops to move; nil if
-- there is none.
local function change_ms(clip, slot_ms, length_ms)
  local start_us = slot_ms * 1000
  local end_us = start_us + min(length_ms, LOOKED_AT_MS) * 1000
  local before = frame_at(clip, start_us - 1)
  local last = min(frame_at(clip, end_us - 1), clip.frame_count - 1)
  if last < before then return nil end
  local segment = clip:segment_of_frame(last)
  local segment_start = segment and clip:segment_frames(segment) or 0
  if segment_start > before then return start_ms(clip, segment_start) end
  for frame = before, last - 1 do
    if moves(clip, frame) ~= moves(clip, frame + 1) then return start_ms(clip, frame + 1) end
  end
  return nil
end

local function eased(passed_ms, length_ms)
  local x = length_ms > 0 and min(floor(passed_ms * WHOLE / length_ms), WHOLE) or WHOLE
  return floor(floor(x * x / 65536) * (3 * WHOLE - 2 * x) / 65536)
end

local function turned(clip, profile, seed, ms, slot)
  if slot < 0 then return 0 end
  local length, half = profile.pose_ms, floor(profile.pose_ms / 2)
  local slot_ms = slot * length
  local start = change_ms(clip, slot_ms, length)
    or slot_ms + part(half, draw(seed, STREAMS.pose_time, 0, slot))
  return eased(max(ms - start, 0), half)
end

--- Returns three poses, each a number and a share in thousandths, and how far the head has turned to the second and
-- to the third.
local function poses_at_keys(clip, profile, ms, poses)
  local index = poses:index_at(frame_at(clip, ms * 1000))
  local frame, share = poses:key_thousandths(index)
  local frame_before, share_before = poses:key_thousandths(max(index - 1, 0))
  local start, length = start_ms(clip, frame), floor(profile.pose_ms / 2)
  local next_frame = poses:key_thousandths(index + 1)
  if next_frame then length = min(length, max(start_ms(clip, next_frame) - start, 0)) end
  share, share_before = max(0, min(share, 1000)), max(0, min(share_before, 1000))
  local part_done = eased(max(ms - start, 0), length)
  return frame_before, share_before, frame_before, share_before, frame, share, 0, part_done
end

local function poses_in_slots(clip, profile, seed, ms)
  local slot = profile.pose_ms > 0 and floor(ms / profile.pose_ms) or 0
  local first, second = turned(clip, profile, seed, ms, slot - 1), turned(clip, profile, seed, ms, slot)
  return max(slot - 1, 0), 1000, slot, 1000, slot + 1, 1000, first, second
end

--- Returns one angle from three poses, each a number and a share, in thousandths of a degree.
local function angle(seed, stream, most, n1, s1, n2, s2, n3, s3, part1, part2)
  local a = either_side(floor(most * s1 / 1000), draw(seed, stream, 0, n1))
  local b = either_side(floor(most * s2 / 1000), draw(seed, stream, 0, n2))
  local c = either_side(floor(most * s3 / 1000), draw(seed, stream, 0, n3))
  return a + scaled(b - a, part1, WHOLE) + scaled(c - b, part2, WHOLE)
end

local function angles(profile, seed, much, ...)
  local most = profile.head_motion
  local pitch = angle(seed, STREAMS.pitch, floor(most * 2 / 3), ...)
  local yaw = angle(seed, STREAMS.yaw, most, ...)
  local roll = angle(seed, STREAMS.roll, floor(most / 2), ...)
  return scaled(pitch, much, 1000), scaled(yaw, much, 1000), scaled(roll, much, 1000)
end

--- Returns pitch, yaw and roll in thousandths of a degree. `poses` is the curve with the times of turns, or nil.
function head.motion(clip, profile, seed, ms, poses)
  local much = speaking(clip, ms)
  if much == 0 then return 0, 0, 0 end
  if poses and poses.key_count > 0 then
    return angles(profile, seed, much, poses_at_keys(clip, profile, ms, poses))
  end
  return angles(profile, seed, much, poses_in_slots(clip, profile, seed, ms))
end

return head
