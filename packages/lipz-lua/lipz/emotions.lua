--- Emotions: the curves of twelve names (docs/guides/faces.md).

local Clip = require("lipz.clip")
local Curve = require("lipz.curve")
local time = require("lipz.time")

local NAMES = {
  "sadness", "anger", "joy", "fear", "disgust", "surprise", "shock", "perplexed", "asleep", "pain", "exertion", "shout",
}
local INDICES = {}
for index, name in ipairs(NAMES) do INDICES[name] = index end

local emotions = { NAMES = NAMES }

--- Writes the thousandths of the twelve emotions at a time into `out`, in the order of `NAMES`.
function emotions.thousandths(clip, at, who, out)
  for index = 1, #NAMES do out[index] = 0 end
  if not clip.fps_numerator then return out end
  local frame, part = time.position(at, clip.fps_numerator, clip.fps_denominator)
  for _, found in ipairs(clip:curves_of(who)) do
    local index = INDICES[found.purpose]
    if index then out[index] = Curve.farther(out[index], found.curve:thousandths(frame, part), 0) end
  end
  return out
end

--- Returns the index of the strongest emotion; nil if all are at most 0.
function emotions.strongest(thousandths)
  local strongest, most = nil, 0
  for index = 1, #NAMES do
    if thousandths[index] > most then strongest, most = index, thousandths[index] end
  end
  return strongest
end

local scratch = {}

--- Returns the emotions of a character at a time: a value, usually from 0 to 10, for each of the twelve names; `sum`;
-- and `strongest`, a name or nil. `who` is nil for the speaker, `{ speaker = name }`, or the name of a different
-- character. Pass the same table as `out` in each rendered frame, so that none is created.
function Clip:emotions_at(at, who, out)
  out = out or {}
  local sum, thousandths = 0, emotions.thousandths(self, at, who, scratch)
  for index, name in ipairs(NAMES) do
    out[name] = thousandths[index] / 1000
    sum = sum + thousandths[index]
  end
  out.sum = sum / 1000
  out.strongest = NAMES[emotions.strongest(thousandths)]
  return out
end

return emotions
