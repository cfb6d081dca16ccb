--- Segments and frames outside a clip have no texts, events or frames, although clips lie next to each other in a bank.

local files = require("test.files")
local lipz = require("lipz")

local function check(is_right, clip, query, index) assert(is_right, ("%s: %s(%d)"):format(clip.key, query, index)) end

--- Makes the queries. Returns their number.
return function()
  local count = 0
  for _, name in ipairs({ "drama", "small" }) do
    local bank = assert(lipz.open(files.golden(name .. ".lipzbank")))
    for clip in bank:clips() do
      for _, segment in ipairs({ -1, -2, clip.segment_count, clip.segment_count + 1 }) do
        local first, last = clip:segment_frames(segment)
        check(first == 0 and last == 0, clip, "segment_frames", segment)
        check(clip:event(segment) == nil, clip, "event", segment)
        check(#clip:events(segment) == 0, clip, "events", segment)
        for _, locale in ipairs(bank:locales()) do check(clip:text(segment, locale) == nil, clip, "text", segment) end
        count = count + 3 + #bank:locales()
      end
      for _, frame in ipairs({ -1, -100, clip.frame_count }) do
        check(clip:segment_of_frame(frame) == nil, clip, "segment_of_frame", frame)
        count = count + 1
      end
    end
  end
  return count
end
