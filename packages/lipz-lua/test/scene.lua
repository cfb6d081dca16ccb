--- The sample, played without a window.

local files = require("test.files")

local EXPECTED = [[
Good evening, Otto.
mara feels neutral
You are late,
mara sees otto
and the fog is early.
mara points fog
Es ist seit zwanzig Jahren unterwegs.
otto feels sad
Es ist hinter den Briefmarkenschrank gefallen.
otto stares parcel
Keiner hat nachgesehen.
otto stops staring
Nicht mal ich.
mara feels thinking
]]

--- Plays the scene. Returns the number of rendered frames, and an error message or nil.
return function()
  local new_scene = dofile((rawget(_G, "lipz_test_package") or ".") .. "/sample/scene.lua")
  local said, events, frames, opened, blinked, last = {}, {}, 0, 0, 0, nil
  local scene = new_scene(files.golden("drama.lipzbank"), function(event) events[#events + 1] = tostring(event) end)
  while scene:update(1 / 60) do
    frames = frames + 1
    local subtitle = scene:subtitle()
    if subtitle and subtitle ~= last then
      said[#said + 1], last = subtitle, subtitle
      for _, event in ipairs(events) do said[#said + 1] = event end
      events = {}
    end
    opened, blinked = math.max(opened, scene.mouth.opening), math.max(blinked, scene.face.blink)
  end
  assert(opened > 0.6 and blinked > 0.9, "the face moves")
  return frames, files.difference("scene", table.concat(said, "\n") .. "\n", EXPECTED)
end
