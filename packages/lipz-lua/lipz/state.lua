--- The lasting effects of events: emotions, stares and pointing.

local event = require("lipz.event")

--- The most events of a query, so that a forged bank cannot make it last.
local MOST_STEPS = 1048576

local state = {}

--- Calls `see` for each typed event of the segments from `first` up to but not including `last`; `steps.left` limits
-- it.
local function each(clip, first, last, steps, see)
  for segment = first, last - 1 do
    steps.left = steps.left - 1
    if steps.left < 0 then return end
    event.each(clip.bank, clip.segments_first + segment, function(verb, character, object)
      steps.left = steps.left - 1
      if steps.left >= 0 then see(verb, character, object) end
    end)
  end
end

local function apply(found, verb, object)
  if verb == "feels" then found.emotion = object
  elseif verb == "stares" then found.stares_at = object
  elseif verb == "stops staring" then found.stares_at = nil
  elseif verb == "points" then found.points_at = object
  elseif verb == "stops pointing" then found.points_at = nil
  end
end

--- Returns the state of the character with a number, nil for a speaker without a name, after the segments of `ranges`.
function state.after(clip, ranges, speaker, character)
  local ids, steps = {}, { left = MOST_STEPS }
  for _, range in ipairs(ranges) do
    each(clip, range[1], range[2], steps, function(verb, of, object)
      of = of or speaker
      if of == character or (character == nil and of == speaker) then apply(ids, verb, object) end
    end)
  end
  local found = {}
  for field, id in pairs(ids) do found[field] = event.name(clip.bank, id) end
  return found
end

--- Returns the numbers of all characters in the clip's events, in the order of their names; false for a speaker
-- without a name, who comes first.
function state.characters(clip, speaker)
  local is_known, list = {}, {}
  each(clip, 0, clip.segment_count, { left = MOST_STEPS }, function(_, of)
    of = of or speaker or false
    if not is_known[of] then
      is_known[of] = true
      list[#list + 1] = of
    end
  end)
  table.sort(list, function(a, b) return (a or -1) < (b or -1) end)
  return list
end

return state
